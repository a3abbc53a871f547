"""`before.png`: what stands before the front, beside the document that a person may edit."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from veduta.facade.cleared.kinds import KINDS
from veduta.imaging.encode import png_bytes
from veduta.run.errors import InputError

BEFORE = "before.png"
BEFORE_COLOURS = (
    (0, 0, 0),
    (150, 92, 190),
    (60, 140, 60),
    (120, 180, 60),
    (210, 60, 60),
    (240, 150, 40),
    (60, 120, 210),
    (230, 220, 60),
)
"""sRGB of each of `KINDS`."""


def before_png(kinds: NDArray[np.uint8]) -> bytes:
    """(h, w) places in `KINDS` as an 8-bit palette PNG whose index is the place."""
    image = Image.fromarray(kinds)
    image.putpalette([part for colour in BEFORE_COLOURS for part in colour])
    return png_bytes(image, optimize=True)


def load_before(document_path: Path, size_px: tuple[int, int]) -> NDArray[np.uint8]:
    """(h, w) places in `KINDS` of the file beside a document; nothing where there is no such file.

    size_px: width and height of the rectified photo. InputError where the file is no such picture.
    """
    path = document_path.with_name(BEFORE)
    if not path.is_file():
        return np.zeros(size_px[::-1], dtype=np.uint8)
    remedy = (
        f"Mend it, or remove it: then nothing but balconies is taken out of {document_path.name}."
    )
    try:
        with Image.open(path, formats=["PNG"]) as image:
            if image.size != size_px:
                fault = f"is {image.width} x {image.height} px"
                fault += f", the photo {size_px[0]} x {size_px[1]} px"
                raise InputError(path, fault, remedy)
            if image.mode not in ("P", "L"):
                raise InputError(path, "has colours and no classes", remedy)
            kinds = np.asarray(image, dtype=np.uint8)
    except (UnidentifiedImageError, OSError) as error:
        raise InputError(path, f"cannot be read as PNG ({error})", remedy) from error
    if kinds.max(initial=0) >= len(KINDS):
        fault = f"has the class {int(kinds.max())}, and there are {len(KINDS)}, from 0"
        raise InputError(path, fault, remedy)
    return kinds
