"""Which way an animal looks in each frame, where it turns round, and the frames in which it turns.

One plane holds no animal that turns towards the camera. On either side of the turn it does: an
animal goes the way it looks, so it has turned where it goes back and was narrow between.
"""

from __future__ import annotations

from collections.abc import Mapping
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
    """Frames that show it whole and in which it does not turn; of fewer nothing is left out."""
    marks: float = 4.0
    """Marks of a frame, each by how far it is trusted; fewer hold no figure."""
    held: float = 0.8
    """Of the frames in which it turns, so many have them."""
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
    nothing is to be parted: it does not turn, its marked joints hold it in all frames, or (few) too
    few frames are left that show it whole.
    """

    turning: NDArray[np.bool_]
    right: Floats | None
    few: bool = False


def stretches_of(
    found: Silhouettes, pictures: Frames | None, looks: WayLooks, trust: Mapping[str, Floats]
) -> Stretches:
    """Of silhouettes and their frames (t, h, w, 3). trust: (t,) in those frames, by joint that is
    marked, how far the mark is trusted.

    Without a cycle each frame has a pose of its own, which marks may turn round as they will, where
    there are some; one cycle for all frames they cannot.
    """
    shown = found.shown()
    middle = middles_of(found.masks, shown)
    ways = ways_of(found.masks, middle, pictures, looks)
    if not ways.turns:
        return Stretches(np.zeros_like(ways.turning), None)
    whole = ~ways.turning if found.cut is None else ~ways.turning & ~found.cut
    if np.count_nonzero(whole) < looks.fewest:
        return Stretches(ways.turning, None, few=True)
    marks = np.sum([np.zeros(len(ways.turning)), *trust.values()], axis=0)
    if np.mean(marks[ways.turning] >= looks.marks) >= looks.held:
        windows = windows_of(found.masks, looks.cells, middle, shown).turned_where(ways.right)
        if repeat_of(windows) is None:
            return Stretches(ways.turning, None)
    return Stretches(ways.turning, ways.right)


def ways_of(masks: Masks, middle_px: Floats, pictures: Frames | None, looks: WayLooks) -> Ways:
    """Of silhouettes (t, h, w), their middles (t, 2; px), and the frames (t, h, w, 3)."""
    gone = gone_by_frame(masks, middle_px, pictures)
    way = gaussian_filter1d(np.concatenate([[0.0], np.cumsum(gone)]), 1.0, mode="nearest")
    narrow = uniform_filter1d(_narrowness(masks), looks.calm, mode="nearest")
    right, turning = np.ones(len(masks)), np.zeros(len(masks), dtype=np.bool_)
    corners, splits = _turns([0, *_corners(way, looks.back), len(masks) - 1], way, narrow, looks)
    begin = 0
    for number, (split, limit) in enumerate(splits):
        right[begin:split] = np.sign(way[corners[number + 1]] - way[corners[number]])
        right[split:] = np.sign(way[corners[number + 2]] - way[corners[number + 1]])
        turning |= _around(narrow < limit, split)
        begin = split
    return Ways(right, turning)


def _turns(
    corners: list[int], way: Floats, narrow: Floats, looks: WayLooks
) -> tuple[list[int], list[tuple[int, float]]]:
    """Of frames at which a way goes back, with both ends, those at which the animal turns, and the
    frame of each in which it is narrowest, with how narrow one in the turn is.

    Where it was not narrow it stepped back. That is dropped alone, and what is left has to go the
    other way after it than before.
    """
    while len(corners) > 2:
        splits, kept = [], [corners[0]]
        for low, corner, high in zip(corners[:-2], corners[1:-1], corners[2:], strict=True):
            # It is narrowest somewhere about where it begins to go back.
            first, last = (low + corner) // 2, (corner + high) // 2
            split = first + int(narrow[first : last + 1].argmin())
            sides = narrow[low : corner + 1], narrow[corner : high + 1]
            limit = looks.narrow * min(float(np.percentile(side, 80)) for side in sides)
            if narrow[split] <= limit:
                kept.append(corner)
                splits.append((split, limit))
        kept.append(corners[-1])
        if len(kept) == len(corners):
            gone = np.diff(way[kept])
            same = np.flatnonzero((np.abs(gone) < looks.back)[1:] | (gone[1:] * gone[:-1] >= 0.0))
            if not len(same):
                return kept, splits
            del kept[1 + int(same[0])]
        corners = kept
    return corners, []


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
