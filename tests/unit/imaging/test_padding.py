"""Corners that show no photo, against the homographies that the tests warped with."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.imaging.padding import inside_photo

SIZE = (400, 480)
CORNERS = [(0, 120), (330, 0), (400, 480), (60, 480)]


def _photo(seed: int) -> NDArray[np.uint8]:
    """(480, 400, 3) of blots, as bright as a wall."""
    rng = np.random.default_rng(seed)
    coarse = rng.integers(90, 230, (60, 50, 3)).astype(np.uint8)
    return np.asarray(cv2.resize(coarse, SIZE, interpolation=cv2.INTER_CUBIC), np.uint8)


def _warped(fill: int) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """The photo within `CORNERS` on a ground of one grey, and where it is by its homography."""
    source = np.array([(0, 0), (400, 0), (400, 480), (0, 480)], np.float32)
    matrix = cv2.getPerspectiveTransform(source, np.array(CORNERS, np.float32))
    grey = (fill, fill, fill)
    pixels = cv2.warpPerspective(_photo(1), matrix, SIZE, borderValue=grey)
    inside = cv2.warpPerspective(np.ones(SIZE[::-1], np.uint8), matrix, SIZE) > 0
    return np.asarray(pixels, np.uint8), inside


@pytest.mark.parametrize("fill", [0, 10, 129])
@pytest.mark.parametrize("quality", [70, 95])
def test_filled_corners_are_no_photo(fill: int, quality: int) -> None:
    pixels, inside = _warped(fill)
    coded = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    found = inside_photo(np.asarray(cv2.imdecode(coded, cv2.IMREAD_COLOR), np.uint8))
    deep = cv2.erode((~inside).astype(np.uint8), np.ones((17, 17), np.uint8), borderValue=1) > 0
    assert not (found & deep).any()
    # No more than a seam is lost.
    assert (inside & ~found).sum() < 0.03 * inside.sum()


def test_a_photo_is_photo_up_to_its_corners() -> None:
    assert inside_photo(_photo(2)).all()


def test_a_flat_sky_over_roofs_is_photo() -> None:
    pixels = _photo(3)
    pixels[:100] = 180
    pixels[:160, 150:250] = 180
    assert inside_photo(pixels).all()


def test_a_flat_sky_over_a_level_roof_is_photo() -> None:
    pixels = _photo(3)
    pixels[:100] = 180
    assert inside_photo(pixels).all()


def test_a_sky_that_is_burnt_out_is_photo() -> None:
    pixels, _ = _warped(255)
    assert inside_photo(pixels).all()


def test_one_colour_alone_is_no_corner() -> None:
    assert inside_photo(np.full((64, 64, 3), 90, np.uint8)).all()
