"""Bounds on real photos: straight edges of a street, and facades under known cameras.

`benchmarks/photos/rectify.py` measures the same on more views and says what each number means.
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.find_plane import plane_of_segments
from veduta.facade.options import RectifyOptions
from veduta.facade.rectify import rectify
from veduta.geometry import homography, polygon, vanishing
from veduta.geometry.vanishing import FacadeView
from veduta.imaging.read import Photo, read_image
from veduta.imaging.segments import detect_segments
from veduta.run.errors import NotFoundError

pytestmark = pytest.mark.regression
LANDSCAPE, PORTRAIT = (1200, 900), (900, 1200)


def _pictures(folder: Path, pattern: str, count: int) -> list[Path]:
    paths = sorted(folder.glob(pattern))
    if len(paths) < count:
        pytest.skip(f"{folder} holds fewer than {count} pictures")
    return paths[:: len(paths) // count][:count]


def _median_deg(directions: NDArray[np.float64]) -> float:
    return float(np.rad2deg(np.median(vanishing.axis_angles(directions))))


def test_street_photos_come_out_straight(veduta_data: Path) -> None:
    before, after = [], []
    for path in _pictures(veduta_data / "facades/street-cc0/images", "*.jpg", 20):
        photo = read_image(path)
        segments = detect_segments(photo.pixels)
        held_out = np.random.default_rng(1).random(len(segments)) < 0.5
        plane = plane_of_segments(segments, held_out, photo, None)
        judged = segments.select(held_out & (segments.lengths() >= 30.0))
        before.append(_median_deg(judged.directions()))
        after.append(_median_deg(judged.mapped(plane.judged_plane_from_image()).directions()))
    straight = int(np.sum(np.array(after) <= 1.0))
    assert straight >= 17  # the bound is 15 of 20
    assert np.sum(np.array(before) <= 1.0) <= 12  # or nothing was measured
    assert 0.2 < float(np.median(after)) < 0.75
    assert max(after) < 1.6


@pytest.mark.parametrize(("folder", "pattern"), [("ecp/images", "*.jpg"), ("cmp", "**/*.jpg")])
def test_facades_under_known_cameras(folder: str, pattern: str, veduta_data: Path) -> None:
    rng = np.random.default_rng(5)
    errors, aspects = [], []
    for path in _pictures(veduta_data / "facades" / folder, pattern, 10):
        source = read_image(path)
        yaw, pitch, roll = (float(np.deg2rad(rng.uniform(-v, v))) for v in (45, 25, 8))
        focal_mm35 = float(rng.uniform(24, 50))
        height, width = source.pixels.shape[:2]
        size = LANDSCAPE if width > height else PORTRAIT
        focal_px = focal_mm35 * float(np.hypot(*size)) / float(np.hypot(36, 24))
        view = FacadeView(yaw, pitch, roll, focal_px, size[0] / 2, size[1] / 2)
        photo, corners = _photographed(source, view, size)
        found = rectify(photo, RectifyOptions(focal_mm35=focal_mm35))
        matrix = np.array(found.record.rectified_from_source)
        error, aspect = _compared(homography.apply(matrix, corners), width, height)
        errors.append(error)
        aspects.append(aspect)
    # Some pictures are themselves off by more than 1 %: see the benchmark.
    assert np.sum(np.array(errors) <= 0.01) >= 7
    assert 0.0005 < float(np.median(errors)) < 0.008
    assert np.sum(np.array(aspects) <= 0.05) >= 9, aspects


def _photographed(
    source: Photo, view: FacadeView, size: tuple[int, int]
) -> tuple[Photo, NDArray[np.float64]]:
    """The picture as a wall in front of noise, and its corners in the photo."""
    height, width = source.pixels.shape[:2]
    distance = 1.3 * view.focal_px * max(width / size[0], height / size[1])
    rotation = view.rotation()
    columns = np.stack([rotation[:, 0], rotation[:, 1], np.array([0.0, 0.0, distance])], axis=1)
    middle = homography.translation(-width / 2, -height / 2)
    matrix = np.asarray(view.camera() @ columns @ middle)
    rng = np.random.default_rng(0)
    noise = cv2.GaussianBlur(rng.normal(0, 1, (size[1], size[0], 3)), (0, 0), 2.0)
    picture = np.clip(128 + 180 * noise, 0, 255).astype(np.uint8)
    half = homography.translation(0.5, 0.5)
    cv2.warpPerspective(
        source.pixels,
        np.linalg.inv(half) @ matrix @ half,
        size,
        dst=picture,
        flags=cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_TRANSPARENT,
    )
    photo = Photo(picture, source.sha256, None, None, source.path)
    return photo, homography.apply(matrix, polygon.rectangle(0, 0, width, height))


def _compared(estimate: NDArray[np.float64], width: int, height: int) -> tuple[float, float]:
    """Corner error after the best shift and scale of x and y (of the width); aspect error."""
    truth = polygon.rectangle(0, 0, width, height)
    e, t = estimate - estimate.mean(axis=0), truth - truth.mean(axis=0)
    each = (e * t).sum(axis=0) / (e * e).sum(axis=0)
    error = float(np.linalg.norm(e * each - t, axis=1).max()) / width
    return error, abs(float(each[0] / each[1]) - 1.0)


def test_rocks_have_no_facade(veduta_data: Path) -> None:
    for path in _pictures(veduta_data / "animals/goat/images", "*.jpg", 4):
        with pytest.raises(NotFoundError):
            rectify(read_image(path), RectifyOptions())
