"""What `veduta photos` leaves in OUT: models, clouds, pictures, walls, the place and the report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from veduta.formats.laz import write_laz
from veduta.photos.cameras.component import Component
from veduta.photos.decoded import DecodedPhotos
from veduta.photos.laying import Laid
from veduta.photos.panorama_file import write_panoramas
from veduta.photos.pictures import write_pictures
from veduta.photos.placing import CLOUD, PICTURES, place_of
from veduta.photos.report import Told, failed_report, photos_report
from veduta.photos.structure import Structure, model_of
from veduta.photos.texture.files import PARTS, TEXTURES
from veduta.photos.texture.step import can_texture, texture_step
from veduta.photos.walls.document import WALLS, Unit
from veduta.photos.walls.step import picture_walls, write_walls
from veduta.photos.world.document import GEOREF, georef_document, write_georef
from veduta.photos.world.georeference import Georeference
from veduta.photos.world.georeferencing import References
from veduta.run.errors import NotFoundError
from veduta.run.outputs import OutFolder, writing_to
from veduta.run.progress import StepProgress
from veduta.run.record import CALL
from veduta.run.report import Failure, Report, timed_step

SPARSE = "sparse"
BY_GPS = (
    "the model is textured from where GPS alone says, as --georef gps asks: what photos show lies"
    " metres off its facades"
)


def write_results(
    laid: Sequence[Laid],
    references: References,
    told: Told,
    opened: OutFolder,
    key: str,
    progress: StepProgress,
) -> None:
    """Write everything that lies in OUT; the first component is the place."""
    first = laid[0]
    pictures, read_photo = opened.work_folder(PICTURES), DecodedPhotos(told.photos)
    with timed_step(told.steps, "pictures"), writing_to(opened.path):
        structure, cameras = write_pictures(
            first.component.structure, read_photo, pictures, progress
        )
    told.laid = [replace(first, component=replace(first.component, structure=structure)), *laid[1:]]
    told.components = [one.component for one in told.laid]
    with timed_step(told.steps, "pictures of walls") as step:
        told.walls = picture_walls(structure, first.walls, read_photo, told.options.walls, progress)
        step.counts["pictures"] = len(told.walls.pictures)
    sparse, work = opened.work_folder(SPARSE), opened.work_folder(CALL)
    walls = work / WALLS
    walls.mkdir()
    world = first.georef.accepted
    with writing_to(opened.path):
        _texture(structure, read_photo, world, references, told, work, progress)
    with timed_step(told.steps, "write"), writing_to(opened.path):
        _write_models(told.components, sparse)
        crs, origin = (None, (0.0, 0.0, 0.0)) if world is None else (world.crs, world.origin_m)
        write_laz(structure.points, structure.colours, work / CLOUD, crs=crs, origin_m=origin)
        write_panoramas([one.structure for one in told.components], work)
        write_georef(georef_document([one.georef for one in told.laid]), work / GEOREF)
        unit: Unit = "unknown" if world is None else "metres"
        part = write_walls(told.walls, structure, unit, work, walls)
        place_of(structure, cameras, part, world, told.textured).save(work)
    report, page = photos_report(told)
    _write_report(report, page, opened, work)
    opened.publish(SPARSE, key, sparse)
    opened.publish(PICTURES, key, pictures)
    opened.publish(WALLS, key, walls)
    for item in (TEXTURES, PARTS):  # without textures what a former call left there goes
        (work / item).mkdir(exist_ok=True)
        opened.publish(item, key, work / item)
    summary = {**report.measures, "left": [list(pair) for pair in told.left]}
    opened.publish(CALL, key, work, summary)


def _texture(
    structure: Structure,
    read_photo: DecodedPhotos,
    world: Georeference | None,
    references: References,
    told: Told,
    work: Path,
    progress: StepProgress,
) -> None:
    """The city model's faces from the photos of the first component, where they lie in it."""
    city = references.model
    by_gps = told.options.world.georef == "gps"
    if city is None or not can_texture(world, city, told.options.texture, by_gps=by_gps):
        return
    if world is not None and world.method == "gps":
        told.alarms.append(BY_GPS)
    with timed_step(told.steps, "texture") as step:
        try:
            told.textured = texture_step(
                structure, read_photo, city, told.options.texture, work, progress
            )
        except NotFoundError as error:
            told.notes.append(f"no textures: {error}")
            step.rejected.append(str(error))
        else:
            step.counts["faces textured"] = told.textured.measures["faces_textured"]


def write_failure(opened: OutFolder, key: str, told: Told, error: NotFoundError) -> None:
    """Say why there is nothing; what an earlier call left is taken away."""
    failure = Failure(subject=told.folder, kind="not-found", reason=str(error))
    work = opened.work_folder(CALL)
    _write_report(*failed_report(told, failure), opened, work)
    for item in (SPARSE, PICTURES, WALLS, TEXTURES, PARTS):
        opened.publish(item, key, opened.work_folder(item))
    opened.publish(CALL, key, work, {"left": [list(pair) for pair in told.left]}, failure)


def _write_models(components: Sequence[Component], sparse: Path) -> None:
    """A folder of each component, as COLMAP has it: binary and text."""
    for number, component in enumerate(components):
        folder = sparse / str(number)
        folder.mkdir()
        model = model_of(component.structure)
        model.update_point_3d_errors()
        model.write_binary(folder)
        model.write_text(folder)


def _write_report(report: Report, page: bytes, opened: OutFolder, work: Path) -> None:
    with writing_to(opened.path):
        (work / "report.json").write_bytes(report.to_json())
        (work / "report.html").write_bytes(page)
