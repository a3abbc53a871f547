"""Runs, bands and widths of strokes against brute force and what was drawn."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from veduta.plan.clean.ink import line_width
from veduta.plan.walls.pieces import straight_pieces
from veduta.plan.walls.runs import run_lengths, run_lengths_down
from veduta.plan.walls.tracks import find_tracks

masks = arrays.arrays(np.bool_, st.tuples(st.integers(1, 9), st.integers(1, 9)))


@given(masks)
def test_runs_are_those_of_counting(mask: np.ndarray) -> None:
    expected = np.zeros(mask.shape, int)
    for y, row in enumerate(mask):
        for x, value in enumerate(row):
            if value:
                first, last = x, x
                while first > 0 and row[first - 1]:
                    first -= 1
                while last + 1 < len(row) and row[last + 1]:
                    last += 1
                expected[y, x] = last - first + 1
    assert (run_lengths(mask) == expected).all()
    assert (run_lengths_down(mask.T.copy()) == expected.T).all()


@pytest.mark.parametrize("degrees", [0, 12, 35, 70, 90])
def test_a_bar_is_one_piece_of_its_direction_and_thickness(degrees: float) -> None:
    image = np.zeros((500, 500), np.uint8)
    run = 180 * np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    normal = 10 * np.array([-run[1], run[0]]) / 180
    corners = [250 - run + normal, 250 + run + normal, 250 + run - normal, 250 - run - normal]
    cv2.fillPoly(image, [np.round(corners).astype(np.int32)], 1)
    pieces = straight_pieces(find_tracks(image.astype(bool)), least_px=10)
    longest = max(pieces, key=lambda one: one.length_px)
    assert abs(longest.direction @ run) / 180 == pytest.approx(1, abs=1e-3)
    # OpenCV fills the outline, too: one pixel more.
    assert longest.thickness_px == pytest.approx(21, abs=1.0)
    assert longest.length_px == pytest.approx(360, abs=45)


@pytest.mark.parametrize("width", [1, 2, 4])
def test_lines_are_as_wide_as_drawn_beside_thick_walls(width: int) -> None:
    mask = np.zeros((400, 400), np.bool_)
    mask[50:70, 20:380] = True
    for row in range(100, 380, 20):
        mask[row : row + width, 30:350] = True
    assert line_width(mask) == pytest.approx(width, abs=0.5)
