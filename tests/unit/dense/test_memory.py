"""What keeps the memory of `veduta dense` within its bound, however many photos there are."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from veduta import _core
from veduta.cameras import Camera
from veduta.dense.build.cloud import CloudParameters, DenseCloud, fuse_cloud
from veduta.dense.document import DepthMap, Views
from veduta.dense.memory import MemoryParameters
from veduta.dense.stages import OnDisk
from veduta.surfaces import vertex_pieces

WIDTH, HEIGHT, COUNT = 40, 30, 6


def _views() -> Views:
    """Cameras in a row, 10 m before a wall; each sees a picture of its own grey."""
    cameras = []
    for number in range(COUNT):
        pose = np.eye(3, 4)
        pose[0, 3] = -0.5 * number
        name = f"{number}.jpg"
        cameras.append(Camera(name, WIDTH, HEIGHT, (40.0, 40.0), (20.0, 15.0), pose))
    return Views(
        tuple(cameras), lambda view: (np.full((HEIGHT, WIDTH, 3), 40 * view, np.uint8), None)
    )


def _fused(most: int | None) -> tuple[DenseCloud, int]:
    depths = np.full((HEIGHT, WIDTH), 10.0, dtype=np.float32)
    facing = np.tile(np.array([0.0, 0.0, -1.0], dtype=np.float32), (HEIGHT * WIDTH, 1))
    sure = np.ones((HEIGHT, WIDTH), dtype=np.float32)
    known = DepthMap(depths, facing, sure, sure.astype(np.uint8))
    links = {view: tuple({max(view - 1, 0), min(view + 1, COUNT - 1)}) for view in range(COUNT)}
    return fuse_cloud(_views(), links, lambda _: known, 2, CloudParameters(), most)


def test_a_cloud_that_would_be_too_large_is_thinned_evenly() -> None:
    whole, one_of = _fused(None)
    assert one_of == 1
    assert len(whole.points_m) > 1200
    most = len(whole.points_m) // 3
    thin, every = _fused(most)
    assert every == 4
    assert most // 2 < len(thin.points_m) <= most
    assert len(thin.normals) == len(thin.colours) == len(thin.views) == len(thin.points_m)
    among = {tuple(one) for one in np.round(whole.points_m, 6).tolist()}
    assert all(tuple(one) in among for one in np.round(thin.points_m, 6).tolist())
    # Each part of the wall lost the same share.
    edges = np.linspace(whole.points_m[:, 0].min(), whole.points_m[:, 0].max() + 1e-6, 5)
    shares = (
        np.histogram(thin.points_m[:, 0], edges)[0] / np.histogram(whole.points_m[:, 0], edges)[0]
    )
    assert np.abs(shares - 0.25).max() < 0.1


def test_what_lies_on_disk_is_read_each_time() -> None:
    read: list[int] = []

    def reader(number: int) -> Callable[[], int]:
        def load() -> int:
            read.append(number)
            return 10 * number

        return load

    found = OnDisk({number: reader(number) for number in range(3)})
    assert len(found) == 3
    assert read == []
    assert found[1] == found[1] == 10
    assert found.get(7) is None
    assert (1 in found, 7 in found) == (True, False)
    assert read.count(1) >= 2


def test_pictures_are_forgotten_beyond_their_share() -> None:
    read: list[int] = []
    picture = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
    views = Views(_views().cameras, lambda view: (read.append(view) or picture, None), 8000.0)
    for view in (0, 1, 1, 2, 0):
        views.pixels(view)
    assert read == [0, 1, 2, 0]


def test_more_memory_allows_more() -> None:
    rule = MemoryParameters()
    for what in (rule.most_points, rule.most_blocks, rule.picture_bytes):
        assert what(8.0) == pytest.approx(2 * what(4.0), rel=1e-3)
    kept = rule.pictures + rule.cloud
    assert kept <= 1.0
    assert rule.most_points(4.0) * rule.point_bytes <= 4e9
    assert rule.most_blocks(4.0) * rule.block_bytes <= 4e9


def test_a_corner_that_is_no_vertex_is_told() -> None:
    with pytest.raises(_core.SurfaceFault, match="corner 9"):
        vertex_pieces(np.array([[0, 1, 9]]), 3)
