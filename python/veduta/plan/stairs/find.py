"""Stairs: treads are parallel lines as long as each other, evenly apart, or turn (`turning`).

Lines are those of the ink that are as long as half a flight is wide at least; an arrow that runs up
the middle parts each in two. What has lines as close in both directions is a tiled floor.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from statistics import median

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Text
from veduta.plan.drawn import Drawn, DrawnStairs
from veduta.plan.stairs.arrow import way_up
from veduta.plan.stairs.probe import probe_of
from veduta.plan.stairs.turning import find_turning
from veduta.plan.walls.runs import run_lengths_down

TREAD_M = (0.19, 0.38)
"""From one nosing to the next."""
WIDTH_M = (0.55, 2.6)
TREAD = (0.005, 0.06)
"""The same as a share of the longer side of all that is drawn."""
RATIO = (1.8, 11.0)
"""Of a tread's width to its depth."""
LEAST_LINE = 0.012
"""Of the lines that are looked for: half a narrow flight beside its arrow; a share, too."""
LEAST_TREADS = 5
MOST_TREADS = 30
EVEN = 0.16
"""Treads of a flight differ by at most this share (and a pixel) from the usual one."""
SAME_ENDS = 0.16
"""Ends of treads lie in line but for this share of their length."""
ARROW = 0.032
"""A tread may be broken over such a share by an arrow or a word."""
INSIDE = 0.85
"""So much of a flight lies in the rooms."""
MISSED = 1
"""So many treads in a row may be hidden, by the word beside an arrow."""
LONGER = 1.3
"""Lines that are so many times as long go on beyond the treads."""
MOST_LINES = 4000
"""A sheet with more short lines is a texture."""
WALL = 0.8
"""A row of ink with this share of the treads' width is a wall's face."""
ACROSS = 0.5
"""A floor is tiled if it has this part of the lines across the treads."""


@dataclass(frozen=True)
class _Line:
    """A horizontal line: its middle's y, and both ends' x, in pixels."""

    y: float
    left: float
    right: float

    @property
    def length(self) -> float:
        return self.right - self.left


def find_flights(
    ink: NDArray[np.bool_], line_px: float, texts: Sequence[Text] = ()
) -> tuple[DrawnStairs, ...]:
    """What looks like flights in the (h, w) mask of ink, whatever its scale; the best first."""
    extent = _extent(ink)
    turned_ink = np.ascontiguousarray(ink.T)
    level = _lines(ink, line_px, extent)
    upright = _lines(turned_ink, line_px, extent)
    found: list[tuple[float, Polygon, int, bool]] = []
    for lines, others, turned in ((level, upright, False), (upright, level, True)):
        for chain in _chains(lines, extent):
            if _goes_on(chain, lines):
                continue
            chain = _to_walls(chain, turned_ink if turned else ink, line_px)
            area = _area(chain)
            if not _crossed(area, len(chain), others):
                shape = _turned(area) if turned else area
                found.append((_score(chain), shape, len(chain) - 1, turned))
    found.sort(key=lambda one: -one[0] * one[2])
    kept: list[DrawnStairs] = []
    for score, shape, treads, turned in found:
        if any(shape.intersects(Polygon(one.outline_px).buffer(-2.0)) for one in kept):
            continue
        up = way_up(shape, turned, ink, treads, texts)
        ring = np.array(shape.exterior.coords)[:-1]
        kept.append(DrawnStairs("", ring, treads, up, round(score, 3), turned))
    stairs = find_turning(ink, kept, probe_of(ink, line_px, extent), texts)
    return tuple(replace(one, id=f"s{number}") for number, one in enumerate(stairs, start=1))


def without_flights(
    ink: NDArray[np.bool_], flights: Sequence[DrawnStairs], line_px: float
) -> NDArray[np.bool_]:
    """The mask without what is drawn in flights: between treads it is as narrow as in walls.

    The lines around a flight stay: they may be faces of walls.
    """
    cleared = ink.copy()
    rim = round(line_px) + 1
    for one in flights:
        if one.steps_px:
            _clear(cleared, Polygon(one.outline_px).buffer(-rim, join_style="mitre"))
            continue
        left, low, right, high = (round(side) for side in Polygon(one.outline_px).bounds)
        cleared[
            low + rim : max(low + rim, high - rim), left + rim : max(left + rim, right - rim)
        ] = 0
    return cleared


def _clear(ink: NDArray[np.bool_], region: BaseGeometry) -> None:
    mask = np.zeros(ink.shape, np.uint8)
    for piece in getattr(region, "geoms", [region]):
        if isinstance(piece, Polygon) and not piece.is_empty:
            cv2.fillPoly(mask, [np.round(piece.exterior.coords).astype(np.int32)], (1,))
    ink[mask > 0] = False


def true_flights(drawn: Drawn, metres_per_px: float) -> tuple[DrawnStairs, ...]:
    """Those of `drawn.stairs` that have the size of stairs and lie in the house."""
    reach = max((wall.thickness_px for wall in drawn.walls), default=0.0) + 2.0
    rooms = [Polygon(room.outline_px) for room in drawn.rooms if not room.outdoors]
    around = unary_union([room.buffer(reach, join_style="mitre") for room in rooms])
    house = unary_union([Polygon(part.exterior) for part in getattr(around, "geoms", [around])])
    kept: list[DrawnStairs] = []
    for one in drawn.stairs:
        tread, width = (side * metres_per_px for side in _sides(one))
        sized = TREAD_M[0] <= tread <= TREAD_M[1] and WIDTH_M[0] <= width <= WIDTH_M[1]
        shape = Polygon(one.outline_px)
        if sized and house.intersection(shape).area >= INSIDE * shape.area:
            kept.append(replace(one, id=f"s{len(kept) + 1}"))
    return tuple(kept)


def _sides(one: DrawnStairs) -> tuple[float, float]:
    """Depth and width of a tread, in pixels: treads are wider than deep, but not flights."""
    if one.path_px is not None:
        outline = Polygon(one.outline_px)
        width = outline.area / LineString(one.path_px).length
        return float(np.median([Polygon(step).area for step in one.steps_px])) / width, width
    left, low, right, high = Polygon(one.outline_px).bounds
    first, second = (right - left, high - low) if one.across else (high - low, right - left)
    return first / one.treads, second


def _extent(ink: NDArray[np.bool_]) -> float:
    rows, columns = np.flatnonzero(ink.any(axis=1)), np.flatnonzero(ink.any(axis=0))
    return float(max(np.ptp(rows), np.ptp(columns)) + 1) if len(rows) else 1.0


def _lines(ink: NDArray[np.bool_], line_px: float, extent: float) -> list[_Line]:
    """Thin horizontal lines of the mask, those in one row with a gap for an arrow made one."""
    least = max(5, round(LEAST_LINE * extent))
    # Walls that treads end at are no part of them.
    thin = ink & (run_lengths_down(ink) <= 1.8 * line_px + 3.0)
    # A line that is askew by a pixel over its length is still one.
    thick = cv2.dilate(thin.astype(np.uint8), np.ones((3, 1), np.uint8))
    opened = cv2.morphologyEx(thick, cv2.MORPH_OPEN, np.ones((1, least), np.uint8))
    _, _, stats, centres = cv2.connectedComponentsWithStats(opened, connectivity=8)
    most = 2.5 * line_px + 4.0
    pieces = [
        _Line(float(at[1]) + 0.5, float(row[cv2.CC_STAT_LEFT]), float(row[:3:2].sum()))
        for row, at in zip(stats[1:], centres[1:], strict=True)
        if row[cv2.CC_STAT_HEIGHT] <= most
    ]
    pieces.sort(key=lambda one: (one.y, one.left))
    return _joined(pieces, max(1.5, 0.5 * line_px), ARROW * extent)


def _joined(pieces: Sequence[_Line], same_px: float, gap_px: float) -> list[_Line]:
    """Pieces in one row with a small gap between them made one; the pieces stay, too."""
    rows: list[list[_Line]] = []
    for one in pieces:
        if rows and one.y - rows[-1][-1].y <= same_px:
            rows[-1].append(one)
        else:
            rows.append([one])
    found: list[_Line] = []
    for row in rows:
        row.sort(key=lambda one: one.left)
        whole = row[0]
        joined = [whole]
        for one in row[1:]:
            if one.left - whole.right <= gap_px:
                whole = _Line((whole.y + one.y) / 2, whole.left, max(whole.right, one.right))
                joined.append(whole)
            else:
                whole = one
            joined.append(one)
        found += joined
    return sorted(found, key=lambda one: one.y)


def _chains(lines: Sequence[_Line], extent: float) -> list[list[_Line]]:
    """Series of lines one above the other, evenly apart."""
    near, far = (one * extent for one in TREAD)
    wide = [one for one in lines if RATIO[0] * near <= one.length <= RATIO[1] * far]
    if len(wide) > MOST_LINES:
        return []
    ys = [one.y for one in wide]
    used: set[int] = set()
    chains = []
    for first in range(len(wide)):
        if first in used:
            continue
        best: list[int] = []
        for second in range(first + 1, len(wide)):
            step = wide[second].y - wide[first].y
            if step > far:
                break
            ratio = wide[first].length / max(step, 1.0)
            if (
                step >= max(near, 5.0)
                and RATIO[0] <= ratio <= RATIO[1]
                and _alike(wide[first], wide[second])
            ):
                chain = _followed(wide, ys, [first, second])
                best = chain if len(chain) > len(best) else best
        if LEAST_TREADS <= len(best) - 1 <= MOST_TREADS:
            used.update(best)
            chains.append([wide[index] for index in best])
    return [_with_hidden(chain) for chain in chains]


def _followed(lines: Sequence[_Line], ys: Sequence[float], chain: list[int]) -> list[int]:
    """The chain, as long as there is a line where the next tread should be."""
    while True:
        last = lines[chain[-1]]
        step = median(_steps([lines[index] for index in chain]))
        slack = EVEN * step + 1.0
        after: int | None = None
        for jump in range(1, MISSED + 2):
            wanted = last.y + jump * step
            near = [
                index
                for index in range(
                    max(chain[-1] + 1, bisect_left(ys, wanted - slack)),
                    bisect_right(ys, wanted + slack),
                )
                if _alike(lines[index], lines[chain[0]])
            ]
            if near:
                after = min(near, key=lambda index: abs(lines[index].y - wanted))
                break
        if after is None:
            return chain
        chain.append(after)


def _to_walls(chain: list[_Line], ink: NDArray[np.bool_], line_px: float) -> list[_Line]:
    """The chain with the face of a solid wall as its first or last tread, where one stands."""
    step = median(_steps(chain))
    left = round(np.median([one.left for one in chain]))
    right = round(np.median([one.right for one in chain]))
    rows = ink[:, left:right].mean(axis=1) > WALL
    found = list(chain)
    for end, way in ((chain[0], -1), (chain[-1], 1)):
        near, far = (end.y + way * share * step for share in (1.0 - EVEN, 1.0 + EVEN))
        low, high = round(max(0.0, min(near, far))), round(max(near, far)) + 1
        dark = np.flatnonzero(rows[low:high]) + low
        if not len(dark):
            continue
        face = float(dark[0] if way > 0 else dark[-1] + 1)
        deep = round(2.0 * line_px) + 3
        behind = (
            rows[round(face) : round(face) + deep]
            if way > 0
            else rows[max(0, round(face) - deep) : round(face)]
        )
        if behind.all():
            one = _Line(face, left, right)
            found = [one, *found] if way < 0 else [*found, one]
    return found


def _steps(chain: Sequence[_Line]) -> list[float]:
    """Spacings, those over hidden treads in parts."""
    gaps = [there.y - here.y for here, there in pairwise(chain)]
    least = min(gaps)
    return [gap / max(1, round(gap / least)) for gap in gaps]


def _with_hidden(chain: list[_Line]) -> list[_Line]:
    """The chain with the treads put in that a word hides."""
    step = median(_steps(chain))
    whole = [chain[0]]
    for here, there in pairwise(chain):
        count = max(1, round((there.y - here.y) / step))
        for number in range(1, count):
            y = here.y + number * (there.y - here.y) / count
            whole.append(_Line(y, here.left, here.right))
        whole.append(there)
    return whole


def _alike(one: _Line, other: _Line) -> bool:
    slack = SAME_ENDS * max(one.length, other.length) + 2.0
    return abs(one.left - other.left) <= slack and abs(one.right - other.right) <= slack


def _area(chain: Sequence[_Line]) -> Polygon:
    left = float(np.median([one.left for one in chain]))
    right = float(np.median([one.right for one in chain]))
    return box(left, chain[0].y, right, chain[-1].y)


def _crossed(area: Polygon, count: int, others: Sequence[_Line]) -> bool:
    """Whether as many lines run across it: tiles. `others` are of the transposed sheet."""
    left, low, right, high = area.buffer(-3.0).bounds if area.area > 400 else area.bounds
    inside = [
        one
        for one in others
        if left < one.y < right and min(one.right, high) - max(one.left, low) > 0.6 * (high - low)
    ]
    # An arrow is one line, or two where it turns.
    rows = len({round(one.y / 3.0) for one in inside})
    return rows >= max(3.0, ACROSS * count * (right - left) / max(high - low, 1.0))


def _goes_on(chain: Sequence[_Line], lines: Sequence[_Line]) -> bool:
    """Whether most of the treads are parts of longer lines: tiles, or half of a flight."""
    longer = [
        any(
            abs(other.y - one.y) <= 2.0
            and other.left <= one.left + 2.0
            and other.right >= one.right - 2.0
            and other.length > LONGER * one.length
            for other in lines
        )
        for one in chain
    ]
    return float(np.mean(longer)) > 0.5


def _score(chain: Sequence[_Line]) -> float:
    """How even the treads are, and how many."""
    steps = np.diff([one.y for one in chain])
    uneven = float(np.std(steps) / np.mean(steps))
    return float(np.clip(0.5 + 0.04 * len(chain) - uneven, 0.05, 0.95))


def _turned(area: Polygon) -> Polygon:
    left, low, right, high = area.bounds
    return box(low, left, high, right)
