"""Where one house ends and the next begins: other rows of windows, other wall, other roof line."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.eyes import SeenElement
from veduta.facade.seen_rows import RowParameters, pitch, window_rows


@dataclass(frozen=True)
class HouseParameters:
    """When two parts of a row of fronts are two houses. Lengths are in storeys.

    `narrowest`: the least width of a house. `windows`: the fewest that each has. `reach`, `strip`:
    how far windows and wall are compared to both sides. `rows`: how far the rows of windows are out
    of line from which on that speaks for two houses; `colour`: the same of the walls' colours
    (OpenCV's Lab, in the median of `bands`, of pixels with this chance of `wall`); `roof`: of the
    step in the outline against the sky. `signs`: how many of the three there must be; `sum`: how
    large all are together, each in units of its own.
    Seen on CMP's pictures b0003 to b0240, every third.
    """

    narrowest: float = 1.6
    windows: int = 4
    reach: float = 3.0
    strip: float = 1.0
    rows: float = 0.14
    colour: float = 12.0
    roof: float = 0.4
    signs: int = 2
    sum: float = 2.8
    bands: int = 8
    wall: float = 0.5


@dataclass(frozen=True)
class PartyWall:
    """A column of pixels between two houses, and what speaks for it (units of the parameters)."""

    x: int
    rows: float
    colour: float
    roof: float

    @property
    def strength(self) -> float:
        """All signs together; each counts three times its unit at most."""
        return sum(min(sign, 3.0) for sign in (self.rows, self.colour, self.roof))

    @property
    def signs(self) -> int:
        """How many speak for it."""
        return sum(sign >= 1.0 for sign in (self.rows, self.colour, self.roof))


def find_party_walls(
    evidence: Evidence,
    skyline: Skyline,
    elements: Sequence[SeenElement],
    wall: NDArray[np.floating],
    parameters: HouseParameters | None = None,
) -> list[PartyWall]:
    """The borders between houses, from left to right.

    elements: in pixels of the evidence; wall: (h, w) the chance of wall there.
    """
    p = parameters or HouseParameters()
    windows = [e for e in elements if e.kind == "window"]
    if len(windows) < 2 * p.windows:
        return []
    storey = _storey(windows)
    found: list[PartyWall] = []
    for x in _free_columns(windows, evidence.width, p.narrowest * storey):
        one = _signs(x, evidence, skyline, windows, wall, storey, p)
        if one is not None and one.signs >= p.signs and one.strength >= p.sum:
            found.append(one)
    kept: list[PartyWall] = []
    near = p.narrowest * storey
    for one in sorted(found, key=lambda w: -w.strength):
        if all(abs(one.x - other.x) >= near for other in kept):
            kept.append(_middle([w for w in found if abs(w.x - one.x) < 0.5 * near]))
    kept.sort(key=lambda w: w.x)
    return _with_windows(kept, windows, p.windows)


def _middle(some: Sequence[PartyWall]) -> PartyWall:
    """The middle one of those for which most speaks."""
    most = max(w.strength for w in some)
    best = [w for w in some if w.strength >= most - 0.05]
    raw = max(w.rows + w.colour + w.roof for w in best)
    best = [w for w in best if w.rows + w.colour + w.roof >= raw - 0.1]
    return best[len(best) // 2]


def _storey(windows: Sequence[SeenElement]) -> float:
    """The height of a storey (px): from row to row, or twice that of a window."""
    boxes = np.array([[e.x0, e.y0, e.x1, e.y1] for e in windows])
    own = 2.0 * float(np.median(boxes[:, 3] - boxes[:, 1]))
    step = pitch(window_rows(boxes, RowParameters()))
    return own if step is None else float(np.clip(step, 0.6 * own, 1.6 * own))


def _free_columns(windows: Sequence[SeenElement], width: int, aside: float) -> list[int]:
    """The middles of the stripes without a window, away from both sides."""
    covered = np.zeros(width + 1, dtype=np.int64)
    for e in windows:
        covered[max(0, round(e.x0))] += 1
        covered[min(width, round(e.x1))] -= 1
    free = np.cumsum(covered)[:-1] <= 0
    ends = np.flatnonzero(np.diff(np.concatenate([[0], free.astype(np.int8), [0]]))).reshape(-1, 2)
    places: list[int] = []
    for a, b in ends.tolist():
        step = max(2, round(0.1 * aside))
        places += list(range(a + 1, b, step)) if b - a > 1 else []
    return [x for x in places if aside <= x <= width - aside]


def _signs(
    x: int,
    evidence: Evidence,
    skyline: Skyline,
    windows: Sequence[SeenElement],
    wall: NDArray[np.floating],
    storey: float,
    p: HouseParameters,
) -> PartyWall | None:
    """What speaks for a border at a column; None where a side has no windows near it."""
    reach = p.reach * storey
    left = [e for e in windows if x - reach <= 0.5 * (e.x0 + e.x1) < x]
    right = [e for e in windows if x <= 0.5 * (e.x0 + e.x1) <= x + reach]
    if min(len(left), len(right)) < 2:
        return None
    strip = max(3, round(p.strip * storey))
    spans = slice(max(0, x - strip), x), slice(x, min(evidence.width, x + strip))
    return PartyWall(
        x,
        min(_out_of_line(left, right), _out_of_line(right, left)) / (p.rows * storey),
        _apart(evidence, wall, spans, p) / p.colour,
        _step(skyline, spans) / (p.roof * storey),
    )


def _out_of_line(some: Sequence[SeenElement], others: Sequence[SeenElement]) -> float:
    """How far windows are from the nearest ones in height, in the median (px)."""
    one = np.array([[e.y0, e.y1] for e in some])
    other = np.array([[e.y0, e.y1] for e in others])
    apart = np.abs(one[:, None] - other[None]).mean(axis=2)
    return float(np.median(apart.min(axis=1)))


def _apart(
    evidence: Evidence, wall: NDArray[np.floating], spans: tuple[slice, slice], p: HouseParameters
) -> float:
    """How far the walls of two strips are apart in colour, in the median of bands."""
    bands = np.linspace(0, evidence.height, p.bands + 1).astype(int)
    found = []
    for top, bottom in zip(bands[:-1], bands[1:], strict=True):
        means = []
        for span in spans:
            mask = wall[top:bottom, span] > p.wall
            if mask.mean() > 0.15:
                means.append(np.median(evidence.lab[top:bottom, span][mask], axis=0))
        if len(means) == 2:
            # Lightness counts half: a shadow is no other wall.
            found.append(float(np.hypot(*(means[0] - means[1])[1:])) * 1.5)
            found[-1] += 0.5 * abs(float(means[0][0] - means[1][0]))
    return float(np.median(found)) if len(found) >= 2 else 0.0


def _step(skyline: Skyline, spans: tuple[slice, slice]) -> float:
    """The step of the outline against the sky between two strips (px)."""
    if skyline.reason:
        return 0.0
    one, other = (float(np.median(skyline.rows[span])) for span in spans)
    return abs(one - other)


def _with_windows(
    walls: list[PartyWall], windows: Sequence[SeenElement], least: int
) -> list[PartyWall]:
    """Without those, the weakest first, that leave a house with too few windows."""
    kept = list(walls)
    middles = np.array([0.5 * (e.x0 + e.x1) for e in windows])
    while kept:
        borders = [-np.inf, *(wall.x for wall in kept), np.inf]
        counts = [
            int(((middles >= a) & (middles < b)).sum())
            for a, b in zip(borders[:-1], borders[1:], strict=True)
        ]
        few = [k for k, count in enumerate(counts) if count < least]
        if not few:
            return kept
        beside = [kept[k] for k in (few[0] - 1, few[0]) if 0 <= k < len(kept)]
        kept.remove(min(beside, key=lambda wall: wall.strength))
    return kept
