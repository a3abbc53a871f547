"""The recipe of the package: a scan, set right by its text, and the text on it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean.coloured import on_white
from veduta.plan.clean.denoise import denoised
from veduta.plan.clean.focus import focused
from veduta.plan.document import Sheet, Text
from veduta.plan.text.orientation import Position, find_position, right_from_scan, set_right
from veduta.plan.text.reading import read_texts
from veduta.plan.text.regions import find_overview
from veduta.plan.text.strips import in_colour

LEFT_PX = 1.1
"""Of a text out of focus so much blur is left: with less, marks of feet and inches are lost."""


@dataclass(frozen=True)
class SheetText:
    """A scan set right: `pixels` (h, w, 3), `right_from_scan` (3, 3) takes the scan's pixels there.

    `texts` are in `pixels`. `position` says how the scan lay.
    """

    pixels: NDArray[np.uint8]
    right_from_scan: NDArray[np.float64]
    position: Position
    texts: list[Text]


def read_sheet(scan: NDArray[np.uint8]) -> SheetText:
    """Read a scan (h, w, 3) or (h, w) that may lie on its side, on its head, or be mirrored."""
    scan = denoised(in_colour(scan))
    sharp = on_white(focused(scan, LEFT_PX))
    overview = find_overview(sharp)
    position = find_position(sharp, overview)
    pixels = set_right(scan, position)
    legible = pixels if sharp is scan else set_right(sharp, position)
    # Of a scan that lay wrong more text is found when it is right.
    texts = read_texts(legible, overview if position.is_upright else None)
    size = (scan.shape[1], scan.shape[0])
    return SheetText(pixels, right_from_scan(position, size), position, texts)


def sheet_of_file(sheet: Sheet, read: SheetText) -> Sheet:
    """The sheet with the way from the file's own pixels; it had that from `read.pixels`.

    The scan was turned by quarters, mirrored, then laid straight. What is turned after a mirror is
    turned the other way before it, so that both turns are one.
    """
    matrix = np.array(sheet.clean_from_scan) @ read.right_from_scan
    straight = -sheet.rotation_rad if read.position.mirrored else sheet.rotation_rad
    turned = straight + read.position.quarter_turns * math.pi / 2.0
    return sheet.model_copy(
        update={
            "clean_from_scan": matrix.tolist(),
            "mirrored": read.position.mirrored,
            "rotation_rad": math.remainder(turned, 2.0 * math.pi),
        }
    )


def moved_texts(texts: Sequence[Text], target_from_source: NDArray[np.float64]) -> list[Text]:
    """Texts in another frame of pixels, by an affine (3, 3)."""
    linear, shift = target_from_source[:2, :2], target_from_source[:2, 2]
    return [
        text.model_copy(
            update={
                "box_px": [
                    (float(x), float(y)) for x, y in np.array(text.box_px) @ linear.T + shift
                ]
            }
        )
        for text in texts
    ]
