"""Houses set down one after the other where there is room."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.layout import STYLES, Layout
from veduta.synthetic.streets.house import House
from veduta.synthetic.streets.outlines import overlap, rectangle, road
from veduta.synthetic.styles import design

STRIDE_M = 0.25
"""How far a house is moved on where it does not fit."""


class Rows:
    """Places one house after the other where there is room."""

    def __init__(
        self,
        rng: np.random.Generator,
        seed: int,
        path: NDArray[np.float64],
        width_m: float,
        fewest_floors: int = 2,
    ) -> None:
        self.rng, self.seed, self.width_m = rng, seed, width_m
        self.fewest_floors = fewest_floors
        self.styles = list(rng.permutation(len(STYLES)))
        self.placed: list[House] = []
        self.roads = [road(start, end, width_m) for start, end in pairwise(path)]

    def close(self, at: NDArray[np.float64], way: NDArray[np.float64]) -> None:
        """A house at a place, its front towards who walks there along `way`."""
        layout = self._layout()
        turn = float(np.arctan2(way[1], way[0]) - np.pi / 2 + self.rng.uniform(-0.12, 0.12))
        along = np.array([np.cos(turn), np.sin(turn)])
        self._add(at - along * layout.width_m * self.rng.uniform(0.4, 0.6), turn, layout)

    def ring(self, radius_m: float) -> None:
        """Houses side by side about the origin, their fronts towards it."""
        layouts = [self._layout()]
        halves: list[float] = []
        while True:
            half = float(np.arctan2(layouts[-1].width_m / 2, radius_m))
            if 2 * (sum(halves) + half) > 2 * np.pi:
                break
            halves.append(half)
            layouts.append(self._layout(len(layouts)))
        # What is left is shared out as gaps.
        gap = (2 * np.pi - 2 * sum(halves)) / len(halves)
        first = 0.0
        for layout, half in zip(layouts, halves, strict=False):
            out = np.array([np.cos(first + half), np.sin(first + half)])
            along = np.array([out[1], -out[0]])
            turn = float(np.arctan2(along[1], along[0]))
            self._add(radius_m * out - along * layout.width_m / 2, turn, layout)
            first += 2 * half + gap

    def row(
        self, start: NDArray[np.float64], way: NDArray[np.float64], length_m: float, side: float
    ) -> None:
        """Houses left (side 1) or right (-1) of the way, until it ends."""
        normal = side * np.array([-way[1], way[0]])
        at = float(self.rng.uniform(0.0, 4.0))
        while True:
            layout, setback, askew = self._layout(), self._setback(), self._askew()
            heading = float(np.arctan2(way[1], way[0]))
            turn = (heading if side > 0 else heading + np.pi) + askew
            along = np.array([np.cos(turn), np.sin(turn)])
            reach = layout.width_m
            while at + reach <= length_m + 3.0:
                middle = start + (at + reach / 2) * way + (self.width_m / 2 + setback) * normal
                corner = middle - along * layout.width_m / 2
                # An askew front must not come nearer to the road than a straight one.
                corner = corner + normal * abs(np.sin(askew)) * layout.width_m / 2
                if self._free(corner, along, layout.width_m, layout.depth_m):
                    break
                at += STRIDE_M
            else:
                return
            self._add(corner, turn, layout)
            at += reach + (0.0 if self.rng.random() < 0.45 else float(self.rng.uniform(1.2, 5.0)))

    def around(self, middle: NDArray[np.float64], clear_m: float, count: int = 30) -> None:
        """Plain buildings of the neighbourhood, of the sizes that the street has.

        clear_m: none stands as near to the middle as this; nobody should see much of them.
        """
        for _ in range(60 * count):
            if count == 0:
                return
            corner = middle + self.rng.uniform(-70.0 - clear_m, 70.0 + clear_m, 2)
            turn = float(self.rng.uniform(0.0, 2 * np.pi))
            along = np.array([np.cos(turn), np.sin(turn)])
            size = self.rng.uniform((8.0, 8.0, 6.0), (18.0, 12.0, 16.0))
            if not self._free(corner, along, size[0], size[1]):
                continue
            if np.linalg.norm(corner - middle) < clear_m:
                continue
            name = f"other-{len(self.placed):02d}"
            base = float(self.rng.normal(0.0, 0.1))
            where = (float(corner[0]), float(corner[1]))
            width, depth, height = (float(value) for value in np.round(size, 2))
            self.placed.append(
                House(name, where, turn, width, depth, base, base + height, None, self.seed)
            )
            count -= 1

    def _layout(self, ahead: int = 0) -> Layout:
        """The next house's, or that of one some houses ahead."""
        number = len(self.placed) + ahead
        style = STYLES[self.styles[number % len(STYLES)]]
        floors = int(self.rng.integers(self.fewest_floors, 6))
        columns = int(self.rng.integers(3, 6))
        return design(style, self._house_seed(ahead), floors, columns)

    def _house_seed(self, ahead: int = 0) -> int:
        return 1000 * self.seed + len(self.placed) + ahead + 1

    def _setback(self) -> float:
        return 0.0 if self.rng.random() < 0.5 else float(self.rng.uniform(0.4, 2.5))

    def _askew(self) -> float:
        return 0.0 if self.rng.random() < 0.7 else float(self.rng.uniform(-0.16, 0.16))

    def _add(self, corner: NDArray[np.float64], turn: float, layout: Layout) -> None:
        base = float(self.rng.uniform(0.0, 0.3))
        self.placed.append(
            House(
                f"house-{len(self.placed):02d}",
                (float(corner[0]), float(corner[1])),
                turn,
                layout.width_m,
                layout.depth_m,
                base,
                base + layout.height_m,
                layout,
                self._house_seed(),
            )
        )

    def _free(
        self, corner: NDArray[np.float64], along: NDArray[np.float64], width: float, depth: float
    ) -> bool:
        wanted = rectangle(corner, along, width, depth)
        taken = [house.outline_m for house in self.placed] + self.roads
        return not any(overlap(wanted, other) for other in taken)
