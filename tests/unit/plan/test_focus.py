"""Blur of scans: measured on sheets of known blur, and taken back towards the sharp sheet."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.clean.focus import MANY_PX, blur_of, focused


def sheet(side_px: int = 400) -> NDArray[np.uint8]:
    """Walls of 9 px round four rooms, with a line beside one of them."""
    pixels = np.full((side_px, side_px, 3), 250, np.uint8)
    ends = np.linspace(40, side_px - 49, 3).astype(int)
    for at in ends:
        pixels[at : at + 9, ends[0] : ends[-1] + 9] = 10
        pixels[ends[0] : ends[-1] + 9, at : at + 9] = 10
    pixels[ends[0] + 12 : ends[0] + 13, 80:150] = 10
    return pixels


def blurred(pixels: NDArray[np.uint8], sigma_px: float) -> NDArray[np.uint8]:
    return np.asarray(cv2.GaussianBlur(pixels, (0, 0), sigma_px), np.uint8)


@pytest.mark.parametrize("sigma_px", [0.9, 1.3, 1.8])
def test_blur_is_measured(sigma_px: float) -> None:
    assert blur_of(blurred(sheet(), sigma_px)) == pytest.approx(sigma_px, abs=0.15)


def test_sharp_sheets_stay() -> None:
    pixels = sheet()
    assert blur_of(pixels) < 0.1
    assert focused(pixels, 0.5) is pixels


def test_nothing_is_known_of_a_blank_sheet() -> None:
    assert blur_of(np.full((300, 300, 3), 240, np.uint8)) == 0.0


def test_large_sheets_stay() -> None:
    large = np.zeros((MANY_PX, MANY_PX, 3), np.uint8)
    assert focused(large, 0.5) is large


@pytest.mark.parametrize("sigma_px", [1.2, 1.8])
def test_blur_is_taken_back(sigma_px: float) -> None:
    """What is left is nearer to a sheet of the blur that is asked for, and to the sharp one."""
    pixels = sheet()
    seen = blurred(pixels, sigma_px)
    sharp = focused(seen, 0.5).astype(float)
    for target, part in ((pixels, 0.7), (blurred(pixels, 0.5), 0.6)):
        assert np.abs(sharp - target).mean() < part * np.abs(seen.astype(float) - target).mean()
    # The paper between the wall and the line beside it is lighter, and the line darker.
    beside, line = 50, 52
    assert sharp[beside, 100, 0] > seen[beside, 100, 0] + 15
    assert sharp[line, 100, 0] < seen[line, 100, 0] - 10


def test_more_is_not_taken_back_than_is_asked_for() -> None:
    seen = blurred(sheet(), 1.3)
    assert focused(seen, 1.4) is seen
    assert blur_of(focused(seen, 1.0)) == pytest.approx(1.0, abs=0.2)
