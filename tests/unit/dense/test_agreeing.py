"""What has no parallax is no depth, however many views agree on it."""

from __future__ import annotations

import numpy as np

from veduta.cameras import Camera
from veduta.dense.document import Views
from veduta.dense.read.agreeing import AgreeParameters, agreed_depths
from veduta.dense.read.neighbours import Comparison

WIDTH, HEIGHT, FAR = 40, 30, 100.0


def test_depths_at_the_far_end_are_dropped() -> None:
    pose = np.column_stack([np.eye(3), np.zeros(3)])
    cameras = tuple(
        Camera(name, WIDTH, HEIGHT, (50.0, 50.0), (WIDTH / 2, HEIGHT / 2), pose) for name in "ab"
    )
    pixels = np.zeros((HEIGHT, WIDTH, 3), dtype=np.uint8)
    views = Views(cameras, lambda _: (pixels, None))
    depths = np.full((HEIGHT, WIDTH), 50.0, dtype=np.float32)
    depths[:, : WIDTH // 2] = 97.0
    planes = np.zeros((HEIGHT * WIDTH, 4), dtype=np.float32)
    planes[:, 0] = 1.0 / depths.ravel()
    found = agreed_depths(
        views, Comparison(0, (1,), 1.0, FAR), {0: planes, 1: planes}, 1, AgreeParameters()
    )
    assert np.isnan(found.depths_m[:, : WIDTH // 2]).all()
    assert np.allclose(found.depths_m[:, WIDTH // 2 :], 50.0)
