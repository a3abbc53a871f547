"""The same picture given several times: saved anew, made smaller, or with other EXIF.

Of such files the best one is used: that with most pixels, then that which knows most of itself.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import Photo

THUMB_PX = 32
SAME_PICTURE = 1.0
"""Mean difference (of 255) up to which two thumbnails show the same picture, saved twice."""


@dataclass
class Pictures:
    """The pictures seen so far. most: how many there can be."""

    most: int
    _thumbs: NDArray[np.float32] = field(init=False)
    _worth: list[tuple[int, int]] = field(init=False, default_factory=list)

    def __post_init__(self) -> None:
        self._thumbs = np.empty((self.most, 3 * THUMB_PX**2), dtype=np.float32)

    def same_as(self, photo: Photo) -> int | None:
        """The number of the picture that shows the same; None where none does."""
        apart = np.abs(self._thumbs[: len(self._worth)] - thumbnail(photo.pixels)).mean(axis=1)
        if not len(apart) or float(apart.min()) > SAME_PICTURE:
            return None
        return int(np.argmin(apart))

    def is_better(self, photo: Photo, number: int) -> bool:
        """Whether a photo is to be used in place of an earlier one that shows the same."""
        return _worth(photo) > self._worth[number]

    def add(self, photo: Photo, number: int | None = None) -> None:
        """Keep a picture, in place of an earlier one where its number is given."""
        if number is None:
            number = len(self._worth)
            self._worth.append(_worth(photo))
        self._thumbs[number] = thumbnail(photo.pixels)
        self._worth[number] = _worth(photo)


def thumbnail(pixels: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Means of blocks, in a row: the same for one picture in different sizes and qualities."""
    small = cv2.resize(pixels, (THUMB_PX, THUMB_PX), interpolation=cv2.INTER_AREA)
    return small.astype(np.float32).reshape(-1)


def _worth(photo: Photo) -> tuple[int, int]:
    """Pixels; and how many of focal length, place and time are known."""
    height, width = photo.pixels.shape[:2]
    known = (photo.focal_px, photo.shot.position, photo.shot.time)
    return height * width, sum(value is not None for value in known)
