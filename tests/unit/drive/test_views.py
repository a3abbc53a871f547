"""Pictures for a vote: the nearest surface of each pixel, by another way of drawing."""

from __future__ import annotations

import numpy as np

from veduta.drive.build import views
from veduta.drive.build.frame import column_frame


def _screen() -> views._Screen:
    line = np.stack([np.zeros(9), np.arange(9.0), np.full(9, 2.0)], axis=1)
    angles = np.deg2rad(np.arange(-60.0, 60.0, 5.0))
    frame = column_frame(line, "left", angles, np.zeros(9))
    return views._Screen(frame, np.array([-1.0, -1.0]), 5.0, (50, 60))


def _soup(seed: int, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles to the left of the path, their vertices' places and colours."""
    random = np.random.default_rng(seed)
    middle = random.uniform([-7.0, 0.0, 0.0], [-2.0, 8.0, 5.0], (count, 3))
    vertices = (middle[:, None] + random.uniform(-1.5, 1.5, (count, 3, 3))).reshape(-1, 3)
    colours = random.uniform(0, 255, (count, 3)).repeat(3, axis=0).astype(np.float32)
    return vertices, np.arange(3 * count).reshape(-1, 3), colours


def _brute(screen: views._Screen, vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """(h, w) the triangle at the middle of each pixel, -1 for none; barycentric, all of them."""
    local = screen.local(vertices)
    flat = (screen.flat(local) - screen.low) * screen.px_m
    height, width = screen.shape
    x, y = np.meshgrid(np.arange(width) + 0.5, height - (np.arange(height) + 0.5))
    nearest, which = np.full(screen.shape, np.inf), np.full(screen.shape, -1)
    for number, corners in enumerate(triangles.tolist()):
        square = np.vstack([flat[corners].T, np.ones(3)])
        shares = np.einsum("ij,jhw->ihw", np.linalg.inv(square), np.stack([x, y, np.ones_like(x)]))
        away = np.einsum("i,ihw->hw", local[corners, 1], shares)
        better = (shares >= 0.0).all(axis=0) & (away < nearest)
        nearest[better], which[better] = away[better], number
    return which


def test_the_nearest_triangle_of_each_pixel_is_drawn() -> None:
    screen, (vertices, triangles, colours) = _screen(), _soup(3, 40)
    picture = views._drawn(screen, vertices, triangles, colours, lambda carried: carried)
    which = _brute(screen, vertices, triangles)
    assert 0.05 < (which >= 0).mean() < 1.0
    expected = np.where(
        (which >= 0)[..., None], colours[triangles[which, 0]], np.array(views._EMPTY)
    )
    off = np.abs(picture.astype(float) - expected).max(axis=2) > 1.5
    assert off.mean() < 0.005  # pixels on an edge


def test_nothing_is_an_empty_picture() -> None:
    none = views._joined([], np.zeros(3))
    picture = views._drawn(_screen(), *none, lambda carried: carried)
    assert (picture == np.array(views._EMPTY)).all()
