"""Rectifying walls that the test drew under cameras that it knows."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from drawn_wall import aspect_ratio, corner_error, draw_wall, photo_of, take, view_of
from numpy.typing import NDArray

from veduta.facade.options import RectifyOptions
from veduta.facade.rectify import Rectified, rectify
from veduta.geometry import homography, polygon
from veduta.run.errors import InputError, NotFoundError

SIZE = (1200, 900)
WALL = (720, 750)


def matrix_of(rectified: Rectified) -> NDArray[np.float64]:
    return np.array(rectified.record.rectified_from_source)


def test_rectified_is_left_alone() -> None:
    wall = draw_wall()
    result = rectify(photo_of(wall), RectifyOptions(rectified=True))
    assert np.array_equal(result.pixels, wall)
    assert result.valid.all()
    assert result.record.method == "rectified"
    assert result.record.aspect == "given"
    assert np.array_equal(matrix_of(result), np.eye(3))


def test_the_empty_corners_of_a_rectified_photo_are_not_valid() -> None:
    wall = draw_wall()
    height, width = wall.shape[:2]
    corner = np.array([(0, 0), (width // 3, 0), (0, height // 2)])
    cv2.fillPoly(wall, [corner], (128, 128, 128))
    valid = rectify(photo_of(wall), RectifyOptions(rectified=True)).valid
    outside = cv2.fillPoly(np.zeros((height, width), np.uint8), [corner], (1,)) > 0
    assert not (valid & outside).any()
    assert (~valid & ~outside).sum() < 0.02 * valid.size


def test_a_large_rectified_photo_is_reduced_and_says_so_in_its_homography() -> None:
    result = rectify(photo_of(draw_wall()), RectifyOptions(rectified=True, max_side_px=375))
    assert result.pixels.shape == (375, 360, 3)
    assert np.allclose(matrix_of(result), np.diag([0.5, 0.5, 1.0]))


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize(
    ("yaw", "pitch", "roll", "focal"),
    [
        (0, 0, 0, 0.7),
        (3, 2, 1, 0.8),
        (40, 5, -2, 0.65),
        (-30, 20, 5, 0.9),
        (10, -24, 8, 0.6),
        (0, 15, -14, 1.1),
        (-45, -10, 0, 0.75),
    ],
)
def test_finds_the_wall_under_a_known_camera(
    yaw: float, pitch: float, roll: float, focal: float, known: bool
) -> None:
    view = view_of(yaw, pitch, roll, focal, SIZE)
    picture, view_from_wall = take(draw_wall(seed=3), view, 0.75, SIZE)
    result = rectify(photo_of(picture, view.focal_px if known else None), RectifyOptions())
    assert corner_error(matrix_of(result), view_from_wall, WALL) < 0.01
    assert aspect_ratio(matrix_of(result), view_from_wall, WALL) == pytest.approx(
        1.0, abs=0.02 if known else 0.12
    )
    assert result.record.aspect == ("focal-length" if known else "assumed")
    assert result.record.residual_deg is not None
    assert result.record.residual_deg < 0.5


def test_pixels_land_where_the_homography_says() -> None:
    view = view_of(25, 8, 3, 0.8, SIZE)
    wall = draw_wall(seed=1)
    picture, view_from_wall = take(wall, view, 0.7, SIZE)
    result = rectify(photo_of(picture, view.focal_px), RectifyOptions())
    # Window glass is dark, its frame is light: look both up through the composed homography.
    for column, floor in [(0, 0), (5, 0), (2, 2), (0, 4), (5, 4)]:
        spots = np.array([[50.0, 80.0], [38.0, 80.0]]) + np.array([120 * column, 150 * floor])
        x, y = homography.apply(matrix_of(result) @ view_from_wall, spots).T
        glass, frame = result.pixels[y.astype(int), x.astype(int)].mean(axis=1)
        assert glass < 90
        assert frame > 180


def test_same_input_same_bytes() -> None:
    picture, _ = take(draw_wall(), view_of(20, 10, 2, 0.8, SIZE), 0.7, SIZE)
    first, second = (rectify(photo_of(picture), RectifyOptions()) for _ in range(2))
    assert first.record == second.record
    assert np.array_equal(first.pixels, second.pixels)


def test_outside_the_photo_is_not_valid() -> None:
    picture, _ = take(draw_wall(), view_of(35, 15, 0, 0.7, SIZE), 1.2, SIZE)
    result = rectify(photo_of(picture), RectifyOptions())
    assert 0.4 < result.valid.mean() < 1.0
    assert (result.pixels[~result.valid] == 0).all()
    assert result.pixels[result.valid].mean() > 60


def test_a_horizon_in_the_photo_does_not_blow_up_memory() -> None:
    # A long wall that runs to its vanishing point inside the photo.
    view = view_of(66, 0, 0, 0.55, SIZE)
    wall = draw_wall(columns=40, floors=4)
    picture, _ = take(wall, view, 4.0, SIZE)
    result = rectify(photo_of(picture, view.focal_px), RectifyOptions())
    assert max(result.pixels.shape[:2]) <= 2000
    assert any("stretched" in note for note in result.notes)


def test_the_larger_wall_of_a_corner_building_is_kept() -> None:
    # Left of x = 760 one wall turned to the left, right of it another turned to the right.
    left_view, right_view = (view_of(yaw, 0, 0, 0.75, SIZE) for yaw in (-35, 50))
    left, left_from_wall = take(draw_wall(columns=14, floors=8), left_view, 1.3, SIZE)
    right, _ = take(draw_wall(columns=14, floors=8, seed=5), right_view, 1.3, SIZE)
    picture = left.copy()
    picture[:, 760:] = right[:, 760:]
    result = rectify(photo_of(picture, left_view.focal_px), RectifyOptions())
    assert any("two walls" in note for note in result.notes)
    assert corner_error(matrix_of(result), left_from_wall, (1680, 1200)) < 0.01
    far = homography.apply(matrix_of(result), np.array([[760.0, 450.0], [1150.0, 450.0]]))
    assert far[0, 0] <= result.record.width_px * 1.12
    assert far[1, 0] > result.record.width_px or far[1, 0] < 0


def _meadow() -> NDArray[np.uint8]:
    rng = np.random.default_rng(2)
    image = np.empty((700, 1000, 3), dtype=np.uint8)
    image[:], image[:230] = (110, 160, 60), (150, 190, 230)
    for _ in range(5000):
        x, y, lean = rng.uniform(0, 1000), rng.uniform(240, 700), rng.normal(0, 0.25)
        length = 5 + 60 * (y - 230) / 470 * rng.uniform(0.5, 1.0)
        top = (int(x + length * np.sin(lean)), int(y - length * np.cos(lean)))
        colour = tuple(int(v) for v in np.clip(rng.normal((70, 130, 40), 30), 0, 255))
        cv2.line(image, (int(x), int(y)), top, colour, 1, cv2.LINE_AA)
    return image


def _noise(blur: float) -> NDArray[np.uint8]:
    noise = np.random.default_rng(1).normal(0, 1, (500, 700, 3))
    if blur:
        noise = cv2.GaussianBlur(noise, (0, 0), blur)
    return np.clip(128 + 60 * noise / noise.std(), 0, 255).astype(np.uint8)


@pytest.mark.parametrize(
    "picture",
    [_noise(0), _noise(2), _noise(6), _meadow(), np.full((300, 400, 3), 90, dtype=np.uint8)],
    ids=["noise", "fine noise", "coarse noise", "meadow", "plain"],
)
def test_where_there_is_no_wall_none_is_found(picture: NDArray[np.uint8]) -> None:
    with pytest.raises(NotFoundError) as caught:
        rectify(photo_of(picture), RectifyOptions())
    assert "straight edges" in caught.value.evidence
    assert "--corners" in caught.value.remedy


@pytest.mark.parametrize("size", [(1, 1), (63, 500), (500, 63)])
def test_tiny_photos_are_refused(size: tuple[int, int]) -> None:
    with pytest.raises(InputError, match="64 px"):
        rectify(photo_of(np.zeros((*size, 3), dtype=np.uint8)), RectifyOptions(rectified=True))


# --- corners -----------------------------------------------------------------------------------


def _corners(matrix: NDArray[np.float64]) -> tuple[float, ...]:
    return tuple(homography.apply(matrix, polygon.rectangle(0, 0, *WALL)).ravel().tolist())


def test_corners_with_a_focal_length_give_the_metric_rectangle() -> None:
    view = view_of(38, 18, 4, 0.8, SIZE)
    picture, view_from_wall = take(draw_wall(), view, 0.7, SIZE)
    options = RectifyOptions(corners=_corners(view_from_wall))
    result = rectify(photo_of(picture, view.focal_px), options)
    width, height = result.record.width_px, result.record.height_px
    assert width / height == pytest.approx(WALL[0] / WALL[1], rel=0.01)
    assert result.record.aspect == "focal-length"
    assert result.valid.all()
    expected = cv2.resize(draw_wall(), (width, height), interpolation=cv2.INTER_AREA)
    assert np.abs(expected.astype(int) - result.pixels).mean() < 10


def test_corners_without_a_focal_length_say_that_the_aspect_is_assumed() -> None:
    view = view_of(5, 3, 1, 0.8, SIZE)
    picture, view_from_wall = take(draw_wall(), view, 0.7, SIZE)
    result = rectify(photo_of(picture), RectifyOptions(corners=_corners(view_from_wall)))
    assert result.record.aspect == "assumed"
    assert any("aspect" in note for note in result.notes)
    ratio = result.record.width_px / result.record.height_px
    assert ratio == pytest.approx(WALL[0] / WALL[1], rel=0.03)


@pytest.mark.parametrize(
    ("corners", "fault"),
    [
        ((300, 100, 100, 100, 100, 400, 300, 400), "wrong way"),
        ((300, 100, 300, 400, 100, 400, 100, 100), "upper left"),
        ((100, 100, 300, 400, 300, 100, 100, 400), "convex"),
        ((100, 100, 200, 100, 300, 100, 200, 400), "convex"),
        ((100, 100, 110, 100, 110, 110, 100, 110), "few pixels"),
        ((-9000, 100, 300, 100, 300, 400, 100, 400), "outside"),
        ((float("nan"), 100, 300, 100, 300, 400, 100, 400), "finite"),
    ],
)
def test_bad_corners_are_named(corners: tuple[float, ...], fault: str) -> None:
    with pytest.raises(InputError, match=fault) as caught:
        rectify(photo_of(draw_wall()), RectifyOptions(corners=corners))
    assert "upper left" in caught.value.remedy


def test_corners_and_rectified_exclude_each_other() -> None:
    options = RectifyOptions(rectified=True, corners=(0, 0, 99, 0, 99, 99, 0, 99))
    with pytest.raises(InputError, match="together"):
        rectify(photo_of(draw_wall()), options)
