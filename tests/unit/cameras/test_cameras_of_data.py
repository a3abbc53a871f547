"""Real sets of cameras: what is known of them comes out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.io

from veduta.cameras import read_cameras

pytestmark = pytest.mark.regression


def test_fountain_is_read_at_the_size_of_its_photos(veduta_data: Path) -> None:
    found = read_cameras(veduta_data / "photos/fountain-P11")
    assert len(found) == 11
    camera = found.cameras[0]
    assert (camera.width_px, camera.height_px) == (1536, 1024)
    assert camera.focal_px == pytest.approx((1379.74, 1382.08))
    np.testing.assert_allclose(camera.centre(), [-7.28137, -7.57667, 0.204446], atol=1e-9)


def test_the_dinosaur_is_seen_as_by_its_matrices(veduta_data: Path) -> None:
    folder = veduta_data / "silhouettes/vgg-dino"
    found = read_cameras(folder)
    matrices = scipy.io.loadmat(folder / "dino_Ps.mat")["P"].ravel()
    points = np.random.default_rng(0).uniform(-0.1, 0.1, (30, 3))
    for matrix, camera in zip(matrices, found.cameras, strict=True):
        local = np.column_stack([points * [1.0, 1.0, -1.0], np.ones(30)]) @ matrix.T
        places, depth = camera.project(points)
        np.testing.assert_allclose(places - 0.5, local[:, :2] / local[:, 2:], atol=1e-6)
        assert (depth > 0.0).all()


@pytest.mark.parametrize("inner", ["data.mat", "colmap_ground_truth"])
def test_the_portal_is_seen_where_it_was(inner: str, veduta_data: Path) -> None:
    found = read_cameras(veduta_data / "photos/lund-door" / inner)
    assert len(found) == 12
    assert found.points is not None
    assert found.visible is not None
    for camera, rows in zip(found.cameras, found.visible, strict=True):
        places, depth = camera.project(found.points[rows])
        assert np.median(depth) > 0.0
        inside = (places >= 0.0).all(axis=1) & (places[:, 0] < camera.width_px)
        assert inside.mean() > 0.98


@pytest.mark.parametrize(
    ("name", "count"), [("stereo/kitti-seq1", 52), ("stereo/kitti03", 20), ("laser/kitti00", 20)]
)
def test_streets_have_pairs_half_a_metre_apart(name: str, count: int, veduta_data: Path) -> None:
    found = read_cameras(veduta_data / name)
    assert len(found) == count
    apart = np.linalg.norm(found.centres[1::2] - found.centres[::2], axis=1)
    np.testing.assert_allclose(apart, 0.535, atol=0.01)
