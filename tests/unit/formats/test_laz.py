"""LAZ, read back by another decoder path and by its header's bytes."""

from __future__ import annotations

import struct
from pathlib import Path

import laspy
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pyproj import CRS

from veduta.formats.laz import write_laz
from veduta.run.errors import InputError


def cloud(count: int = 500, spread: float = 10.0, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return spread * rng.standard_normal((count, 3)), rng.integers(0, 256, (count, 3), np.uint8)


def test_points_and_colours_come_back(tmp_path: Path) -> None:
    points, colours = cloud()
    write_laz(points, colours, tmp_path / "a.laz")
    read = laspy.read(tmp_path / "a.laz")
    assert np.abs(read.xyz - points).max() <= 0.5001 * read.header.scales.max()
    assert np.array_equal(np.column_stack([read.red, read.green, read.blue]) // 257, colours)
    assert read.header.parse_crs() is None


def test_the_header_is_that_of_las_1_4(tmp_path: Path) -> None:
    """By the bytes of ASPRS LAS 1.4 R15, table 3; bit 7 of the format says compressed."""
    points, colours = cloud(count=123)
    write_laz(points, colours, tmp_path / "a.laz")
    data = (tmp_path / "a.laz").read_bytes()
    assert data[:4] == b"LASF"
    assert struct.unpack_from("<BB", data, 24) == (1, 4)
    assert data[104] == 7 | 0x80
    assert struct.unpack_from("<H", data, 6)[0] & 0x10  # the CRS, if any, is WKT
    assert struct.unpack_from("<Q", data, 247) == (123,)
    highest_x, lowest_x = struct.unpack_from("<dd", data, 179)
    assert highest_x == pytest.approx(points[:, 0].max(), abs=1e-4)
    assert lowest_x == pytest.approx(points[:, 0].min(), abs=1e-4)


def test_in_a_crs(tmp_path: Path) -> None:
    points, colours = cloud()
    origin = (691_000.25, 5_335_000.5, 520.0)
    write_laz(points, colours, tmp_path / "a.laz", crs="EPSG:25832", origin_m=origin)
    read = laspy.read(tmp_path / "a.laz")
    assert read.header.parse_crs() == CRS("EPSG:25832")
    assert np.allclose(read.xyz, points + origin, atol=0.000501)
    assert np.allclose(read.header.scales, 0.001)


def test_a_crs_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="EPSG:code"):
        write_laz(*cloud(), tmp_path / "a.laz", crs="EPSG:99999999")


@settings(max_examples=30, deadline=None)
@given(
    spread=st.floats(1e-3, 1e5),
    far=st.floats(0.0, 1e9),
    count=st.sampled_from([0, 1, 2, 40]),
)
def test_the_furthest_fits(
    tmp_path_factory: pytest.TempPathFactory, spread: float, far: float, count: int
) -> None:
    """A stray point far off costs resolution, and nothing else."""
    points, colours = cloud(count, spread)
    if count:
        points[0] = far
    path = tmp_path_factory.mktemp("laz") / "a.laz"
    write_laz(points, colours, path)
    read = laspy.read(path)
    assert len(read.points) == count
    if count:
        assert np.abs(read.xyz - points).max() <= 0.51 * read.header.scales.max() + 1e-9 * far
    if count == 40:
        low, high = np.quantile(points, [0.25, 0.75], axis=0)
        reach = np.abs(points).max()
        assert read.header.scales.max() <= max(1.001e-5 * (high - low).max(), 1e-8 * reach)


def test_the_same_points_give_the_same_bytes(tmp_path: Path) -> None:
    for name in ("a.laz", "b.laz"):
        write_laz(*cloud(), tmp_path / name)
    assert (tmp_path / "a.laz").read_bytes() == (tmp_path / "b.laz").read_bytes()
