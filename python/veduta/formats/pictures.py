"""The textures of a place as files beside a model, each once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.shapes import Look
from veduta.imaging.encode import jpeg_bytes
from veduta.place.material import Colour, Texture
from veduta.run.atomic import write_bytes

JPEG_QUALITY = 92


class Pictures:
    """Writes each texture once, as `<model>-<look>.jpg` beside the model."""

    def __init__(self, model: Path) -> None:
        self._model = model
        self._names: dict[Texture, str] = {}

    def name(self, look: Look) -> str | None:
        """The file of a look's texture, by its name beside the model; None where it has none."""
        texture = look.material.texture
        if texture is None:
            return None
        if texture not in self._names:
            name = f"{self._model.stem.replace(' ', '-')}-{look.name}.jpg"
            write_bytes(self._model.parent / name, jpeg_bytes(texture.pixels, JPEG_QUALITY))
            self._names[texture] = name
        return self._names[texture]


def colours_at(
    texture: Texture | None, colour: Colour, uv: NDArray[np.float64]
) -> NDArray[np.uint8]:
    """(n, 3) sRGB of a material at texture coordinates (n, 2): the nearest pixel's, repeated."""
    tint = np.array(colour)
    if texture is None:
        return np.tile(np.round(tint * 255.0).astype(np.uint8), (len(uv), 1))
    height, width = texture.pixels.shape[:2]
    # The lower and right edge belong to the last pixel, not to the first of the next repeat.
    inside = np.where((uv >= 0.0) & (uv <= 1.0), uv, uv - np.floor(uv))
    x = np.minimum((inside[:, 0] * width).astype(np.int64), width - 1)
    y = np.minimum((inside[:, 1] * height).astype(np.int64), height - 1)
    found: NDArray[np.uint8] = np.round(texture.pixels[y, x] * tint).astype(np.uint8)
    return found
