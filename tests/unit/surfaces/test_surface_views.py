"""Views of a set of cameras: undistorted, masked, at their size."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest
from surfaces.painted_relief import camera_at, painted, relief

from veduta.cameras import CameraSet
from veduta.run.errors import InputError
from veduta.surfaces import surface_views, texture_mesh


def written(folder: Path) -> CameraSet:
    """Three cameras with their pictures; the last one's is missing."""
    cameras = []
    for number, x in enumerate((-1.0, 0.0, 1.0)):
        view = painted(relief(), camera_at(f"v{number}.png", (x, -4.0, 0.2)))
        path = folder / view.camera.name
        cv2.imwrite(str(path), view.read()[..., ::-1])
        cameras.append(replace(view.camera, picture=path if number < 2 else None))
    return CameraSet(tuple(cameras), source=str(folder))


def test_pictures_give_texture(tmp_path: Path) -> None:
    views = surface_views(written(tmp_path))
    assert len(views) == 2
    assert texture_mesh(relief(), views).seen_share == 1.0


def test_masks_and_lenses_hide(tmp_path: Path) -> None:
    cameras = written(tmp_path)
    mask = np.full((160, 200), 255, np.uint8)
    mask[:, :100] = 0
    cv2.imwrite(str(tmp_path / "mask.png"), mask)
    bent = replace(cameras.cameras[1], distortion=(0.3, 0.0, 0.0, 0.0))
    plain = cameras.cameras[0]
    both = replace(cameras, cameras=(plain, bent), masks={plain.name: tmp_path / "mask.png"})
    first, second = surface_views(both)
    hidden = first.hidden()
    assert hidden is not None
    np.testing.assert_array_equal(hidden, mask == 0)
    beyond = second.hidden()
    assert beyond is not None
    assert beyond[0, 0]
    assert not beyond[80, 100]
    assert not second.camera.distorted


def test_what_cannot_be_used(tmp_path: Path) -> None:
    cameras = written(tmp_path)
    none = replace(cameras, cameras=cameras.cameras[2:])
    with pytest.raises(InputError, match="no pictures"):
        surface_views(none)
    small = cameras.cameras[0].scaled(0.5)
    with pytest.raises(InputError, match="200 x 160 px"):
        surface_views(replace(cameras, cameras=(small,)))[0].read()
