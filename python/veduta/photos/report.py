"""What `report.json` and `report.html` say: table 2.1 of the thesis for this run, and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from veduta.photos.component import Component
from veduta.photos.engine import NAME, engine_version
from veduta.photos.match import PairRecord
from veduta.photos.options import PhotosOptions
from veduta.photos.read import PhotoRecord
from veduta.photos.report_pictures import error_picture, match_picture, plan_picture
from veduta.photos.structure import errors_px
from veduta.run.page import Bars, Page, Table, render
from veduta.run.report import Failure, Report, StepRecord, counted, versions

FILES = (
    ("sparse/", "cameras, photos and points in the format of COLMAP, a folder per component"),
    ("points.ply", "the points of the first component, with colours"),
    ("pictures/", "the photos without the distortion of the lens, as the studio shows them"),
    ("place.json", "points and cameras, for `veduta view`"),
)
ENGINE_NOTE = (
    "the engine adds up on several threads: another run may differ in the last digits of a pose"
)
SCALE_NOTE = (
    "the scale is not known: nothing in the photos says it. The unit is chosen so that points lie"
    " 10 from the cameras in the middle"
)
UP_NOTE = "up is inferred: people hold cameras level"


@dataclass
class Told:
    """What the steps have found so far; the report is made of it."""

    folder: str
    options: PhotosOptions
    steps: list[StepRecord]
    photos: tuple[PhotoRecord, ...] = ()
    left: list[tuple[str, str]] = field(default_factory=list)
    """Files that no camera was found for, as (name, reason)."""
    how: str = ""
    pairs: list[PairRecord] = field(default_factory=list)
    keypoints: list[int] = field(default_factory=list)
    components: list[Component] = field(default_factory=list)


def measures_of(told: Told) -> dict[str, Any]:
    """The run in numbers; sizes of the first component, which is shown."""
    first = told.components[0].structure
    kind = told.components[0].lens.kind
    errors = errors_px(first)
    return {
        "photos": len(told.photos) + len(told.left) - _placeless(told),
        "calibrated": sum(len(item.structure.names) for item in told.components),
        "components": [len(item.structure.names) for item in told.components],
        "keypoints_mean": round(float(np.mean(told.keypoints)), 1),
        "pairs": len(told.pairs),
        "pairs_verified": sum(pair.verified > 0 for pair in told.pairs),
        "points": len(first.points),
        "observations": len(first.point_of),
        "track_mean": round(len(first.point_of) / max(1, len(first.points)), 3),
        "error_px": round(float(errors.mean()), 4),
        "error_median_px": round(float(np.median(errors)), 4),
        "lens": kind.lens,
        "cameras": kind.sharing,
        "principal_point": kind.principal_point,
        "seconds": round(sum(step.seconds for step in told.steps), 1),
    }


def _placeless(told: Told) -> int:
    """Photos that are in both lists: readable, but without a pose."""
    names = {photo.name for photo in told.photos}
    return sum(name in names for name, _ in told.left)


def summary_line(measures: dict[str, Any]) -> str:
    """What was found, in a line."""
    parts = measures["components"]
    several = f" in {len(parts)} components" if len(parts) > 1 else ""
    return (
        f"{measures['calibrated']} of {counted(measures['photos'], 'photo')} calibrated{several}, "
        f"{measures['points']:,} points, {measures['error_px']:.2f} px off on average"
    )


def photos_report(told: Told) -> tuple[Report, bytes]:
    """The report of a run, and its page."""
    measures = measures_of(told)
    report = Report(
        verb="photos",
        subject=told.folder,
        state="done",
        options=told.options.model_dump(mode="json"),
        steps=told.steps,
        measures=measures,
        notes=_notes(told),
        versions={**versions(), NAME: engine_version()},
    )
    component = told.components[0]
    page = Page(
        title=told.folder,
        summary=summary_line(measures),
        facts=_facts(measures),
        pictures=[
            plan_picture(component.structure),
            match_picture([photo.image_id for photo in told.photos], told.pairs),
            error_picture(errors_px(component.structure)),
        ],
        tables=[_run_table(told, measures), _cameras(told), *_left(told), *_kinds(told)],
        bars=[Bars("Time per step", "s", [(step.name, step.seconds) for step in told.steps])],
        files=FILES,
    )
    return report, render(report, page)


def failure_report(told: Told, failure: Failure) -> tuple[Report, bytes]:
    """The report of a run that gave nothing: how far it came, and why it ended there."""
    report = Report(
        verb="photos",
        subject=told.folder,
        state="failed",
        options=told.options.model_dump(mode="json"),
        steps=told.steps,
        failures=[failure],
        versions={**versions(), NAME: engine_version()},
    )
    pictures = []
    if told.pairs:
        pictures = [match_picture([photo.image_id for photo in told.photos], told.pairs)]
    page = Page(
        title=told.folder,
        summary="No photos could be placed.",
        pictures=pictures,
        tables=_left(told),
    )
    return report, render(report, page)


def _notes(told: Told) -> list[str]:
    notes = [SCALE_NOTE, f"{UP_NOTE}; theirs lie {told.components[0].level_deg:.1f}° off"]
    notes += [f"{photo.name}: {note}" for photo in told.photos for note in photo.notes]
    unknown = sum(photo.focal_px is None for photo in told.photos)
    if unknown:
        notes.append(
            f"{counted(unknown, 'photo')} of {len(told.photos)} without a focal length in EXIF:"
            " it was found from the photos alone"
        )
    if len(told.components) > 1:
        sizes = ", ".join(
            f"sparse/{number} ({len(item.structure.names)} photos)"
            for number, item in enumerate(told.components)
        )
        notes.append(
            f"the photos fall into components that share no view: {sizes}. How they lie to each"
            " other is not known; points.ply and place.json show the first"
        )
    return [*notes, ENGINE_NOTE]


def _facts(measures: dict[str, Any]) -> list[tuple[str, str]]:
    middle = "" if measures["principal_point"] == "middle" else ", principal point found"
    return [
        ("photos calibrated", f"{measures['calibrated']} of {measures['photos']}"),
        ("points", f"{measures['points']:,}"),
        ("reprojection error", f"{measures['error_px']:.2f} px"),
        ("photos per point", f"{measures['track_mean']:.1f}"),
        ("cameras", f"{measures['lens']}, {measures['cameras']}{middle}"),
    ]


def _run_table(told: Told, measures: dict[str, Any]) -> Table:
    sizes = sorted({(photo.width_px, photo.height_px) for photo in told.photos})
    shown = ", ".join(f"{width} x {height}" for width, height in sizes[:3])
    rows: list[tuple[str, str]] = [
        ("resolution", shown + (f" and {len(sizes) - 3} more" if len(sizes) > 3 else "")),
        ("photos (N)", f"{measures['photos']}"),
        ("calibrated (N cal)", f"{measures['calibrated']}"),
        *((f"time of {step.name}", f"{step.seconds:.1f} s") for step in told.steps),
        ("time in all", f"{measures['seconds']:.1f} s"),
        ("features per photo (n SIFT, mean)", f"{measures['keypoints_mean']:,.0f}"),
        ("points (n points 3D)", f"{measures['points']:,}"),
        ("error", f"{measures['error_px']:.3f} px"),
    ]
    note = f"As table 2.1 of the thesis that the method follows. Compared: {told.how}."
    return Table("The run", ("what", "how much"), rows, note=note)


def _cameras(told: Told) -> Table:
    rows: list[Sequence[float | int | str | None]] = []
    exif = {photo.image_id: photo.focal_px for photo in told.photos}
    for number, component in enumerate(told.components):
        structure = component.structure
        errors = errors_px(structure)
        for row, image_id in enumerate(structure.image_ids):
            own = structure.image_of == row
            camera = structure.camera(row)
            rows.append(
                [
                    structure.names[row],
                    number,
                    int(own.sum()),
                    round(float(errors[own].mean()), 3) if own.any() else None,
                    round(camera.mean_focal_length(), 1),
                    None if (stated := exif[image_id]) is None else round(stated, 1),
                ]
            )
    columns = ("photo", "component", "points seen", "error px", "focal length px", "by EXIF px")
    return Table("Cameras", columns, rows)


def _left(told: Told) -> list[Table]:
    rows = [list(pair) for pair in told.left]
    return [Table("Photos left out, and why", ("photo", "why"), rows)] if rows else []


def _kinds(told: Told) -> list[Table]:
    """How the kind of camera was chosen, for each component."""
    note = (
        "A fifth of the observations was held out, the cameras were adjusted to the others, and"
        " the error is that of the held-out ones. The first kind is taken that is not worse than"
        " the best, but for chance."
    )
    columns = ("lens", "cameras", "principal point", "numbers", "held-out error px", "taken")
    tables = []
    for number, component in enumerate(told.components):
        rows = [
            [
                candidate.kind.lens,
                candidate.kind.sharing,
                candidate.kind.principal_point,
                candidate.parameters,
                round(candidate.error_px, 4),
                "yes" if candidate.kind == component.lens.kind else "",
            ]
            for candidate in component.lens.tried
        ]
        title = "Which kind of camera" + (f" (component {number})" if number else "")
        if rows:
            tables.append(Table(title, columns, rows, note=note, for_experts=True))
    return tables
