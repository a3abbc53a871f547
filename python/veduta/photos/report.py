"""What `report.json` and `report.html` say: the run in numbers, and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from veduta.photos.cameras.component import Component, component_name
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.laying import Laid
from veduta.photos.mapping.doubt import Doubt
from veduta.photos.mapping.engine import NAME, engine_version
from veduta.photos.mapping.initial_pair import Start
from veduta.photos.mapping.rigs import RigTold
from veduta.photos.matching.match import PairRecord
from veduta.photos.options import PhotosOptions
from veduta.photos.report_doubts import (
    FOLDED_NOTE,
    components_note,
    doubts_note,
    doubts_table,
)
from veduta.photos.report_pictures import error_picture, match_picture, plan_picture
from veduta.photos.report_rig import (
    panorama_measures,
    panorama_notes,
    rig_alarms,
    rig_measures,
    rig_table,
)
from veduta.photos.report_starts import GLOBAL_NOTE, starts_notes, starts_table
from veduta.photos.texture.step import Textured
from veduta.photos.walls.report import walls_pictures, walls_table
from veduta.photos.walls.step import FoundWalls
from veduta.photos.world.position_file import PhotoPositions
from veduta.photos.world.report import (
    georef_alarms,
    georef_line,
    georef_measures,
    georef_notes,
    georef_tables,
)
from veduta.run.failed import failure_report
from veduta.run.page import Bars, Page, Picture, Table, render
from veduta.run.report import Failure, Report, StepRecord, counted, versions

FILES = (
    ("sparse/", "cameras, photos and points as COLMAP has them (`.bin`, `.txt`), by component"),
    ("points.ply", "the points of the first component, with colours"),
    ("points.laz", "the same, for survey software"),
    ("frames/", "with `--video`: the frames of the film that are photos"),
    ("pictures/", "the photos without the distortion of the lens, as the studio shows them"),
    ("walls.json", "the walls that the points speak for: ends, heights, and their pictures"),
    ("walls/", "a metric picture of each wall (transparent: not seen), and `walls.glb`"),
    ("panoramas.json", "where each panorama that was cut into views stands, and how it is turned"),
    ("georef.json", "where the place lies in the world, how well that is known, and why"),
    ("model.city.json", "the city model with textures, where photos lie in one (CityJSON)"),
    ("textures/", "its pictures, and of each a mask: white where no photo shows it"),
    ("parts/", "its textured buildings, a file each, and the others together (glTF binary)"),
    ("tileset.json", "all its buildings, for viewers of 3D Tiles"),
    ("place.json", "points, cameras, walls and the textured model, for `veduta view`"),
)
ENGINE_NOTE = (
    "the engine adds up on several threads: another run may differ in the last digits of a pose"
)
SCALE_NOTE = (
    "the scale is not known: nothing in the photos says it. The unit is chosen so that points lie"
    " 10 from the cameras in the middle"
)
UP_NOTE = "up is inferred: people hold cameras level, and walls and vertical edges stand upright"


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
    notes: list[str] = field(default_factory=list)
    """What else a person has to know of the run."""
    marks: list[str] = field(default_factory=list)
    """Lines of the control points that name photos which are not there."""
    positions: PhotoPositions | None = None
    """Where a file says that photos were taken."""
    alarms: list[str] = field(default_factory=list)
    """What a person must be told at the terminal, too."""
    is_given: bool = False
    """Whether other software has made the model."""
    components: list[Component] = field(default_factory=list)
    doubts: tuple[Doubt, ...] = ()
    """Pairs that match, and that were not mapped with."""
    starts: tuple[Start, ...] = ()
    """The pairs of photos that maps were begun with."""
    folded: bool = False
    """Whether photos contradict each other all the same."""
    laid: list[Laid] = field(default_factory=list)
    """The components where they lie."""
    walls: FoundWalls = field(default_factory=lambda: FoundWalls((), ()))
    """Of the first component."""
    rig: RigTold | None = None
    """Where the photos were taken by one."""
    textured: Textured | None = None
    """The city model, where the first component lies in one."""


def measures_of(told: Told) -> dict[str, Any]:
    """The run in numbers; sizes of the first component, which is shown."""
    first, errors = told.components[0].structure, told.components[0].errors_px
    kind = told.components[0].lens.kind
    return {
        "photos": len(told.photos) + len(told.left) - _placeless(told),
        "calibrated": sum(len(item.structure.names) for item in told.components),
        "components": [len(item.structure.names) for item in told.components],
        "keypoints_mean": round(float(np.mean(told.keypoints)), 1),
        "pairs": len(told.pairs),
        "pairs_verified": sum(pair.verified > 0 for pair in told.pairs),
        "pairs_doubtful": len(told.doubts),
        "points": len(first.points),
        "observations": len(first.point_of),
        "track_mean": round(len(first.point_of) / max(1, len(first.points)), 3),
        "error_px": round(float(errors.mean()), 4),
        "error_median_px": round(float(np.median(errors)), 4),
        "walls": len(told.walls.walls),
        "lens": kind.lens,
        "cameras": kind.sharing,
        "principal_point": kind.principal_point,
        "seconds": round(sum(step.seconds for step in told.steps), 1),
        **({"gcp_unknown": told.marks} if told.marks else {}),
        "alarms": [
            *told.alarms,
            *rig_alarms(told.rig),
            *georef_alarms([one.georef for one in told.laid]),
        ],
        **georef_measures([one.georef for one in told.laid]),
        **({} if told.textured is None else told.textured.measures),
        **rig_measures(told.rig),
        **panorama_measures([one.structure for one in told.components]),
    }


def _placeless(told: Told) -> int:
    """Photos that are in both lists: readable, but without a pose."""
    names = {photo.name for photo in told.photos}
    return sum(name in names for name, _ in told.left)


def summary_line(measures: dict[str, Any]) -> str:
    """What was found, in a line."""
    parts = measures["components"]
    several = f" in {len(parts)} components" if len(parts) > 1 else ""
    world = georef_line(measures)
    return (
        f"{measures['calibrated']} of {counted(measures['photos'], 'photo')} calibrated{several}, "
        f"{measures['points']:,} points, {measures['error_px']:.2f} px off on average"
        + (f"; {world}" if world else "")
    )


def _headline(measures: dict[str, Any]) -> str:
    """As `summary_line`; the terminal has what was refused in lines of its own."""
    nowhere = measures.get("georef_refused") and not measures.get("georeferenced")
    return summary_line(measures) + ("; not laid into the world" if nowhere else "")


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
    georef = [one.georef for one in told.laid]
    page = Page(
        title=told.folder,
        summary=_headline(measures),
        facts=_facts(measures),
        pictures=[
            plan_picture(component.structure, in_metres=georef[0].accepted is not None),
            *walls_pictures(component.structure, told.walls),
            *(picture for one in told.laid for picture in one.pictures),
            *(() if told.textured is None else told.textured.pictures),
            _matches(told),
            error_picture(component.errors_px),
        ],
        tables=[
            _run_table(told, measures),
            *georef_tables(georef),
            *(() if told.textured is None else told.textured.tables),
            *walls_table(told.walls, "unknown" if georef[0].accepted is None else "metres"),
            _cameras(told),
            *_left(told),
            *doubts_table(told.doubts, _names(told)),
            *rig_table(told.rig, component.structure, told.photos),
            *starts_table(told.starts, _image_ids(told), _names(told)),
            *_kinds(told),
        ],
        bars=[Bars("Time per step", "s", [(step.name, step.seconds) for step in told.steps])],
        files=_files(told),
    )
    return report, render(report, page)


def _files(told: Told) -> list[tuple[str, str]]:
    """What lies beside the report: a link to what is not there helps nobody."""
    missing = set()
    if not any(photo.video for photo in told.photos):
        missing.add("frames/")
    if not any(photo.view for photo in told.photos):
        missing.add("panoramas.json")
    if not told.walls.pictures:
        missing.add("walls/")
    if told.textured is None:
        missing |= {"model.city.json", "textures/", "parts/", "tileset.json"}
    return [(name, meaning) for name, meaning in FILES if name not in missing]


def failed_report(told: Told, failure: Failure) -> tuple[Report, bytes]:
    """The report of a run that gave nothing, with the matches and what was left out."""
    page = Page(
        title=told.folder,
        summary="No photos could be placed.",
        pictures=[_matches(told)] if told.pairs else [],
        tables=_left(told),
    )
    engines = {NAME: engine_version()}
    return failure_report(
        "photos", told.folder, failure, told.options, told.steps, page=page, engines=engines
    )


def _matches(told: Told) -> Picture:
    doubtful = [(doubt.first, doubt.second) for doubt in told.doubts]
    names = [photo.name for photo in told.photos]
    ids = [photo.image_id for photo in told.photos]
    return match_picture(ids, told.pairs, doubtful, names)


def _notes(told: Told) -> list[str]:
    georef = [one.georef for one in told.laid]
    in_world = bool(georef) and georef[0].accepted is not None
    notes = [] if in_world else [SCALE_NOTE]
    notes += [up_note(told.components[0]), *georef_notes(georef), *told.notes]
    notes += [f"control points, {mark}" for mark in told.marks]
    notes += [*told.alarms, *rig_alarms(told.rig), *panorama_notes(told.photos)]
    notes += [] if told.textured is None else [told.textured.line]
    notes += [f"{photo.name}: {note}" for photo in told.photos for note in photo.notes]
    unknown = sum(photo.focal_px is None for photo in told.photos)
    if unknown and not told.is_given:
        notes.append(
            f"{counted(unknown, 'photo')} of {len(told.photos)} without a focal length in EXIF:"
            " it was found from the photos alone"
        )
    listed = sum(photo.focal_source == "camera-table" for photo in told.photos)
    if listed:
        notes.append(
            f"{counted(listed, 'photo')} of {len(told.photos)} whose EXIF gives a focal length in"
            " millimetres alone: the size of the sensor is from the table of cameras"
        )
    if len(told.components) > 1:
        sizes = [len(item.structure.names) for item in told.components]
        notes.append(components_note(sizes, [one.accepted is not None for one in georef]))
    if told.options.map.mapping == "global" and not told.is_given:
        notes.append(GLOBAL_NOTE)
    notes += starts_notes(told.starts, _image_ids(told), _names(told))
    if told.doubts:
        notes.append(doubts_note(told.doubts))
    if told.folded:
        notes.append(FOLDED_NOTE)
    return notes if told.is_given else [*notes, ENGINE_NOTE]


def _names(told: Told) -> dict[int, str]:
    return {photo.image_id: photo.name for photo in told.photos}


def _image_ids(told: Told) -> list[tuple[int, ...]]:
    return [component.structure.image_ids for component in told.components]


def up_note(component: Component) -> str:
    """What says which way is up."""
    found = component.upright
    if found is not None and found.by:
        return f"up is inferred from {found.by}, to {found.sd_deg:.1f}°"
    note = f"{UP_NOTE}; the cameras lie {component.level_deg:.1f}° off"
    if found is None:
        return note
    return f"{note}, and what is upright moved it by {found.moved_deg:.1f}°"


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
        ("photos", f"{measures['photos']}"),
        ("photos whose place was found", f"{measures['calibrated']}"),
        *((f"time of {step.name}", f"{step.seconds:.1f} s") for step in told.steps),
        ("time in all", f"{measures['seconds']:.1f} s"),
        ("features per photo, on average", f"{measures['keypoints_mean']:,.0f}"),
        ("points in space", f"{measures['points']:,}"),
        ("distance of a feature from its point, on average", f"{measures['error_px']:.3f} px"),
    ]
    note = f"Which photos were compared: {told.how}."
    return Table("The run", ("what", "how much"), rows, note=note)


def _cameras(told: Told) -> Table:
    rows: list[Sequence[float | int | str | None]] = []
    exif = {photo.image_id: photo.focal_px for photo in told.photos}
    for number, component in enumerate(told.components):
        structure, errors = component.structure, component.errors_px
        for row, image_id in enumerate(structure.image_ids):
            own = structure.image_of == row
            camera = structure.camera(row)
            rows.append(
                [
                    structure.names[row],
                    component_name(number),
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
        "Observations were held out in five parts, one after the other, the cameras were adjusted"
        " to the others, and the error is that of the held-out ones. The first kind is taken that"
        " is not worse than the best, but for chance. What was clearly worse on some parts was not"
        " tried on all: it saw fewer."
    )
    columns = (
        "lens",
        "cameras",
        "principal point",
        "numbers",
        "held out",
        "held-out error px",
        "taken",
    )
    tables = []
    for number, component in enumerate(told.components):
        rows = [
            [
                candidate.kind.lens,
                candidate.kind.sharing,
                candidate.kind.principal_point,
                candidate.parameters,
                len(candidate.errors_px),
                round(candidate.error_px, 4),
                "yes" if candidate.kind == component.lens.kind else "",
            ]
            for candidate in component.lens.tried
        ]
        title = "Which kind of camera" + (
            f" (component {component_name(number)})" if number else ""
        )
        if rows:
            tables.append(Table(title, columns, rows, note=note, for_experts=True))
    return tables
