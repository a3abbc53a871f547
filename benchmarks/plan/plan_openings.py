"""Openings of walls that are known: the paper's way and Veduta's side by side; what scores mean.

    python benchmarks plan/plan_openings [--seeds A..B] [--keep]

As in AV3D, where a person has drawn the walls: each straight wall of synthetic plans of known
styles is searched for doors and windows, by `openings.av3d` and by `openings.along`. The second
table is of plans that are read as a whole, without text: of all openings with a score, the share
that is right.
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from plan_scores import NONE, Hits, gap_overlap, matched
from plan_sets import seeds
from plan_truth import Gap as TrueGap
from plan_truth import true_layout
from record import Row, keep_or_print

from veduta.plan.clean import ink as inks
from veduta.plan.clean.sheet import clean_sheet
from veduta.plan.drawn import Cleaned, Drawn
from veduta.plan.openings.along import changed_stretches, profile, usual_profile
from veduta.plan.openings.av3d import search_wall
from veduta.plan.openings.classify import judge
from veduta.plan.openings.evidence import look_at
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.strip import Sheet, cut_strip
from veduta.plan.reading import read_cleaned
from veduta.run.errors import NotFoundError
from veduta.synthetic.plans.house import Wall
from veduta.synthetic.plans.sets import FIRST_TEST_SEED, sheets_of
from veduta.synthetic.plans.truth_file import SheetTruth

WIDTHS_M = (0.45, 3.0)
THIN_M = 0.1
BINS = (0.0, 0.4, 0.6, 0.75, 0.9, 1.01)
NOTES = (
    "Openings of straight walls whose places and thicknesses are known; right: IoU 0.5 along the"
    " wall and door (gaps with them) or window. Seeds below 10000.",
    "Scores: openings of whole plans, by the score that plan.json says; right as in `plan`.",
)
Span = tuple[float, float, str]


@dataclass(frozen=True)
class Line:
    """A true wall in pixels, and its true openings along it."""

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    thickness_px: float
    outer: bool
    openings: tuple[Span, ...]


def lines_of(truth: SheetTruth, clean_from_m: NDArray[np.float64]) -> list[Line]:
    """The straight walls of a sheet."""
    scale = float(abs(np.linalg.det(clean_from_m[:2, :2])) ** 0.5)

    def px(point: tuple[float, float]) -> NDArray[np.float64]:
        return np.asarray(clean_from_m[:2, :2] @ np.array(point) + clean_from_m[:2, 2])

    def openings(wall: Wall) -> tuple[Span, ...]:
        return tuple(
            (one.along_m * scale, (one.along_m + one.width_m) * scale, _side(one.kind))
            for one in truth.storey.openings
            if one.wall == wall.id
        )

    return [
        Line(px(w.start_m), px(w.end_m), w.thickness_m * scale, w.outer, openings(w))
        for w in truth.storey.walls
        if w.bulge == 0.0
    ]


def _side(kind: str) -> str:
    return "window" if kind == "window" else "door"


def by_av3d(line: Line, sheet: Sheet, scale: float) -> list[Span]:
    """What the paper's way finds."""
    widths = (WIDTHS_M[0] * scale, WIDTHS_M[1] * scale)
    found = search_wall(line.start, line.end, line.thickness_px, sheet, widths)
    return [
        (one.first_px, one.last_px, "door" if one.type == "swing" else "window") for one in found
    ]


def by_along(lines: Sequence[Line], sheet: Sheet, scale: float) -> list[list[Span]]:
    """What differs from walls, judged by what is drawn there; for each line."""
    own = [profile(cut_strip(one.start, one.end, one.thickness_px, sheet)) for one in lines]
    found = []
    for line, across in zip(lines, own, strict=True):
        alike = [p for p, other in zip(own, lines, strict=True) if other.outer == line.outer]
        spans = changed_stretches(across, usual_profile(alike), WIDTHS_M[0] * scale)
        found.append([one for span in spans if (one := _judged(line, span, sheet, scale))])
    return found


def _judged(line: Line, span: tuple[int, int], sheet: Sheet, scale: float) -> Span | None:
    length = float(np.hypot(*(line.end - line.start)))
    way, near = (line.end - line.start) / length, line.thickness_px / 2
    low, high = max(float(span[0]), near), min(float(span[1]), length - near)
    if high - low < 3:
        return None
    ends = line.start + low * way, line.start + high * way
    gap = Gap(0, True, 0, False, *ends, line.thickness_px, ends[1])
    judged = judge(gap, look_at(gap, sheet), THIN_M * scale, line.outer)
    return None if judged is None else (low, high, _side(judged.kind))


def hits(found: Sequence[Span], true: Sequence[Span]) -> Hits:
    """Right ones by overlap and side."""

    def affinity(first: Span, second: Span) -> float:
        common = min(first[1], second[1]) - max(first[0], second[0])
        share = common / (max(first[1], second[1]) - min(first[0], second[0]))
        return share if share >= 0.5 and first[2] == second[2] else 0.0

    return Hits(len(matched(found, true, affinity)), len(found), len(true))


def scored(drawn: Drawn, truth: SheetTruth) -> Iterator[tuple[float, bool]]:
    """The score of each opening of a plan, and whether it is right."""
    to_m = np.linalg.inv(truth.px_from_m) @ np.linalg.inv(drawn.cleaned.clean_from_scan)
    scale = float(abs(np.linalg.det(to_m[:2, :2])) ** 0.5)
    walls, gaps = {wall.id: wall for wall in drawn.walls}, []
    for one in drawn.openings:
        ends = drawn.wall_ends(walls[one.wall])
        way = (ends[1] - ends[0]) / float(np.hypot(*(ends[1] - ends[0])))
        at = np.array(
            [ends[0] + along * way for along in (one.along_px, one.along_px + one.width_px)]
        )
        plain = one.kind == "door" and one.type == "plain"
        kind = "gap" if plain else one.kind
        metres = at @ to_m[:2, :2].T + to_m[:2, 2]
        gaps.append(TrueGap(kind, one.type, metres, walls[one.wall].thickness_px * scale))

    def affinity(first: TrueGap, second: TrueGap) -> float:
        share = gap_overlap(first, second)
        return share if share >= 0.5 and first.kind == second.kind else 0.0

    right = {i for i, _ in matched(gaps, true_layout(truth).gaps, affinity)}
    for index, one in enumerate(drawn.openings):
        yield one.score, index in right


def measure(chosen: Sequence[int]) -> list[Row]:
    """Both tables."""
    known: dict[tuple[str, str], Hits] = defaultdict(lambda: NONE)
    says: list[tuple[float, bool]] = []
    for seed in chosen:
        for picture, truth in sheets_of(seed):
            cleaned: Cleaned = clean_sheet(picture)
            clean_from_m = cleaned.clean_from_scan @ truth.px_from_m
            scale = float(abs(np.linalg.det(clean_from_m[:2, :2])) ** 0.5)
            sheet = Sheet(cleaned.ink, inks.faint_marks(cleaned.ink, cleaned.line_px))
            lines = lines_of(truth, clean_from_m)
            for line, along in zip(lines, by_along(lines, sheet, scale), strict=True):
                for name, found in (("along", along), ("AV3D", by_av3d(line, sheet, scale))):
                    for style in (truth.style, "all"):
                        known[style, name] += hits(found, line.openings)
            try:
                says += scored(read_cleaned(cleaned), truth)
            except NotFoundError:
                continue
    styles = sorted({style for style, _ in known})
    rows: list[Row] = [
        {
            "set": "known walls",
            "part": style,
            "true": known[style, "along"].true,
            "AV3D F1": known[style, "AV3D"].f1,
            "along F1": known[style, "along"].f1,
        }
        for style in styles
    ]
    for low, high in zip(BINS, BINS[1:], strict=False):
        inside = [right for score, right in says if low <= score < high]
        if inside:
            share = float(np.mean(inside))
            part = f"{low:.2f} to {min(high, 1.0):.2f}"
            rows.append({"set": "score", "part": part, "found": len(inside), "right": share})
    return rows


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=seeds, default=range(64, 80))
    parser.add_argument("--keep", action="store_true")
    arguments = parser.parse_args()
    if max(arguments.seeds) >= FIRST_TEST_SEED:
        parser.error("these seeds are kept back from development")
    keep_or_print("plan_openings", measure(arguments.seeds), NOTES, keep=arguments.keep)


if __name__ == "__main__":
    main()
