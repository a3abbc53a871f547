"""Where a wall is thicker for a while and as before after it: chimney breasts, piers, pilasters.

Its centre line would step aside and back, or bow, and what is beside the steps would be windows.
Such a stretch becomes as thick as the wall on both sides of it; what stands out is no wall.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.walls.solid import Thickness
from veduta.plan.walls.tracks import Track


@dataclass(frozen=True)
class BreastRule:
    """Lengths count in thicknesses of the wall that goes on.

    out: a breast stands out by so much, at least. deep: and by no more. long: it is no longer.
    apart: to the wall on either side, over a wall that joins there; solid: of what lies between,
    so much is. same_px: sides of one wall differ by at most so much. broad: a breast is at least so
    many times as long as it stands out: what is shorter is a stub of a wall that joins, beside a
    door. stub: so is what is no longer than so many times the thickness of thin walls.
    """

    out: float = 0.25
    deep: float = 3.0
    long: float = 12.0
    apart: float = 1.6
    solid: float = 0.9
    same_px: float = 2.0
    broad: float = 1.0
    stub: float = 1.4


BREAST = BreastRule()


@dataclass(frozen=True)
class Band:
    """A straight stretch of wall: whether along y, from and to, its two sides, in pixels."""

    steep: bool
    start: float
    end: float
    low: float
    high: float

    @property
    def thick(self) -> float:
        """From side to side."""
        return self.high - self.low


def without_breasts(
    solid: NDArray[np.bool_],
    tracks: Sequence[Track],
    thickness: Thickness,
    rule: BreastRule = BREAST,
) -> tuple[NDArray[np.bool_], int]:
    """A mask (h, w) of walls without what stands out of them, and how many such places there are;
    the mask itself where there is none. tracks: those of the mask.

    Upright walls alone are looked at: their sides are rows and columns of pixels.
    """
    bands = [
        band for track in tracks
        if (band := _band(track)) is not None and band.thick >= 0.8 * thickness.least_px
    ]  # fmt: skip
    cleared, count = solid.copy(), 0
    stub_px = rule.stub * _thin(bands)
    for band in bands:
        if band.end - band.start <= stub_px:
            continue
        wall = _wall_around(band, bands, solid, rule)
        if wall is None:
            continue
        for low, high in ((band.low, wall[0]), (wall[1], band.high)):
            _clear(cleared, band, low, high)
        count += 1
    return (cleared, count) if count else (solid, 0)


def _thin(bands: Sequence[Band]) -> float:
    """The thickness of thin walls: a quarter of the length of all is no thicker; 0 of none."""
    order = sorted(bands, key=lambda one: one.thick)
    total = np.cumsum([one.end - one.start for one in order])
    return order[int(np.searchsorted(total, 0.25 * total[-1]))].thick if order else 0.0


def _band(track: Track) -> Band | None:
    """A track as a band where both of its sides are straight and along an axis."""
    low, high = float(np.median(track.low)), float(np.median(track.high))
    stray = max(float(np.ptp(np.quantile(one, (0.05, 0.95)))) for one in (track.low, track.high))
    if stray > BREAST.same_px:
        return None
    return Band(track.steep, float(track.along[0]) - 0.5, float(track.along[-1]) + 0.5, low, high)


def _wall_around(
    band: Band, bands: Sequence[Band], solid: NDArray[np.bool_], rule: BreastRule
) -> tuple[float, float] | None:
    """Both sides of the wall that goes on before and behind a band that is thicker than it."""
    alike = [
        one for one in bands
        if one.steep == band.steep and one is not band and one.thick < band.thick
        and band.low - rule.same_px <= one.low and one.high <= band.high + rule.same_px
        and rule.out * one.thick <= band.thick - one.thick <= rule.deep * one.thick
        and band.end - band.start <= rule.long * one.thick
        and band.end - band.start >= rule.broad * (band.thick - one.thick) - rule.same_px
    ]  # fmt: skip
    before = [one for one in alike if -2.0 <= band.start - one.end <= rule.apart * one.thick]
    behind = [one for one in alike if -2.0 <= one.start - band.end <= rule.apart * one.thick]
    for one in before:
        for other in behind:
            same = max(abs(one.low - other.low), abs(one.high - other.high)) <= rule.same_px
            if not same:
                continue
            wall = (min(one.low, other.low), max(one.high, other.high))
            ends = ((one.end, band.start), (band.end, other.start))
            if all(_solid(solid, band.steep, gap, wall) >= rule.solid for gap in ends):
                return wall
    return None


def _window(
    steep: bool, along: tuple[float, float], across: tuple[float, float]
) -> tuple[slice, slice]:
    """Rows and columns of a rectangle."""
    own, other = (
        slice(max(0, round(min(pair))), max(0, round(max(pair)))) for pair in (along, across)
    )
    return (own, other) if steep else (other, own)


def _solid(
    solid: NDArray[np.bool_], steep: bool, gap: tuple[float, float], wall: tuple[float, float]
) -> float:
    """How much of a gap between stretches of a wall is solid; all of none."""
    if gap[1] - gap[0] < 1.0:
        return 1.0
    inside = solid[_window(steep, gap, wall)]
    return float(inside.mean()) if inside.size else 1.0


def _clear(mask: NDArray[np.bool_], band: Band, low: float, high: float) -> None:
    """Take what lies along a band between two lines out of a mask, where no other wall joins."""
    if high - low < 1.0:
        return
    mask[_window(band.steep, (band.start - 1.0, band.end + 1.0), (low, high))] = False
