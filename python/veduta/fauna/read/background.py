"""What is behind the animal: given, or estimated from all frames, even where the animal stays.

The median over time is the background where the animal covers a place in fewer than half of the
frames. An animal that wriggles on the spot covers it for longer; then the place is filled from its
surroundings, and of the values seen there the one nearest to that is taken.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.uint8]
Floats32 = NDArray[np.float32]


@dataclass(frozen=True)
class BackgroundLooks:
    """What tells the animal's places from those where only the camera's noise is."""

    frames: int = 21
    """Frames that are looked at, evenly over time."""
    noise: float = 6.0
    """A place that varies by more than so many times the noise is one that the animal was at."""
    least: float = 14.0
    """And by so many grey levels at least: compression makes noise of its own."""
    stays: float = 4.0
    """Where all its places together are less than so many times its own area, it stays."""
    whole: float = 0.9
    """Of all frames so many differ by no more than the animal's area, and its own in the median."""


@dataclass(frozen=True, eq=False)
class Background:
    """pixels: (h, w, 3) uint8. noise: grey levels, of a frame against it. filled: share of pixels
    that were filled from their surroundings. given: by the user.
    """

    pixels: Pixels
    noise: float
    filled: float
    given: bool


def given_background(frames: Pixels, pixels: Pixels) -> Background:
    """The user's picture; its noise is that of the frames against it."""
    return Background(pixels, _noise(frames, pixels), 0.0, given=True)


def estimated_background(frames: Pixels, looks: BackgroundLooks) -> Background:
    """The background of frames (t, h, w, 3) of a camera that stands still."""
    chosen = np.linspace(0, len(frames) - 1, min(len(frames), looks.frames)).round().astype(int)
    few = frames[chosen]
    middle = len(few) // 2
    median = np.partition(few, middle, axis=0)[middle]
    noise = _noise(few, median)
    level = max(looks.noise * noise, looks.least)
    apart = np.stack([most_apart(frame, median) for frame in few])
    # Where the median shows the animal itself, a frame in which it is elsewhere differs at both.
    own = float(np.quantile((apart > level).sum(axis=(1, 2)), looks.whole))
    place = _largest_filled(apart.max(axis=0) > level)
    if own <= 0.0 or float(place.sum()) > looks.stays * own:
        return Background(median, noise, 0.0, given=False)
    reach = max(3, round(0.1 * float(np.sqrt(place.sum()))))
    wide = cv2.dilate(place, np.ones((2 * reach + 1, 2 * reach + 1), np.uint8))
    around = cv2.inpaint(median, wide, float(reach), cv2.INPAINT_TELEA)
    inpainted = np.asarray(around, dtype=np.uint8)
    from_around = np.stack([most_apart(frame, inpainted) for frame in few])
    nearest = from_around.argmin(axis=0)
    seen = np.take_along_axis(few, nearest[None, ..., None], axis=0)[0]
    behind = wide.astype(np.bool_)
    unseen = behind & (from_around.min(axis=0) > level)
    pixels = np.where(behind[..., None], seen, median)
    pixels = np.where(unseen[..., None], around, pixels)
    return Background(pixels.astype(np.uint8), noise, float(unseen.mean()), given=False)


def most_apart(first: Pixels, second: Pixels) -> Pixels:
    """(h, w) uint8 the difference of two pictures in the channel in which it is the largest."""
    red, green, blue = cv2.split(cv2.absdiff(first, second))
    return np.asarray(cv2.max(cv2.max(red, green), blue), dtype=np.uint8)


def _noise(frames: Pixels, background: Pixels) -> float:
    """Standard deviation of a frame against the background, by the middle of all differences."""
    ground = np.ascontiguousarray(background[::2, ::2])
    counts = np.zeros(256, dtype=np.int64)
    for frame in frames[:: max(1, len(frames) // 8), ::2, ::2]:
        apart = cv2.absdiff(np.ascontiguousarray(frame), ground)
        counts += np.bincount(np.asarray(apart).ravel(), minlength=256)
    # Differences are whole grey levels: their counts hold the middle one.
    middle = int(np.searchsorted(np.cumsum(counts), 0.5 * counts.sum()))
    return 1.4826 * middle + 0.5


def _largest_filled(changed: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """The largest connected place, closed over gaps, with what it encloses."""
    varied = cv2.morphologyEx(changed.astype(np.uint8), cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    size = max(3, round(0.02 * max(varied.shape)) | 1)
    closed = cv2.morphologyEx(varied, cv2.MORPH_CLOSE, np.ones((size, size), np.uint8))
    count, labels, stats, _ = cv2.connectedComponentsWithStats(closed, connectivity=8)
    if count < 2:
        return np.zeros(changed.shape, dtype=np.uint8)
    row = 1 + int(stats[1:, cv2.CC_STAT_AREA].argmax())
    outlines, _ = cv2.findContours(
        (labels == row).astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE
    )
    filled = np.zeros(changed.shape, dtype=np.uint8)
    cv2.drawContours(filled, outlines, -1, 1, cv2.FILLED)
    return filled
