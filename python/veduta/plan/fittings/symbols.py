"""What cells of a room are symbols of: how plans draw things, in the sizes that they come in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import MultiPoint, Polygon

from veduta.plan.document import FittingKind
from veduta.plan.fittings.cells import Cell


@dataclass(frozen=True)
class Sizes:
    """From and to, in metres unless said otherwise; of common products, drawn a little wrong.

    oval: share of its rectangle that an ellipse fills, pi / 4 but for pixels, up to that of a
    rounded box; small: the least of a ring of few pixels; rounded: of a long box with round
    corners. box: least share of a rectangle. triangle: as `oval`. tank, bowl: of a toilet. near:
    how far apart are cells that one line parts.
    """

    oval: tuple[float, float] = (0.68, 0.93)
    small: float = 0.6
    box: float = 0.86
    triangle: tuple[float, float] = (0.4, 0.6)
    near: float = 0.09
    bowl: tuple[float, float, float, float] = (0.3, 0.62, 0.26, 0.48)
    tank: tuple[float, float, float, float] = (0.26, 0.62, 0.08, 0.3)
    tub: tuple[float, float, float, float] = (1.25, 2.05, 0.55, 1.0)
    rounded: tuple[float, float] = (0.8, 0.985)
    tub_alone: tuple[float, float, float, float] = (1.15, 1.95, 0.42, 0.95)
    tub_inside: tuple[float, float] = (0.45, 0.93)
    basin: tuple[float, float, float, float] = (0.36, 0.95, 0.28, 0.66)
    basin_inside: tuple[float, float] = (0.2, 0.8)
    alone: tuple[float, float, float, float] = (0.36, 0.66, 0.25, 0.5)
    washer: tuple[float, float] = (0.5, 0.7)
    shower: tuple[float, float] = (0.68, 1.25)
    ring: tuple[float, float] = (0.1, 0.34)
    hob: tuple[float, float] = (0.35, 0.72)
    sink: tuple[float, float, float, float] = (0.28, 0.62, 0.22, 0.5)
    counter: tuple[float, float, float, float] = (0.9, 6.0, 0.45, 0.8)
    pillow: tuple[float, float, float, float] = (0.3, 0.95, 0.2, 0.6)
    bed: tuple[float, float, float, float] = (1.7, 2.4, 0.75, 2.15)


HOLLOW = 0.02
"""Of a cell in which others lie, such a share at least is not its own."""
MOST_NEAR = 6
"""Cells near another of which groups are made: more are tiles."""
BOWL = 0.5
"""The score of an oval alone."""


@dataclass(frozen=True)
class Symbol:
    """A thing as it is drawn. middle_px, back: (2,), the latter the unit vector to its back.

    width_m is along its back. cells: places of the cells that it is drawn with.
    """

    kind: FittingKind
    middle_px: NDArray[np.float64]
    back: NDArray[np.float64]
    width_m: float
    depth_m: float
    score: float
    cells: frozenset[int]


def symbols_in(
    cells: Sequence[Cell], metres_per_px: float, sizes: Sizes | None = None
) -> list[Symbol]:
    """All that cells may be, the surest first; one cell may be part of several."""
    reader = _Reader(cells, metres_per_px, sizes or Sizes())
    found = [
        *reader.tubs(),
        *reader.toilets(),
        *reader.basins(),
        *reader.bowls(),
        *reader.showers(),
        *reader.hobs(),
        *reader.sinks(),
        *reader.beds(),
    ]
    return sorted(found, key=lambda one: (-one.score, -one.width_m * one.depth_m))


def _sized(cell: Cell, limits: tuple[float, float, float, float]) -> bool:
    low, high, narrow, wide = limits
    return low <= cell.length_m <= high and narrow <= cell.width_m <= wide


class _Reader:
    """The cells of one room, and which lie in which."""

    def __init__(self, cells: Sequence[Cell], metres_per_px: float, sizes: Sizes) -> None:
        self.cells, self.metres_per_px, self.sizes = cells, metres_per_px, sizes
        self.inside: dict[int, list[int]] = {
            outer: [
                inner
                for inner, other in enumerate(cells)
                if cell.hollow > HOLLOW
                and inner != outer
                and other.shape.area < cell.shape.area
                and cell.shape.contains(other.shape.representative_point())
            ]
            for outer, cell in enumerate(cells)
        }

    def oval(self, cell: Cell) -> bool:
        """Whether it is round, or a box with round corners."""
        return self.sizes.oval[0] <= cell.fill <= self.sizes.oval[1]

    def round(self, cell: Cell) -> bool:
        """Whether it may be a small ring: of few pixels, and a dashed line may cross it."""
        return self.sizes.small <= cell.fill <= self.sizes.oval[1] and cell.aspect < 1.6

    def apart(self, one: Cell, other: Cell) -> float:
        """Metres between two cells."""
        return float(one.shape.distance(other.shape)) * self.metres_per_px

    def tubs(self) -> Iterator[Symbol]:
        """A long box with a rounded box in it, nearly as large; or such a rounded box alone."""
        low, high = self.sizes.tub_inside
        for place, cell in enumerate(self.cells):
            if cell.aspect < 1.45:
                continue
            whole = cell.length_m * cell.width_m
            shares = [
                self.cells[one].length_m * self.cells[one].width_m / whole
                for one in self.inside[place]
                if self.cells[one].aspect > 1.3
            ]
            if _sized(cell, self.sizes.tub) and any(low <= share <= high for share in shares):
                score = 0.9
            elif self._rounded(cell) and _sized(cell, self.sizes.tub_alone):
                score = 0.65
            else:
                continue
            yield self._of("bathtub", place, score)

    def _rounded(self, cell: Cell) -> bool:
        low, high = self.sizes.rounded
        return low <= cell.fill <= high and cell.aspect < 3.2 and cell.round_corners >= 2

    def _of(self, kind: FittingKind, place: int, score: float) -> Symbol:
        """A cell with all that is in it; one of its long sides is its back."""
        cell = self.cells[place]
        within = frozenset({place, *self.inside[place]})
        return Symbol(kind, cell.middle_px, cell.across, cell.length_m, cell.width_m, score, within)

    def toilets(self) -> Iterator[Symbol]:
        """An oval with a box behind it."""
        for place, bowl in enumerate(self.cells):
            if not _sized(bowl, self.sizes.bowl) or not self.oval(bowl) or bowl.aspect > 1.75:
                continue
            for other, tank in enumerate(self.cells):
                if other == place or not _sized(tank, self.sizes.tank) or tank.aspect < 1.25:
                    continue
                if tank.width_m > 0.8 * bowl.length_m or self.apart(bowl, tank) > self.sizes.near:
                    continue
                between = tank.middle_px - bowl.middle_px
                reach = float(np.linalg.norm(between))
                back = tank.across if float(between @ tank.across) > 0 else -tank.across
                if reach == 0.0 or float(between @ back) < 0.93 * reach:
                    continue
                if abs(float(between @ tank.along)) * self.metres_per_px > 0.08:
                    continue
                depth = self._depth((bowl, tank), back)
                if not 0.42 <= depth <= 0.9:
                    continue
                middle = self._middle((bowl, tank), back)
                within = {place, other, *self.inside[place]}
                yield Symbol(
                    "toilet",
                    middle,
                    back,
                    max(bowl.width_m, tank.length_m),
                    depth,
                    0.9,
                    frozenset(within),
                )

    def basins(self) -> Iterator[Symbol]:
        """An oval in a box: a basin; a circle in a square of the size of a machine is one."""
        low, high = self.sizes.basin_inside
        for place, cell in enumerate(self.cells):
            if not _sized(cell, self.sizes.basin):
                continue
            whole = cell.length_m * cell.width_m
            within = self.inside[place]
            if cell.fill < self.sizes.oval[0]:  # its tap opens the rim around the bowl to a C
                within = self._embraced(cell)
            for one in within:
                bowl = self.cells[one]
                share = bowl.length_m * bowl.width_m / whole
                if not self.oval(bowl) or not low <= share <= high:
                    continue
                side_low, side_high = self.sizes.washer
                square = (
                    cell.aspect < 1.12 and side_low <= cell.width_m and cell.length_m <= side_high
                )
                machine = square and bowl.aspect < 1.12
                kind: FittingKind = "washer" if machine else "basin"
                yield self._of(kind, place, 0.75)

    def _embraced(self, cell: Cell) -> list[int]:
        """What lies within the bend of a cell that is a bent rim; nothing where it is none."""
        hull = cell.shape.convex_hull
        if hull.area < self.sizes.oval[0] * cell.length_px * cell.width_px:
            return []
        return [
            one
            for one, other in enumerate(self.cells)
            if other is not cell and hull.contains(other.shape)
        ]

    def sinks(self) -> Iterator[Symbol]:
        """A box in a worktop: round corners or not, alone or beside the ribs where plates drip."""
        for place, top in enumerate(self.cells):
            if not _sized(top, self.sizes.counter) or top.fill < self.sizes.box:
                continue
            held = self.inside[place]
            for one in held:
                bowl = self.cells[one]
                deep = float(np.abs((bowl.middle_px - top.middle_px) @ top.across))
                if (
                    not _sized(bowl, self.sizes.sink)
                    or bowl.fill < self.sizes.oval[0]
                    or deep * self.metres_per_px > 0.35 * top.width_m
                    or len(self.inside[one]) > 1
                    or any(one in self.inside[other] for other in held)
                ):
                    continue
                size = (max(bowl.length_m, 0.5), min(top.width_m, 0.6))
                yield Symbol(
                    "kitchen-sink", bowl.middle_px, top.across, *size, 0.8, frozenset({one})
                )

    def bowls(self) -> Iterator[Symbol]:
        """Ovals alone: `find` tells by the walls whether they are basins or toilets."""
        for place, cell in enumerate(self.cells):
            if _sized(cell, self.sizes.alone) and self.oval(cell) and 1.15 < cell.aspect < 2.0:
                yield self._of("basin", place, BOWL)

    def showers(self) -> Iterator[Symbol]:
        """A square in triangles."""
        low, high = self.sizes.shower
        least, most = self.sizes.triangle
        corners = [
            index
            for index, cell in enumerate(self.cells)
            if least <= cell.fill <= most and 0.5 * low <= cell.length_m <= 1.5 * high
        ]
        for chosen in self._groups(corners, (4, 3, 2), 2 * self.sizes.near):
            parts = [self.cells[one] for one in chosen]
            around = self._rectangle(parts)
            if around is None:
                continue
            middle, along, length, width = around
            square = low <= width <= length <= min(high, 1.25 * width)
            if square and self._area(parts) > 0.6 * length * width:
                across = np.array([-along[1], along[0]])
                score = 0.6 + 0.08 * len(chosen)
                yield Symbol("shower", middle, across, length, width, score, frozenset(chosen))

    def hobs(self) -> Iterator[Symbol]:
        """Four rings in a square; three in a row are no hob."""
        low, high = self.sizes.ring
        rings = [
            index
            for index, cell in enumerate(self.cells)
            if low <= cell.width_m and cell.length_m <= high and self.round(cell)
        ]
        # Of rings in rings the outer one counts.
        rings = [one for one in rings if not any(one in self.inside[other] for other in rings)]
        least, most = self.sizes.hob
        for chosen in self._groups(rings, (4,), most):
            around = self._rectangle([self.cells[one] for one in chosen])
            if around is None:
                continue
            middle, along, length, width = around
            if not least <= width <= length <= min(most + 0.15, 1.6 * width):
                continue
            across = np.array([-along[1], along[0]])
            middles = np.array([self.cells[one].middle_px for one in chosen])
            own = (middles - middle) @ np.column_stack([along, across])
            quarters = {(x > 0, y > 0) for x, y in own.tolist()}
            if len(quarters) == 4 and np.abs(own).min() * self.metres_per_px > 0.06:
                size = (max(length, 0.5), max(width, 0.5))
                yield Symbol("hob", middle, across, *size, 0.85, frozenset(chosen))

    def _groups(
        self, cells: Sequence[int], counts: Sequence[int], near_m: float
    ) -> Iterator[tuple[int, ...]]:
        """Cells together of which each is near to the first; of each first one, few."""
        for count in counts:
            for number, first in enumerate(cells):
                near = [
                    other
                    for other in cells[number + 1 :]
                    if self.apart(self.cells[first], self.cells[other]) <= near_m
                ]
                for rest in combinations(near[:MOST_NEAR], count - 1):
                    yield (first, *rest)

    def _area(self, parts: Sequence[Cell]) -> float:
        return sum(part.shape.area for part in parts) * self.metres_per_px**2

    def _rectangle(
        self, parts: Sequence[Cell]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], float, float] | None:
        """As `_rectangle`, its sides in metres."""
        found = _rectangle(parts)
        if found is None:
            return None
        return *found[:2], found[2] * self.metres_per_px, found[3] * self.metres_per_px

    def beds(self) -> Iterator[Symbol]:
        """A long box with one or two pillows at one end; its blanket may be a second box."""
        for place, cell in enumerate(self.cells):
            pillows = [
                one
                for one in self.inside[place]
                if _sized(self.cells[one], self.sizes.pillow) and self.cells[one].aspect > 1.2
            ]
            if not 1 <= len(pillows) <= 3 or cell.fill < self.sizes.box:
                continue
            for other in (None, *range(len(self.cells))):
                if other == place or other in pillows:
                    continue
                found = self._bed(place, other, pillows)
                if found is not None:
                    yield found
                    break

    def _bed(self, place: int, blanket: int | None, pillows: Sequence[int]) -> Symbol | None:
        parts = [self.cells[place]]
        if blanket is not None:
            parts.append(self.cells[blanket])
            if parts[1].fill < 0.75 or self.apart(*parts) > self.sizes.near:
                return None
        around = self._rectangle(parts)
        if around is None:
            return None
        middle, along, length, width = around
        low, high, narrow, wide = self.sizes.bed
        if not (low <= length <= high and narrow <= width <= wide):
            return None
        heads = [self.cells[one] for one in pillows]
        ends = np.array([(one.middle_px - middle) @ along for one in heads]) * self.metres_per_px
        if (
            self._area(parts) < 0.85 * length * width
            or sum(one.length_m for one in heads) < 0.45 * width
            or any(abs(float(one.along @ along)) > 0.3 for one in heads)
            or np.abs(ends).min() < 0.25 * length
            or np.ptp(np.sign(ends)) > 0
        ):
            return None
        within = {place, *self.inside[place]} | ({blanket} if blanket is not None else set())
        back = along * float(np.sign(ends[0]))
        return Symbol("bed", middle, back, width, length, 0.85, frozenset(within))

    def _depth(self, parts: Sequence[Cell], back: NDArray[np.float64]) -> float:
        reach = np.concatenate([part.outline_px for part in parts]) @ back
        return float(np.ptp(reach)) * self.metres_per_px + 0.02

    def _middle(self, parts: Sequence[Cell], back: NDArray[np.float64]) -> NDArray[np.float64]:
        side = np.array([-back[1], back[0]])
        points = np.concatenate([part.outline_px for part in parts])
        deep, wide = points @ back, points @ side
        middle: NDArray[np.float64] = (
            back * (deep.min() + deep.max()) / 2 + side * (wide.min() + wide.max()) / 2
        )
        return middle


def _rectangle(
    parts: Sequence[Cell],
) -> tuple[NDArray[np.float64], NDArray[np.float64], float, float] | None:
    """Middle, direction of the longer side, both sides (px) of the least rectangle around cells."""
    box = MultiPoint(np.concatenate([part.outline_px for part in parts])).minimum_rotated_rectangle
    if not isinstance(box, Polygon):
        return None
    corners = np.asarray(box.exterior.coords)[:4]
    first, second = corners[1] - corners[0], corners[2] - corners[1]
    if np.linalg.norm(first) < np.linalg.norm(second):
        first, second = second, first
    length, width = float(np.linalg.norm(first)), float(np.linalg.norm(second))
    if width == 0.0:
        return None
    return corners.mean(axis=0), first / length, length + 1.0, width + 1.0
