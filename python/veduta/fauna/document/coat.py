"""`coat.png`: the texture of an animal, which hides where it is invented."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from veduta.fauna.motion.figure import Figure, Floats, posed
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


@dataclass(frozen=True)
class Panel:
    """What of an animal's plane a panel of its coat shows: from `low` so far, in lengths."""

    low: tuple[float, float]
    size: tuple[float, float]

    def uv(self, points: Floats) -> Floats:
        """(n, 2) places in the panel, 0..1, v down, of points in the plane, y up."""
        share = (points - np.array(self.low)) / np.array(self.size)
        return np.stack([share[:, 0], 1.0 - share[:, 1]], axis=1).clip(0.0, 1.0)


def panel_of(figure: Figure) -> Panel:
    """The panel of an animal with limbs: all of it as it stands."""
    start = np.array([figure.limbs[0].part.points[0]])
    at = posed(figure, start, figure.rest[None], figure.length, figure.apart).joints[0]
    low = (at - figure.deep[:, None]).min(axis=0) - 0.02
    high = (at + figure.deep[:, None]).max(axis=0) + 0.02
    size = high - low
    return Panel((float(low[0]), float(low[1])), (float(size[0]), float(size[1])))
