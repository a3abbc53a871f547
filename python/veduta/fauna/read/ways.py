"""Which way an animal looks in each frame, where it turns round, and the frames in which it turns.

One plane holds no animal that turns towards the camera. On either side of the turn it does: an
animal goes the way it looks, so it has turned where it goes back and was narrow between.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, uniform_filter1d

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.nearer import Frames
from veduta.fauna.read.silhouettes import Masks, Silhouettes
from veduta.fauna.read.travel import gone_by_frame
from veduta.fauna.read.windows import middles_of, repeat_of, windows_of


@dataclass(frozen=True)
class WayLooks:
    """What a turn is."""

    back: float = 0.15
    """It goes so many of its silhouettes' widths there, and as many back: little, for it was narrow
    between, too."""
    narrow: float = 0.75
    """Between it is narrower for its height than on both sides by this share."""
    fewest: int = 5
    """Frames in which it does not turn; of fewer nothing is left out."""
    cells: int = 48
    """Of the windows in which a cycle is looked for."""
    calm: int = 3
    """Frames over which widths are averaged."""


@dataclass(frozen=True, eq=False)
class Ways:
    """right: (t,) 1 where it looks to the right of the picture, -1 to the left. turning: (t,) where
    it is seen too much from its end. Of an animal that does not turn all are 1, and none.
    """

    right: Floats
    turning: NDArray[np.bool_]

    @property
    def turns(self) -> bool:
        """Whether it turns at all."""
        return bool((self.right != self.right[0]).any())


@dataclass(frozen=True, eq=False)
class Stretches:
    """turning: (t,) frames in which it turns round. right: (t,) which way it looks; None where
    nothing is to be parted: it does not turn, or its marked joints hold it in all frames.
    """

    turning: NDArray[np.bool_]
    right: Floats | None


def stretches_of(
    found: Silhouettes, pictures: Frames | None, looks: WayLooks, *, marked: bool
) -> Stretches:
    """Of silhouettes and their frames (t, h, w, 3). marked: whether joints are.

    Without a cycle each frame has a pose of its own, which marks may turn round as they will; one
    cycle for all frames they cannot.
    """
    shown = found.shown()
    middle = middles_of(found.masks, shown)
    ways = ways_of(found.masks, middle, pictures, looks)
    kept = int(np.count_nonzero(~ways.turning))
    if not ways.turns or kept < looks.fewest:
        return Stretches(np.zeros_like(ways.turning), None)
    windows = windows_of(found.masks, looks.cells, middle, shown).turned_where(ways.right)
    if marked and repeat_of(windows) is None:
        return Stretches(ways.turning, None)
    return Stretches(ways.turning, ways.right)


def ways_of(masks: Masks, middle_px: Floats, pictures: Frames | None, looks: WayLooks) -> Ways:
    """Of silhouettes (t, h, w), their middles (t, 2; px), and the frames (t, h, w, 3)."""
    gone = gone_by_frame(masks, middle_px, pictures)
    way = gaussian_filter1d(np.concatenate([[0.0], np.cumsum(gone)]), 1.0, mode="nearest")
    narrow = uniform_filter1d(_narrowness(masks), looks.calm, mode="nearest")
    right, turning = np.ones(len(masks)), np.zeros(len(masks), dtype=np.bool_)
    corners = [0, *_corners(way, looks.back), len(masks) - 1]
    if len(corners) < 3:
        return Ways(right, turning)
    usual = [
        float(np.percentile(narrow[a : b + 1], 80))
        for a, b in zip(corners[:-1], corners[1:], strict=True)
    ]
    begin = 0
    for number, corner in enumerate(corners[1:-1]):
        # It is narrowest somewhere about where it begins to go back.
        low, high = (corners[number] + corner) // 2, (corner + corners[number + 2]) // 2
        split = low + int(narrow[low : high + 1].argmin())
        limit = looks.narrow * min(usual[number], usual[number + 1])
        if narrow[split] > limit:
            return Ways(np.ones(len(masks)), np.zeros(len(masks), dtype=np.bool_))
        right[begin:split] = np.sign(way[corner] - way[corners[number]])
        right[split:] = np.sign(way[corners[number + 2]] - way[corner])
        turning |= _around(narrow < limit, split)
        begin = split
    return Ways(right, turning)


def _narrowness(masks: Masks) -> Floats:
    """(t,) width for height of the silhouettes."""
    wide = masks.any(axis=1).sum(axis=1).astype(np.float64)
    high = masks.any(axis=2).sum(axis=1)
    return np.asarray(wide / np.maximum(high, 1))


def _corners(way: Floats, back: float) -> list[int]:
    """The frames at which a way turns back by so much, after it has gone so much."""
    found: list[int] = []
    best, sign = 0, 0.0
    for row in range(1, len(way)):
        if sign == 0.0:
            low, high = int(way[: row + 1].argmin()), int(way[: row + 1].argmax())
            if way[high] - way[low] >= back:
                sign, best = (1.0, high) if high > low else (-1.0, low)
                first = min(low, high)
                # What came before the first end is a way of its own where it is long enough.
                if first > 0 and abs(way[first] - way[0]) >= back:
                    found.append(first)
            continue
        if sign * (way[row] - way[best]) > 0.0:
            best = row
        elif sign * (way[best] - way[row]) >= back:
            found.append(best)
            sign, best = -sign, row
    return found


def _around(narrow: NDArray[np.bool_], split: int) -> NDArray[np.bool_]:
    """The narrow frames that lie together with one of them."""
    found = np.zeros_like(narrow)
    low = high = split
    while low > 0 and narrow[low - 1]:
        low -= 1
    while high + 1 < len(narrow) and narrow[high + 1]:
        high += 1
    found[low : high + 1] = True
    return found
