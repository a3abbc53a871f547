"""Where walls are interrupted: from an end of a wall on to the next wall in its line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.arcs import Arc
from veduta.plan.walls.pieces import FACET_RAD, Piece

PARALLEL_RAD = np.radians(7.0)
CROSSING_RAD = np.radians(25.0)
BESIDE = 0.55
"""Walls on both sides of an opening lie beside each other by at most this part of a thickness."""

FARTHEST = 60.0
"""Openings are at most so many wall thicknesses wide (a garage door in a thin wall)."""

LEAST_PX = 3
"""What is narrower is a flaw of the ink."""


@dataclass(frozen=True)
class Gap:
    """An interruption from an end of wall `piece` to `target`: its end, or its side.

    `start` and `end` (2,) lie on the centre line of `piece`; the end is on the target's face.
    `at_end` says which end of the piece this is (else its start). `far` is where the target's
    face is, where a stub too short to be a piece stands between it and the opening.
    """

    piece: int
    at_end: bool
    target: int
    to_side: bool
    start: NDArray[np.float64]
    end: NDArray[np.float64]
    thickness_px: float
    far: NDArray[np.float64]
    bulge: float = 0.0

    @cached_property
    def arc(self) -> Arc:
        """Its centre line."""
        return Arc(self.start, self.end, self.bulge)

    @property
    def width_px(self) -> float:
        """From wall to wall, on the centre line."""
        return self.arc.length_px

    @staticmethod
    def along(line: Piece, low: float, high: float) -> Gap:
        """A stretch of a wall that nothing interrupts."""
        part = line.part(low, high)
        return Gap(
            -1, True, -1, False, part.start, part.end, line.thickness_px, part.end, part.bulge
        )

    def part(self, low: float, high: float) -> Gap:
        """What of it lies between two places along it."""
        start, end = self.arc.at(np.array([low, high]))
        return replace(self, start=start, end=end, bulge=self.arc.bulge_of(low, high))


def find_gaps(pieces: list[Piece], curved: Sequence[Piece] = ()) -> list[Gap]:
    """The nearest wall ahead of each end of each piece, where it is not touching already.

    Straight gaps end at curved walls, too: these count as the pieces after the straight ones.
    """
    found: dict[tuple[object, ...], Gap] = {}
    facets = [(one, number) for number, arc in enumerate(curved) for one in arc.facets(FACET_RAD)]
    targets = [*pieces, *(one for one, _ in facets)]
    walls = _lines_of(targets)
    for index in range(len(pieces)):
        for at_end in (False, True):
            gap = _ahead(targets, walls, index, at_end)
            if gap is None:
                continue
            if gap.target >= len(pieces):
                number = facets[gap.target - len(pieces)][1]
                gap = replace(gap, target=len(pieces) + number, to_side=True)
            if gap.to_side:
                found[(index, at_end)] = gap
            else:
                found.setdefault(tuple(sorted((gap.piece, gap.target))), gap)
    return list(found.values())


def beyond_corners(pieces: Sequence[Piece]) -> list[Gap]:
    """From the far face of the wall that an end of a wall meets on to the next wall across.

    Nothing is interrupted there, but a wall of panels from end to end may go on.
    What walls in one line on both sides lead to is found once.
    """
    walls = _lines_of(pieces)
    found = []
    for index, piece in enumerate(pieces):
        for at_end in (False, True):
            tip = piece.end if at_end else piece.start
            ray = piece.direction if at_end else -piece.direction
            to_line, to_face, crosses = walls.crossings(tip, ray, walls.thickness)
            half = to_line - to_face
            crosses = crosses & (np.arange(len(pieces)) != index)
            met = crosses & (np.abs(to_line) <= half + 0.6 * piece.thickness_px)
            if not met.any():
                continue
            origin = tip + float((to_line + half)[met].max()) * ray
            ahead = np.where(crosses & ~met & (to_face > 0.0), to_face, np.inf)
            target = int(ahead.argmin())
            if not np.isfinite(ahead[target]):
                continue
            end = tip + float(ahead[target]) * ray
            if (end - origin) @ ray > LEAST_PX:
                thick = piece.thickness_px
                found.append(Gap(index, at_end, target, True, origin, end, thick, end))
    return _once(found)


def _once(gaps: Sequence[Gap]) -> list[Gap]:
    """Straight gaps without those whose middle lies in one before them, both in one line."""
    kept: list[int] = []
    lines = _lines_of(gaps)
    for number, gap in enumerate(gaps):
        away = (gap.start + gap.end) / 2.0 - lines.start[kept]
        way, line = lines.way[number], lines.way[kept]
        along = (away * line).sum(axis=1)
        across = np.abs(away[:, 0] * line[:, 1] - away[:, 1] * line[:, 0])
        cross = np.abs(way[0] * line[:, 1] - way[1] * line[:, 0])
        thick = np.maximum(gap.thickness_px, lines.thickness[kept])
        within = (along >= 0.0) & (along <= lines.length[kept])
        within &= (across <= np.maximum(3.0, BESIDE * thick)) & (cross <= np.sin(PARALLEL_RAD))
        if not within.any():
            kept.append(number)
    return [gaps[number] for number in kept]


class Lines:
    """Straight walls as arrays: starts, ends and ways (n, 2), lengths and thicknesses (n,)."""

    def __init__(
        self, start: NDArray[np.float64], end: NDArray[np.float64], thickness: NDArray[np.float64]
    ) -> None:
        self.start, self.end, self.thickness = start, end, thickness
        run = end - start
        self.length = np.hypot(run[:, 0], run[:, 1])
        self.way = run / np.maximum(self.length, 1e-9)[:, None]

    def crossings(
        self,
        origin: NDArray[np.float64],
        ray: NDArray[np.float64],
        slack: NDArray[np.float64],
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
        """(..., n) how far ahead of rays lines and faces lie, and which walls cross the rays.

        Origins and unit vectors of rays are (..., 2); walls may end by `slack` before they meet.
        """
        apart = self.start - origin
        cross = ray[..., 0] * self.way[:, 1] - ray[..., 1] * self.way[:, 0]
        safe = np.where(np.abs(cross) > 1e-6, cross, 1.0)
        to_line = (apart[..., 0] * self.way[:, 1] - apart[..., 1] * self.way[:, 0]) / safe
        along = (apart[..., 0] * ray[..., 1] - apart[..., 1] * ray[..., 0]) / safe
        crosses = (np.abs(cross) >= np.sin(CROSSING_RAD)) & (along >= -slack)
        crosses &= along <= self.length + slack
        return to_line, to_line - self.thickness / 2 / np.abs(safe), crosses


def _lines_of(pieces: Sequence[Piece | Gap]) -> Lines:
    ends = np.array([(one.start, one.end) for one in pieces], float).reshape(-1, 2, 2)
    return Lines(ends[:, 0], ends[:, 1], np.array([one.thickness_px for one in pieces], float))


def _ahead(pieces: Sequence[Piece], walls: Lines, index: int, at_end: bool) -> Gap | None:
    piece = pieces[index]
    origin = piece.end if at_end else piece.start
    ray = piece.direction if at_end else -piece.direction
    # (n, 2): to the end of each wall, and to its side; infinite where it is not ahead.
    away = np.stack([_to_ends(piece, origin, ray, walls), _to_sides(origin, ray, walls)], axis=1)
    near = np.maximum(max(3.0, 0.3 * piece.thickness_px), walls.thickness)
    away[away <= -near[:, None]] = np.inf
    away[index] = np.inf
    target, to_side = divmod(int(away.argmin()), 2)
    distance = float(away[target, to_side])
    other = pieces[target]
    thickness = piece.thickness_px if to_side else min(piece.thickness_px, other.thickness_px)
    if distance <= max(3.0, 0.3 * thickness) or distance > FARTHEST * thickness:
        return None
    end = origin + distance * ray
    return Gap(index, at_end, target, bool(to_side), origin, end, thickness, end)


def _to_ends(
    piece: Piece, origin: NDArray[np.float64], ray: NDArray[np.float64], walls: Lines
) -> NDArray[np.float64]:
    """(n,) how far ahead collinear pieces begin; infinite of others."""
    cross = np.abs(ray[0] * walls.way[:, 1] - ray[1] * walls.way[:, 0])
    ends = np.stack([walls.start, walls.end], axis=1) - origin
    along = ends @ ray
    nearest = np.take_along_axis(ends, along.argmin(axis=1)[:, None, None], axis=1)[:, 0]
    beside = np.abs(ray[0] * nearest[:, 1] - ray[1] * nearest[:, 0])
    thick = np.maximum(piece.thickness_px, walls.thickness)
    ahead = (cross <= np.sin(PARALLEL_RAD)) & (beside <= np.maximum(3.0, BESIDE * thick))
    return np.where(ahead & (along.max(axis=1) >= 0), along.min(axis=1), np.inf)


def _to_sides(
    origin: NDArray[np.float64], ray: NDArray[np.float64], walls: Lines
) -> NDArray[np.float64]:
    """(n,) how far ahead the faces of crossing pieces lie; infinite of others."""
    to_line, to_face, crosses = walls.crossings(origin, ray, walls.thickness)
    half = to_line - to_face
    return np.where(crosses & (to_line >= -half - 3), to_face, np.inf)


def trimmed(gap: Gap, solid: NDArray[np.bool_]) -> Gap | None:
    """The gap without solid wall at its ends; None where all of it is solid.

    Stubs of wall beside a junction are shorter than any piece that is followed.
    """
    empty = _empty(gap, solid)
    if len(empty) < LEAST_PX:
        return None
    return gap.part(float(empty[0]), float(empty[-1] + 1))


def parted(gap: Gap, solid: NDArray[np.bool_]) -> tuple[Gap, ...]:
    """What of the gap is not solid, piece by piece, as two doors with a pillar between them."""
    empty = _empty(gap, solid)
    runs = np.split(empty, np.flatnonzero(np.diff(empty) > LEAST_PX) + 1)
    return tuple(
        gap.part(float(run[0]), float(run[-1] + 1)) for run in runs if len(run) >= LEAST_PX
    )


def _empty(gap: Gap, solid: NDArray[np.bool_]) -> NDArray[np.intp]:
    """At which whole pixels along the gap there is no solid wall."""
    steps = np.arange(0.5, gap.width_px, 1.0)
    beside = np.linspace(-0.35, 0.35, 7) * gap.thickness_px
    points = gap.arc.at(steps[:, None], beside[None, :])
    index = np.floor(points).astype(int)
    x = np.clip(index[..., 0], 0, solid.shape[1] - 1)
    y = np.clip(index[..., 1], 0, solid.shape[0] - 1)
    return np.flatnonzero(solid[y, x].mean(axis=1) < 0.5)
