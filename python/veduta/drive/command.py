"""`veduta drive`: from a log to a place in OUT."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import JsonValue

from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.pictures import (
    atlas_picture,
    depth_picture,
    histogram_picture,
    object_picture,
    plan_picture,
    source_picture,
)
from veduta.drive.build.pictures_of import Seen, look
from veduta.drive.build.place import PICTURES, classified, drive_place
from veduta.drive.build.segment import Geometry, Textured, frame_of, reconstruct, texture
from veduta.drive.document.model import Correction, DriveDocument, DriveSegment, PathPose
from veduta.drive.options import DriveOptions
from veduta.drive.read.log import log_files, read_log
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.drive.record import DriveRecord
from veduta.formats.laz import write_laz
from veduta.run.digests import file_digest
from veduta.run.errors import NotFoundError
from veduta.run.page import Table
from veduta.run.progress import Progress
from veduta.run.report import Count
from veduta.run.verb import VerbCall, VerbResult, run_verb
from veduta.run.work import Work

VERSION = "4"
DOCUMENT, POINTS = "drive.json", "points.laz"
_JPEG_QUALITY = 90


def run_drive(
    log: Path, out: Path, options: DriveOptions, progress: Progress, *, force: bool = False
) -> VerbResult:
    """The whole verb. InputError where the log cannot be read."""
    inputs: list[JsonValue] = [[path.name, file_digest(path)] for path in log_files(log)]
    call = VerbCall("drive", VERSION, log.name or str(log), options, inputs)
    return run_verb(call, out, lambda work: _make(log, options, work), progress, force=force)


def _make(log: Path, options: DriveOptions, work: Work) -> None:
    with work.step("read") as step:
        spacing_m = options.columns.column_spacing_m
        record = read_log(
            log, options.seed, spacing_m, lambda share: work.progress("read", share),
            work.stages / "unpacked",
        )  # fmt: skip
        step.counts["sweeps"], step.counts["images"] = len(record.sweeps), len(record.shots)
        for note in record.notes:
            work.note(note)
    road_m = record.height_m
    with work.step("segments") as step:
        spacing = column_spacing(record, options)
        ahead_m = options.columns.reach_m if record.full else 0.0
        line = driven_line(record.path(), spacing, ahead_m)
        if len(line) < 2:
            raise NotFoundError("a path", "the scanner did not move", "Drive along a street.")
        segments = cut_segments(line, spacing)
        step.counts["segments"] = len(segments)
        step.rejected += [f"{one.id}: {one.reason}" for one in segments if one.fate == "leave-out"]
    geometries = _geometries(record, segments, options, road_m, work)
    seen = _looked(record, geometries, options.seed, work)
    textured = _textured(geometries, seen, options, work)
    with work.step("place"):
        _write(log, record, segments, textured, seen, line, road_m, work)
    _tell(record, textured, line, work)


def _geometries(
    record: DriveRecord,
    segments: Sequence[DriveSegment],
    options: DriveOptions,
    road_m: float,
    work: Work,
) -> list[Geometry]:
    found = []
    with work.step("layers") as step:
        built = [one for one in segments if one.fate == "build"]
        for number, segment in enumerate(built):
            work.progress("layers", number / len(built))
            frame = frame_of(segment, options, road_m)
            points = points_beside(record, segment, options)
            geometry = reconstruct(segment, frame, points, options)
            if geometry.measured_walls() < 10:
                step.rejected.append(f"{segment.id}: no facade stands along it")
                continue
            found.append(geometry)
            step.counts[f"{segment.id}: objects"] = geometry.object_count
    if not found:
        raise NotFoundError(
            "a facade", "no segment has a main depth", "Drive along a street with buildings."
        )
    return found


def _looked(
    record: DriveRecord, geometries: Sequence[Geometry], seed: int, work: Work
) -> list[Seen]:
    with work.step("images") as step:
        hiding = [one.foreground() for one in geometries]
        hiding += [one.crowns(seed) for one in geometries]
        foreground = np.concatenate(hiding)
        seen = []
        for number, shot in enumerate(record.shots):
            work.progress("images", number / len(record.shots))
            seen.append(look(shot, foreground))
        step.counts["images"] = len(seen)
    return seen


def _textured(
    geometries: Sequence[Geometry], seen: Sequence[Seen], options: DriveOptions, work: Work
) -> list[Textured]:
    found = []
    with work.step("texture") as step:
        for number, geometry in enumerate(geometries):
            work.progress("texture", number / len(geometries))
            one = texture(geometry, seen, options)
            found.append(one)
            step.counts[f"{geometry.segment.id}: triangles"] = len(one.surface.triangles)
    return found


def _write(
    log: Path,
    record: DriveRecord,
    segments: Sequence[DriveSegment],
    textured: Sequence[Textured],
    seen: Sequence[Seen],
    line: NDArray[np.float64],
    road_m: float,
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
        corrections=_corrections(record),
        segments=list(segments),
        notes=list(record.notes),
    )
    text = json.dumps(document.model_dump(mode="json", by_alias=True), indent=1)
    (folder / DOCUMENT).write_text(text + "\n", encoding="utf-8")
    cloud = classified([one.geometry for one in textured])
    write_laz(cloud.points_m, cloud.colours, folder / POINTS, crs=record.crs,
              origin_m=record.origin_m, classes=cloud.classes)  # fmt: skip
    drive_place(record, textured, seen, line, road_m).save(folder)
    for name, meaning in (
        ("place.json", "the place: `veduta view` shows it"),
        ("parts/", "a textured mesh of each segment (GLB)"),
        (POINTS, "scan points: 2 ground, 6 building, 64 foreground, 65 glass"),
        (DOCUMENT, "the path and its segments"),
        (f"{PICTURES}/", "the images"),
    ):
        work.file(name, meaning)


def _corrections(record: DriveRecord) -> list[Correction]:
    """Each by the scan that was taken next to its time."""
    times = np.array([sweep.time_s for sweep in record.sweeps])
    found = []
    for time_s, moved, why in record.corrections:
        sweep = record.sweeps[int(np.argmin(np.abs(times - time_s)))].name
        x, y, z = (round(float(value), 3) for value in moved)
        found.append(Correction(sweep=sweep, moved_m=(x, y, z), reason=why))
    return found


def _tell(
    record: DriveRecord, textured: Sequence[Textured], line: NDArray[np.float64], work: Work
) -> None:
    triangles = sum(len(one.surface.triangles) for one in textured)
    objects = sum(one.geometry.object_count for one in textured)
    fine = sum(one.fine_triangles for one in textured)
    share = sum(one.unseen_share * one.fine_triangles for one in textured) / max(fine, 1)
    work.measure("segments", len(textured))
    work.measure("triangles", triangles)
    work.measure("triangles_before_joining", fine)
    work.measure("joining_error_m", round(max(one.error_m for one in textured), 4))
    work.measure("objects_taken_out", objects)
    work.measure("triangles_seen_in_no_image", round(share, 4))
    work.measure("atlas_px", sum(int(one.atlas.surface.sum()) for one in textured))
    work.measure("image_px", textured[0].atlas.inputs_px)
    work.summary = (
        f"{len(textured)} facade meshes of {triangles:,} triangles; {objects} objects taken out;"
        f" {100 * share:.1f} % of the triangles are seen in no image"
    )
    if not record.shots:
        work.doubt("there are no images: nothing is textured")
    elif share > 0.2:
        work.doubt(f"{100 * share:.0f} % of the triangles are seen in no image: plain or invented")
    work.picture(
        "From above", "Building yellow, foreground green, ground brown, glass blue, path white",
        plan_picture([one.geometry for one in textured], line),
    )  # fmt: skip
    rows: list[list[Count | None]] = []
    for one in textured:
        _segment_pictures(one, work)
        kinds = np.bincount(one.geometry.layers.kind, minlength=66)
        rows.append([
            one.geometry.segment.id, int(kinds[6]), int(kinds[2]), int(kinds[64]), int(kinds[65]),
            one.geometry.object_count, round(one.unseen_share, 3), one.geometry.segment.reason,
        ])  # fmt: skip
    work.table(Table(
        "Segments",
        ["segment", "building points", "ground", "foreground", "glass", "objects",
         "triangles seen in no image", "why it is so cut"],
        rows,
    ))  # fmt: skip


def _segment_pictures(one: Textured, work: Work) -> None:
    geometry, name = one.geometry, one.geometry.segment.id
    work.picture(f"{name}: as scanned", "Depth image before; near is light",
                 depth_picture(geometry.layers.first, geometry), wide=True)  # fmt: skip
    work.picture(f"{name}: depth histogram", "Main depth white, split depth blue",
                 histogram_picture(geometry), wide=True)  # fmt: skip
    work.picture(f"{name}: objects", "What stood before the facade", object_picture(geometry),
                 wide=True)  # fmt: skip
    work.picture(f"{name}: background", "Depth image after",
                 depth_picture(geometry.background.depth, geometry), wide=True)  # fmt: skip
    work.picture(f"{name}: what is known", "Grey measured, orange filled, blue inferred",
                 source_picture(one.background, geometry), wide=True)  # fmt: skip
    work.picture(f"{name}: atlas before", "Red is seen in no image",
                 atlas_picture(one, filled=False), wide=True)  # fmt: skip
    work.picture(f"{name}: atlas after", "Holes filled, and marked",
                 atlas_picture(one, filled=True), wide=True)  # fmt: skip
