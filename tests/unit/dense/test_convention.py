"""Cameras in another convention are told by the points of their own set."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from veduta.cameras import Camera
from veduta.dense.document import Views
from veduta.dense.read.sparse import SparseParameters, SparsePoints, require_in_view
from veduta.run.errors import InputError

WIDTH, HEIGHT, FOCAL = 320, 240, 300.0
RULE = SparseParameters()


def _set() -> tuple[list[Camera], SparsePoints]:
    """Three cameras before a wall of points that all of them show."""
    draw = np.random.default_rng(2)
    points = np.column_stack([draw.uniform(-1.5, 1.5, (200, 2)), draw.uniform(4.0, 5.0, 200)])
    cameras = []
    for x in (-0.4, 0.0, 0.4):
        pose = np.column_stack([np.eye(3), [-x, 0.0, 0.0]])
        middle = (WIDTH / 2, HEIGHT / 2)
        cameras.append(Camera(f"{x}", WIDTH, HEIGHT, (FOCAL, FOCAL), middle, pose))
    return cameras, SparsePoints(points, (np.arange(200),) * 3)


def _views(cameras: list[Camera]) -> Views:
    pixels = np.zeros((HEIGHT, WIDTH, 3), dtype=np.uint8)
    return Views(tuple(cameras), lambda _: (pixels, None))


def test_right_cameras_pass() -> None:
    cameras, points = _set()
    require_in_view(_views(cameras), points, "set", RULE)


@pytest.mark.parametrize("case", ["scaled", "looking back", "inverted"])
def test_another_convention_is_refused(case: str) -> None:
    cameras, points = _set()
    changed = []
    for camera in cameras:
        pose = camera.cam_from_world
        if case == "scaled":  # for photos that are four times as large
            changed.append(replace(camera, focal_px=(4 * FOCAL, 4 * FOCAL)))
        elif case == "looking back":  # z towards who looks, as OpenGL has it
            changed.append(replace(camera, cam_from_world=np.diag([1.0, -1.0, -1.0]) @ pose))
        else:  # world from camera, of cameras that are turned
            turn = np.array([[0.0, 0, -1], [0, 1, 0], [1, 0, 0]])
            changed.append(replace(camera, cam_from_world=np.column_stack([turn, pose[:, 3]])))
    with pytest.raises(InputError, match="do not fit their points") as caught:
        require_in_view(_views(changed), points, "set", RULE)
    assert "x to the right and y down" in caught.value.remedy
