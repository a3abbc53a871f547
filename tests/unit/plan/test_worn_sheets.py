"""Grain, specks, creases and stains are taken out of a sheet; what was drawn stays."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.clean import ink as inks
from veduta.plan.clean.denoise import denoised, noise_of

Pixels = NDArray[np.uint8]


def drawing(grey: int = 0) -> Pixels:
    """Walls 12 px thick, lines of 2 px, a window filled with grey, and dots 3 px wide in a wall."""
    sheet = np.full((400, 600, 3), 255, np.uint8)
    cv2.rectangle(sheet, (40, 40), (560, 360), (grey,) * 3, 12)
    cv2.line(sheet, (300, 46), (300, 354), (grey,) * 3, 12)
    cv2.rectangle(sheet, (80, 80), (200, 160), (grey,) * 3, 2)
    cv2.rectangle(sheet, (120, 34), (220, 46), (170,) * 3, -1)
    cv2.rectangle(sheet, (120, 34), (220, 46), (grey,) * 3, 1)
    return sheet


def drawn(pixels: Pixels) -> NDArray[np.bool_]:
    ink = inks.ink_of(inks.darkness(pixels))
    return inks.marks(inks.without_shades(ink, inks.marks(ink)))


def misjudged(pixels: Pixels, grey: int = 0) -> float:
    """The share of the sheet that is ink and should be paper, or the other way round."""
    return float((drawn(pixels) != drawn(drawing(grey))).mean())


@pytest.mark.parametrize("sigma", [18.0, 25.0])
def test_grain_goes_and_lines_stay(sigma: float) -> None:
    rng = np.random.default_rng(1)
    grainy = np.clip(drawing() + rng.normal(0.0, sigma, (400, 600, 3)), 0, 255).astype(np.uint8)
    assert noise_of(denoised(grainy)) < 0.2 * noise_of(grainy)
    assert misjudged(denoised(grainy)) < 0.002


def test_a_faded_print_is_cleaned_by_its_own_contrast() -> None:
    rng = np.random.default_rng(2)
    faded = 130.0 + drawing() / 255.0 * 75.0 + rng.normal(0.0, 6.0, (400, 600, 1))
    assert misjudged(denoised(np.clip(faded, 0, 255).astype(np.uint8))) < 0.01


def test_a_clean_sheet_stays_as_it_is() -> None:
    sheet = drawing()
    assert denoised(sheet) is sheet
    ink = inks.ink_of(inks.darkness(sheet))
    assert inks.without_shades(ink, inks.marks(ink)) is ink


def test_specks_go() -> None:
    speckled, where = drawing(), np.random.default_rng(3).random((400, 600))
    speckled[where < 0.01], speckled[where > 0.99] = 0, 255
    assert (denoised(speckled) != drawing()).any(axis=2).mean() < 0.004


def test_dots_in_walls_are_drawn() -> None:
    """Stippled concrete: as many specks, but at few places of the sheet."""
    dotted = drawing(200)
    dotted[36:44:3, 60:540:3] = 0
    dotted[60:340:3, 296:304:3] = 0
    assert denoised(dotted) is dotted


@pytest.mark.parametrize("at", [150, 420])
def test_the_shade_of_a_crease_is_no_ink(at: int) -> None:
    across = np.exp(-(((np.arange(600) - at) / 12.0) ** 2))
    creased = drawing() * (1.0 - 0.3 * across)[None, :, None]
    assert misjudged(creased.astype(np.uint8)) < 0.002


def test_pale_strokes_out_of_focus_are_ink() -> None:
    """A pale line as blurred as the walls around it."""
    sheet = drawing()
    cv2.line(sheet, (330, 200), (540, 200), (170,) * 3, 6)
    sheet = cv2.GaussianBlur(sheet, (0, 0), 2.0)
    assert drawn(sheet)[200, 350:520].all()
