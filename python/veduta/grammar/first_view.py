"""Where a visitor of a town begins, and which way he looks: at fronts, and never at backs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.lot import Lot, anchors_of, boxes_of


@dataclass(frozen=True)
class ViewParameters:
    """How the first view is chosen; by eye, on streets, rows and towns.

    most_lots: so many fronts at most are looked at. alike: length of the mean of the ways that
    fronts look (unit vectors) from which on the town has one front. beside: cosine between that
    mean and a front that one begins at. heights: a front is seen whole from so many of its heights
    away, but from `least_m` to `most_m`. aside: so much of that way one stands to its left.
    free_m: to the house on the other side of a street. step_m: how finely what is free is looked
    for. before_m: from the first house back along a street that has two sides; along_deg: so
    far beside its axis one looks, at one side; share: and so much of a height up. lit: a front
    that looks to the north by more is not in the sun.
    """

    most_lots: int = 2000
    alike: float = 0.5
    beside: float = 0.7
    heights: float = 1.4
    least_m: float = 15.0
    most_m: float = 60.0
    aside: float = 0.4
    free_m: float = 1.5
    step_m: float = 0.5
    before_m: float = 4.0
    along_deg: float = 18.0
    share: float = 0.4
    lit: float = 0.1


@dataclass(frozen=True)
class FirstView:
    """The eye and what it looks at (x, y; m from the origin of all lots), and the height of that.

    row: of the lot whose front one stands at. up: what is looked at lies so much of a front's
    height up.
    """

    eye_m: tuple[float, float]
    target_m: tuple[float, float]
    row: int
    up: float


def first_view(
    lots: Sequence[Lot], height_m: float, parameters: ViewParameters | None = None
) -> FirstView | None:
    """Before the fronts if they look the same way, else at the beginning of a street, along it.

    height_m: of the fronts. None where no lot has a front that has a length.
    """
    given = parameters or ViewParameters()
    rows = np.unique(np.linspace(0, len(lots) - 1, min(len(lots), given.most_lots)).astype(int))
    if not len(lots):
        return None
    anchors = anchors_of(lots)[rows, :2]
    edges = np.array([lots[row].rings_m[0][:2] for row in rows.tolist()])
    along = edges[:, 1] - edges[:, 0]
    length = np.linalg.norm(along, axis=1)
    sound = length > 0
    if not sound.any():
        return None
    middle = (edges.mean(axis=1) + anchors)[sound]
    outward = np.column_stack([along[:, 1], -along[:, 0]])[sound] / length[sound, None]
    fronts = _Fronts(middle, outward, boxes_of(lots), given)
    mean = outward.mean(axis=0)
    size = float(np.linalg.norm(mean))
    if size >= given.alike:
        view = fronts.before_row(mean / size, height_m)
    else:
        view = fronts.along_street()
    number, eye, target, up = view
    return FirstView(_pair(eye), _pair(target), int(rows[sound][number]), up)


@dataclass(frozen=True)
class _Fronts:
    """middle, outward: (n, 2) of the fronts. boxes: of all lots."""

    middle: NDArray[np.float64]
    outward: NDArray[np.float64]
    boxes: tuple[NDArray[np.float64], NDArray[np.float64]]
    given: ViewParameters

    def before_row(
        self, way: NDArray[np.float64], height_m: float
    ) -> tuple[int, NDArray[np.float64], NDArray[np.float64], float]:
        """Off the front in the middle of the outermost row, a little to its left."""
        given = self.given
        out, across = self.middle @ way, self.middle @ np.array([way[1], -way[0]])
        odd = np.where(self.outward @ way >= given.beside, 0.0, np.inf)
        aside = np.abs(across - (across.min() + across.max()) / 2)
        number = int(np.argmin(odd + aside + (out.max() - out)))
        normal, middle = self.outward[number], self.middle[number]
        wished = float(np.clip(given.heights * height_m, given.least_m, given.most_m))
        away = min(
            wished, max(self._free(middle, normal, wished + given.free_m) - given.free_m, 2.0)
        )
        left = np.array([normal[1], -normal[0]])  # of one who looks at the front
        return number, middle + away * normal + given.aside * away * left, middle, given.share

    def along_street(self) -> tuple[int, NDArray[np.float64], NDArray[np.float64], float]:
        """In the middle of a street in the middle of the town, where its first house begins."""
        given = self.given
        double = 2 * np.arctan2(self.outward[:, 1], self.outward[:, 0])
        across = np.arctan2(np.sin(double).mean(), np.cos(double).mean()) / 2
        way = np.array([np.sin(across), -np.cos(across)])
        if way @ (1.0, 2.0) < 0:  # to the north and the east: the sun is behind
            way = -way
        ahead, aside = self.middle @ way, self.middle @ np.array([way[1], -way[0]])
        far = np.abs(aside - (aside.min() + aside.max()) / 2)
        # A front that looks along the street is none of its sides, and the side that looks to the
        # south lies in the sun.
        odd = np.where(np.abs(self.outward @ way) < given.beside, 0.0, np.inf)
        lit = odd + np.where(self.outward[:, 1] <= given.lit, 0.0, np.inf)
        odd = lit if np.isfinite(lit).any() else odd
        number = int(np.argmin(odd + far + (ahead - ahead.min())))
        normal, middle = self.outward[number], self.middle[number]
        free = self._free(middle, normal, 2 * given.least_m)
        eye = middle + 0.5 * free * normal - given.before_m * way
        ahead_m = 0.5 * free / np.tan(np.radians(given.along_deg)) - given.before_m
        return number, eye, middle + ahead_m * way, given.share

    def _free(
        self, middle: NDArray[np.float64], normal: NDArray[np.float64], most_m: float
    ) -> float:
        """How far it is from a front to the next lot before it (m), up to `most_m`."""
        low, high = self.boxes
        ways = np.arange(self.given.step_m, most_m, self.given.step_m)
        near = np.flatnonzero(((low <= middle + most_m) & (high >= middle - most_m)).all(axis=1))
        points = middle + ways[:, None] * normal
        inside = (points[:, None] > low[near]) & (points[:, None] < high[near])
        hit: NDArray[np.bool_] = np.count_nonzero(np.count_nonzero(inside, axis=2) == 2, axis=1) > 0
        # Boxes of lots that stand askew reach before their own fronts.
        clear = np.flatnonzero(~hit)
        first = int(clear[0]) if len(clear) else 0
        met = np.flatnonzero(hit[first:])
        return float(ways[first + met[0]]) if len(met) else most_m


def _pair(point: NDArray[np.float64]) -> tuple[float, float]:
    x, y = point.tolist()
    return x, y
