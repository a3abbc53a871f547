"""Windows copied from where they fit best: one level of the pyramid."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.offsets import moved
from veduta.surfaces.filling.options import FillParameters

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]
_NO_FIT = np.float32(1e9)


@dataclass(frozen=True, eq=False)
class Level:
    """One size of the picture. known: before anything was copied. near: around the hole.

    pixels: (h, w, 3), with what coarser levels filled. sure: (h, w) 1 for known, less for guessed,
    0 where nothing is. hole: (h, w) what is to be filled.
    """

    pixels: Floats
    known: Mask
    sure: Floats
    hole: Mask
    near: tuple[slice, slice]


@dataclass(frozen=True, eq=False)
class Copied:
    """pixels: (h, w, 3) filled. used: (k,) how many pixels each offset gave. fit: (n,) root mean
    square difference (of 255) of the windows about the hole's pixels.
    """

    pixels: Floats
    used: NDArray[np.int64]
    fit: Floats


def copy_windows(
    level: Level,
    offsets: NDArray[np.int64],
    repeats: Floats,
    parameters: FillParameters,
    *,
    blend: bool,
) -> Copied:
    """Fill the hole by the windows that fit best, of those at the offsets.

    repeats: (k,) mean square difference of the whole picture by each offset. blend: take the mean
    of all windows over a pixel, weighted by their fit, and not the best one (which is sharp).
    """
    best, cost = _best_windows(level, offsets, repeats, parameters)
    near, hole = level.near, level.hole[level.near]
    size = (parameters.windows_px[-1],) * 2
    worth = 1.0 / (cost + 25.0)
    top = np.zeros(hole.shape, dtype=np.float32)
    taken = np.zeros((*hole.shape, 3), dtype=np.float32)
    owner = np.full(hole.shape, -1, dtype=np.int64)
    for number in np.unique(best[best >= 0]):
        offset = offsets[number]
        there = moved(level.known, level.near, offset)
        weight = cv2.GaussianBlur(np.where(best == number, worth, 0.0), size, 0)
        weight = np.where(there, weight, 0.0).astype(np.float32)
        source = moved(level.pixels, level.near, offset)
        if blend:
            taken += weight[..., None] * source
        else:
            better = weight > top
            taken[better] = source[better]
        owner[weight > top] = number
        top = top + weight if blend else np.maximum(top, weight)
    if blend:
        taken /= np.maximum(top, 1e-12)[..., None]
    filled = hole & (top > 0.0)
    if not blend:
        beside = (top > 0.0) & level.known[near]
        taken += level_with_rim(level.pixels[level.near], taken, beside, parameters.light)
    pixels = level.pixels.copy()
    pixels[level.near][filled] = taken[filled]
    used = np.bincount(owner[filled], minlength=len(offsets))
    return Copied(pixels, used, np.sqrt(cost[hole]))


def level_with_rim(given: Floats, taken: Floats, known: Mask, light: float) -> Floats:
    """(h, w, 3) what to add to copied pixels so that they are as bright as the known ones beside.

    The differences of known pixels from what would be copied to them, as far as they are ones of
    light and not of things, spread by a kernel with long tails (inverse squares of distance).
    """
    apart = given - taken
    weight = (known & (np.abs(apart).max(axis=2) < light)).astype(np.float32)
    summed, weights = np.zeros_like(taken), np.zeros_like(weight)
    sigma = 1.5
    while sigma < max(known.shape):
        share = np.float32(1.0 / sigma**2)
        summed += share * cv2.GaussianBlur(apart * weight[..., None], (0, 0), sigma)
        weights += share * cv2.GaussianBlur(weight, (0, 0), sigma)
        sigma *= 2.0
    return np.asarray(summed / np.maximum(weights, 1e-6)[..., None], dtype=np.float32)


def _best_windows(
    level: Level, offsets: NDArray[np.int64], repeats: Floats, parameters: FillParameters
) -> tuple[NDArray[np.int64], Floats]:
    """(h, w) of the near part: the best offset's number, and its cost (mean square, of 255)."""
    shape = level.hole[level.near].shape
    best = np.full(shape, -1, dtype=np.int64)
    cost = np.full(shape, _NO_FIT, dtype=np.float32)
    limit = np.float32(parameters.good**2)
    for side in parameters.windows_px:
        own, own_cost = np.full(shape, -1, dtype=np.int64), np.full(shape, _NO_FIT, np.float32)
        for number, (offset, repeat) in enumerate(zip(offsets, repeats, strict=True)):
            tried = _window_cost(level, offset, float(repeat), side, parameters)
            better = tried < own_cost
            own[better], own_cost[better] = number, tried[better]
        open_ = (cost > limit) & (own_cost < cost)
        best[open_], cost[open_] = own[open_], own_cost[open_]
        if not ((cost > limit) & level.hole[level.near]).any():
            break
    return best, cost


def _window_cost(
    level: Level, offset: NDArray[np.int64], repeat: float, side: int, parameters: FillParameters
) -> Floats:
    """(h, w) mean square difference of windows and those at an offset, weighed by what is sure."""
    near = level.near
    there = moved(level.known, near, offset)
    square = ((moved(level.pixels, near, offset) - level.pixels[near]) ** 2).mean(axis=2)
    square = np.minimum(square, parameters.different**2)
    weight = np.where(there, level.sure[near], 0.0).astype(np.float32)
    size = (side, side)
    faith = parameters.faith
    summed = cv2.boxFilter((weight * square).astype(np.float32), -1, size)
    weights = cv2.boxFilter(weight, -1, size)
    cost = (summed + faith * repeat) / (weights + faith)
    share = cv2.boxFilter(there.astype(np.float32), -1, size)
    return np.asarray(np.where(share >= parameters.known, cost, _NO_FIT), dtype=np.float32)


def sure_of(known: Mask, hole: Mask, guessed: float | None) -> Floats:
    """(h, w) 1 where known, `guessed` in the hole if it was filled before, else 0."""
    sure = known.astype(np.float32)
    if guessed is not None:
        sure[hole] = guessed
    return sure
