"""The recipe of cleaning: a scan in, a straight sheet with its ink out."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.clean import ink as inks
from veduta.plan.clean.coloured import with_black_walls
from veduta.plan.clean.denoise import denoised
from veduta.plan.clean.fields import without_fields
from veduta.plan.clean.focus import focused
from veduta.plan.clean.letterhead import without_letterhead
from veduta.plan.clean.straighten import laid_straight, skew, work_scale
from veduta.plan.drawn import Cleaned
from veduta.run.errors import NotFoundError

LEAST_SIDE_PX = 100
"""A house on fewer pixels has walls of less than one."""

BORDER = 0.03
"""Dark strips along the sheet's edge, up to this share of its side, are the scanner's."""

MOST_INK = 0.3
LEAST_PAPER = 0.6
"""A sheet with more ink and less paper, as shares of it, is no drawing. None of ten plans had more
than 0.20 of ink or less than 0.71 of paper; none of 38 photos of streets, animals and facades had
less than 0.35 of what counts as ink, or more than 0.53 of paper."""

PAPER = 0.1
"""What is at most so dark is paper."""

LEFT_PX = 0.5
"""Of a sheet out of focus so much blur is left, as in a good scan: less of it would be noise."""

LEAST_TEXTURE = 6.0
"""Grey levels within 5 x 5 px, at the median: drawings on paper of any colour are plain at most
places (0 to 2 on those plans), photos are not (9 to 66)."""


def clean_sheet(pixels: NDArray[np.uint8], subject: str = "the drawing") -> Cleaned:
    """Lay (h, w, 3) sRGB pixels straight and tell ink from paper.

    Raises NotFoundError where nothing is drawn, where it is a photo, or too small for a plan.
    """
    height, width = pixels.shape[:2]
    if min(height, width) < LEAST_SIDE_PX:
        raise NotFoundError(
            "a floor plan", f"{subject} is {width} x {height} px", "Scan it at 1000 px a side."
        )
    notes = []
    bare = without_letterhead(pixels)
    if bare is not pixels:
        pixels = bare
        notes.append("bands of one colour along edges of the sheet are left out")
    if inks.is_negative(pixels):
        pixels = 255 - pixels
        notes.append("light lines on a dark sheet: colours inverted")
    quiet = denoised(pixels)
    if quiet is not pixels:
        pixels = quiet
        notes.append("grainy: its noise was taken out")
    sharp = focused(pixels, LEFT_PX)
    if sharp is not pixels:
        pixels = sharp
        notes.append("out of focus: its blur was taken back")
    rotation = skew(pixels)
    straight, clean_from_scan = laid_straight(pixels, rotation, work_scale(width, height))
    redrawn = with_black_walls(straight)
    if redrawn is not None:
        notes.append("walls are what is light between floors in flat colours")
    dark = inks.darkness(without_fields(straight) if redrawn is None else redrawn)
    ink = _without_border(inks.ink_of(dark))
    ink = inks.without_shades(ink, inks.marks(ink))
    mask = inks.marks(ink)
    filled = inks.without_pinholes(ink, mask)
    if filled is not ink:
        ink, mask = filled, inks.marks(filled)
    if mask.mean() < 1e-4:
        raise NotFoundError(
            "a floor plan", f"{subject} is blank", "Give the picture of a drawn plan."
        )
    inked, paper = float(mask.mean()), float((dark < PAPER).mean())
    if inked > MOST_INK and paper < LEAST_PAPER and _texture(straight) > LEAST_TEXTURE:
        evidence = f"{subject} is no drawing: {inked:.0%} of it is dark and {paper:.0%} is paper"
        raise NotFoundError("a floor plan", evidence, "Give the picture of a drawn plan.")
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


def _texture(pixels: NDArray[np.uint8]) -> float:
    """The median over the sheet, at 1000 px a side, of the range of greys around a pixel."""
    grey = cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY)
    shrink = min(1.0, 1000.0 / max(grey.shape))
    small = cv2.resize(grey, None, fx=shrink, fy=shrink, interpolation=cv2.INTER_AREA)
    around = np.ones((5, 5), np.uint8)
    return float(np.median(cv2.dilate(small, around) - cv2.erode(small, around)))


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
