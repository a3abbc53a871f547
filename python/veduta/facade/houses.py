"""Where one house ends and the next begins: what changes from one side of a column to the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence
from veduta.facade.eyes import Seen, SeenElement
from veduta.facade.party_signs import SIGNS, Fronts, SignParameters, fronts_of, signs_at
from veduta.facade.seen_rows import RowParameters, pitch, window_rows

_ROWS, _ROOF, _LINE = (SIGNS.index(name) for name in ("rows", "roof", "line"))


@dataclass(frozen=True)
class HouseParameters:
    """When two parts of a row of fronts are two houses. Lengths are in storeys.

    narrowest: the least width of a house. windows: the fewest that each has, and that there are in
    all. weights, offset: the logarithm of the odds of a border is the sum of the signs
    (`party_signs`, each cut off at `most`) by their weights, and the offset; fitted on pictures of
    CMP in which the borders were marked by eye, of odd numbers below 240. sure: the chance from
    which on the houses are parted; likely: from which on it is said that there may be several: so
    that of the pictures of one house that were fitted to one in thirty is parted and one in ten
    doubted. `benchmarks/facade/houses.py` fits all of them. goes_on: where the signs of rows, roof
    and line are all below these, windows and outline go on and hardly a line runs down, the wall
    may be in another light and no more: such a border is never sure. Of 33 borders that were found
    on pictures that had been fitted to it takes 1 of 21 right ones and 1 of 9 wrong ones; of 21 on
    others 0 of 15 and 2 of 6.
    """

    narrowest: float = 1.6
    windows: int = 4
    weights: tuple[float, ...] = (2.08, 0.2, 2.86, 1.33, 2.75, 1.25, 0.0, 1.55, 0.0)
    offset: float = -6.64
    most: float = 1.5
    sure: float = 0.86
    likely: float = 0.53
    goes_on: tuple[float, float, float] = (0.25, 0.1, 0.75)


@dataclass(frozen=True)
class PartyWall:
    """A column of pixels between two houses, how likely it is one, and the signs of it."""

    x: int
    chance: float
    signs: tuple[float, ...] = ()


@dataclass(frozen=True)
class PartyWalls:
    """Those that part houses, from left to right; and the likeliest that is not sure enough."""

    walls: tuple[PartyWall, ...]
    doubtful: PartyWall | None = None

    def without(self, goes_on: Callable[[float], bool]) -> PartyWalls:
        """Those at whose column no one house goes on."""
        doubtful = self.doubtful
        if doubtful is not None and goes_on(doubtful.x):
            doubtful = None
        return PartyWalls(tuple(wall for wall in self.walls if not goes_on(wall.x)), doubtful)


def find_party_walls(
    evidence: Evidence,
    seen: Seen,
    elements: Sequence[SeenElement],
    parameters: HouseParameters | None = None,
) -> PartyWalls:
    """The borders between houses in a picture that the eyes have seen.

    elements: in pixels of the evidence.
    """
    p = parameters or HouseParameters()
    windows = [e for e in elements if e.kind == "window"]
    if len(windows) < p.windows:
        return PartyWalls(())
    storey = storey_of(windows)
    return party_walls_of(fronts_of(evidence, seen, windows, storey), p)


def party_walls_of(fronts: Fronts, parameters: HouseParameters | None = None) -> PartyWalls:
    """The same of fronts that are gathered already."""
    p = parameters or HouseParameters()
    return chosen(candidates(fronts, p), fronts.storey, p)


def chosen(
    some: Sequence[PartyWall], storey: float, parameters: HouseParameters | None = None
) -> PartyWalls:
    """Of columns that may be borders: those that are, none nearer to another than a house."""
    p = parameters or HouseParameters()
    near = p.narrowest * storey
    found = [w for w in some if w.chance >= p.likely]
    kept: list[PartyWall] = []
    for one in sorted(found, key=lambda w: -w.chance):
        if all(abs(one.x - other.x) >= near for other in kept):
            kept.append(_middle([w for w in found if abs(w.x - one.x) < 0.5 * near]))
    sure = sorted((w for w in kept if w.chance >= p.sure), key=lambda w: w.x)
    unsure = [w for w in kept if w.chance < p.sure]
    return PartyWalls(tuple(sure), unsure[0] if unsure else None)


def candidates(fronts: Fronts, parameters: HouseParameters | None = None) -> list[PartyWall]:
    """Every column that may be a border, with its chance."""
    p = parameters or HouseParameters()
    own = SignParameters()
    found = []
    for x in free_columns(fronts.windows, fronts.evidence.width, 0.5 * fronts.storey):
        signs = signs_at(fronts, x, own)
        if signs is not None:
            found.append(PartyWall(x, chance_of(signs, p), tuple(signs.tolist())))
    return found


def chance_of(signs: NDArray[np.float64], parameters: HouseParameters) -> float:
    """The chance of a border by its signs."""
    cut = np.clip(signs, 0.0, parameters.most)
    log_odds = parameters.offset + float(cut @ np.array(parameters.weights[: len(SIGNS)]))
    chance = float(1.0 / (1.0 + np.exp(-log_odds)))
    if bool((signs[[_ROWS, _ROOF, _LINE]] < np.array(parameters.goes_on)).all()):
        return min(chance, parameters.sure - 0.01)
    return chance


def storey_of(windows: Sequence[SeenElement]) -> float:
    """The height of a storey (px): from row to row, or twice that of a window."""
    boxes = np.array([[e.x0, e.y0, e.x1, e.y1] for e in windows])
    own = 2.0 * float(np.median(boxes[:, 3] - boxes[:, 1]))
    step = pitch(window_rows(boxes, RowParameters()))
    return own if step is None else float(np.clip(step, 0.6 * own, 1.6 * own))


def free_columns(windows: Sequence[SeenElement], width: int, aside: float) -> list[int]:
    """Columns in the stripes without a window, away from both sides."""
    covered = np.zeros(width + 1, dtype=np.int64)
    for e in windows:
        covered[max(0, round(e.x0))] += 1
        covered[min(width, round(e.x1))] -= 1
    free = np.cumsum(covered)[:-1] <= 0
    ends = np.flatnonzero(np.diff(np.concatenate([[0], free.astype(np.int8), [0]]))).reshape(-1, 2)
    step = max(2, round(0.3 * aside))
    places = [x for a, b in ends.tolist() if b - a > 1 for x in range(a + 1, b, step)]
    return [x for x in places if aside <= x <= width - aside]


def house_spans(
    walls: Sequence[PartyWall],
    windows: Sequence[SeenElement],
    borders: tuple[int, int],
    storey: float,
    parameters: HouseParameters | None = None,
) -> list[tuple[int, int]]:
    """Columns from and to of each house between the walls; parts of houses at the sides are none.

    borders: of what is looked at. A house has some windows and width; what has less beside both
    borders belongs to a house that the picture cuts off, and between two walls to its neighbour.
    """
    p = parameters or HouseParameters()
    edges = [borders[0], *(wall.x for wall in walls), borders[1]]
    middles = np.array([0.5 * (e.x0 + e.x1) for e in windows])

    def is_house(a: int, b: int) -> bool:
        inside = int(((middles >= a) & (middles < b)).sum())
        return inside >= p.windows and b - a >= p.narrowest * storey

    while len(edges) > 2:
        poor = [k for k in range(1, len(edges) - 2) if not is_house(edges[k], edges[k + 1])]
        if not poor:
            break
        del edges[poor[0]]
    spans = list(zip(edges[:-1], edges[1:], strict=True))
    whole = [span for span in spans if is_house(*span)]
    return whole or [borders]


def _middle(some: Sequence[PartyWall]) -> PartyWall:
    """The middle one of those for which most speaks."""
    most = max(w.chance for w in some)
    best = [w for w in some if w.chance >= most - 0.01]
    return best[len(best) // 2]
