"""`veduta dense --colmap`: COLMAP itself reads the workspace, and fuses its maps to the wall."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from PIL import Image
from stereo_scene import BLOCK_M, WALL_M, depths, eyes, write_set

from veduta.cli.main import main
from veduta.formats.colmap_dense import quaternion
from veduta.formats.colmap_model import pose


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    photos = write_set(tmp_path_factory.mktemp("set") / "wall")
    out = tmp_path_factory.mktemp("dense") / "out"
    call = ["dense", str(photos), "-o", str(out), "--quiet", "--no-mesh", "--colmap"]
    assert main(call) == 0
    return out / "colmap"


def test_the_model_shows_its_points_where_its_images_say(workspace: Path) -> None:
    model = pycolmap.Reconstruction(str(workspace / "sparse"))
    assert len(model.images) == 4
    assert len(model.points3D) > 50
    for image in model.images.values():
        seen = [one for one in image.points2D if one.has_point3D()]
        assert len(seen) > 20
        away = [
            np.linalg.norm(image.project_point(model.points3D[one.point3D_id].xyz) - one.xy)
            for one in seen
        ]
        assert max(away) < 0.01
        with Image.open(workspace / "images" / image.name) as photo:
            assert photo.size == (image.camera.width, image.camera.height)


def test_maps_are_the_depths(workspace: Path) -> None:
    for number, eye in enumerate(eyes(4)):
        name = f"view{number}.jpg.geometric.bin"
        folder = workspace / "stereo"
        read = pycolmap.DepthMap()
        read.read(folder / "depth_maps" / name)
        found = np.array(read.to_array())
        truth, _ = depths(eye)
        known = found > 0.0
        assert found.shape == truth.shape
        assert known.mean() > 0.6
        assert np.quantile(np.abs(found - truth)[known] / truth[known], 0.9) < 0.01


def test_colmap_fuses_the_maps_to_the_wall(workspace: Path, tmp_path: Path) -> None:
    options = pycolmap.StereoFusionOptions()
    options.min_num_pixels = 3
    pycolmap.stereo_fusion(tmp_path / "fused.ply", workspace, options=options, output_type="PLY")
    head, _, body = (tmp_path / "fused.ply").read_bytes().partition(b"end_header\n")
    rows = np.frombuffer(body, dtype=np.dtype([("xyz", "<f4", 6), ("rgb", "u1", 3)]))
    assert f"element vertex {len(rows)}\n".encode() in head
    assert len(rows) > 5000  # a pixel counts where three maps and their normals agree
    y = rows["xyz"][:, 1]
    away = np.minimum(np.abs(y - WALL_M), np.abs(y - BLOCK_M))
    assert np.quantile(away, 0.9) < 0.05
    assert np.median(rows["xyz"][:, 4]) < -0.9  # normals face the cameras


def test_turns_come_back_from_their_quaternions() -> None:
    random = np.random.default_rng(0)
    for _ in range(50):
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
        turn *= np.sign(np.linalg.det(turn))
        back = pose(Path("x"), "x", quaternion(turn), np.zeros(3))[:, :3]
        np.testing.assert_allclose(back, turn, atol=1e-12)
    half = np.diag([1.0, -1.0, -1.0])
    np.testing.assert_allclose(pose(Path("x"), "x", quaternion(half), np.zeros(3))[:, :3], half)
