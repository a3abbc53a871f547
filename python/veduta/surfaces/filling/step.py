"""Holes filled: short gaps by interpolation, the rest by windows that repeat elsewhere.

Section 7.3 of the paper on facades from a driving truck. Its search of a window for each pixel of
the hole is here one of offsets: on the coarsest level of a Gaussian pyramid all are looked at, the
best are followed to finer levels, and windows shrink where none fits.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.filling.bridging import bridge
from veduta.surfaces.filling.offsets import refined, repeats
from veduta.surfaces.filling.options import FillParameters
from veduta.surfaces.filling.windows import Level, copy_windows, sure_of

Floats = NDArray[np.float32]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Filled:
    """pixels: (h, w, 3) uint8 sRGB. invented: (h, w) bool, what was not there before.

    bridged, copied: numbers of pixels filled by interpolation and by copying. unlike: share of the
    copied ones whose window fits nowhere well: what stands there is a guess.
    """

    pixels: NDArray[np.uint8]
    invented: Mask
    bridged: int
    copied: int
    unlike: float


def fill_holes(
    pixels: NDArray[np.uint8], holes: Mask, parameters: FillParameters | None = None
) -> Filled:
    """Fill holes (h, w) of a picture (h, w, 3) whose axes are those of its facade.

    The same comes out for the same input. What cannot be filled, because nothing is known, is grey.
    ValueError where the shapes differ.
    """
    chosen = parameters or FillParameters()
    if pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.shape[:2] != holes.shape:
        raise ValueError(f"pixels {pixels.shape} and holes {holes.shape} do not belong together")
    if not holes.any() or holes.all():
        grey = np.full_like(pixels, 128) if holes.any() else pixels
        return Filled(grey, holes.copy(), 0, 0, 1.0 if holes.any() else 0.0)
    work = np.where(holes[..., None], 0, pixels).astype(np.float32)
    work, known = bridge(work, ~holes, chosen)
    bridged = int((known & holes).sum())
    copied, poor = 0, 0
    _, numbers = cv2.connectedComponents((~known).astype(np.uint8), connectivity=8)
    original = known.copy()
    for number in _largest_first(np.asarray(numbers, dtype=np.int32), chosen.most_holes):
        hole = numbers == number
        work, fit = _fill_one(work, original, hole, chosen)
        copied += int(hole.sum())
        poor += int((fit > 2.0 * chosen.good).sum())
    result = np.where(holes[..., None], np.clip(np.rint(work), 0, 255), pixels).astype(np.uint8)
    return Filled(result, holes.copy(), bridged, copied, poor / max(copied, 1))


def _largest_first(numbers: NDArray[np.int32], most_holes: int) -> NDArray[np.int64]:
    """The holes' numbers; beyond `most_holes`, the small ones are one hole together."""
    sizes = np.bincount(numbers.ravel())
    sizes[0] = 0
    order = np.argsort(-sizes, kind="stable")
    order = order[sizes[order] > 0]
    if len(order) > most_holes:
        rest = order[most_holes - 1 :]
        numbers[np.isin(numbers, rest)] = rest[0]
        order = order[:most_holes]
    return np.asarray(order, dtype=np.int64)


def _fill_one(
    work: Floats, known: Mask, hole: Mask, parameters: FillParameters
) -> tuple[Floats, Floats]:
    """The picture with one hole filled, coarse to fine, and how well each window fits."""
    sizes = _pyramid(work, known, hole, parameters.coarsest_px)
    offsets = np.zeros((0, 2), dtype=np.int64)
    worth = np.zeros(0, dtype=np.float32)
    guess: Floats | None = None
    fit = np.zeros(0, dtype=np.float32)
    for place, (pixels, there, open_) in enumerate(reversed(sizes)):
        near = _near(open_, parameters.windows_px[0])
        if guess is None:
            offsets, worth = repeats(pixels, there, open_, parameters)
        else:
            offsets, worth = refined(offsets, pixels, there, near)
            height, width = open_.shape
            large = cv2.resize(guess, (width, height), interpolation=cv2.INTER_LINEAR)
            pixels = np.where(open_[..., None], large, pixels)
        if not len(offsets):
            return _flat(work, known, hole), np.full(int(hole.sum()), 255.0, dtype=np.float32)
        rounds = parameters.coarsest_rounds if guess is None else parameters.rounds
        last = place == len(sizes) - 1
        for turn in range(rounds):
            is_guessed = guess is not None or turn > 0
            sure = sure_of(there, open_, parameters.guessed if is_guessed else None)
            level = Level(pixels, there, sure, open_, near)
            blend = not (last and turn == rounds - 1)
            made = copy_windows(level, offsets, worth, parameters, blend=blend)
            pixels, fit = made.pixels, made.fit
            if guess is None or turn == 0:
                keep = np.argsort(-made.used, kind="stable")[: parameters.offsets]
                keep = keep[made.used[keep] > 0] if (made.used > 0).any() else keep[:1]
                offsets, worth = offsets[np.sort(keep)], worth[np.sort(keep)]
        guess = pixels
    result = work if guess is None else guess
    return np.where(hole[..., None], result, work).astype(np.float32), fit


def _pyramid(
    work: Floats, known: Mask, hole: Mask, coarsest_px: int
) -> list[tuple[Floats, Mask, Mask]]:
    """Pixels, what is known, and the hole, each half as large as the one before."""
    levels = [(work, known, hole)]
    while max(levels[-1][1].shape) > coarsest_px and min(levels[-1][1].shape) > 16:
        pixels, there, open_ = levels[-1]
        weight = cv2.pyrDown(there.astype(np.float32))
        values = cv2.pyrDown(np.where(there[..., None], pixels, 0.0).astype(np.float32))
        coarse = np.asarray(values / np.maximum(weight, 1e-6)[..., None], dtype=np.float32)
        part = cv2.pyrDown(open_.astype(np.float32))
        small = np.asarray(part > 0.25)
        if not small.any():
            small = part >= part.max()
        levels.append((coarse, np.asarray(weight > 0.6) & ~small, small))
    return levels


def _near(hole: Mask, reach: int) -> tuple[slice, slice]:
    """The part of the picture about a hole."""
    rows, columns = np.flatnonzero(hole.any(axis=1)), np.flatnonzero(hole.any(axis=0))
    height, width = hole.shape
    return (
        slice(max(0, int(rows[0]) - reach), min(height, int(rows[-1]) + reach + 1)),
        slice(max(0, int(columns[0]) - reach), min(width, int(columns[-1]) + reach + 1)),
    )


def _flat(work: Floats, known: Mask, hole: Mask) -> Floats:
    """Where nothing repeats: the mean of what is known."""
    filled = work.copy()
    filled[hole] = work[known].mean(axis=0) if known.any() else 128.0
    return filled
