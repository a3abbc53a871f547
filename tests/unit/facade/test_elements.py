"""Single elements of fronts: each step against a closed form or brute force, on drawn pictures."""

from __future__ import annotations

from itertools import product

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.casements import casements
from veduta.facade.elements.balconies import BalconyParameters, find_balconies, texture_energy
from veduta.facade.elements.boosted import Boosted, SearchedSizes, detector, found_by, stump_values
from veduta.facade.elements.cornices import find_cornices, seen_bands
from veduta.facade.elements.grid_energy import EnergyParameters, aligned, grid_energy
from veduta.facade.elements.texture_error import TextureParameters, blobs, texture_error
from veduta.facade.elements.two_colours import two_colours
from veduta.facade.elements.windows import WindowParameters, find_windows
from veduta.facade.eyes import Seen, SeenElement


def grid(rows: int = 4, columns: int = 5) -> NDArray[np.float64]:
    x, y = np.meshgrid(50.0 + 100.0 * np.arange(columns), 60.0 + 120.0 * np.arange(rows))
    return np.column_stack([x.ravel(), y.ravel(), x.ravel() + 40.0, y.ravel() + 76.0])


def overlap(one: NDArray[np.float64], other: NDArray[np.float64]) -> float:
    low, high = np.maximum(one[:2], other[:2]), np.minimum(one[2:], other[2:])
    shared = np.clip(high - low, 0.0, None).prod()
    union = (one[2:] - one[:2]).prod() + (other[2:] - other[:2]).prod() - shared
    return float(shared / union)


def test_texture_error_is_that_of_least_squares_in_each_window() -> None:
    rng = np.random.default_rng(0)
    grey = rng.integers(0, 256, (30, 32)).astype(np.uint8)
    own = TextureParameters()
    values = grey.astype(np.float64)
    half = own.reach_px // 2
    mean = np.array(
        [
            [values[y - half : y + half + 1, x - half : x + half + 1].mean() for x in range(8, 18)]
            for y in range(8, 16)
        ]
    )
    centred = values - cv2.blur(values, (7, 7), borderType=cv2.BORDER_REFLECT)
    np.testing.assert_allclose(values[8:16, 8:18] - mean, centred[8:16, 8:18])
    squared = np.zeros(grey.shape)
    for y, x, (down, right) in product(range(6, 22), range(6, 22), ((0, 1), (1, 0))):
        rows, columns = np.mgrid[y - half : y + half + 1, x - half : x + half + 1]
        both = [(step * down, step * right) for step in own.steps_px]
        pairs = np.stack(
            [
                (centred[rows - dy, columns - dx] + centred[rows + dy, columns + dx]).ravel()
                for dy, dx in both
            ],
            axis=1,
        )
        moments = pairs.T @ pairs + own.ridge * 49.0 * np.eye(2)
        factors = np.linalg.solve(moments, pairs.T @ centred[rows, columns].ravel())
        squared[y, x] += (centred[y, x] - factors @ pairs[24]) ** 2
    expected = np.sqrt(squared[9 - half : 9 + half + 1, 10 - half : 10 + half + 1].mean())
    assert texture_error(grey, own)[9, 10] == pytest.approx(expected, rel=1e-6)


def test_texture_error_is_low_within_and_high_between_materials() -> None:
    rng = np.random.default_rng(1)
    grey = np.full((60, 80), 90.0)
    grey[:, 40:] = 180.0
    error = texture_error((grey + rng.normal(0, 2, grey.shape)).astype(np.uint8))
    assert error[10:50, 37:43].mean() > 3.0 * error[10:50, 10:30].mean()


def test_blobs_are_the_product_of_rows_and_columns() -> None:
    strength = np.random.default_rng(2).random((6, 9))
    product = np.outer(strength.mean(axis=1), strength.mean(axis=0))
    expected = (product - product.min()) / (product.max() - product.min())
    np.testing.assert_allclose(blobs(strength), expected)


def test_the_energy_is_highest_in_line_and_descent_brings_boxes_there() -> None:
    own = EnergyParameters(aspect=1.9)
    boxes = grid()
    best = grid_energy(boxes, own)
    assert best == pytest.approx(3.0 * len(boxes), rel=1e-3)
    moved = boxes + np.random.default_rng(3).normal(0.0, 5.0, boxes.shape)
    assert grid_energy(moved, own) < 0.9 * best
    back = aligned(moved, own)
    assert grid_energy(back, own) > grid_energy(moved, own)
    np.testing.assert_allclose(back[:5, 1], back[0, 1], atol=0.5)
    assert grid_energy(boxes[:1], own) == pytest.approx(1.0, rel=1e-3)


def drawn_grid() -> NDArray[np.uint8]:
    pixels = np.full((620, 560, 3), (214, 196, 160), np.uint8)
    noise = np.random.default_rng(4).normal(0.0, 3.0, pixels.shape)
    for x0, y0, x1, y1 in grid().astype(int).tolist():
        cv2.rectangle(pixels, (x0, y0), (x1 - 1, y1 - 1), (52, 60, 72), -1)
    return np.asarray(np.clip(pixels + noise, 0, 255), np.uint8)


def test_windows_of_a_drawn_grid_are_found() -> None:
    found = find_windows(drawn_grid())
    assert found.is_grid
    right = [max(overlap(one, true) for one in found.boxes) > 0.5 for true in grid()]
    assert np.mean(right) > 0.85


def test_noise_has_no_grid_of_windows() -> None:
    pixels = np.random.default_rng(5).integers(0, 256, (300, 300, 3)).astype(np.uint8)
    own = WindowParameters(long_px=300)
    noise, grid_of_windows = find_windows(pixels, own), find_windows(drawn_grid())
    assert noise.energy < grid_of_windows.energy - 0.3


def test_a_plain_wall_has_nothing() -> None:
    pixels = np.full((200, 160, 3), 180, np.uint8)
    assert not find_windows(pixels).is_grid
    assert find_balconies(pixels).shape == (0, 4)
    assert find_cornices(pixels, np.zeros((0, 4))).shape == (0, 4)


def test_two_clusters_are_told_apart_by_their_colours() -> None:
    rng = np.random.default_rng(6)
    dark, light = rng.normal(40, 6, (600, 3)), rng.normal(190, 12, (2400, 3))
    found = two_colours(np.concatenate([light, dark]))
    np.testing.assert_allclose(found.means, [[40] * 3, [190] * 3], atol=2.0)
    np.testing.assert_allclose(found.shares, [0.2, 0.8], atol=0.01)
    assert found.chance(np.array([[45.0, 42, 44], [180, 185, 190]]), 0) == pytest.approx([1.0, 0.0])


def test_bars_have_energy_and_their_balcony_a_box() -> None:
    pixels = np.full((600, 400, 3), 200, np.uint8)
    true = np.array([120.0, 300, 280, 330])
    for x in range(120, 280, 4):
        pixels[300:330, x : x + 2] = 30
    # Ornaments: bars alone have energy in one direction.
    for x in range(124, 280, 8):
        cv2.line(pixels, (x - 4, 302), (x + 4, 328), (30, 30, 30), 1)
        cv2.line(pixels, (x + 4, 302), (x - 4, 328), (30, 30, 30), 1)
    pixels[300:302, 120:280] = pixels[328:330, 120:280] = 30
    energy = texture_energy(pixels, BalconyParameters())
    assert energy[310:320, 150:250].mean() > 20.0 * energy[100:200].mean()
    assert max(overlap(one, true) for one in find_balconies(pixels)) > 0.4


def test_a_ledge_across_the_front_is_a_cornice_and_one_across_windows_is_none() -> None:
    pixels = np.full((600, 500, 3), 190, np.uint8)
    pixels[200:212, 10:490] = 90
    found = find_cornices(pixels, np.zeros((0, 4)))
    assert [overlap(one, np.array([10.0, 200, 490, 212])) > 0.6 for one in found].count(True) == 1
    windows = np.array([[20.0, 150, 220, 260], [240, 150, 480, 260]])
    left = find_cornices(pixels, windows)
    assert not any(overlap(one, np.array([10.0, 200, 490, 212])) > 0.5 for one in left)


def boosted() -> Boosted:
    """A detector of bright squares in the dark: the middle less each side of the margin."""
    middle = [3, 3, 9, 9]
    sides = [[0, 0, 12, 2], [0, 10, 12, 12], [0, 0, 2, 12], [10, 0, 12, 12]]
    rectangles = np.array([[middle, side] for side in sides])
    four = np.full(4, 1.0)
    return Boosted(12, 12, 0.5, rectangles, 0.8 * four, four, 2, 1.0, 3.0)


def test_stumps_see_the_same_in_pictures_and_in_windows() -> None:
    own, sizes = boosted(), SearchedSizes(0.05, 0.05)
    pixels = np.full((120, 120, 3), 40, np.uint8)
    pixels[47:53, 27:33] = 220
    boxes, scores = found_by(own, pixels, sizes)
    assert len(boxes) == 1
    assert scores[0] == 4.0
    assert overlap(boxes[0], np.array([27.0, 47, 33, 53])) > 0.6
    patch = pixels[44:56, 24:36, 0][None]
    values = stump_values(own, patch)[0]
    inside, contrast = 220.0, patch.std()
    assert values[0] == pytest.approx((inside - 40.0) / contrast)


def test_elements_of_another_size_than_most_are_left_out() -> None:
    pixels = np.full((200, 200, 3), 40, np.uint8)
    for x in (20, 50, 80, 110, 140):
        pixels[100:106, x : x + 6] = 220
    pixels[150:168, 90:108] = 220
    boxes, _ = found_by(boosted(), pixels, SearchedSizes(0.03, 0.09))
    heights = boxes[:, 3] - boxes[:, 1]
    assert len(boxes) >= 5
    assert heights.max() / heights.min() <= 1.5**2
    assert heights.max() < 18.0


@pytest.mark.parametrize("kind", ["modillion", "console", "door"])
def test_trained_detectors_are_whole(kind: str) -> None:
    own = detector(kind)
    assert len(own.rectangles) == len(own.thresholds) == len(own.weights) > own.first
    assert own.rectangles[..., 2].max() <= own.width
    assert own.rectangles[..., 3].max() <= own.height


def seen_with(name: str, boxes: list[tuple[int, int, int, int]]) -> Seen:
    """A look at a picture of 200 x 100 pixels that calls these boxes so, and all else wall."""
    classes = np.zeros((2, 100, 200), np.float32)
    classes[0] = 1.0
    for x0, y0, x1, y1 in boxes:
        classes[:, y0:y1, x0:x1] = np.array([0.1, 0.9], np.float32)[:, None, None]
    nothing = np.zeros((0, 25, 50), np.float32)
    return Seen(
        ("wall", name), (), classes, nothing, np.zeros((4, 25, 50), np.float32), 1, 1, 200, 100
    )


def test_shutters_beside_a_window_belong_to_it_and_blinds_close_it() -> None:
    seen = seen_with("blind", [(30, 20, 40, 60), (62, 20, 72, 60), (120, 20, 140, 50)])
    windows = [SeenElement("window", x, 20.0, x + 20.0, 60.0, 0.9) for x in (41.0, 120.0, 170.0)]
    open_, closed, bare = casements(seen, windows)
    assert open_.box == pytest.approx((30.0, 20.0, 72.0, 60.0))
    assert (open_.left, open_.right, open_.is_closed) == (True, True, False)
    assert closed.is_closed
    assert closed.blind == pytest.approx(0.75)
    assert bare.box == (170.0, 20.0, 190.0, 60.0)
    assert not bare.left


def test_bands_of_a_class_are_long_parts_of_its_pixels() -> None:
    seen = seen_with("cornice", [(10, 30, 150, 38), (170, 50, 178, 70)])
    np.testing.assert_allclose(seen_bands(seen, "cornice"), [[10.0, 30.0, 150.0, 38.0]])
