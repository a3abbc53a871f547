"""Lawns are paper, inner walls in a paler tone are walls, and panes are neither."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from veduta.plan.clean.fields import without_fields
from veduta.plan.clean.sheet import clean_sheet
from veduta.plan.walls.pale import pale_walls
from veduta.plan.walls.solid import Thickness

GREEN, NAVY, GREY = (122, 178, 84), (18, 22, 58), (108, 108, 110)


def sheet() -> np.ndarray:
    """A house with dark outer walls of 14 px on a lawn, a grey inner wall, a thin grey line."""
    pixels = np.full((600, 900, 3), 255, np.uint8)
    cv2.rectangle(pixels, (80, 60), (820, 540), GREEN, -1)
    grain = np.random.default_rng(3).normal(0.0, 20.0, (600, 900, 1))
    lawn = (pixels == np.array(GREEN)).all(axis=2)
    pixels[lawn] = np.clip(pixels + grain, 0, 255).astype(np.uint8)[lawn]
    cv2.rectangle(pixels, (250, 160), (650, 440), NAVY, -1)
    cv2.rectangle(pixels, (264, 174), (636, 426), (255, 255, 255), -1)
    cv2.rectangle(pixels, (440, 174), (446, 426), GREY, -1)
    return pixels


def test_a_lawn_is_painted_white_and_walls_in_it_stay() -> None:
    pixels = sheet()
    cleared = without_fields(pixels)
    assert (cleared[80:140, 100:800] == 255).mean() > 0.99
    assert (cleared[163:171, 260:640] == np.array(NAVY)).all()
    assert (cleared[200:400, 441:445] == np.array(GREY)).all()


def test_plain_sheets_and_sheets_in_the_shade_stay_as_they_are() -> None:
    plain = np.full((400, 400, 3), 255, np.uint8)
    cv2.rectangle(plain, (50, 50), (350, 350), (0, 0, 0), 8)
    assert without_fields(plain) is plain
    shaded = (plain * 0.7).astype(np.uint8)
    assert without_fields(shaded) is shaded


def test_a_shadow_that_ends_softly_is_no_field() -> None:
    pixels = np.full((600, 600, 3), 255.0)
    away = np.hypot(*np.mgrid[-300:300, -300:300])
    pixels -= 130.0 * np.clip((220.0 - away) / 160.0, 0.0, 1.0)[:, :, None]
    shadow = pixels.astype(np.uint8)
    assert np.array_equal(without_fields(shadow), shadow)


def test_grey_walls_around_a_floor_of_a_strong_tint_stay() -> None:
    pixels = np.full((600, 900, 3), 255, np.uint8)
    cv2.rectangle(pixels, (250, 160), (650, 440), GREY, -1)
    cv2.rectangle(pixels, (262, 172), (638, 428), (196, 222, 160), -1)
    cv2.rectangle(pixels, (440, 172), (451, 428), GREY, -1)
    for wall in ((250, 160), (650, 440)), ((262, 172), (638, 428)):
        cv2.rectangle(pixels, *wall, (0, 0, 0), 2)
    cleared = without_fields(pixels)
    assert (cleared[200:400, 300:420] == 255).all()
    assert (cleared[200:400, 443:449] == np.array(GREY)).all()
    assert (cleared[200:400, 254:258] == np.array(GREY)).all()


def thick_house(wall_px: int, tone: tuple[int, int, int], inner_px: int = 15) -> np.ndarray:
    """Three rooms within filled walls, two doors and two windows in black lines, 1000 x 800 px."""
    pixels = np.full((800, 1000, 3), 255, np.uint8)
    white, black, low, high = (255, 255, 255), (0, 0, 0), 60 + wall_px, 740 - wall_px
    cv2.rectangle(pixels, (60, 60), (940, 740), tone, -1)
    cv2.rectangle(pixels, (low, low), (940 - wall_px, high), white, -1)
    cv2.rectangle(pixels, (500, low), (500 + inner_px, high), tone, -1)
    cv2.rectangle(pixels, (500, 400), (940 - wall_px, 400 + inner_px), tone, -1)
    for y in (200, 520):
        cv2.rectangle(pixels, (498, y), (502 + inner_px, y + 80), white, -1)
        cv2.line(pixels, (500, y), (420, y), black, 3)
        cv2.ellipse(pixels, (500, y), (80, 80), 0, 90, 180, black, 2)
    for x in (200, 650):
        cv2.rectangle(pixels, (x, 60), (x + 120, 60 + wall_px), white, -1)
        for y in (60, 60 + wall_px // 2, 60 + wall_px):
            cv2.line(pixels, (x, y), (x + 120, y), black, 2)
    return pixels


THICK = [
    (45, (128, 128, 128)),
    (60, (100, 100, 100)),
    (45, (178, 80, 60)),
    (60, (214, 150, 130)),
]


@pytest.mark.parametrize(("wall_px", "tone"), THICK)
@pytest.mark.parametrize("lines", [False, True])
def test_thick_walls_with_a_fill_are_no_fields(
    wall_px: int, tone: tuple[int, int, int], lines: bool
) -> None:
    pixels = thick_house(wall_px, tone)
    if lines:  # so much black that the fill is far from the darkest
        cv2.rectangle(pixels, (150, 480), (420, 640), (0, 0, 0), -1)
    assert np.array_equal(without_fields(pixels), pixels)


def test_a_lawn_beside_a_house_with_thick_grey_walls_is_painted_white_alone() -> None:
    pixels = np.full((1000, 1000, 3), 255, np.uint8)
    pixels[:800] = thick_house(45, (128, 128, 128))
    cv2.rectangle(pixels, (150, 480), (420, 640), (0, 0, 0), -1)
    cv2.rectangle(pixels, (60, 790), (940, 980), GREEN, -1)
    cleared = without_fields(pixels)
    assert (cleared[800:970, 70:930] == 255).all()
    assert np.array_equal(cleared[:780], pixels[:780])


@pytest.mark.parametrize("wall_px", [45, 60])
def test_a_house_with_thick_grey_walls_keeps_them_as_ink(wall_px: int) -> None:
    tone = {45: 128, 60: 100}[wall_px]
    cleaned = clean_sheet(thick_house(wall_px, (tone, tone, tone)))
    ink = cv2.resize(cleaned.ink, (1000, 800), interpolation=cv2.INTER_AREA)
    assert (ink[300:500, 65 : 55 + wall_px] > 0.5).all()
    assert (ink[745 - wall_px : 735, 70:930] > 0.5).all()


@pytest.mark.parametrize("turns", [True, False])
def test_pale_strokes_are_walls_where_they_go_around_corners(turns: bool) -> None:
    dark = np.zeros((500, 700), np.bool_)
    dark[50:450, 50:650] = True
    dark[64:436, 64:636] = False
    pale = np.zeros_like(dark)
    if turns:
        pale[64:250, 300:308] = pale[250:258, 120:500] = True
        pale[420:436, 300:308] = True  # a stub beside a door
    else:  # panes in an outer wall
        dark[50:64, 200:500] = False
        pale[53:61, 200:500] = True
    found = pale_walls(dark | pale, dark, Thickness(6.0, 14.0))
    assert found.any() == turns
    if turns:
        assert found[100:240, 302:306].all()
        assert found[425:434, 302:306].all()
        assert not (found & ~pale & ~dark).any()
