"""Photos without distortion: against OpenCV, and against the rays of the lens."""

from __future__ import annotations

import cv2
import numpy as np
import pycolmap
from photo_scene import ARC, FOCAL_PX, HEIGHT_PX, WIDTH_PX, take_photo

from veduta.photos.straight import pinhole_of, shown_px, straightened

K1, K2, P1, P2 = -0.15, 0.05, 0.002, -0.003


def test_as_opencv_does_it() -> None:
    pixels = take_photo(ARC[0])
    camera = pycolmap.Camera(
        model="OPENCV",
        width=WIDTH_PX,
        height=HEIGHT_PX,
        params=[FOCAL_PX, FOCAL_PX + 6, 230.0, 190.0, K1, K2, P1, P2],
    )
    pinhole = pinhole_of(camera)
    picture = straightened(pixels, camera, pinhole)
    matrix = np.array([[FOCAL_PX, 0, 229.5], [0, FOCAL_PX + 6, 189.5], [0, 0, 1]])
    coefficients = np.array([K1, K2, P1, P2])
    columns, rows = cv2.initUndistortRectifyMap(
        matrix, coefficients, np.eye(3), matrix, (WIDTH_PX, HEIGHT_PX), cv2.CV_32FC1
    )
    wanted = cv2.remap(pixels, columns, rows, cv2.INTER_CUBIC)
    apart = np.abs(picture.astype(int) - wanted.astype(int))
    assert float(apart.mean()) < 0.4
    assert pinhole.centre_px == (230.0, 190.0)
    assert pinhole.focal_px == (FOCAL_PX, FOCAL_PX + 6)


def test_a_lens_without_distortion_leaves_the_photo() -> None:
    pixels = take_photo(ARC[1])
    params = [FOCAL_PX, FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2]
    camera = pycolmap.Camera(model="PINHOLE", width=WIDTH_PX, height=HEIGHT_PX, params=params)
    picture = straightened(pixels, camera, pinhole_of(camera, 10 * WIDTH_PX))
    np.testing.assert_array_equal(picture, pixels)


def test_a_large_photo_is_made_smaller() -> None:
    pixels = take_photo(ARC[2])
    params = [FOCAL_PX, FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2]
    camera = pycolmap.Camera(model="PINHOLE", width=WIDTH_PX, height=HEIGHT_PX, params=params)
    pinhole = pinhole_of(camera, WIDTH_PX // 2)
    picture = straightened(pixels, camera, pinhole)
    assert picture.shape == (HEIGHT_PX // 2, WIDTH_PX // 2, 3)
    assert pinhole.focal_px == (FOCAL_PX / 2, FOCAL_PX / 2)
    wanted = cv2.resize(pixels, (WIDTH_PX // 2, HEIGHT_PX // 2), interpolation=cv2.INTER_AREA)
    assert float(np.abs(picture.astype(int) - wanted.astype(int)).mean()) < 6


def test_pixels_that_the_photo_lacks_are_told() -> None:
    """A barrel lens: its corners, pulled straight, lie outside; brute force over all pixels."""
    camera = pycolmap.Camera(
        model="OPENCV", width=320, height=200, params=[260, 260, 150, 104, 0.2, 0.05, 0.002, 0.001]
    )
    pinhole = pinhole_of(camera)
    x, y = np.meshgrid(np.arange(320) + 0.5, np.arange(200) + 0.5)
    rays = np.column_stack([(x.ravel() - 150) / 260, (y.ravel() - 104) / 260, np.ones(x.size)])
    across, down = camera.img_from_cam(rays).T.reshape(2, 200, 320)
    inner = np.minimum.reduce([across, 320 - across, down, 200 - down])
    shown = shown_px(camera, pinhole)
    assert 0.5 < shown.mean() < 0.95
    assert not shown[inner < 1.9].any()
    assert shown[inner > 2.1].all()
