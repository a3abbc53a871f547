"""The recipe of cleaning: a scan in, a straight sheet with its ink out."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean import ink as inks
from veduta.plan.clean.straighten import laid_straight, skew, work_scale
from veduta.plan.document import Text
from veduta.plan.drawn import Cleaned
from veduta.run.errors import NotFoundError

TextReader = Callable[[NDArray[np.uint8]], Sequence[Text]]
"""Reads the texts of (h, w, 3) pixels."""

LEAST_SIDE_PX = 100
"""A house on fewer pixels has walls of less than one."""

BORDER = 0.03
"""Dark strips along the sheet's edge, up to this share of its side, are the scanner's."""


def clean_sheet(pixels: NDArray[np.uint8], subject: str = "the drawing") -> Cleaned:
    """Lay (h, w, 3) sRGB pixels straight and tell ink from paper.

    Raises NotFoundError where nothing is drawn, or it is too small for a plan.
    """
    height, width = pixels.shape[:2]
    if min(height, width) < LEAST_SIDE_PX:
        raise NotFoundError(
            "a floor plan", f"{subject} is {width} x {height} px", "Scan it at 1000 px a side."
        )
    notes = []
    if inks.is_negative(pixels):
        pixels = 255 - pixels
        notes.append("light lines on a dark sheet: colours inverted")
    rotation = skew(pixels)
    straight, clean_from_scan = laid_straight(pixels, rotation, work_scale(width, height))
    ink = _without_border(inks.ink_of(inks.darkness(straight)))
    mask = inks.marks(ink)
    if mask.mean() < 1e-4:
        raise NotFoundError(
            "a floor plan", f"{subject} is blank", "Give the picture of a drawn plan."
        )
    if rotation:
        notes.append(f"turned by {np.degrees(rotation):.2f} degrees to lie straight")
    return Cleaned(
        pixels=straight,
        ink=ink,
        clean_from_scan=clean_from_scan,
        mirrored=False,
        rotation_rad=rotation,
        line_px=inks.line_width(mask),
        notes=tuple(notes),
    )


def _without_border(ink: NDArray[np.float32]) -> NDArray[np.float32]:
    """Ink without the dark strips that scanners and screenshots leave along the edges."""
    cleared = ink.copy()
    for turn in range(4):
        view = np.rot90(cleared, turn)
        deepest = max(2, round(view.shape[0] * BORDER))
        dark = (view[:deepest] > 0.5).mean(axis=1) > 0.6
        if dark[:2].any():
            # A strip reaches the edge; a wall near it has paper behind it.
            light = np.flatnonzero(~dark[1:])
            view[: int(light[0]) + 4 if len(light) else deepest] = 0
    return cleared
