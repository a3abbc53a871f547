"""Folders in KITTI's layout: what is read, and what is said of broken ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.drive.read.kitti import read_kitti
from veduta.run.errors import InputError

_TR = "0 -1 0 0 0 0 -1 0 1 0 0 0"
_IDENTITY = "1 0 0 0 0 1 0 0 0 0 1 0"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two scans of a road 1.7 m below the scanner, one metre apart."""
    (tmp_path / "velodyne").mkdir()
    side = np.arange(-6.0, 6.0, 0.2)
    x, y = np.meshgrid(side, side)
    road = np.stack([x.ravel(), y.ravel(), np.full(x.size, -1.7), np.zeros(x.size)], axis=1)
    for name in ("000000", "000001"):
        road.astype("<f4").tofile(tmp_path / "velodyne" / f"{name}.bin")
    (tmp_path / "calib.txt").write_text(f"Tr: {_TR}\n")
    (tmp_path / "poses.txt").write_text(f"{_IDENTITY}\n1 0 0 0 0 1 0 0 0 0 1 1\n")
    return tmp_path


def test_road_is_level_and_path_runs_forward(folder: Path) -> None:
    record = read_kitti(folder, 1)
    np.testing.assert_allclose(record.path(), [[0, 0, 1.7], [0, 1, 1.7]], atol=1e-6)
    points = record.sweeps[0].world_points()
    np.testing.assert_allclose(points[:, 2], 0.0, atol=1e-6)
    # The scanner's x is forward: y of the world; its y is to the left: -x of the world.
    raw = record.sweeps[0].read()
    np.testing.assert_allclose(points[:, 0], -raw[:, 1], atol=1e-6)
    np.testing.assert_allclose(points[:, 1], raw[:, 0], atol=1e-6)


def test_zero_and_nan_ranges_are_dropped(folder: Path) -> None:
    path = folder / "velodyne" / "000000.bin"
    rows = np.fromfile(path, "<f4").reshape(-1, 4)
    rows[:5] = np.nan
    rows[5:10] = 0.0
    rows.tofile(path)
    points = read_kitti(folder, 1).sweeps[0].read()
    assert np.isfinite(points).all()
    assert np.linalg.norm(points, axis=1).min() > 2.0


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("calib.txt", "P0: 1 2\n", "'Tr'"),
        ("poses.txt", f"{_IDENTITY}\n", "1 poses for 2 scans"),
        ("poses.txt", f"{_IDENTITY}\n1 2 3\n", "line 2"),
        ("poses.txt", f"{_IDENTITY}\n{_IDENTITY.replace('0', 'nan')}\n", "no number"),
        ("times.txt", "0.0\n", "1 times for 2 scans"),
        ("times.txt", "a\nb\n", "not numbers"),
    ],
)
def test_broken_files_are_named(folder: Path, name: str, text: str, said: str) -> None:
    (folder / name).write_text(text)
    with pytest.raises(InputError) as error:
        read_kitti(folder, 1)
    assert error.value.subject.endswith(name)
    assert said in error.value.fault


def test_cut_scan_is_named(folder: Path) -> None:
    path = folder / "velodyne" / "000001.bin"
    path.write_bytes(path.read_bytes()[:-3])
    record = read_kitti(folder, 1)
    with pytest.raises(InputError) as error:
        record.sweeps[1].read()
    assert error.value.subject.endswith("000001.bin")


def test_folder_without_scans_is_refused(folder: Path) -> None:
    for path in (folder / "velodyne").iterdir():
        path.unlink()
    with pytest.raises(InputError, match="no scans"):
        read_kitti(folder, 1)


@pytest.mark.parametrize("matrix", [" ".join("0" * 12), "-7 0 6 0 0 7 2 0 0 0 1 0"])
def test_colour_camera_that_is_none_is_refused(folder: Path, matrix: str) -> None:
    (folder / "image_2").mkdir()
    (folder / "calib.txt").write_text(f"Tr: {_TR}\nP2: {matrix}\n")
    with pytest.raises(InputError, match="is not the matrix") as error:
        read_kitti(folder, 1)
    assert error.value.subject.endswith("calib.txt")
    assert error.value.remedy
