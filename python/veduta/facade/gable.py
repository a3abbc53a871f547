"""Whether a front ends in a gable: the sky comes down to both sides of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.extent import Skyline

Line = NDArray[np.float64]


@dataclass(frozen=True)
class GableParameters:
    """When the outline against the sky is a gable.

    `least`, `most`: how high it is over its eaves, in widths of the front. `off`: how far the
    outline may lie from the two slopes, as a share of the gable's height. `better`: how much
    further it must lie from the best straight line. `block`: where a block on a flat roof (a stair
    tower, the middle of an attic) lies nearer to the outline than this share of that, it is no
    gable. `middle`: how far from the middle of the front the top may be, in widths. `wall`: the
    chance of wall or window, in the gable, from which on it is one; else it is the end of a hipped
    roof. `columns`: that many are looked at.
    Seen on CMP's pictures b0003 to b0240, every third; `block` on renders and two others, too.
    """

    least: float = 0.14
    most: float = 1.3
    off: float = 0.14
    better: float = 1.7
    block: float = 0.6
    middle: float = 0.2
    wall: float = 0.45
    columns: int = 96


@dataclass(frozen=True)
class Gable:
    """Rows of its top and of its eaves (pixels of the analysis)."""

    top: float
    eaves: float
    off: float


def is_wall(gable: Gable, wall: NDArray[np.floating], skyline: Skyline, least: float) -> bool:
    """Whether what lies between the eaves and the outline is wall, by its chance (h, w)."""
    rows = np.arange(len(wall))[:, None]
    inside = (rows >= skyline.rows + 2) & (rows < gable.eaves)
    return bool(inside.any()) and float(wall[inside].mean()) >= least


def find_gable(skyline: Skyline, parameters: GableParameters | None = None) -> Gable | None:
    """The gable that the skyline between the sides of a front shows; None where there is none."""
    p = parameters or GableParameters()
    if skyline.reason or len(skyline.rows) < 24:
        return None
    width = len(skyline.rows)
    places = np.linspace(0, width - 1, p.columns).round().astype(int)
    rows = skyline.rows[places].astype(np.float64)
    across = (places + 0.5) / width
    gable = _best(rows, across, width, p)
    if gable is None:
        return None
    line = np.polyval(np.polyfit(across, rows, 1), across)
    level = min(_apart(rows - np.median(rows)), _apart(rows - line))
    high = gable.eaves - gable.top
    if gable.off > p.off * high or level < p.better * gable.off:
        return None
    return None if _block_apart(rows) < p.block * gable.off else gable


def _apart(differences: Line) -> float:
    """How far an outline lies from another (rows): the mean of the nearer nine tenths."""
    apart = np.sort(np.abs(differences))
    return float(apart[: max(1, round(0.9 * len(apart)))].mean())


def _block_apart(rows: Line, step: int = 3) -> float:
    """How far an outline lies from the nearest one of two levels: a block on a flat roof."""
    count, best = len(rows), np.inf
    places = np.arange(count)
    for first in range(0, count - 2 * step, step):
        for last in range(first + 2 * step, count + 1, step):
            inside = (places >= first) & (places < last)
            if count - (last - first) < 2 * step:
                continue
            high, low = np.median(rows[inside]), np.median(rows[~inside])
            best = min(best, _apart(rows - np.where(inside, high, low)))
    return float(best)


def _best(rows: Line, across: Line, width: int, p: GableParameters) -> Gable | None:
    """Two slopes that the outline lies nearest to: of many tops, each with its best height."""
    found: Gable | None = None
    for middle in np.linspace(0.5 - p.middle, 0.5 + p.middle, 9):
        reach = np.where(across < middle, middle, 1.0 - middle)
        slope = 1.0 - np.abs(across - middle) / reach
        for share in (0.0, 0.1, 0.25):  # of the slopes' height that is cut off: a clipped gable
            shape = np.minimum(slope, 1.0 - share)
            for low in (50.0, 75.0, 90.0):
                eaves = float(np.percentile(rows[slope < 0.2], low))
                high = (eaves - float(np.percentile(rows[shape >= 0.9 * shape.max()], 40.0))) / (
                    1.0 - share
                )
                if not p.least * width <= high <= p.most * width:
                    continue
                off = _apart(eaves - high * shape - rows)
                if found is None or off < found.off:
                    found = Gable(eaves - high, eaves, off)
    return found
