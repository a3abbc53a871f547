"""Hollow walls by their colour, on sheets that CAD programs draw in layers."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.plan.walls.layers import colour_layers, hollow_walls, walls_of_a_colour

Image = NDArray[np.uint8]
GREEN, BLUE, RED, GREY = (0, 150, 0), (20, 20, 220), (220, 0, 0), (120, 120, 120)
LINE = 2.0
WALL = 12


def _frame(image: Image, left: int, top: int, right: int, bottom: int) -> None:
    """A hollow wall of 12 px of paper and two lines of 2 px around a box, and its inside."""
    for grow in (0, WALL + 2):
        corners = (left - grow, top - grow), (right + grow, bottom + grow)
        cv2.rectangle(image, *corners, GREEN, 1)
        inner = (left - grow + 1, top - grow + 1), (right + grow - 1, bottom + grow - 1)
        cv2.rectangle(image, *inner, GREEN, 1)


def _sheet() -> tuple[Image, NDArray[np.bool_]]:
    """Two rooms whose walls have grey axes inside, furniture, tiles and a covered face; the walls.

    Nothing parts the walls' insides from the axes, and a red line lies on a stretch of a face.
    """
    image = np.full((600, 1000, 3), 255, np.uint8)
    _frame(image, 60, 60, 440, 540)
    _frame(image, 520, 60, 940, 540)
    walls = np.zeros((600, 1000), np.bool_)
    for left, right in ((60, 440), (520, 940)):
        walls[60 - WALL - 2 : 540 + WALL + 3, left - WALL - 2 : right + WALL + 3] = True
        walls[62:539, left + 2 : right - 1] = False
    for y in (53, 547):
        for x in range(20, 980, 40):
            cv2.line(image, (x, y), (x + 25, y), GREY, 2)
    for x, y in ((100, 120), (300, 400), (600, 120), (800, 420)):
        for step in range(5):
            cv2.rectangle(image, (x + 8 * step, y), (x + 8 * step + 4, y + 70), RED, 2)
        cv2.rectangle(image, (x, y - 30), (x + 90, y - 10), BLUE, 2)
    for x in range(560, 700, 12):
        cv2.line(image, (x, 300), (x, 400), BLUE, 2)
    cv2.line(image, (150, 60), (190, 60), RED, 2)
    return image, walls


def test_layers_are_the_lines_of_each_colour() -> None:
    image, _ = _sheet()
    ink = image.min(axis=2) < 180
    layers = colour_layers(image, ink)
    assert len(layers) == 4
    for colour in (GREEN, BLUE, RED, GREY):
        own = (image == np.array(colour, np.uint8)).all(axis=2)
        assert any((layer == own).all() for layer in layers)


def test_walls_of_a_colour_are_those_that_were_drawn() -> None:
    image, walls = _sheet()
    found = walls_of_a_colour(image, image.min(axis=2) < 180, LINE)
    assert found is not None
    assert (found & walls).sum() / (found | walls).sum() > 0.97


def test_chains_of_dimensions_are_no_walls() -> None:
    image, walls = _sheet()
    whole = np.full((760, 1160, 3), 255, np.uint8)
    whole[80:680, 80:1080] = image
    for step in (0, 14, 60, 74):
        cv2.line(whole, (40, 4 + step), (1130, 4 + step), (0, 180, 220), 2)
        cv2.line(whole, (40, 756 - step), (1130, 756 - step), (0, 180, 220), 2)
    found = walls_of_a_colour(whole, whole.min(axis=2) < 180, LINE)
    assert found is not None
    assert not found[:80].any()
    assert (found[80:680, 80:1080] & walls).sum() > 0.97 * walls.sum()
    chains = whole.copy()
    chains[(whole == np.array(GREEN, np.uint8)).all(axis=2)] = 255
    cv2.rectangle(chains, (140, 140), (1020, 620), GREEN, 2)
    assert walls_of_a_colour(chains, chains.min(axis=2) < 180, LINE) is None


def test_a_sheet_of_three_colours_has_no_layers() -> None:
    image, _ = _sheet()
    image[(image == np.array(BLUE, np.uint8)).all(axis=2)] = RED
    assert walls_of_a_colour(image, image.min(axis=2) < 180, LINE) is None


def test_colours_without_hollow_walls_are_no_walls() -> None:
    image, _ = _sheet()
    image[(image == np.array(GREEN, np.uint8)).all(axis=2)] = 255
    cv2.rectangle(image, (60, 60), (940, 540), GREEN, 2)
    assert walls_of_a_colour(image, image.min(axis=2) < 180, LINE) is None


@pytest.mark.parametrize("breadth", [7, 14, 30])
def test_a_wall_whose_ends_are_not_drawn_is_filled_between_its_faces(breadth: int) -> None:
    lines = np.zeros((300, 700), np.bool_)
    lines[100:102, 50:650] = lines[102 + breadth : 104 + breadth, 50:650] = True
    found = hollow_walls(lines, LINE, 60.0)
    assert found.length_px == pytest.approx(600, rel=0.02)
    assert found.mask[102 : 102 + breadth, 50:650].all()
    assert found.mask.sum() == pytest.approx(600 * (breadth + 4), rel=0.02)
