"""Full scans in other layouts: KITTI raw, and LAS with and without poses."""

from __future__ import annotations

from pathlib import Path

import laspy
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from veduta.drive.read.log import log_files, read_log
from veduta.run.errors import InputError

Floats = NDArray[np.float64]
LATITUDE = 49.0


def _yard(seed: int, place: Floats, yaw: float) -> Floats:
    """(n, 3) points of a road and two walls in the frame of a scanner 1.7 m over the road."""
    random = np.random.default_rng(seed)
    road = np.column_stack([random.uniform(-15, 15, (3000, 2)), np.full(3000, -1.7)])
    walls = [
        np.column_stack(
            [random.uniform(-15, 25, 2500), np.full(2500, y), random.uniform(-1.7, 4, 2500)]
        )
        for y in (-8.0, 9.0)
    ]
    boxes = [
        np.column_stack([
            np.full(300, x), random.uniform(y, y + 2, 300), random.uniform(-1.7, 2.0, 300)
        ])
        for x, y in ((-9.0, -8.0), (-2.0, 6.0), (4.0, -8.0), (9.0, 7.0), (15.0, -8.0))
    ]  # fmt: skip
    world = np.concatenate([road, *walls, *boxes])
    cosine, sine = np.cos(yaw), np.sin(yaw)
    turn = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    return np.asarray((world - place) @ turn)


def _write_las(path: Path, points: Floats) -> None:
    header = laspy.LasHeader(point_format=3, version="1.2")
    header.scales = np.full(3, 0.001)
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = points.T
    cloud.write(path)


def test_poses_beside_las_are_taken_as_they_are(tmp_path: Path) -> None:
    lines = []
    for row in range(3):
        place = np.array([0.8 * row, 0.0, 0.0])
        _write_las(tmp_path / f"{row:03d}.las", _yard(row, place, 0.0))
        matrix = np.column_stack([np.eye(3), place + np.array([4e5, 5e6, 100.0])])
        lines.append(" ".join(f"{value:.3f}" for value in matrix.ravel()))
    (tmp_path / "poses.txt").write_text("\n".join(lines))
    record = read_log(tmp_path, 1)
    assert record.given_poses
    np.testing.assert_allclose(np.diff(record.path()[:, 0]), 0.8, atol=0.01)
    assert record.height_m == pytest.approx(1.7, abs=0.03)


def test_las_without_poses_is_matched(tmp_path: Path) -> None:
    for row in range(3):
        place = np.array([0.6 * row, 0.0, 0.0])
        _write_las(tmp_path / f"{row:03d}.las", _yard(7, place, 0.0))
    record = read_log(tmp_path, 1)
    assert record.path_from == "registration of the scans"
    step = np.linalg.norm(np.diff(record.path()[:, :2], axis=0), axis=1)
    np.testing.assert_allclose(step, 0.6, atol=0.05)


def test_broken_las_and_poses_are_told(tmp_path: Path) -> None:
    for row in range(2):
        _write_las(tmp_path / f"{row}.las", _yard(row, np.zeros(3), 0.0))
    (tmp_path / "poses.txt").write_text("1 0 0 0")
    with pytest.raises(InputError, match=r"2 lines of twelve.*remove it"):
        read_log(tmp_path, 1)
    (tmp_path / "poses.txt").unlink()
    (tmp_path / "0.las").write_bytes(b"LASF and no more")
    with pytest.raises(InputError, match="no LAS"):
        read_log(tmp_path, 1)


@pytest.fixture
def raw(tmp_path: Path) -> Path:
    """A day's folder with calibration, and a drive of three scans to the north-east."""
    drive = tmp_path / "2011_09_26_drive_0001_sync"
    for name in ("velodyne_points/data", "oxts/data", "image_02/data"):
        (drive / name).mkdir(parents=True)
    metre = np.rad2deg(1.0 / (6_378_137.0 * np.cos(np.deg2rad(LATITUDE))))
    for row in range(3):
        place = 0.7 * row * np.array([np.sqrt(0.5), np.sqrt(0.5), 0.0])
        points = _yard(row, place, np.pi / 4).astype("<f4")
        rows = np.column_stack([points, np.zeros(len(points), "<f4")])
        rows.astype("<f4").tofile(drive / f"velodyne_points/data/{row:010d}.bin")
        latitude = LATITUDE + np.rad2deg(place[1] / 6_378_137.0)
        text = f"{latitude:.12f} {8.0 + place[0] * metre:.12f} 110.0 0 0 {np.pi / 4:.9f} 0 0"
        (drive / f"oxts/data/{row:010d}.txt").write_text(text)
    Image.fromarray(np.zeros((30, 100, 3), np.uint8)).save(drive / "image_02/data/0000000001.png")
    eye = "1 0 0 0 1 0 0 0 1"
    (tmp_path / "calib_imu_to_velo.txt").write_text(f"R: {eye}\nT: 0 0 0")
    (tmp_path / "calib_velo_to_cam.txt").write_text("R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 -0.3")
    (tmp_path / "calib_cam_to_cam.txt").write_text(
        f"calib_time: 09-Jan-2012 13:57:47\nR_rect_00: {eye}\n"
        "P_rect_02: 50 0 50 3 0 50 15 0 0 0 1 0"
    )
    return drive


def test_raw_drive_goes_north_east(raw: Path) -> None:
    record = read_log(raw, 1)
    step = np.diff(record.path(), axis=0)
    np.testing.assert_allclose(step[:, :2], 0.7 * np.sqrt(0.5), atol=0.02)
    assert record.height_m == pytest.approx(1.7, abs=0.03)
    (shot,) = record.shots
    forward = shot.world_from_cam[:3, 2]
    np.testing.assert_allclose(forward, [np.sqrt(0.5), np.sqrt(0.5), 0.0], atol=0.02)
    eye = shot.world_from_cam[:3, 3] - record.path()[1]
    # 0.3 m ahead of the scanner, and 6 cm to its left.
    np.testing.assert_allclose(eye @ forward, 0.3, atol=0.01)
    names = {path.name for path in log_files(raw)}
    assert "calib_cam_to_cam.txt" in names


def test_raw_drive_with_a_broken_file_is_told(raw: Path) -> None:
    (raw / "oxts/data/0000000001.txt").write_text("49.0 8.0")
    with pytest.raises(InputError, match="six numbers"):
        read_log(raw, 1)
    (raw.parent / "calib_velo_to_cam.txt").write_text("R: 1 2 3\nT: 0 0 0")
    with pytest.raises(InputError, match="not 9"):
        read_log(raw, 1)
