"""Lots from GeoPackages: files written here byte by byte, as the standard has them."""

from __future__ import annotations

import sqlite3
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.grammar import package_lots
from veduta.grammar.lots import read_lots
from veduta.grammar.options import LotOptions
from veduta.grammar.rings import RingFault
from veduta.grammar.wkb import polygons_of_wkb
from veduta.run.errors import InputError

SQUARE = [(100.0, 200.0), (110.0, 200.0), (110.0, 210.0), (100.0, 210.0), (100.0, 200.0)]
HOLE = [(102.0, 202.0), (102.0, 204.0), (104.0, 204.0), (104.0, 202.0), (102.0, 202.0)]


def wkb(rings: list[list[tuple[float, ...]]], order: str = "<", code: int = 3) -> bytes:
    found = struct.pack("B", order == "<") + struct.pack(f"{order}II", code, len(rings))
    for ring in rings:
        found += struct.pack(f"{order}I", len(ring))
        found += b"".join(struct.pack(f"{order}{len(point)}d", *point) for point in ring)
    return found


def multi(polygons: list[bytes]) -> bytes:
    return struct.pack("<BII", 1, 6, len(polygons)) + b"".join(polygons)


def cell(geometry: bytes, envelope: int = 0, empty: bool = False) -> bytes:
    flags = 1 | envelope << 1 | empty << 4
    size = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[envelope]
    return b"GP" + struct.pack("<BBi", 0, flags, 28992) + b"\0" * size + geometry


def package(path: Path, rows: list[tuple[Any, ...]], srs: int = 28992, layers: int = 1) -> Path:
    """A file with columns fid, geom, name, height and shops."""
    with sqlite3.connect(path) as base:
        base.execute(
            "CREATE TABLE gpkg_spatial_ref_sys (srs_id, organization, organization_coordsys_id)"
        )
        base.execute("INSERT INTO gpkg_spatial_ref_sys VALUES (28992, 'epsg', 28992)")
        base.execute("INSERT INTO gpkg_spatial_ref_sys VALUES (99, 'mine', 7)")
        base.execute(
            "CREATE TABLE gpkg_geometry_columns "
            "(table_name, column_name, geometry_type_name, srs_id)"
        )
        for number in range(layers):
            name = f"lots {number}"
            base.execute(
                f'CREATE TABLE "{name}" (fid INTEGER PRIMARY KEY, geom BLOB, name TEXT, '
                "height REAL, shops BOOLEAN)"
            )
            base.executemany(f'INSERT INTO "{name}" VALUES (?, ?, ?, ?, ?)', rows)
            values = (name, "geom", "POLYGON", srs)
            base.execute("INSERT INTO gpkg_geometry_columns VALUES (?, ?, ?, ?)", values)
    return path


def test_rows_become_lots(tmp_path: Path) -> None:
    far = [(x + 50, y) for x, y in SQUARE]
    rows = [
        (1, cell(wkb([SQUARE, HOLE]), envelope=1), "town hall", 12.5, 1),
        (2, cell(multi([wkb([SQUARE]), wkb([far], ">")]), envelope=4), None, None, 0),
        (3, None, "nothing", 1.0, None),
        (4, cell(struct.pack("<BIdd", 1, 1, 0.0, 0.0)), "a point", 1.0, None),
        (5, cell(wkb([[SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]]])), "crossing", 1.0, None),
        (6, b"nonsense", "broken", 1.0, None),
    ]
    found = read_lots(package(tmp_path / "lots.gpkg", rows))
    assert (found.crs, found.origin_m) == ("EPSG:28992", (100.0, 200.0, 0.0))
    assert [lot.name for lot in found.lots] == ["town hall", "2-1", "2-2"]
    first = found.lots[0]
    assert first.attributes == {"fid": 1.0, "name": "town hall", "height": 12.5, "shops": True}
    assert first.rings_m[0].tolist() == [[0, 0], [10, 0], [10, 10], [0, 10]]
    assert len(first.rings_m) == 2
    assert found.lots[2].anchor_m == (50.0, 0.0, 0.0)
    assert found.lots[1].attributes["shops"] is False
    assert [f.reason for f in found.failures] == [
        "its geometry is none of a GeoPackage",
        "its outline encloses nothing, or crosses itself",
    ]
    assert found.notes == ("left out, for they are no polygons: 1 Point, 1 row without geometry",)


def test_heights_are_kept_and_measures_are_not(tmp_path: Path) -> None:
    high = [(x, y, 7.0) for x, y in SQUARE]
    both = [(x, y, 7.0, 99.0) for x, y in SQUARE]
    measured = [(x, y, 99.0) for x, y in SQUARE]
    rows: list[tuple[Any, ...]] = [
        (1, cell(wkb([high], code=1003)), "iso", 1.0, 0),
        (2, cell(wkb([both], code=3003)), "both", 1.0, 0),
        (3, cell(wkb([high], code=0x80000003)), "extended", 1.0, 0),
        (4, cell(wkb([measured], code=2003)), "measured", 1.0, 0),
    ]
    found = read_lots(package(tmp_path / "lots.gpkg", rows))
    heights = [lot.anchor_m[2] + found.origin_m[2] for lot in found.lots]
    assert heights == [7, 7, 7, 0]


def test_a_layer_of_several_is_named(tmp_path: Path) -> None:
    path = package(tmp_path / "lots.gpkg", [(1, cell(wkb([SQUARE])), "a", 1.0, 0)], layers=2)
    with pytest.raises(
        InputError, match=r"has 2 layers of polygons\. Name one with --layer: lots 0"
    ):
        read_lots(path)
    assert len(read_lots(path, LotOptions(layer="lots 1")).lots) == 1
    with pytest.raises(InputError, match="Did you mean `lots 0`"):
        read_lots(path, LotOptions(layer="lot 0"))


def test_what_is_no_package_is_told(tmp_path: Path) -> None:
    plain = tmp_path / "plain.gpkg"
    with sqlite3.connect(plain) as base:
        base.execute("CREATE TABLE t (x)")
    with pytest.raises(InputError, match=r"no GeoPackage.*ogr2ogr -f GPKG lots\.gpkg plain\.gpkg"):
        read_lots(plain)
    other = package(tmp_path / "crs.gpkg", [(1, cell(wkb([SQUARE])), "a", 1.0, 0)], srs=99)
    with pytest.raises(InputError, match="without EPSG code"):
        read_lots(other)
    torn = tmp_path / "torn.gpkg"
    torn.write_bytes(other.read_bytes()[:5000])
    with pytest.raises(InputError, match=r"torn\.gpkg.*sqlite3 torn\.gpkg \.recover"):
        read_lots(torn)
    spaced = tmp_path / "my lots; old.gpkg"
    spaced.write_bytes(torn.read_bytes())
    with pytest.raises(InputError, match=r"sqlite3 'my lots; old\.gpkg' \.recover"):
        read_lots(spaced)
    empty = package(tmp_path / "empty.gpkg", [])
    with pytest.raises(InputError, match="no lot that can be used"):
        read_lots(empty)


def test_what_a_view_computes_is_not_run(tmp_path: Path) -> None:
    path = tmp_path / "view.gpkg"
    package(path, [], layers=0)
    with sqlite3.connect(path) as base:
        base.execute(
            "CREATE VIEW endless AS WITH RECURSIVE n(x) AS (SELECT 1 UNION ALL SELECT x FROM n) "
            "SELECT x AS geom FROM n"
        )
        base.execute("INSERT INTO gpkg_geometry_columns VALUES ('endless', 'geom', 'POLYGON', -1)")
    with pytest.raises(InputError, match="no layer of polygons"):
        read_lots(path)


@given(st.binary(max_size=200), st.sampled_from([b"", b"\1\3\0\0\0", b"\0\0\0\0\6", b"\1\6\0\0\0"]))
def test_bytes_that_are_no_geometry_are_refused(content: bytes, start: bytes) -> None:
    try:
        polygons, _ = polygons_of_wkb(start + content)
    except RingFault:
        return
    for rings in polygons or []:
        assert all(isinstance(ring, np.ndarray) and ring.shape[1] == 3 for ring in rings)


def test_a_file_that_is_named_like_a_package_and_is_none(tmp_path: Path) -> None:
    path = tmp_path / "lots.gpkg"
    path.write_bytes(b"\xb0\x00 no database")
    with pytest.raises(InputError, match="is no GeoPackage"):
        read_lots(path)
    path.unlink()
    with pytest.raises(InputError, match="does not exist"):
        read_lots(path)


def test_a_cell_too_large_costs_nothing_but_its_row(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(package_lots, "MAX_CELL_BYTES", 5000)
    sound = cell(wkb([SQUARE]))
    rows = [(number, sound, f"lot {number}", 1.0, 0) for number in (2, 5, 9)]
    rows += [(3, sound + bytes(9000), "large", 1.0, 0), (20, sound + bytes(9000), "last", 1.0, 0)]
    found = read_lots(package(tmp_path / "lots.gpkg", rows))
    assert [lot.name for lot in found.lots] == ["lot 2", "lot 5", "lot 9"]
    told = [(failure.subject.rpartition(" ")[2], failure.reason) for failure in found.failures]
    assert told == [("2", "a cell is larger than 0 MB"), ("5", "a cell is larger than 0 MB")]
