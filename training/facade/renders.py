"""Synthetic facades with a label per pixel, for `prepare.py`.

    python training/facade/renders.py OUT [--count 640]

About a second each. OUT gets NAME.jpg and NAME.png; the channels of the latter are the label (a
place in `veduta.place.semantics.LABELS`) and the semantic code of what each pixel shows (255: sky).
"""

from __future__ import annotations

import argparse
from pathlib import Path
from unittest import mock

import cv2
import numpy as np

from veduta.synthetic.facade import SyntheticFacade, make_facade
from veduta.synthetic.layout import STYLES
from veduta.synthetic.options import Perspective, SyntheticOptions, Weather
from veduta.synthetic.truth import label_image

SKY = 255
VIEWS: tuple[Perspective, ...] = ("frontal", "frontal", "mild")
WEATHERS: tuple[Weather, ...] = ("sunny", "cloudy")


def main() -> None:
    """Render, one seed after the other; what is there stays."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--count", type=int, default=640)
    call = parser.parse_args()
    call.out.mkdir(parents=True, exist_ok=True)
    for seed in range(call.count):
        path = call.out / f"r{seed:04d}.jpg"
        if not path.exists():
            facade, semantic = _made(seed)
            cv2.imwrite(str(path), facade.photo[..., ::-1], (cv2.IMWRITE_JPEG_QUALITY, 90))
            cv2.imwrite(str(path.with_suffix(".png")), _labels(facade, semantic))


def _options(seed: int) -> SyntheticOptions:
    rng = np.random.default_rng(seed)
    return SyntheticOptions(
        style="haussmann" if seed % 2 else STYLES[seed // 2 % len(STYLES)],
        long_side_px=int(rng.integers(420, 640)),
        perspective=VIEWS[seed % 3],
        weather=WEATHERS[seed // 2 % 2],
        detached=bool(rng.random() < 0.4),
        occluders=bool(rng.random() < 0.6),
        samples=1,
    )


def _labels(facade: SyntheticFacade, semantic: np.ndarray) -> np.ndarray:
    return np.dstack([facade.truth.labels, semantic, semantic])


def _made(seed: int) -> tuple[SyntheticFacade, np.ndarray]:
    """A facade, and (h, w) the semantic code of what each pixel shows.

    The truth of a facade folds the street into one label, so the codes are read where it is made.
    """
    kept: list[np.ndarray] = []

    def read(feature: np.ndarray, codes: np.ndarray) -> np.ndarray:
        kept.append(np.where(feature >= 0, codes[np.maximum(feature, 0)], SKY).astype(np.uint8))
        return label_image(feature, codes)

    with mock.patch("veduta.synthetic.facade.label_image", read):
        return make_facade(seed, _options(seed)), kept[0]


if __name__ == "__main__":
    main()
