"""PCD files written by hand, and broken ones."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.drive.read.clouds import read_clouds
from veduta.drive.read.pcd import read_pcd
from veduta.run.errors import InputError, NotFoundError

_HEAD = (
    "# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {sizes}\nTYPE {kinds}\nCOUNT {counts}\n"
    "WIDTH {n}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA {data}\n"
)


def _write(path: Path, points: np.ndarray, data: str = "binary") -> Path:
    head = _HEAD.format(
        fields="x y z intensity", sizes="4 4 4 4", kinds="F F F F", counts="1 1 1 1",
        n=len(points), data=data,
    )  # fmt: skip
    rows = np.concatenate([points, np.zeros((len(points), 1))], axis=1).astype("<f4")
    text = "\n".join(" ".join(str(v) for v in row) for row in rows.tolist()).encode()
    path.write_bytes(head.encode() + (rows.tobytes() if data == "binary" else text))
    return path


@pytest.mark.parametrize("data", ["binary", "ascii"])
def test_points_come_back(tmp_path: Path, data: str) -> None:
    points = np.random.default_rng(3).normal(size=(50, 3))
    np.testing.assert_allclose(
        read_pcd(_write(tmp_path / "a.pcd", points, data)), points, atol=1e-6
    )


def test_cut_file_says_how_far_it_goes(tmp_path: Path) -> None:
    path = _write(tmp_path / "a.pcd", np.zeros((10, 3)))
    path.write_bytes(path.read_bytes()[:-30])
    with pytest.raises(InputError, match="ends after 8 of 10 points"):
        read_pcd(path)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("DATA binary", "DATA binary_compressed", "binary_compressed"),
        ("FIELDS x y z", "FIELDS x y w", "no field 'z'"),
        ("POINTS 10", "POINTS 99999999999", "99999999999"),
        ("TYPE F F", "TYPE Q F", "unknown type"),
        ("DATA binary", "DOTA", "no header"),
        ("FIELDS x y z", "FIELDS x x y", "two fields 'x'"),
        ("COUNT 1 1 1 1", "COUNT 1 1 1 99999999999", "999 values"),
        ("COUNT 1 1 1 1", "COUNT 1 1 1 0", "0 values"),
        ("COUNT 1 1 1 1", "COUNT 3 1 1 1", "several values"),
        ("SIZE 4 4", "SIZE 1 4", "unknown type"),
    ],
)
def test_broken_headers_are_told(tmp_path: Path, old: str, new: str, said: str) -> None:
    path = _write(tmp_path / "a.pcd", np.zeros((10, 3)))
    path.write_bytes(path.read_bytes().replace(old.encode(), new.encode()))
    with pytest.raises(InputError, match=said):
        read_pcd(path)


def _room(shift: float, random: np.random.Generator) -> np.ndarray:
    """A street of 30 m seen from `shift` m along it: two walls with piers, a road."""
    x = random.uniform(-15, 15, 6000)
    side = random.choice([-6.0, 7.0], 6000) + np.where(np.mod(x, 4.0) < 1.0, 0.4, 0.0)
    walls = np.stack([x, side, random.uniform(-1.7, 1.5, 6000)], axis=1)
    flat = random.uniform(-6, 6, (6000, 2))
    road = np.stack([flat[:, 0] * 2.5, flat[:, 1], np.full(6000, -1.7)], axis=1)
    return np.concatenate([walls, road]) - [shift, 0.0, 0.0]


def test_path_is_found_without_poses(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    for number in range(4):
        _write(tmp_path / f"{number:03d}.pcd", _room(0.8 * number, random))
    record = read_clouds(tmp_path, 1)
    assert not record.given_poses
    expected = np.stack([np.zeros(4), 0.8 * np.arange(4), np.full(4, 1.7)], axis=1)
    np.testing.assert_allclose(record.path(), expected, atol=0.06)


def test_scans_of_two_places_are_not_joined(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    _write(tmp_path / "000.pcd", _room(0.0, random))
    _write(tmp_path / "001.pcd", random.uniform(-80, 80, (4000, 3)))
    with pytest.raises(NotFoundError, match="001"):
        read_clouds(tmp_path, 1)


def test_histogram_beside_the_points_is_passed_over(tmp_path: Path) -> None:
    head = _HEAD.format(
        fields="h _ x y z", sizes="4 1 4 4 4", kinds="F U F F F", counts="2 1 1 1 1", n=1,
        data="ascii",
    )  # fmt: skip
    path = tmp_path / "a.pcd"
    path.write_text(head + "8 9 0 1 2 3\n")
    np.testing.assert_array_equal(read_pcd(path), [[1.0, 2.0, 3.0]])


def test_huge_file_is_refused_unread(tmp_path: Path) -> None:
    path = tmp_path / "a.pcd"
    with path.open("wb") as file:
        file.truncate(2 << 30)
    with pytest.raises(InputError, match="more than"):
        read_pcd(path)
