"""The bending of lenses against the engine's own."""

from __future__ import annotations

import numpy as np
import pycolmap
import pytest

from veduta.synthetic.camera import Camera, look_at
from veduta.synthetic.lens import Distortion

LENSES = (
    Distortion(),
    Distortion(k1=-0.12),
    Distortion(k1=-0.25, k2=0.09),
    Distortion(k1=0.06, k2=-0.02, p1=0.003, p2=-0.002, aspect=1.01),
)


@pytest.mark.parametrize("lens", LENSES)
def test_pixels_are_those_of_the_engine(lens: Distortion) -> None:
    """OPENCV has all of the terms."""
    straight = look_at((0.0, -8.0, 1.6), (0.5, 0.0, 2.0), (1000, 750), 700.0)
    camera = Camera(1000, 750, 700.0, (510.0, 370.0), straight.cam_from_world, lens)
    params = [700.0, 700.0 * lens.aspect, 510.0, 370.0, lens.k1, lens.k2, lens.p1, lens.p2]
    engine = pycolmap.Camera(model="OPENCV", width=1000, height=750, params=params)
    points = np.random.default_rng(1).uniform((-4.0, -1.0, -1.0), (4.0, 3.0, 5.0), (200, 3))
    local = points @ camera.cam_from_world[:3, :3].T + camera.cam_from_world[:3, 3]
    pixels, depth = camera.project(points)
    assert np.allclose(pixels, engine.img_from_cam(local), atol=1e-9)
    rays = camera.rays(pixels)
    assert np.allclose(camera.position_m + rays * depth[:, None], points, atol=1e-7)
