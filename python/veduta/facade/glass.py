"""Fronts of glass: bands of panes between mullions, where a search for single windows finds none.

A curtain wall or a ribbon of windows has no wall between its panes, and what the eyes mark as
windows there is any part of it. What repeats is seen instead: storeys upwards, mullions across.
Each pane becomes an element; without a beat of mullions, the band of a floor is one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float
from veduta.facade.eyes import Seen, SeenElement
from veduta.run.report import counted

GLASS = ("window", "blind")
GLASS_TOLD = "glass:"
"""How the note begins that says so."""
Line = NDArray[np.float64]
Mask = NDArray[np.bool_]
Span = tuple[int, int]
Band = tuple[int, int, int, int]


@dataclass(frozen=True)
class GlassParameters:
    """When a front is of glass, and what its panes are.

    storeys: the least and the greatest height of a storey, in heights of the picture. beat: the
    least correlation of a profile with itself, one storey or one mullion on. gap: what parts two
    panes and no more than that, in storeys. wide: the least length of a band, in storeys: no
    single window has it. share: of all that is glass, how much must lie in such bands; full: the
    chance of glass in one; rows: on how many storeys there are some. pane: the least and the
    greatest distance of mullions, in storeys. bars: the least and the greatest width of one, in
    panes. apart: how much less glass there is at a mullion, from which on its width is seen. kept:
    the share of a pane's cell that must be glass.
    Seen on CMP's b0001, b0047, b0070, b0083, b0134, b0164, b0215, b0280 and two renders.
    """

    storeys: tuple[float, float] = (0.03, 0.25)
    beat: float = 0.25
    gap: float = 0.2
    wide: float = 1.3
    share: float = 0.5
    full: float = 0.6
    rows: int = 2
    pane: tuple[float, float] = (0.12, 1.6)
    bars: tuple[float, float] = (0.06, 0.35)
    apart: float = 0.15
    kept: float = 0.5


@dataclass(frozen=True)
class Glass:
    """Panes in pixels of the evidence, and the storey and pane that repeat (px); pane 0: none.

    bands: (k, 4) left, top, right, bottom of each band of glass.
    """

    panes: tuple[SeenElement, ...]
    bands: NDArray[np.float64]
    storey: float
    pane: float

    @property
    def floors(self) -> int:
        """On how many floors there is glass."""
        return len(set(self.bands[:, 1].tolist()))

    def goes_on(self, x: float) -> bool:
        """Whether floors have glass on both sides of a column, or there: no house ends at it."""
        return bool((self.bands[:, 0].min() < x) and (x < self.bands[:, 2].max()))

    def replaces(self, one: SeenElement) -> bool:
        """Whether an element is a part of the glass that was taken for a window."""
        return self.has(one.kind, 0.5 * (one.x0 + one.x1), 0.5 * (one.y0 + one.y1))

    def has(self, kind: str, x: float, y: float) -> bool:
        """Whether what has its middle there is a part of the glass, and no door or the like."""
        left, top, right, bottom = self.bands.T
        slack = 0.5 * (self.storey - float(np.median(bottom - top)))
        across = (x >= left) & (x <= right)
        inside = across & (y >= top - slack) & (y <= bottom + slack)
        return kind == "window" and bool(inside.any())


@dataclass(frozen=True)
class Mullions:
    """How far they are apart and where one's middle is (px); how wide, in panes; 0 for none."""

    pane: float
    first: float
    bar: float


def find_glass(
    evidence: Evidence, seen: Seen, parameters: GlassParameters | None = None
) -> Glass | None:
    """The bands of glass of a picture that the eyes have seen; None where it has next to none."""
    size = evidence.width, evidence.height
    return glass_of(evidence, seen.chance_at(size, *GLASS), parameters)


def glass_of(
    evidence: Evidence, chance: Float, parameters: GlassParameters | None = None
) -> Glass | None:
    """The same by the chance (h, w) that a pixel of the evidence is of a window."""
    p = parameters or GlassParameters()
    glass = chance > 0.5
    columns = glass.mean(axis=0) > 0.3
    if columns.sum() < 0.1 * evidence.width:
        return None
    low, high = (share * evidence.height for share in p.storeys)
    edges = np.abs(evidence.gy[:, columns]).mean(axis=1)
    storey = beat(_level(chance[:, columns].mean(axis=1)) + _level(edges), (low, high), p.beat)
    if storey is None:
        return None
    wide = _wide_runs(glass, storey, p)
    if wide.sum() < p.share * max(1, int(glass.sum())):
        return None
    floors = _floors(chance, wide, storey)
    bands = [
        band
        for floor in floors
        for band in _bands(wide, floor, p.wide * storey)
        if chance[band[1] : band[3], band[0] : band[2]].mean() > p.full
    ]
    if len({top for _, top, _, _ in bands}) < p.rows:
        return None
    mullions = _mullions(evidence, chance, bands, storey, p)
    panes = [one for band in bands for one in _panes(chance, band, mullions, p.kept)]
    return Glass(tuple(panes), np.array(bands, np.float64), storey, mullions.pane)


def with_panes(
    elements: Sequence[SeenElement], glass: Glass | None, px_per_rectified: float
) -> list[SeenElement]:
    """The elements (pixels of what was seen), with panes for what was found of the glass."""
    if glass is None:
        return list(elements)
    own = [_scaled(one, px_per_rectified) for one in elements]
    kept = [one for one, moved in zip(elements, own, strict=True) if not glass.replaces(moved)]
    return [*(_scaled(one, 1.0 / px_per_rectified) for one in glass.panes), *kept]


def glass_note(glass: Glass | None, metres_per_px: float) -> str:
    """What is said of a front of glass; metres for a pixel of the evidence."""
    if glass is None:
        return ""
    on = f"{GLASS_TOLD} bands of panes on {counted(glass.floors, 'floor')}"
    if glass.pane <= 0.0:
        return f"{on}, without mullions at equal distances: each band is one opening"
    apart = glass.pane * metres_per_px
    return f"{on}, read as {len(glass.panes)} panes between mullions {apart:.1f} m apart"


def _scaled(one: SeenElement, by: float) -> SeenElement:
    return replace(one, x0=by * one.x0, y0=by * one.y0, x1=by * one.x1, y1=by * one.y1)


def beat(profile: Line, between: tuple[float, float], least: float) -> float | None:
    """The shortest distance (px) after which a profile (n,) is much like itself; None for none."""
    low, high = max(2, round(between[0])), min(round(between[1]), len(profile) // 2)
    level = cv2.blur(
        profile.reshape(1, -1), (2 * (high // 2) + 1, 1), borderType=cv2.BORDER_REFLECT
    )
    rest = profile - np.asarray(level, np.float64).ravel()
    alike = np.array([_alike(rest, step) for step in range(high + 2)])
    inner = np.arange(low, high + 1)
    if not len(inner):
        return None
    peaks = [
        k for k in inner.tolist()
        if alike[k] >= max(alike[k - 1], alike[k + 1]) and alike[k] > least
    ]  # fmt: skip
    if not peaks:
        return None
    best = max(alike[k] for k in peaks)
    first = next(k for k in peaks if alike[k] > 0.8 * best)
    before, here, after = alike[first - 1 : first + 2].tolist()
    bend = before - 2.0 * here + after
    return float(first + (0.5 * (before - after) / bend if bend < 0.0 else 0.0))


def _alike(values: Line, step: int) -> float:
    """The correlation of a profile with itself, so many pixels on."""
    one, other = values[: len(values) - step], values[step:]
    power = float(np.sqrt((one @ one) * (other @ other)))
    return float(one @ other) / power if power > 1e-9 else 0.0


def _level(values: NDArray[np.floating]) -> Line:
    """A profile with the mean 0 and the deviation 1."""
    own = np.asarray(values, np.float64)
    return np.asarray((own - own.mean()) / max(float(own.std()), 1e-6))


def _wide_runs(glass: Mask, storey: float, p: GlassParameters) -> Mask:
    """Where glass runs on across for longer than a window, mullions taken for glass."""
    reach = np.ones((1, round(p.gap * storey) | 1), np.uint8)
    closed = cv2.morphologyEx(glass.astype(np.uint8), cv2.MORPH_CLOSE, reach, borderValue=0)
    long = np.ones((1, round(p.wide * storey) | 1), np.uint8)
    return np.asarray(cv2.morphologyEx(closed, cv2.MORPH_OPEN, long, borderValue=0) > 0)


def _floors(chance: Float, wide: Mask, storey: float) -> list[Span]:
    """Rows from and to of the panes of each floor, by what each storey has at the same height."""
    columns = wide.mean(axis=0) > 0.2
    if not columns.any():
        return []
    profile = chance[:, columns].mean(axis=1).astype(np.float64)
    rows = np.flatnonzero(wide.mean(axis=1) > 0.25 * wide.mean(axis=1).max())
    turn = np.arange(rows[0], rows[-1] + 1)
    steps = max(8, round(storey))
    place = np.floor((turn % storey) / storey * steps).astype(int)
    usual = np.array([np.median(profile[turn[place == k]]) for k in range(steps)])
    least, most = float(usual.min()), float(usual.max())
    low = usual < least + 0.4 * (most - least)
    start = int(usual.argmin())  # a storey begins where there is least glass
    above = next((k for k in range(steps) if not low[(start + k) % steps]), 0)
    below = next((k for k in range(steps) if not low[(start - k) % steps]), 0)
    first = (start / steps) * storey + storey * np.floor(rows[0] / storey - 1.0)
    found = []
    for top in np.arange(first, rows[-1], storey):
        a = round(max(top + above / steps * storey, rows[0]))
        b = round(min(top + storey - below / steps * storey, rows[-1] + 1))
        if b - a > 0.3 * storey and wide[a:b].mean() > 0.1:
            found.append((a, b))
    return found


def _bands(wide: Mask, floor: Span, least: float) -> list[Band]:
    """The bands of a floor: left, top, right, bottom."""
    top, bottom = floor
    inside = wide[top:bottom].mean(axis=0) > 0.5
    ends = np.flatnonzero(np.diff(np.concatenate([[0], inside.astype(np.int8), [0]])))
    runs = [(int(a), int(b)) for a, b in ends.reshape(-1, 2)]
    return [(a, top, b, bottom) for a, b in runs if b - a >= least]


def _mullions(
    evidence: Evidence,
    chance: Float,
    bands: Sequence[Band],
    storey: float,
    p: GlassParameters,
) -> Mullions:
    """By the edges of the bands and, where the eyes tell panes apart, by these."""
    edges = _across(np.abs(evidence.gx), bands)
    glass = _across(chance, bands)
    between = p.pane[0] * storey, p.pane[1] * storey
    pane = beat(_level(edges) - _level(glass), between, p.beat)
    if pane is None:
        return Mullions(0.0, 0.0, 0.0)
    steps = max(8, round(4.0 * pane))
    at = np.arange(evidence.width)[edges > 0.0]
    place = np.floor(((at + 0.5) % pane) / pane * steps).astype(int) % steps
    folded = np.array(
        [[_mean(one[at][place == k]) for k in range(steps)] for one in (edges, glass)]
    )
    own = _around(folded, round(0.5 * p.bars[0] * steps))
    apart = float(own[1].max() - own[1].min())
    if apart < p.apart:  # no more than lines
        return Mullions(pane, int(own[0].argmax()) / steps * pane, p.bars[0])
    middle = int(own[1].argmin())
    bar = float((folded[1] < own[1].min() + 0.5 * apart).mean())
    return Mullions(pane, middle / steps * pane, float(np.clip(bar, *p.bars)))


def _across(values: NDArray[np.floating], bands: Sequence[Band]) -> Line:
    """The mean (w,) of an image in the bands, column by column; 0 where there is none."""
    total, count = np.zeros(values.shape[1]), np.zeros(values.shape[1])
    for left, top, right, bottom in bands:
        total[left:right] += values[top:bottom, left:right].mean(axis=0)
        count[left:right] += 1.0
    found = total / np.maximum(count, 1.0)
    return np.where(count > 0.0, np.maximum(found, 1e-6), 0.0)


def _around(folded: NDArray[np.float64], reach: int) -> NDArray[np.float64]:
    """Means over some places to both sides of each, round and round."""
    turns = [np.roll(folded, k, axis=1) for k in range(-reach, reach + 1)]
    return np.asarray(np.mean(turns, axis=0))


def _mean(values: Line) -> float:
    return float(values.mean()) if len(values) else 0.0


def _panes(chance: Float, band: Band, mullions: Mullions, kept: float) -> list[SeenElement]:
    """The panes of a band, those cut by its ends where more than half of them is left."""
    left, top, right, bottom = band
    pane, half = mullions.pane, 0.5 * mullions.bar * mullions.pane
    if pane <= 0.0:
        return [_element(chance, float(left), top, float(right), bottom)]
    start = mullions.first + pane * np.floor((left - mullions.first) / pane)
    found = []
    for x in np.arange(start, right, pane):
        a, b = max(float(left), x + half), min(float(right), x + pane - half)
        if b - a > kept * pane:
            found.append(_element(chance, a, top, b, bottom))
    return found


def _element(chance: Float, left: float, top: int, right: float, bottom: int) -> SeenElement:
    inside = chance[top:bottom, int(left) : max(int(left) + 1, round(right))]
    return SeenElement("window", left, float(top), right, float(bottom), float(inside.mean()))
