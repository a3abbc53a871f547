"""Photos without distortion: against OpenCV, and against the rays of the lens."""

from __future__ import annotations

import cv2
import numpy as np
import pycolmap
from photo_scene import ARC, FOCAL_PX, HEIGHT_PX, WIDTH_PX, take_photo

from veduta.photos import pictures
from veduta.photos.pictures import undistorted

K1, K2, P1, P2 = -0.15, 0.05, 0.002, -0.003


def test_as_opencv_does_it() -> None:
    pixels = take_photo(ARC[0])
    camera = pycolmap.Camera(
        model="OPENCV",
        width=WIDTH_PX,
        height=HEIGHT_PX,
        params=[FOCAL_PX, FOCAL_PX + 6, 230.0, 190.0, K1, K2, P1, P2],
    )
    picture, pinhole = undistorted(pixels, camera)
    matrix = np.array([[FOCAL_PX, 0, 229.5], [0, FOCAL_PX + 6, 189.5], [0, 0, 1]])
    wanted = cv2.undistort(pixels, matrix, np.array([K1, K2, P1, P2]))
    apart = np.abs(picture.astype(int) - wanted.astype(int))
    assert float(apart.mean()) < 0.4
    assert pinhole.centre_px == (230.0, 190.0)
    assert pinhole.focal_px == (FOCAL_PX, FOCAL_PX + 6)


def test_a_lens_without_distortion_leaves_the_photo() -> None:
    pixels = take_photo(ARC[1])
    params = [FOCAL_PX, FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2]
    camera = pycolmap.Camera(model="PINHOLE", width=WIDTH_PX, height=HEIGHT_PX, params=params)
    picture, _ = undistorted(pixels, camera)
    assert np.abs(picture.astype(int) - pixels.astype(int)).max() <= 1


def test_a_large_photo_is_made_smaller(monkeypatch: object) -> None:
    pixels = take_photo(ARC[2])
    params = [FOCAL_PX, FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2]
    camera = pycolmap.Camera(model="PINHOLE", width=WIDTH_PX, height=HEIGHT_PX, params=params)
    monkeypatch.setattr(pictures, "LONGEST_PX", WIDTH_PX // 2)  # type: ignore[attr-defined]
    picture, pinhole = undistorted(pixels, camera)
    assert picture.shape == (HEIGHT_PX // 2, WIDTH_PX // 2, 3)
    assert pinhole.focal_px == (FOCAL_PX / 2, FOCAL_PX / 2)
    wanted = cv2.resize(pixels, (WIDTH_PX // 2, HEIGHT_PX // 2), interpolation=cv2.INTER_AREA)
    assert float(np.abs(picture.astype(int) - wanted.astype(int)).mean()) < 6
