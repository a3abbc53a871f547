"""A house and a street: what stands where.

World: metres, x east, y north, z up, the ground at z = 0 but for what houses stand higher.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.layout import Layout
from veduta.synthetic.streets.outlines import rectangle

BEND_M = 12.0
"""Over which the heading of one who walks turns at a bend."""


@dataclass(frozen=True)
class House:
    """A building on a rectangle.

    corner_m: (2,) the left end of its front, for one who looks at it. turn_rad: of the front,
    counter-clockwise from east. base_m, top_m: the foot and the eaves. layout: of the facade, and
    seed: of its looks; layout is None where nobody photographs it. four_sided: its front is on all
    of its sides.
    """

    id: str
    corner_m: tuple[float, float]
    turn_rad: float
    width_m: float
    depth_m: float
    base_m: float
    top_m: float
    layout: Layout | None
    seed: int
    four_sided: bool = False

    @property
    def along(self) -> NDArray[np.float64]:
        """(2,) unit, from the left end of the front to the right one."""
        return np.array([np.cos(self.turn_rad), np.sin(self.turn_rad)])

    @property
    def outline_m(self) -> NDArray[np.float64]:
        """(4, 2) counter-clockwise from the left end of the front."""
        return rectangle(np.array(self.corner_m), self.along, self.width_m, self.depth_m)

    def world_from_front(self, side: int = 0) -> NDArray[np.float64]:
        """(4, 4) from a facade's part (x along the wall, y into the building, z up).

        side: number of the outline's edge; the front is 0.
        """
        turn = self.turn_rad + side * np.pi / 2
        c, s = np.cos(turn), np.sin(turn)
        moved = np.eye(4)
        moved[:2, :2] = [[c, -s], [s, c]]
        moved[:3, 3] = (*self.outline_m[side], self.base_m)
        return moved


@dataclass(frozen=True)
class Street:
    """path_m: (k, 2) its middle line; the last point is the first where it goes round a block.

    width_m: between the fronts, without set-backs. houses: those that photos show. others:
    buildings around, that the photos show at most through gaps. origin_m: of the world in `crs`.
    """

    seed: int
    path_m: NDArray[np.float64]
    width_m: float
    houses: tuple[House, ...]
    others: tuple[House, ...]
    crs: str = "EPSG:32632"
    origin_m: tuple[float, float, float] = (691_000.0, 5_334_500.0, 512.0)

    @property
    def is_round(self) -> bool:
        """Whether it ends where it begins."""
        return bool(np.allclose(self.path_m[0], self.path_m[-1]))

    @property
    def length_m(self) -> float:
        """Along the middle line."""
        return float(np.linalg.norm(np.diff(self.path_m, axis=0), axis=1).sum())

    def at(self, along_m: float) -> tuple[NDArray[np.float64], float]:
        """The point of the middle line at a distance from its start, and the heading (rad)."""
        ways = np.diff(self.path_m, axis=0)
        before_m, first = 0.0, self.path_m[0]
        if self.is_round:
            # One comes from the last piece, and goes on with the first.
            before_m, first = float(np.linalg.norm(ways[-1])), first - ways[-1]
            ways = np.concatenate([ways[-1:], ways, ways[:1]])
        along_m += before_m
        corners = first + np.concatenate([np.zeros((1, 2)), np.cumsum(ways, axis=0)])
        lengths = np.linalg.norm(ways, axis=1)
        ends = np.cumsum(lengths)
        headings = np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))
        piece = min(int(np.searchsorted(ends, along_m)), len(ways) - 1)
        left = along_m - (ends[piece] - lengths[piece])
        place = corners[piece] + left * ways[piece] / lengths[piece]
        turns = np.clip((along_m - ends[:-1]) / BEND_M + 0.5, 0.0, 1.0) * np.diff(headings)
        return place, float(headings[0] + turns.sum())
