"""From the rectified photo to the facade document by edges and colours alone: the recipe."""

from __future__ import annotations

from veduta.facade.appearance import class_scores, wall_colour
from veduta.facade.bare_floors import doubt_railings
from veduta.facade.between import doubt_unparted, look_between
from veduta.facade.compose import Parse, compose
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.evidence import gather
from veduta.facade.extent import find_skyline, row_histograms
from veduta.facade.floors import split_floors
from veduta.facade.ground import read_ground
from veduta.facade.ground_windows import find_ground_windows, with_windows
from veduta.facade.openings import find_openings, only_seen, read_columns
from veduta.facade.options import FacadeOptions
from veduta.facade.plausible import require_facade, storey_doubts
from veduta.facade.presence import require_building
from veduta.facade.rectify import Rectified
from veduta.facade.roof_windows import find_roof_windows
from veduta.facade.rows import gather_rows
from veduta.facade.sides import crop, find_sides, whole
from veduta.run.progress import StepProgress, no_progress
from veduta.run.report import StepRecord, timed_step


def analyse_plain(
    rectified: Rectified,
    source: Source,
    options: FacadeOptions,
    progress: StepProgress = no_progress,
) -> tuple[FacadeDocument, list[StepRecord]]:
    """By edges and colours alone, nothing learned; NotFoundError where the image shows none."""
    steps: list[StepRecord] = []
    with timed_step(steps, "extent") as step:
        progress("extent", 0.0)
        evidence = gather(rectified.pixels, rectified.valid)
        require_building(evidence)
        skyline = find_skyline(evidence)
        named = rectified.record.method == "corners"
        sides = whole(evidence) if named else find_sides(evidence, skyline)
        sky, (evidence, skyline) = skyline, crop(evidence, skyline, sides)
        histograms = row_histograms(evidence, skyline)
        step.counts |= {"skyline_row": skyline.level, "left": sides.left, "right": sides.right}
        if skyline.reason:
            step.rejected.append(f"sky: {skyline.reason}")
    with timed_step(steps, "floors") as step:
        progress("floors", 0.3)
        lines = gather_rows(evidence, skyline, histograms)
        floors = split_floors(lines, options.scale.height_m)
        floors_above_ground = len(floors.boundaries) - 1
        step.counts |= {"floors_above_ground": floors_above_ground, "energy": floors.energy}
    with timed_step(steps, "columns") as step:
        progress("columns", 0.6)
        rows = floors.eaves, floors.ground_top
        wall = wall_colour(evidence, *rows, floors.mean_storey)
        cues = class_scores(evidence, wall, *rows, floors.mean_storey)
        columns, scores = read_columns(evidence, floors, wall, cues)
        step.counts |= {"columns": len(columns.stripes), "energy": columns.energy}
    with timed_step(steps, "openings") as step:
        progress("openings", 0.8)
        boxes = find_roof_windows(evidence, skyline, floors, columns)
        openings = find_openings(evidence, floors, columns, scores, cues)
        boxes += doubt_railings(openings, cues, floors)
        require_facade(lines, floors, wall, boxes)
        pairs = look_between(boxes, wall, floors)
        boxes = doubt_unparted(boxes, pairs, floors)
        doubts = storey_doubts(lines, floors, cues.window, pairs)
        under = find_ground_windows(evidence, floors, columns)
        boxes += with_windows(read_ground(evidence, floors, wall), under, floors.mean_storey)
        boxes = only_seen(boxes, evidence, skyline)
        for kind in ("window", "balcony", "door", "shop"):
            step.counts[kind] = sum(b.kind == kind for b in boxes)
    with timed_step(steps, "document"):
        document = compose(
            Parse(evidence, sky, skyline, sides, floors, columns, boxes, doubts),
            rectified,
            source,
            options,
        )
    progress("document", 1.0)
    return document, steps
