"""`veduta carve`: photos with silhouettes become a closed, coloured object in a place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
from pydantic import JsonValue

from veduta.cameras import CameraSet, cameras_digest, in_metres, read_cameras
from veduta.carve.boarded import board_of, placed_by_board
from veduta.carve.build.appearance import carved_triangles, colour_vertices
from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.consistency import Consistency, carve_by_colour
from veduta.carve.build.hull import Hull, carve_hull, root_of
from veduta.carve.build.measures import Measures, measure_mesh, overlaps
from veduta.carve.build.pieces import without_crumbs
from veduta.carve.build.place import Shape, base_of, object_mesh, photo_name, place_of
from veduta.carve.build.texturing import textured
from veduta.carve.build.upright import turn_upright
from veduta.carve.catalogue import ROW, write_row
from veduta.carve.faults import doubtful_views, refuse_silhouettes
from veduta.carve.options import CarveOptions
from veduta.carve.pictures import carved_picture, outlines_picture, sides_picture
from veduta.carve.read.masks import find_masks
from veduta.carve.read.unposed import bare_cameras
from veduta.carve.read.views import Record, read_views
from veduta.carve.stages import Stages
from veduta.carve.turned import turn_views
from veduta.carve.views import View
from veduta.place.mesh import Mesh
from veduta.run.card import Engine, choose_engine, say_engine, tell_engine
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.names import real_path
from veduta.run.page import Bars
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work

VERSION = "7"
MODEL, POINTS = "object.glb", "object.ply"


def run_carve(
    record: Path, out: Path, options: CarveOptions, progress: Progress, *, force: bool = False
) -> VerbResult:
    """Carve the object of a folder in OUT; InputError where it cannot be one."""
    if not record.exists():
        raise InputError(record, "does not exist", "Name the folder of the photos and cameras.")
    base = record if record.is_dir() else record.parent
    board_of(options.poses)
    if options.poses.unposed:
        cameras = bare_cameras(base)
    else:
        cameras = in_metres(read_cameras(record), options.scale)
    masks: list[JsonValue] = [
        [name, file_digest(path)] for name, path in sorted(find_masks(base, cameras).items())
    ]
    call = VerbCall(
        command="carve",
        version=VERSION,
        subject=real_path(base).name,
        options=options,
        inputs=[cameras_digest(cameras), masks],
    )

    def make(work: Work) -> None:
        _make(work, cameras, base, call.subject, Stages(work, call.inputs, options))

    return run_verb(call, out, make, progress, force=force)


def _make(work: Work, cameras: CameraSet, folder: Path, name: str, stages: Stages) -> None:
    options = stages.options
    engine = choose_engine(options.device.device)
    cameras, views = _read(work, cameras, folder, stages)
    with work.step("bounds"):
        root = root_of(find_bounds(views), options.volume.levels)
    with work.step("hull") as step:
        hull = carve_hull(views, root, engine=engine)
        step.counts["voxels inside"] = hull.volume.inside()
        step.counts["cubes judged"] = sum(sum(level) for level in hull.volume.counts())
        if hull.volume.inside() == 0:
            raise _nothing(views)
    consistency = _carve_by_colour(work, hull, views, options, engine)
    tell_engine(work, engine)
    shape = _mesh(work, views, hull if consistency is None else consistency.hull, consistency)
    measures = _measure(work, views, shape, cameras)
    kept = options.volume.up == "kept" or cameras.crs is not None
    shift = np.zeros(3) if kept else base_of(shape.positions)
    with work.step("object"):
        coloured = object_mesh(name, shape, shift)
    shown = coloured
    if not options.texture.no_texture:
        with work.step("texture") as step:
            most = options.texture.max_atlas_px
            found = textured(coloured, shift, views, most, work.progress)
            step.counts["charts"] = found.charts
            work.measure("textured_share", round(found.seen_share, 4))
            shown = found.mesh
    with work.step("writing"):
        _write(work, (coloured, shown), views, cameras, shift)
    _tell(work, shape, views, measures, cameras)
    say_engine(work, engine)


def _read(
    work: Work, cameras: CameraSet, folder: Path, stages: Stages
) -> tuple[CameraSet, tuple[View, ...]]:
    options = stages.options
    board = board_of(options.poses)
    if board is not None:
        cameras = in_metres(placed_by_board(work, cameras, board), options.scale)
    with work.step("cameras") as step:
        for note in cameras.notes:
            work.note(note)
        if options.volume.up == "auto" and cameras.crs is None and not options.poses.turntable:
            cameras = turn_upright(cameras)
        step.counts["cameras"] = len(cameras)
    with work.step("silhouettes") as step:
        found: Record = read_views(
            folder,
            cameras,
            options.silhouettes,
            progress=work.progress,
            board=board,
            keep=stages.silhouettes,
        )
        step.counts["views"] = len(found.views)
        step.rejected.extend(found.left_out)
        views = refuse_silhouettes(folder, found.views)
        step.rejected.extend(
            f"{view.name}: no silhouette" for view in found.views if view not in views
        )
        if found.threshold is not None:
            work.note(
                "The background was told by its colours: what differs from them by"
                f" {found.threshold:.1f} deviations is the object."
            )
    work.picture("Silhouettes", "what was taken for the object", outlines_picture(views), wide=True)
    if options.poses.turntable:
        cameras, views = turn_views(work, views, folder, options.poses, stages.turns)
        cameras = in_metres(cameras, options.scale)
        views = tuple(
            replace(view, camera=camera)
            for view, camera in zip(views, cameras.cameras, strict=True)
        )
    return cameras, views


def _nothing(views: Sequence[View]) -> NotFoundError:
    return NotFoundError(
        "an object",
        f"the silhouettes of {len(views)} views have no voxel in common",
        "Look at the silhouettes in the report: one may be inverted, or a camera may not belong"
        " to its photo.",
    )


def _carve_by_colour(
    work: Work, hull: Hull, views: Sequence[View], options: CarveOptions, engine: Engine
) -> Consistency | None:
    if not options.colour.carve:
        return None
    with work.step("colour consistency") as step:
        found = carve_by_colour(hull, views, options.colour, engine=engine)
        step.counts["sweeps"] = len(found.carved_by_sweep)
        step.counts["voxels carved"] = int(found.carved.sum())
    work.measure("colour_spread_typical", round(found.typical, 2))
    work.measure("colour_spread_carved", round(found.spread, 2))
    return found


def _mesh(work: Work, views: Sequence[View], hull: Hull, consistency: Consistency | None) -> Shape:
    with work.step("surface") as step:
        positions, triangles = hull.surface()
        if not len(triangles):
            raise _nothing(views)
        whole = without_crumbs(positions, triangles, views)
        positions, triangles = whole.positions, whole.triangles
        step.counts["crumbs left out"] = whole.dropped
        if whole.dropped:
            work.note(
                f"{whole.dropped} loose crumbs, {whole.dropped_share:.2%} of the volume, are left"
                " out: they fill no silhouette that the object leaves open."
            )
        step.counts["vertices"], step.counts["triangles"] = len(positions), len(triangles)
        carved = np.zeros(len(triangles), dtype=bool)
        if consistency is not None and consistency.carved.any():
            carved = carved_triangles(positions, triangles, consistency)
            step.counts["triangles carved by colour"] = int(carved.sum())
    with work.step("colours") as step:
        coloured = colour_vertices(views, positions, triangles, hull.root.voxel_m)
        unseen = int((coloured.views == 0).sum())
        step.counts["vertices that no photo shows"] = unseen
        work.measure("unseen_share", round(unseen / len(positions), 4))
    return Shape(positions, triangles, coloured.colours, carved)


def _measure(work: Work, views: Sequence[View], shape: Shape, cameras: CameraSet) -> Measures:
    with work.step("measures"):
        found = measure_mesh(shape.positions, shape.triangles, views)
        fits = overlaps(views, shape.positions, shape.triangles)
    unit = "m" if cameras.scale == "metres" else "units"
    work.measure(f"volume_{unit}3", float(f"{found.volume:.5g}"))
    work.measure(f"volume_error_{unit}3", float(f"{found.volume_error:.2g}"))
    work.measure(f"area_{unit}2", float(f"{found.area:.5g}"))
    work.measure(f"area_error_{unit}2", float(f"{found.area_error:.2g}"))
    work.measure("triangles", len(shape.triangles))
    work.measure("pieces", found.pieces)
    work.measure("silhouette_iou_mean", round(float(fits.mean()), 4))
    work.measure("silhouette_iou_least", round(float(fits.min()), 4))
    work.bars(
        Bars(
            "Overlap of each silhouette with the object's (intersection over union)",
            "",
            [(view.name, round(float(fit), 4)) for view, fit in zip(views, fits, strict=True)],
        )
    )
    for doubt in doubtful_views(views, fits):
        work.doubt(doubt)
    return found


def _write(
    work: Work,
    meshes: tuple[Mesh, Mesh],
    views: Sequence[View],
    cameras: CameraSet,
    shift: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
) -> None:
    """meshes: with a colour for each vertex, and as it is shown."""
    place = place_of(meshes[1], views, cameras, shift)
    for number, view in enumerate(views):
        path = work.folder / photo_name(number)
        path.parent.mkdir(exist_ok=True)
        _, data = cv2.imencode(".jpg", cv2.cvtColor(view.pixels, cv2.COLOR_RGB2BGR))
        path.write_bytes(data.tobytes())
    place.save(work.folder)
    place.write(work.folder / MODEL)
    place_of(meshes[0], views, cameras, shift).write(work.folder / POINTS)
    size = np.ptp(meshes[0].positions_m, axis=0)
    write_row(work.folder / ROW, meshes[0].id, MODEL, size, cameras.scale == "metres")
    work.file(ROW, "a row for a catalogue of `veduta plan --catalogue`")
    work.file(MODEL, "the object, with its texture, for any program that shows glTF")
    work.file(POINTS, "the same as PLY, closed, with a colour for each vertex")
    work.file("place.json", "the place for `veduta view`, with the cameras and their photos")


def _tell(
    work: Work,
    shape: Shape,
    views: Sequence[View],
    measures: Measures,
    cameras: CameraSet,
) -> None:
    unit = "m" if cameras.scale == "metres" else "units of the cameras"
    size = " x ".join(f"{one:.4g}" for one in measures.size)
    volume = f"{measures.volume:.4g} ± {measures.volume_error:.1g}"
    work.fact("Size", f"{size} {unit}")
    work.fact("Volume", f"{volume} {unit}, cubed")
    work.fact("Area", f"{measures.area:.4g} ± {measures.area_error:.1g} {unit}, squared")
    work.fact("Triangles", f"{len(shape.triangles):,}")
    carved = float(shape.carved.mean())
    work.summary = (
        f"An object of {len(shape.triangles):,} triangles from {len(views)} views: {size} {unit},"
        f" volume {volume}"
    )
    work.picture("The object", "from four sides, above and below", sides_picture(shape), wide=True)
    if carved > 0.0:
        work.picture(
            "Hull and concavities",
            f"grey: bounded by silhouettes; orange: carved because the photos' colours disagreed"
            f" ({carved:.1%} of the triangles)",
            carved_picture(shape),
            wide=True,
        )
    work.note(
        "The hull is the largest object that fits all silhouettes: what lies in a hollow that no"
        " silhouette shows is filled, unless the colours carved it."
    )
    if cameras.scale == "unknown":
        work.note("The cameras have no known scale: lengths are in their own unit.")
