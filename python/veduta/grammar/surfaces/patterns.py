"""The two test pictures that CityEngine brings along, drawn anew: `builtin:default`, `uvtest`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

PREFIX = "builtin:"
_SIZE = 512
_CELLS = 8


def pattern_of(name: str) -> str | None:
    """Which pattern a name of a rule file means (`builtin:uvtest.png`); None for other names."""
    if not name.startswith(PREFIX):
        return None
    plain = name.removeprefix(PREFIX).split(":")[0].rsplit(".", 1)[0].lower()
    return plain if plain in PATTERNS else None


def checkerboard() -> NDArray[np.uint8]:
    """(256, 256, 3) sRGB: 16 x 16 black and white squares."""
    row, column = np.indices((256, 256)) // 16
    grey = np.where((row + column) % 2 == 0, 235, 25).astype(np.uint8)
    return np.repeat(grey[:, :, None], 3, axis=2)


def uv_test() -> NDArray[np.uint8]:
    """(512, 512, 3) sRGB: squares that say their row and column; u grows red, v grows green."""
    y, x = np.indices((_SIZE, _SIZE))
    row, column = y * _CELLS // _SIZE, x * _CELLS // _SIZE
    u, v = column / (_CELLS - 1), 1.0 - row / (_CELLS - 1)
    shade = np.where((row + column) % 2 == 0, 1.0, 0.78)
    pixels = np.stack([60 + 180 * u, 60 + 180 * v, 150 + 0 * u], axis=2) * shade[:, :, None]
    image = Image.fromarray(np.round(pixels).astype(np.uint8))
    draw = ImageDraw.Draw(image)
    side = _SIZE // _CELLS
    for across in range(_CELLS):
        for up in range(_CELLS):
            corner = (across * side + 6, (_CELLS - 1 - up) * side + 6)
            draw.text(corner, f"{across}{up}", fill=(20, 20, 20))
    return np.asarray(image, dtype=np.uint8)


PATTERNS = {"default": checkerboard, "uvtest": uv_test}
