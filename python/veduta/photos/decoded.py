"""The pixels of the photos, few at a time: pictures, walls and textures are made of them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.photos.bounded import Bounded
from veduta.photos.intake.read import PhotoRecord

MOST_BYTES = 384 * 1024**2
"""Five photos of 24 megapixels, or all of a small set: these are read once."""


class DecodedPhotos:
    """Reads photos by their image ids."""

    def __init__(self, photos: Iterable[PhotoRecord], most_bytes: int = MOST_BYTES) -> None:
        self._paths = {photo.image_id: photo.path for photo in photos}
        self._kept = Bounded(self._read, lambda pixels: int(pixels.nbytes), most_bytes)

    def __call__(self, image_id: int) -> NDArray[np.uint8]:
        """(h, w, 3) sRGB, upright; not to be written to."""
        return self._kept(image_id)

    def _read(self, image_id: int) -> NDArray[np.uint8]:
        pixels = read_image(self._paths[image_id]).pixels
        pixels.flags.writeable = False
        return pixels
