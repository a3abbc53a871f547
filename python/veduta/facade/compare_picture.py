"""Pictures of a comparison: the true labels, and what was found drawn over the photo."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.facade.compare import labels_in_photo
from veduta.facade.document import FacadeDocument
from veduta.facade.outputs import COLOURS
from veduta.imaging.encode import png_bytes
from veduta.place.semantics import LABELS
from veduta.synthetic.truth import FacadeTruth

_FRACTION_BITS = 4
_GAP_PX = 12


def truth_png(truth: FacadeTruth) -> bytes:
    """The true labels (h, w) as an 8-bit palette PNG; the index is the place in `LABELS`."""
    image = Image.fromarray(truth.labels)
    image.putpalette([part for name in LABELS for part in COLOURS[name]])
    return png_bytes(image, optimize=True)


def comparison_png(photo: NDArray[np.uint8], truth: FacadeTruth, document: FacadeDocument) -> bytes:
    """The photo, the true classes, and the found ones with the true outlines in white."""
    true = _mixed(photo, truth.labels, [COLOURS[name] for name in LABELS])
    labels = labels_in_photo(document, truth.labels.shape)
    found = _mixed(photo, labels, [COLOURS[name] for name in document.classes])
    for element in truth.elements:
        outline = np.rint((element.quad_px - 0.5) * 2**_FRACTION_BITS).astype(np.int32)
        for picture in (true, found):
            cv2.polylines(
                picture, [outline], True, (255, 255, 255), 1, cv2.LINE_AA, shift=_FRACTION_BITS
            )
    gap = np.full((photo.shape[0], _GAP_PX, 3), 255, np.uint8)
    return png_bytes(np.hstack([photo, gap, true, gap, found]), optimize=True)


def _mixed(
    photo: NDArray[np.uint8], labels: NDArray[np.uint8], colours: list[tuple[int, int, int]]
) -> NDArray[np.uint8]:
    """The photo under transparent class colours; black where there is no label."""
    palette = np.zeros((256, 3), np.float32)
    palette[: len(colours)] = colours
    mixed = 0.4 * photo.astype(np.float32) + 0.6 * palette[labels]
    return np.ascontiguousarray(np.rint(mixed).astype(np.uint8))
