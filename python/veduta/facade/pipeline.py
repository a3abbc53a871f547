"""One photo becomes a building: read, rectify, analyse, model, write.

An edited document takes the second way in: load, model, write.
"""

from __future__ import annotations

import io
import math
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.facade.analyse import read_houses
from veduta.facade.cleared import BEFORE, before_png, hidden_kinds, load_before
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.eyes import Seen, look
from veduta.facade.house_folders import house_folder, main_house
from veduta.facade.load import DOCUMENT, PHOTO, load_document, load_photo
from veduta.facade.model import Model, build_model
from veduta.facade.options import FacadeOptions, ModelOptions, StyleOptions
from veduta.facade.outputs import label_png, rasterise
from veduta.facade.overlay import overlay, png
from veduta.facade.quantities import QUANTITIES, quantities_csv
from veduta.facade.rectify import Rectified, rectify
from veduta.facade.rule_outputs import write_rule_files
from veduta.facade.seen_mouldings import seen_mouldings
from veduta.facade.seen_shutters import seen_shutters
from veduta.facade.style_told import StyleTold
from veduta.facade.wall import Wall
from veduta.formats.cityjson import write_cityjson
from veduta.imaging.encode import jpeg_bytes
from veduta.imaging.read import Photo, read_image
from veduta.place.part import Part
from veduta.place.place import ModelFile, Place
from veduta.run.progress import StepProgress, no_progress
from veduta.run.report import StepRecord, timed_step

VERSION = "41"
"""Raised when any step changes its result: no older result is then taken for a new one's."""
JPEG_QUALITY = 95


@dataclass(frozen=True)
class Building:
    """What one photo gave; `photo_jpeg` is the rectified photo as it is stored.

    before: (h, w) what stands before the front, places in `cleared.KINDS`. beside: the
    photo's other houses, each with the folder in that of this one that it gets. steps: of such
    a house alone; what was done for the whole photo is told of the main one.
    """

    document: FacadeDocument
    photo_jpeg: bytes
    pixels: NDArray[np.uint8]
    before: NDArray[np.uint8]
    model: Model
    style: StyleTold | None = None
    beside: tuple[tuple[str, Building], ...] = ()
    steps: tuple[StepRecord, ...] = ()

    @property
    def part(self) -> Part:
        """What the rules derive to."""
        return self.model.part

    @cached_property
    def found(self) -> NDArray[np.uint8]:
        """What was found, drawn over the photo: for a file, and for the report."""
        return overlay(self.document, self.pixels)


def reconstruct(
    image: Path,
    options: FacadeOptions,
    part_id: str,
    steps: list[StepRecord],
    progress: StepProgress = no_progress,
) -> Building:
    """The building in one photo; each step adds its record to `steps`."""
    progress("read", 0.0)
    with timed_step(steps, "read") as step:
        photo = read_image(image)
        step.counts |= {"width_px": photo.pixels.shape[1], "height_px": photo.pixels.shape[0]}
    progress("rectify", 0.0)
    with timed_step(steps, "rectify") as step:
        rectified = rectify(photo, options.rectify)
        step.counts["method"] = rectified.record.method
    seen = None
    if options.eyes.eyes == "learned":
        progress("look", 0.0)
        with timed_step(steps, "look"):
            seen = look(rectified.pixels)
    source = _source(photo)
    documents, analysis, others = read_houses(rectified, source, options, progress, seen)
    steps.extend(analysis)
    said = (*photo.notes, *rectified.notes)
    documents = [_with_details(_with_notes(d, said), rectified, seen) for d in documents]
    place = main_house(documents)
    document = documents[place]
    document = _on_wall(_sized(document, options.model), options.wall)
    document = _measured(document, options, steps)
    jpeg, pixels = _stored(rectified.pixels)
    document, style = _styled(document, pixels, seen, options.style, steps, progress)
    before = np.zeros(pixels.shape[:2], np.uint8) if seen is None else hidden_kinds(seen)
    model = _model(document, pixels, before, part_id, steps, progress)
    beside = []
    for number, other in enumerate(documents, start=1):
        if number - 1 != place:
            own = _sized(other, options.model)
            folder = house_folder(number)
            taken = others[number - 1]
            built = _model(own, pixels, before, f"{part_id}-{folder}", taken, progress)
            house = Building(own, jpeg, pixels, before, built, steps=tuple(taken))
            beside.append((folder, house))
    return Building(document, jpeg, pixels, before, model, style, tuple(beside))


def rebuild(
    document_path: Path,
    options: ModelOptions,
    part_id: str,
    steps: list[StepRecord],
    progress: StepProgress = no_progress,
) -> Building:
    """The building of a document that somebody may have edited; its photo lies beside it."""
    progress("load", 0.0)
    with timed_step(steps, "load") as step:
        document = _sized(load_document(document_path), options)
        pixels = load_photo(document_path, document)
        before = load_before(document_path, (pixels.shape[1], pixels.shape[0]))
        step.counts["elements"] = len(document.elements)
    model = _model(document, pixels, before, part_id, steps, progress)
    jpeg = document_path.with_name(PHOTO).read_bytes()
    return Building(document, jpeg, pixels, before, model)


def write_building(
    building: Building,
    folder: Path,
    steps: list[StepRecord],
    progress: StepProgress = no_progress,
) -> None:
    """Write all files of one building but its report."""
    progress("write", 0.0)
    with timed_step(steps, "write") as step:
        document = building.document
        text = document.model_dump_json(by_alias=True, indent=1) + "\n"
        (folder / DOCUMENT).write_text(text, encoding="utf-8")
        (folder / PHOTO).write_bytes(building.photo_jpeg)
        (folder / BEFORE).write_bytes(before_png(building.before))
        (folder / "labels.png").write_bytes(label_png(document, rasterise(document)))
        (folder / "overlay.png").write_bytes(png(building.found))
        table = quantities_csv(document, building.part)
        (folder / QUANTITIES).write_text(table, encoding="utf-8")
        write_rule_files(building.model, folder)
        if building.style is not None:
            building.style.write(folder)
        Place().add(building.part, file=ModelFile("model.glb")).save(folder)
        pictures = {texture: name for name, texture in building.model.textures.items()}
        write_cityjson(building.part, folder / "model.city.json", pictures)
        step.counts["bytes"] = sum(file.stat().st_size for file in folder.rglob("*"))


def _with_details(
    document: FacadeDocument, rectified: Rectified, seen: Seen | None
) -> FacadeDocument:
    """The document with the cornices, courses and shutters that the eyes see."""
    if seen is None:
        return document
    scale = document.scale.metres_per_px
    found = seen_mouldings(seen, rectified.pixels, document.facade, scale)
    shutters = seen_shutters(seen, document)
    return document.model_copy(update={"mouldings": found, "shutters": shutters})


def _source(photo: Photo) -> Source:
    height, width = photo.pixels.shape[:2]
    return Source(image=photo.path.name, sha256=photo.sha256, width_px=width, height_px=height)


def _with_notes(document: FacadeDocument, notes: tuple[str, ...]) -> FacadeDocument:
    """The document with notes of the steps before the analysis, each once."""
    return document.model_copy(update={"notes": list(dict.fromkeys((*notes, *document.notes)))})


def _sized(document: FacadeDocument, asked: ModelOptions) -> FacadeDocument:
    """The document with the sizes that the model gets, so that a rebuild has them too."""
    return document.model_copy(update={"model": asked.over(document.model)})


def _on_wall(document: FacadeDocument, wall: Wall | None) -> FacadeDocument:
    """The document with the wall that its front stands on, and what was chosen of it."""
    if wall is None:
        return document
    said = wall.notes(
        document.facade.width_m,
        document.model.depth_m,
        is_scaled=document.scale.basis == "width"
        and math.isclose(document.facade.width_m, wall.width_m, rel_tol=1e-9),
    )
    return document.model_copy(update={"wall": wall, "notes": [*document.notes, *said]})


def _measured(
    document: FacadeDocument, options: FacadeOptions, steps: list[StepRecord]
) -> FacadeDocument:
    """The document with the depths of a depth map, where one is given."""
    if options.depth.depth_map is None or options.elevation is None:
        return document
    from veduta.facade.measured import with_depths  # loaded where it is used: few calls ask for it

    with timed_step(steps, "depth map") as step:
        found = with_depths(document, options.depth.depth_map, options.elevation)
        step.counts["measured"] = sum(one.depth_m is not None for one in found.elements)
    return found


def _stored(pixels: NDArray[np.uint8]) -> tuple[bytes, NDArray[np.uint8]]:
    """The photo as JPEG, and (h, w, 3) as it is read back.

    The model is textured from what is stored, so that a rebuild of an untouched document gives
    the same bytes.
    """
    data = jpeg_bytes(pixels, JPEG_QUALITY, subsampling=0)
    with Image.open(io.BytesIO(data)) as image:
        return data, np.asarray(image.convert("RGB"), dtype=np.uint8)


def _styled(
    document: FacadeDocument,
    pixels: NDArray[np.uint8],
    seen: Seen | None,
    options: StyleOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> tuple[FacadeDocument, StyleTold | None]:
    if options.style is None:
        return document, None
    from veduta.facade.style import find_style  # loaded where it is used: few calls ask for it

    return find_style(document, pixels, seen, options, steps, progress)


def _model(
    document: FacadeDocument,
    pixels: NDArray[np.uint8],
    before: NDArray[np.uint8],
    part_id: str,
    steps: list[StepRecord],
    progress: StepProgress,
) -> Model:
    progress("model", 0.0)
    with timed_step(steps, "model") as step:
        model = build_model(document, pixels, part_id, before)
        part = model.part
        step.counts |= {"features": len(part.features), "materials": len(part.materials)}
        step.rejected.extend(part.notes)
    return model
