"""LAS and LAZ that count more than the file has room for are refused before they are read."""

from __future__ import annotations

import struct
from pathlib import Path

import laspy
import numpy as np
import pytest

from veduta.drive.read.las import read_las
from veduta.run.errors import InputError

POINTS = np.random.default_rng(1).uniform(-9.0, 9.0, (500, 3))


def scan(path: Path, version: str = "1.4") -> Path:
    header = laspy.LasHeader(point_format=6 if version == "1.4" else 3, version=version)
    header.scales = [0.001] * 3
    file = laspy.LasData(header)
    file.x, file.y, file.z = POINTS.T
    file.write(str(path))
    return path


def change(path: Path, at: int, form: str, value: int) -> None:
    data = bytearray(path.read_bytes())
    struct.pack_into(form, data, at, value)
    path.write_bytes(data)


@pytest.mark.parametrize("version", ["1.2", "1.4"])
@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_a_sound_scan_is_read(tmp_path: Path, suffix: str, version: str) -> None:
    points = read_las(scan(tmp_path / f"scan{suffix}", version))
    np.testing.assert_allclose(points, POINTS, atol=1e-3)


@pytest.mark.parametrize("suffix", [".las", ".laz"])
@pytest.mark.parametrize("at", [100, 243])
def test_records_that_cannot_be_there(tmp_path: Path, suffix: str, at: int) -> None:
    path = scan(tmp_path / f"scan{suffix}")
    change(path, at, "<I", 2_000_000_000)
    with pytest.raises(InputError, match=f"{path.name}.* 2,000,000,000 records"):
        read_las(path)


def test_chunks_that_cannot_be_there(tmp_path: Path) -> None:
    """lazrs makes room for all of them: 48 GB, of a file of a few kilobytes."""
    path = scan(tmp_path / "scan.laz")
    (points_at,) = struct.unpack_from("<I", path.read_bytes(), 96)
    (table_at,) = struct.unpack_from("<q", path.read_bytes(), points_at)
    change(path, table_at + 4, "<I", 2_000_000_000)
    with pytest.raises(InputError, match="2,000,000,000 records or chunks"):
        read_las(path)


def test_chunks_of_a_table_that_the_end_tells_of(tmp_path: Path) -> None:
    path = scan(tmp_path / "scan.laz")
    data = path.read_bytes()
    (points_at,) = struct.unpack_from("<I", data, 96)
    table = data[points_at : points_at + 8]
    (table_at,) = struct.unpack("<q", table)
    path.write_bytes(data + table)
    change(path, points_at, "<q", -1)
    change(path, table_at + 4, "<I", 2_000_000_000)
    with pytest.raises(InputError, match="2,000,000,000 records or chunks"):
        read_las(path)


def test_a_head_that_is_cut_is_named(tmp_path: Path) -> None:
    path = scan(tmp_path / "scan.las")
    path.write_bytes(path.read_bytes()[:60])
    with pytest.raises(InputError, match="is no LAS that can be read"):
        read_las(path)


def test_a_day_that_no_calendar_has_is_named(tmp_path: Path) -> None:
    path = scan(tmp_path / "scan.las")
    change(path, 90, "<I", 60000 + (9999 << 16))
    with pytest.raises(InputError, match="is no LAS that can be read"):
        read_las(path)


def test_a_version_whose_head_is_longer_is_named(tmp_path: Path) -> None:
    """The fields of 1.5 would lie behind the end of this file."""
    path = scan(tmp_path / "scan.las")
    path.write_bytes(path.read_bytes()[:375])
    change(path, 24, "<H", 1 + (5 << 8))
    with pytest.raises(InputError, match="is no LAS that can be read"):
        read_las(path)
