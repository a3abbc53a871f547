"""How stones, bricks, tiles and boards lie beside each other: which of them each pixel is in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.surfaces.canvas import Canvas, Field


@dataclass(frozen=True)
class Bond:
    """The pieces of a canvas; the columns by pixel are (h, w).

    number: the piece. right, up: metres from the piece's left and lower edge. width, height: of the
    piece (m). row: which course it is in, from below.
    """

    count: int
    number: NDArray[np.int32]
    row: NDArray[np.int32]
    right: Field
    up: Field
    width: Field
    height: Field

    @property
    def inside(self) -> Field:
        """Metres from the nearest edge of the piece."""
        across = np.minimum(self.right, self.width - self.right)
        return np.asarray(np.minimum(across, np.minimum(self.up, self.height - self.up)))

    def each(self, values: NDArray[np.floating]) -> Field:
        """A value for each piece, by pixel."""
        return np.asarray(values, np.float32)[self.number]


def bond(canvas: Canvas, heights_m: Sequence[float], joints_m: Sequence[Sequence[float]]) -> Bond:
    """Courses from below, each with the places of its joints (m, at least one, in any period)."""
    width_m = canvas.size_m[0]
    beds = np.concatenate([[0.0], np.cumsum(heights_m)]) * (canvas.size_m[1] / sum(heights_m))
    shape, x = canvas.shape, canvas.x_m
    columns = {name: np.empty(shape, np.float32) for name in ("right", "up", "width", "height")}
    number, row = np.empty(shape, np.int32), np.empty(shape, np.int32)
    count = 0
    for course, ((low, high), own) in enumerate(zip(pairwise(beds), joints_m, strict=True)):
        lines = (canvas.y_m >= low) & (canvas.y_m < high)
        joints = np.unique(np.mod(np.asarray(own, np.float64), width_m))
        ends = np.concatenate([joints, [joints[0] + width_m]])
        seen = np.where(x < joints[0], x + width_m, x)
        piece = np.clip(np.searchsorted(ends, seen, side="right") - 1, 0, len(joints) - 1)
        number[lines], row[lines] = count + piece, course
        columns["right"][lines] = seen - ends[piece]
        columns["width"][lines] = np.diff(ends)[piece]
        columns["up"][lines] = (canvas.y_m[lines] - low)[:, None]
        columns["height"][lines] = high - low
        count += len(joints)
    return Bond(count, number, row, **columns)


def running(
    canvas: Canvas, columns: int, rows: int, shifts: Sequence[float] = (0.0, 0.5), jitter: float = 0
) -> Bond:
    """Equal pieces; each course is shifted by a share of a piece, in turn, and joints stray."""
    wide = canvas.size_m[0] / columns
    joints = []
    for row in range(rows):
        at = (np.arange(columns) + shifts[row % len(shifts)]) * wide
        joints.append(at + canvas.rng.uniform(-jitter, jitter, columns) * wide)
    return bond(canvas, [canvas.size_m[1] / rows] * rows, [each.tolist() for each in joints])


def random_lengths(
    canvas: Canvas, heights_m: Sequence[float], shortest_m: float, longest_m: float
) -> Bond:
    """Courses of pieces of random lengths, whose joints keep clear of those below."""
    joints: list[list[float]] = []
    total = canvas.size_m[0]
    for _ in heights_m:
        best, clear = [0.0], -1.0
        for _ in range(24):
            count = round(total / canvas.rng.uniform(shortest_m, longest_m))
            lengths = canvas.rng.uniform(shortest_m, longest_m, max(count, 2))
            at = np.cumsum(lengths) * (total / lengths.sum()) + canvas.rng.uniform(0.0, total)
            below = np.asarray(joints[-1] if joints else [0.0])
            apart = np.abs(np.mod(at[:, None] - below + total / 2, total) - total / 2)
            if float(apart.min()) > clear:
                best, clear = at.tolist(), float(apart.min())
        joints.append(best)
    return bond(canvas, heights_m, joints)
