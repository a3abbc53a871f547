"""What is refused as no drawing, and what is not."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from test_reading import two_rooms

from veduta.plan.clean.sheet import clean_sheet
from veduta.run.errors import NotFoundError


def test_a_photo_is_no_drawing() -> None:
    """Leaves and shadows: noise of all sizes, as the spectrum of photos has it."""
    rng = np.random.default_rng(4)
    photo = np.zeros((480, 640, 3))
    for size in (4, 12, 40, 120, 480):
        coarse = rng.normal(size=(size * 3 // 4 + 1, size, 3)).astype(np.float32)
        photo += cv2.resize(coarse, (640, 480), interpolation=cv2.INTER_CUBIC)
    pixels = np.clip(128 + 35 * photo, 0, 255).astype(np.uint8)
    with pytest.raises(NotFoundError, match=r"hall.jpg is no drawing: \d+% of it is dark"):
        clean_sheet(pixels, "hall.jpg")


def test_drawings_on_paper_of_any_colour_are_drawings() -> None:
    """Yellowed, a little noisy, and light lines on blue."""
    noise = np.random.default_rng(5).normal(0, 6, (1000, 1400, 3))
    grainy = np.clip(two_rooms((244, 226, 178), 40) + noise, 0, 255).astype(np.uint8)
    blue = np.where(two_rooms() > 128, (30, 70, 150), (230, 235, 245)).astype(np.uint8)
    for sheet in (two_rooms(), grainy, blue):
        assert clean_sheet(sheet).ink.max() > 0.9


@pytest.mark.parametrize("noise", [0.0, 12.0])
@pytest.mark.parametrize("paper", [(29, 65, 127), (70, 82, 84), (20, 20, 20)])
def test_a_blueprint_has_its_ink_where_its_lines_are(
    paper: tuple[int, int, int], noise: float
) -> None:
    blueprint = np.where(two_rooms() > 128, paper, (230, 235, 245))
    grain = np.random.default_rng(6).normal(0, noise, blueprint.shape)
    found = clean_sheet(np.clip(blueprint + grain, 0, 255).astype(np.uint8))
    usual = clean_sheet(two_rooms())
    assert any("inverted" in note for note in found.notes)
    assert ((found.ink > 0.5) != (usual.ink > 0.5)).mean() < 0.01


def test_dark_lines_on_dark_paper_are_no_blueprint() -> None:
    for paper in ((120, 120, 120), (150, 110, 70)):
        assert not any("inverted" in note for note in clean_sheet(two_rooms(paper, 10)).notes)


def test_a_sheet_out_of_focus_is_made_sharp_and_said_so() -> None:
    sharp = two_rooms()
    blurred = np.asarray(cv2.GaussianBlur(sharp, (0, 0), 1.5), np.uint8)
    assert clean_sheet(sharp).notes == ()
    cleaned = clean_sheet(blurred)
    assert cleaned.notes == ("out of focus: its blur was taken back",)
    # Lines are drawn as broad as before: without that they were broader by half.
    assert cleaned.line_px == pytest.approx(clean_sheet(sharp).line_px, rel=0.2)
