"""Which of several known offsets serves where, decided on a small copy of a picture."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.offsets import moved
from veduta.surfaces.filling.options import RepeatParameters

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
Offsets = NDArray[np.int64]
_NEVER = np.float32(1e9)


@dataclass(frozen=True, eq=False)
class Spoilt:
    """A picture (h, w, 3) uint8, its holes (h, w), and (h,) the zone of each of its rows."""

    pixels: NDArray[np.uint8]
    holes: Mask
    zones: NDArray[np.int64]

    def small(self, scale: float) -> Small:
        """The same at a scale, of known pixels alone."""
        height, width = self.holes.shape
        size = max(1, round(width * scale)), max(1, round(height * scale))
        weight = cv2.resize((~self.holes).astype(np.float32), size, interpolation=cv2.INTER_AREA)
        there = np.where(self.holes[..., None], 0, self.pixels).astype(np.float32)
        values = cv2.resize(there, size, interpolation=cv2.INTER_AREA)
        shown = values / np.maximum(weight, 1e-3)[..., None]
        middles = ((np.arange(size[1]) + 0.5) * height / size[1]).astype(np.int64)
        return Small(np.asarray(shown, np.float32), np.asarray(weight > 0.6), self.zones[middles])


@dataclass(frozen=True, eq=False)
class Small:
    """A small copy (h, w, 3), what of it is known (h, w), and the zones (h,) of its rows."""

    pixels: Floats
    known: Mask
    zones: NDArray[np.int64]

    @property
    def whole(self) -> tuple[slice, slice]:
        """All rows and columns."""
        return slice(0, self.known.shape[0]), slice(0, self.known.shape[1])

    def source(self, step: NDArray[np.int64]) -> Mask:
        """(h, w) where the step leads to what is known and lies in the same zone."""
        rows = np.arange(len(self.zones)) + int(step[1])
        same = (rows >= 0) & (rows < len(self.zones))
        same &= self.zones[np.clip(rows, 0, len(self.zones) - 1)] == self.zones
        there: Mask = moved(self.known, self.whole, step) & same[:, None]
        return there


@dataclass(frozen=True, eq=False)
class Choice:
    """number (h', w') of the offset of each place of the small copy, -1 for none; cost (h', w').

    The cost is the mean square difference (of 255) of what is around, at least.
    """

    number: NDArray[np.int16]
    cost: Floats


def choose(small: Small, steps: Offsets, reach: float, parameters: RepeatParameters) -> Choice:
    """The best of the steps (k, 2), x y, for each place of the small copy.

    reach: the size of what repeats, in pixels of the copy.
    """
    shown, sure = small.pixels, small.known.astype(np.float32)
    number = np.full(small.known.shape, -1, dtype=np.int16)
    cost = np.full(small.known.shape, _NEVER, dtype=np.float32)
    sources = [small.source(step) for step in steps]
    for _ in range(parameters.rounds):
        number.fill(-1)
        cost.fill(_NEVER)
        for place, (step, source) in enumerate(zip(steps, sources, strict=True)):
            tried = _cost(small, shown, sure, step, source, reach, parameters)
            better = tried < cost
            number[better], cost[better] = place, tried[better]
        shown = small.pixels.copy()
        for place in np.unique(number[number >= 0]):
            mine = (number == place) & ~small.known
            shown[mine] = moved(small.pixels, small.whole, steps[place])[mine]
        guessed = np.where(number >= 0, parameters.guessed, 0.0)
        sure = np.where(small.known, 1.0, guessed).astype(np.float32)
    return Choice(number, cost)


def _cost(
    small: Small,
    shown: Floats,
    sure: Floats,
    step: NDArray[np.int64],
    source: Mask,
    reach: float,
    parameters: RepeatParameters,
) -> Floats:
    """(h, w) mean square difference around each place, `_NEVER` where the step leads nowhere."""
    if not source.any():
        return np.full(source.shape, _NEVER, dtype=np.float32)
    apart = moved(shown, small.whole, step) - shown
    square = cv2.transform(apart * apart, np.full((1, 3), 1.0 / 3.0, np.float32))
    square = np.minimum(square, parameters.different**2)
    weight = np.where(source, sure, 0.0).astype(np.float32)
    total = float(weight.sum())
    repeats = float((weight * square).sum()) / total if total > 0 else parameters.different**2
    summed = np.full(source.shape, parameters.faith * repeats, dtype=np.float32)
    weights = np.full(source.shape, parameters.faith, dtype=np.float32)
    weighed = weight * square
    for share, much in zip(parameters.around, (1.0, parameters.far_weight), strict=True):
        summed += much * _spread(weighed, share * reach)
        weights += much * _spread(weight, share * reach)
    cost = np.where(source, summed / weights, parameters.different**2).astype(np.float32)
    return np.where(source, _spread(cost, parameters.steady * reach), _NEVER).astype(np.float32)


def _spread(values: Floats, sigma: float) -> Floats:
    """The mean around: two box filters, about a Gaussian of this deviation."""
    side = max(3, 2 * round(1.2 * sigma) + 1)
    once = cv2.boxFilter(values, -1, (side, side))
    return np.asarray(cv2.boxFilter(once, -1, (side, side)), np.float32)


def refined(
    spoilt: Spoilt,
    choice: Choice,
    offsets: Offsets,
    around_px: int,
    parameters: RepeatParameters,
) -> Offsets:
    """Each offset that was chosen, moved by the few pixels by which what is around fits best.

    around_px: how far around the holes is looked. It stays where another is hardly better.
    """
    reach_px = parameters.refine_px
    height, width = spoilt.holes.shape
    grey = cv2.cvtColor(spoilt.pixels, cv2.COLOR_RGB2GRAY).astype(np.float32)
    known = (~spoilt.holes).astype(np.float32)
    number = cv2.resize(choice.number, (width, height), interpolation=cv2.INTER_NEAREST)
    number = np.where(spoilt.holes, number, -1)
    found = offsets.copy()
    steps = [(y, x) for y in range(-reach_px, reach_px + 1) for x in range(-reach_px, reach_px + 1)]
    steps.sort(key=lambda step: abs(step[0]) + abs(step[1]))
    for which in np.unique(number[number >= 0]):
        offset = offsets[which]
        part = _around(number == which, around_px, offset, reach_px)
        if part is None:
            continue
        least = np.inf
        for dy, dx in steps:
            by = offset + np.array([dx, dy])
            source = (
                slice(part[0].start + by[1], part[0].stop + by[1]),
                slice(part[1].start + by[0], part[1].stop + by[0]),
            )
            both = known[part] * known[source]
            apart = np.minimum(np.abs(grey[source] - grey[part]), parameters.outlier)
            difference = float((apart * both).sum()) / max(float(both.sum()), 1.0)
            if difference < parameters.better * least:
                found[which], least = by, difference
    return found


def _around(
    mask: Mask, more: int, offset: NDArray[np.int64], margin: int
) -> tuple[slice, slice] | None:
    """The part about a mask that stays in the picture when it is moved by about an offset."""
    spans = []
    for axis, by in ((0, int(offset[1])), (1, int(offset[0]))):
        where = np.flatnonzero(mask.any(axis=1 - axis))
        length = mask.shape[axis]
        low = max(0, int(where[0]) - more, margin - by)
        high = min(length, int(where[-1]) + more + 1, length - by - margin)
        if high - low < 4:
            return None
        spans.append(slice(low, high))
    return spans[0], spans[1]
