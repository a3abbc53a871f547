"""Walls as columns, and what lays them level into the world: scale, turn about z, and shift.

The plane is that of complex numbers, x + iy: a level similarity is one product and one sum.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.wall import Wall

Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class WallColumns:
    """w walls in their own frame. start, end: (w,) complex. bottom, top: (w,).

    cut_edges: (w, 2), cut_tops: (w,) where only the view of the photos ends; None: nowhere.
    ground: height of the ground that the photos were taken above; None: it is not asked.
    """

    start: Complex
    end: Complex
    bottom: NDArray[np.float64]
    top: NDArray[np.float64]
    cut_edges: NDArray[np.bool_] | None = None
    cut_tops: NDArray[np.bool_] | None = None
    ground: float | None = None

    def __len__(self) -> int:
        return len(self.start)

    @property
    def width(self) -> NDArray[np.float64]:
        """(w,)."""
        return np.abs(self.end - self.start)

    @property
    def height(self) -> NDArray[np.float64]:
        """(w,)."""
        return self.top - self.bottom

    @property
    def middle(self) -> Complex:
        """(w,)."""
        return (self.start + self.end) / 2.0


@dataclass(frozen=True)
class Placements:
    """h ways to lay a level model into the plane: world = turn * model + shift.

    turn: (h,) complex, its length the scale. shift: (h,) complex.
    """

    turn: Complex
    shift: Complex

    def __len__(self) -> int:
        return len(self.turn)

    def taken(self, rows: NDArray[np.int64] | NDArray[np.bool_]) -> Placements:
        """Some of them."""
        return Placements(self.turn[rows], self.shift[rows])

    def moved(self, places: Complex) -> Complex:
        """(h, n) complex places of the model in the world of each."""
        return self.turn[:, None] * places + self.shift[:, None]


def wall_columns(
    walls: Sequence[Wall],
    cut_edges: NDArray[np.bool_] | None = None,
    cut_tops: NDArray[np.bool_] | None = None,
) -> WallColumns:
    """The columns of walls."""
    return WallColumns(
        np.array([complex(*wall.start) for wall in walls]),
        np.array([complex(*wall.end) for wall in walls]),
        np.array([wall.bottom for wall in walls]),
        np.array([wall.top for wall in walls]),
        cut_edges,
        cut_tops,
    )


def complex_of(places: NDArray[np.float64]) -> Complex:
    """(n, 2) as (n,) complex."""
    return places[:, 0] + 1j * places[:, 1]


def plane_fit(model: Complex, world: Complex) -> Placements:
    """The absolute orientation in the plane (equations 2.29 to 2.33) of (h, n) places each.

    Closed: with places about their means, the turn that leaves least squares is
    sum(conj(m) w) / sum(|m|^2). (2.32) drops the scale; the shift here has it.
    """
    about = model - model.mean(axis=1, keepdims=True)
    there = world - world.mean(axis=1, keepdims=True)
    size = np.maximum((np.abs(about) ** 2).sum(axis=1), 1e-300)
    turn = (np.conj(about) * there).sum(axis=1) / size
    return Placements(turn, world.mean(axis=1) - turn * model.mean(axis=1))
