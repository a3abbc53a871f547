"""`coat.png`: the texture of an animal, which hides where it is invented."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from veduta.place.material import Texture
from veduta.run.errors import InputError

COAT = "coat.png"
_REMEDY = "Let it stand beside animal.json as it was written, or set its `coat` to null."


def save_coat(coat: Texture, path: Path) -> None:
    """As RGBA: what is invented has half the alpha."""
    alpha = np.where(coat.invented, 127, 255).astype(np.uint8)
    cv2.imwrite(str(path), np.dstack([coat.pixels[..., ::-1], alpha]))


def load_coat(path: Path) -> Texture:
    """The coat in a file; InputError where there is none."""
    found = cv2.imread(str(path), cv2.IMREAD_UNCHANGED) if path.is_file() else None
    if found is None or found.ndim != 3 or found.shape[2] != 4 or found.dtype != np.uint8:
        raise InputError(path, "is no coat of an animal", _REMEDY)
    pixels = np.ascontiguousarray(found[..., 2::-1], dtype=np.uint8)
    return Texture(pixels, found[..., 3] < 200)
