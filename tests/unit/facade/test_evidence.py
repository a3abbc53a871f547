"""Colours, gradients and profiles against scikit-image, scipy and plain loops."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from scipy import ndimage

from veduta.facade.evidence import LONG_EDGE_PX, blur, blur_line, gather, two_class_threshold


def _whole(pixels: NDArray[np.uint8]) -> NDArray[np.bool_]:
    return np.ones(pixels.shape[:2], bool)


def _lab(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """CIE Lab of sRGB under D65, written out from the standards (IEC 61966-2-1, CIE 15)."""
    srgb = pixels / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    to_xyz = np.array(
        [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    )
    xyz = linear @ to_xyz.T / [0.9505, 1.0, 1.089]
    cube = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz * (29 / 6) ** 2 / 3 + 4 / 29)
    x, y, z = np.moveaxis(cube, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def test_lab_is_that_of_the_standard() -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (40, 50, 3)).astype(np.uint8)
    evidence = gather(pixels, _whole(pixels))
    true = _lab(pixels)
    assert evidence.px_per_rectified == 1.0
    assert np.abs(evidence.lab[:, :, 0] * 100 / 255 - true[:, :, 0]).max() < 1.5
    assert np.abs(evidence.lab[:, :, 1:] - 128 - true[:, :, 1:]).max() < 3.0


def test_gradients_of_a_ramp() -> None:
    """Lightness that grows by a constant per pixel has that constant for a derivative."""
    rows, columns = np.mgrid[0:60, 0:80]
    grey = (40 + 1.5 * columns + 0.5 * rows).astype(np.uint8)
    pixels = np.repeat(grey[:, :, None], 3, axis=2)
    evidence = gather(pixels, _whole(pixels))
    for found, axis in ((evidence.gx, 1), (evidence.gy, 0)):
        true = np.gradient(ndimage.gaussian_filter(evidence.lab[:, :, 0], 0.8), axis=axis)
        inner = np.s_[6:-6, 6:-6]
        assert np.mean(found[inner]) == pytest.approx(float(np.mean(true[inner])), rel=0.02)
    assert np.mean(evidence.gx[6:-6, 6:-6]) > 2 * np.mean(evidence.gy[6:-6, 6:-6]) > 0


def test_large_images_are_brought_to_analysis_resolution() -> None:
    pixels = np.zeros((1800, 900, 3), np.uint8)
    pixels[:, 450:] = 255
    valid = _whole(pixels)
    valid[:600] = False
    evidence = gather(pixels, valid)
    assert (evidence.height, evidence.width) == (LONG_EDGE_PX, LONG_EDGE_PX // 2)
    assert evidence.px_per_rectified == pytest.approx(LONG_EDGE_PX / 1800)
    assert evidence.valid.sum() == pytest.approx(2 / 3 * evidence.valid.size, rel=0.01)
    peak = np.abs(evidence.gx[400]).argmax()
    assert abs(int(peak) - LONG_EDGE_PX // 4) <= 1


def test_the_border_of_the_photo_is_no_edge() -> None:
    pixels = np.full((100, 100, 3), 200, np.uint8)
    pixels[:, :30] = 0
    valid = _whole(pixels)
    valid[:, :30] = False
    edge = np.abs(gather(pixels, _whole(pixels)).gx).max()
    left = np.abs(gather(pixels, valid).gx).max()
    assert edge > 20
    assert left < 0.05 * edge, "only the tail of the blur"


@given(
    arrays(np.float32, (20, 24), elements=st.floats(-50, 50, width=32)),
    st.floats(0.6, 2.0),
    st.floats(0.6, 2.0),
)
def test_blur_is_gaussian(values: NDArray[np.float32], x: float, y: float) -> None:
    true = ndimage.gaussian_filter(values.astype(np.float64), (y, x), mode="mirror", truncate=6)
    assert np.abs(blur(values, x, y) - true).max() < 0.3


def test_a_spread_of_zero_leaves_an_axis_alone() -> None:
    values = np.random.default_rng(0).normal(0, 1, (9, 9)).astype(np.float32)
    assert np.allclose(blur(values, 0.0, 0.0), values, atol=1e-6)
    line = blur_line(values[0], 1.5)
    alone = blur(values, 1.5, 0.0)[0]
    assert np.allclose(line, alone, atol=1e-5)


@given(arrays(np.float64, st.integers(8, 80), elements=st.integers(0, 640).map(lambda v: v / 10)))
def test_threshold_parts_best(values: NDArray[np.float64]) -> None:
    """No bin centre has a greater variance between the two classes than the one found."""
    counts, edges = np.histogram(values, 64)
    centres = (edges[1:] + edges[:-1]) / 2

    def between(threshold: float) -> float:
        low = centres <= threshold
        if not counts[low].sum() or not counts[~low].sum():
            return 0.0
        means = [np.average(centres[part], weights=counts[part]) for part in (low, ~low)]
        weights = [counts[part].sum() for part in (low, ~low)]
        return float(weights[0] * weights[1] * (means[0] - means[1]) ** 2)

    found = two_class_threshold(values)
    assert between(found) == pytest.approx(max(map(between, centres)), rel=1e-6, abs=1e-9)
