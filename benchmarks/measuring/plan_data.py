"""Where the real plans lie, and what their benchmarks share: pictures of what was found."""

from __future__ import annotations

import os
from pathlib import Path

import cv2
import numpy as np
from PIL import Image
from plan_pictures import Image as Pixels
from plan_pictures import overlay
from plan_truth import Affine, Layout

PLANS = Path(os.environ.get("VEDUTA_DATA", Path(__file__).parents[3] / "shared" / "data")) / "plans"
MOST_PX = 3000
Image.MAX_IMAGE_PIXELS = 120_000_000  # the plans of mlstruct have 64 million


def pixels_of(path: Path) -> Pixels:
    """An image as sRGB (h, w, 3) on white."""
    with Image.open(path) as image:
        whole = image.convert("RGBA")
        white = Image.new("RGBA", whole.size, (255, 255, 255, 255))
        return np.asarray(Image.alpha_composite(white, whole).convert("RGB"))


def picture(
    path: Path,
    words: str,
    found: Layout | None,
    true: Layout | None,
    px_from_m: Affine,
    folder: Path,
) -> None:
    """One overlay as a picture of its own, at most 3000 px wide."""
    pixels = pixels_of(path)
    step = -(-max(pixels.shape[:2]) // MOST_PX)
    small = np.ascontiguousarray(pixels[::step, ::step])
    shrink = np.diag([1.0 / step, 1.0 / step, 1.0])
    drawn = overlay(small, found, true, shrink @ px_from_m)
    cv2.putText(drawn, words, (10, 30), cv2.FONT_HERSHEY_SIMPLEX, 0.8, (0, 0, 0), 2, cv2.LINE_AA)
    folder.mkdir(parents=True, exist_ok=True)
    name = f"{path.parent.name}-{path.name.split('.')[0][:12]}.png"
    cv2.imwrite(str(folder / name), drawn[..., ::-1])
