"""Where walls are interrupted: from an end of a wall on to the next wall in its line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.arcs import Arc
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
    for index in range(len(pieces)):
        for at_end in (False, True):
            gap = _ahead(targets, index, at_end)
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


def _ahead(pieces: list[Piece], index: int, at_end: bool) -> Gap | None:
    piece = pieces[index]
    origin = piece.end if at_end else piece.start
    ray = piece.direction if at_end else -piece.direction
    best: tuple[float, int, bool] | None = None
    for other_index, other in enumerate(pieces):
        if other_index == index:
            continue
        for distance, to_side in (_to_end(piece, origin, ray, other), _to_side(origin, ray, other)):
            near = max(3.0, 0.3 * piece.thickness_px)
            if distance is None or distance <= -max(near, other.thickness_px):
                continue
            if best is None or distance < best[0]:
                best = (distance, other_index, to_side)
    if best is None:
        return None
    distance, target, to_side = best
    other = pieces[target]
    thickness = piece.thickness_px if to_side else min(piece.thickness_px, other.thickness_px)
    if distance <= max(3.0, 0.3 * thickness) or distance > FARTHEST * thickness:
        return None
    end = origin + distance * ray
    return Gap(index, at_end, target, to_side, origin, end, thickness, end)


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


def _to_end(
    piece: Piece, origin: NDArray[np.float64], ray: NDArray[np.float64], other: Piece
) -> tuple[float | None, bool]:
    """How far ahead a collinear piece begins."""
    cross = abs(ray[0] * other.direction[1] - ray[1] * other.direction[0])
    if cross > np.sin(PARALLEL_RAD):
        return None, False
    ends = np.array([other.start, other.end]) - origin
    along = ends @ ray
    nearest = int(np.argmin(along))
    beside = abs(ray[0] * ends[nearest, 1] - ray[1] * ends[nearest, 0])
    thick = max(piece.thickness_px, other.thickness_px)
    if beside > max(3.0, BESIDE * thick) or along.max() < 0:
        return None, False
    return float(along[nearest]), False


def _to_side(
    origin: NDArray[np.float64], ray: NDArray[np.float64], other: Piece
) -> tuple[float | None, bool]:
    """How far ahead the face of a crossing piece lies."""
    cross = ray[0] * other.direction[1] - ray[1] * other.direction[0]
    if abs(cross) < np.sin(CROSSING_RAD):
        return None, True
    apart = other.start - origin
    distance = (apart[0] * other.direction[1] - apart[1] * other.direction[0]) / cross
    along = (apart[0] * ray[1] - apart[1] * ray[0]) / cross
    slack = other.thickness_px
    if not -slack <= along <= other.length_px + slack:
        return None, True
    half = other.thickness_px / 2 / abs(cross)
    if distance < -half - 3:
        return None, True
    return float(distance - half), True
