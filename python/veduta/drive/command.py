"""`veduta drive`: from a log to a place in OUT."""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import JsonValue

from veduta.drive.build.beside import column_spacing
from veduta.drive.build.bodies import Body, bodies_of
from veduta.drive.build.body_file import BUILDINGS, write_bodies
from veduta.drive.build.edited import with_document
from veduta.drive.build.facade_files import FACADES, write_facade_list
from veduta.drive.build.levels import FOLDER, TILESET, write_levels
from veduta.drive.build.outcome import Outcome
from veduta.drive.build.path_report import MARGIN_M, corrections_table, path_picture
from veduta.drive.build.pictures import plan_picture
from veduta.drive.build.place import PICTURES, add_houses, classified, drive_place
from veduta.drive.build.times import times_table
from veduta.drive.build.vote import PAGE, write_vote
from veduta.drive.document.load import DOCUMENT, load_document
from veduta.drive.document.model import Correction, DriveDocument, DriveSegment, PathPose
from veduta.drive.options import DriveOptions
from veduta.drive.read.above_street import points_above_street
from veduta.drive.read.log import log_files, read_log
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.drive.record import DriveRecord
from veduta.drive.stages import layer_segments, texture_segments
from veduta.formats.laz import write_laz_parts
from veduta.formats.place_json import name_tileset
from veduta.place.place import Place
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.names import given_name, real_path
from veduta.run.page import Table
from veduta.run.progress import Progress
from veduta.run.report import Count
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work

VERSION = "15"
POINTS, MANIFEST = "points.laz", "place.json"
_JPEG_QUALITY = 90


def run_drive(
    log: Path,
    out: Path,
    options: DriveOptions,
    progress: Progress,
    *,
    document: Path | None = None,
    force: bool = False,
) -> VerbResult:
    """The whole verb. document: an edited `drive.json` of this log: its path and its segments are
    taken instead of being found. InputError where the log cannot be read.
    """
    if options.texture.anonymise:
        fault = "cannot be done: there is no detector of faces and number plates"
        raise InputError("--anonymise", fault, "Blur the images before, and leave it out.")
    inputs: list[JsonValue] = [[path.name, file_digest(path)] for path in log_files(log)]
    edited, in_place = None, False
    if document is not None:
        edited = (document, load_document(document))
        inputs.append(["edited", file_digest(document)])
        in_place = real_path(document) == real_path(out / DOCUMENT)
    name = "drive" if edited is None else "drive (rebuild)"
    call = VerbCall(name, VERSION, log.name or given_name(log), options, inputs, in_place)
    make = partial(_make, log, options, edited, inputs)
    return run_verb(call, out, make, progress, force=force)


def _make(
    log: Path,
    options: DriveOptions,
    edited: tuple[Path, DriveDocument] | None,
    inputs: JsonValue,
    work: Work,
) -> None:
    """inputs: digests of all that it is made of; what a killed run has kept depends on them."""
    with work.step("read") as step:
        spacing_m = options.columns.column_spacing_m
        record = read_log(
            log, options.seed, spacing_m, lambda share: work.progress("read", share),
            work.stages / "unpacked",
        )  # fmt: skip
        if edited is not None:
            record = with_document(record, edited[1], edited[0])
        step.counts["sweeps"], step.counts["images"] = len(record.sweeps), len(record.shots)
        for note in record.notes:
            work.note(note)
        for doubt in record.doubts:
            work.doubt(doubt)
    road_m = record.height_m
    with work.step("segments") as step:
        spacing = column_spacing(record, options)
        ahead_m = options.columns.reach_m if record.full else 0.0
        line = driven_line(record.path(), spacing, ahead_m)
        if len(line) < 2:
            raise NotFoundError("a path", "the scanner did not move", "Drive along a street.")
        if edited is None:
            segments = cut_segments(line, spacing, points_above_street(record, line))
        else:
            segments = edited[1].segments
        step.counts["segments"] = len(segments)
        step.rejected += [f"{one.id}: {one.reason}" for one in segments if one.fate == "leave-out"]
    layered = layer_segments(record, segments, options, road_m, inputs, work)
    outcomes = texture_segments(record, layered, options, inputs, work)
    corrected = _corrections(record)
    with work.step("place"):
        told = {one.segment.id: one.segment for one in layered}
        known = [told.get(one.id, one) for one in segments]
        corrections = [one for _, one in corrected]
        _write(log, record, known, corrections, outcomes, line, road_m, options, work)
    _tell_path(record, known, corrected, line, work)
    _tell(record, outcomes, line, work)


def _write(
    log: Path,
    record: DriveRecord,
    segments: Sequence[DriveSegment],
    corrections: Sequence[Correction],
    outcomes: Sequence[Outcome],
    line: NDArray[np.float64],
    road_m: float,
    options: DriveOptions,
    work: Work,
) -> None:
    folder = work.folder
    (folder / PICTURES).mkdir()
    for shot in record.shots:
        with Image.open(shot.path) as image:
            image.convert("RGB").save(folder / PICTURES / f"{shot.name}.jpg", quality=_JPEG_QUALITY)
    document = DriveDocument(
        record=log.name,
        crs=record.crs,
        vertical_datum=record.vertical_datum,
        origin=record.origin_m,
        path_from=record.path_from,
        path=[
            PathPose(
                sweep=sweep.name,
                time_s=sweep.time_s,
                matrix=tuple(sweep.world_from_sensor[:3].ravel().round(6).tolist()),
            )
            for sweep in record.sweeps
        ],
        corrections=list(corrections),
        segments=list(segments),
        notes=list(record.notes),
    )
    text = json.dumps(document.model_dump(mode="json", by_alias=True), indent=1)
    (folder / DOCUMENT).write_text(text + "\n", encoding="utf-8")
    near = np.median(line, axis=0)
    write_laz_parts(
        ((one.points_m, one.colours, one.classes) for one in classified(outcomes)),
        folder / POINTS, (near[0], near[1], near[2]), crs=record.crs, origin_m=record.origin_m,
    )  # fmt: skip
    place = drive_place(record, outcomes, line, road_m, folder)
    bodies = _bodies(record, outcomes, folder / BUILDINGS, work)
    add_houses(place, bodies, record)
    place.save(folder)
    if options.mesh.tiles:
        _write_tiles(record, outcomes, place, work)
    rows = [row for one in outcomes for _, _, row in one.planes]
    planes = write_facade_list(rows, folder / FACADES)
    files = [
        (MANIFEST, "the place: `veduta view` shows it"),
        ("parts/", "a textured mesh of each segment (GLB)"),
        ("raw/", "the same as it was scanned"),
        (POINTS, "scan points: 2 ground, 6 building, 64 foreground, 65 glass, 66 filled"),
        (DOCUMENT, "the path and its segments"),
    ]
    files += (
        [("taken-out.ply", "what was taken out")] if (folder / "taken-out.ply").exists() else []
    )
    if planes:
        files.append((f"{FACADES}/", "each facade plane straight on, and where it stands"))
    if bodies:
        files.append((BUILDINGS, "the houses behind the facades, closed, with roofs (LoD2)"))
    if write_vote([one.pair for one in outcomes if one.pair is not None], folder, options.seed):
        files.append((PAGE, "segments as scanned and as made, side by side, for a vote"))
    work.measure("facade_planes", planes)
    files += [(f"{PICTURES}/", "the images")] if record.shots else []
    for name, meaning in files:
        work.file(name, meaning)


def _write_tiles(
    record: DriveRecord, outcomes: Sequence[Outcome], place: Place, work: Work
) -> None:
    """The segments in levels of detail, which the manifest names."""
    lift_m = record.origin_m[2] - place.origin_m[2]
    count = write_levels(outcomes, lift_m, work.folder)
    name_tileset(work.folder / MANIFEST, f"{FOLDER}/{TILESET}")
    work.measure("tiles", count)
    work.file(f"{FOLDER}/", "the segments in levels of detail (3D Tiles): what the studio fetches")


def _bodies(record: DriveRecord, outcomes: Sequence[Outcome], path: Path, work: Work) -> list[Body]:
    """The houses that are closed by the roofs of the surface model; says why where none is."""
    grid = None if record.roofs is None else record.roofs()
    if grid is None:
        work.note(f"no {BUILDINGS}: the log names no surface model, so that roofs are unknown")
        return []
    bodies: list[Body] = []
    for one in outcomes:
        for name, plane, _ in one.planes:
            behind = bodies_of(name, plane, grid)
            bodies += behind.found
            for begin, end in behind.roofless:
                work.doubt(
                    f"the house {begin:.0f} to {end:.0f} m along {name} is left out: the surface"
                    " model has too few heights of its roof"
                )
    left_out = write_bodies(bodies, path, record.name, record.crs, record.origin_m)
    if left_out:
        work.doubt(f"{len(left_out)} houses do not close and are left out: {', '.join(left_out)}")
    if not bodies:
        work.note(f"no {BUILDINGS}: the surface model has no roofs behind the facades")
    work.measure("buildings_closed", len(bodies) - len(left_out))
    return [one for one in bodies if one.name not in left_out]


def _corrections(record: DriveRecord) -> list[tuple[int, Correction]]:
    """Each with the row of the scan that was taken next to its time."""
    times = np.array([sweep.time_s for sweep in record.sweeps])
    found = []
    for time_s, moved, why in record.corrections:
        row = int(np.argmin(np.abs(times - time_s)))
        x, y, z = (round(float(value), 3) for value in moved)
        name = record.sweeps[row].name
        found.append((row, Correction(sweep=name, moved_m=(x, y, z), reason=why)))
    return found


def _tell_path(
    record: DriveRecord,
    segments: Sequence[DriveSegment],
    corrected: Sequence[tuple[int, Correction]],
    line: NDArray[np.float64],
    work: Work,
) -> None:
    """The path over the surface model, and what was corrected of it: scans by their rows."""
    if record.overview is not None:
        near = line[:, :2].min(axis=0) - MARGIN_M, line[:, :2].max(axis=0) + MARGIN_M
        low, high = ((float(corner[0]), float(corner[1])) for corner in near)
        places = record.path()
        moved = [(places[row], np.array(one.moved_m)) for row, one in corrected]
        work.picture(
            "The path over the surface model",
            "Path white, from the blue dot; segments beside it, on the side they look to: built"
            " green, left as scanned orange, left out grey; corrections red, ten times as long",
            path_picture(record.overview(low, high), line, segments, moved), wide=True,
        )  # fmt: skip
    if corrected:
        work.table(corrections_table([one for _, one in corrected]))


def _tell(
    record: DriveRecord, outcomes: Sequence[Outcome], line: NDArray[np.float64], work: Work
) -> None:
    triangles = sum(one.triangles for one in outcomes)
    objects = sum(one.objects for one in outcomes)
    fine = sum(one.fine for one in outcomes)
    share = sum(one.unseen_share * one.fine for one in outcomes) / max(fine, 1)
    work.measure("segments", len(outcomes))
    work.measure("triangles", triangles)
    work.measure("triangles_before_joining", fine)
    work.measure("joining_error_m", round(max(one.error_m for one in outcomes), 4))
    work.measure("objects_taken_out", objects)
    work.measure("triangles_seen_in_no_image", round(share, 4))
    work.measure("atlas_px", sum(one.texels for one in outcomes))
    work.measure("image_px", sum(shot.width_px * shot.height_px for shot in record.shots))
    looked = sum(one.looked for one in outcomes)
    if looked:
        wrong = sum(one.contradicted for one in outcomes)
        work.measure("filled_points_where_images_disagree", round(wrong / looked, 4))
    filled = sum(one.others.pixels for one in outcomes)
    if filled:
        apart = sum(one.others.off_m * one.others.pixels for one in outcomes if one.others.pixels)
        work.measure("hole_pixels_from_other_sensors", filled)
        work.measure("others_apart_from_interpolation_m", round(apart / filled, 4))
    work.summary = (
        f"{len(outcomes)} facade meshes of {triangles:,} triangles; {objects} objects taken out;"
        f" {100 * share:.1f} % of the triangles are seen in no image"
    )
    if record.shots:
        work.note(f"{PICTURES}/ and the textures are not anonymised: blur the images before")
    if not record.shots:
        work.doubt("there are no images: nothing is textured")
    elif share > 0.2:
        work.doubt(f"{100 * share:.0f} % of the triangles are seen in no image: plain or invented")
    points = np.concatenate([one.sample for one in outcomes])
    kinds = np.concatenate([one.kinds for one in outcomes])
    work.picture(
        "From above",
        "Building yellow, foreground green, ground brown, glass blue, filled orange, path white",
        plan_picture(points, kinds, line),
    )  # fmt: skip
    work.table(times_table({step.name: step.seconds for step in work.steps}, outcomes))
    rows: list[list[Count | None]] = []
    for one in outcomes:
        rows.append([
            one.segment.id, *(int(one.counts[kind]) for kind in (6, 2, 64, 65, 66)), one.objects,
            round(one.unseen_share, 3), one.segment.reason,
        ])  # fmt: skip
    work.table(Table(
        "Segments",
        ["segment", "building points", "ground", "foreground", "glass", "filled", "objects",
         "triangles seen in no image", "why it is so cut"],
        rows,
    ))  # fmt: skip
