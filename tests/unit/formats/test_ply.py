"""Points as PLY: read back by trimesh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import trimesh

from veduta.formats.ply import write_points


def test_points_and_colours(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    points = rng.uniform(-50, 50, (200, 3))
    colours = rng.integers(0, 256, (200, 3), dtype=np.uint8)
    write_points(points, colours, tmp_path / "points.ply")
    cloud = trimesh.load(tmp_path / "points.ply")
    assert np.allclose(cloud.vertices, points, atol=1e-5)
    assert np.array_equal(np.asarray(cloud.colors)[:, :3], colours)


def test_no_points(tmp_path: Path) -> None:
    write_points(np.empty((0, 3)), np.empty((0, 3), dtype=np.uint8), tmp_path / "none.ply")
    assert (tmp_path / "none.ply").read_bytes().endswith(b"end_header\n")
