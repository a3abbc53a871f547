"""Lots, edits and terrains that broke readers: the file is named, with what to do."""

from __future__ import annotations

import json
import sqlite3
from pathlib import Path

import numpy as np
import pytest
from PIL import Image, TiffImagePlugin

from veduta.grammar.edits import read_edits
from veduta.grammar.lots import read_lots
from veduta.grammar.terrain import read_terrain
from veduta.run.errors import InputError

SQUARE = [[0, 0, 0], [10_000, 0, 0], [10_000, 8_000, 0], [0, 8_000, 0]]


def test_obj_with_a_number_beyond_64_bits(tmp_path: Path) -> None:
    path = tmp_path / "lots.obj"
    path.write_text("o a\nv 0 0 0\nv 9 0 0\nv 9 0 -8\nf 1 2 9999999999999999999999\n")
    with pytest.raises(InputError, match=r"lots\.obj: has no lot .*names a vertex that is not"):
        read_lots(path)


@pytest.mark.parametrize("height", ["1e308", "-1e308", "1e12"])
def test_obj_with_a_height_beyond_the_earth(height: str, tmp_path: Path) -> None:
    path = tmp_path / "lots.obj"
    path.write_text(f"o a\nv 0 {height} 0\nv 9 0 0\nv 9 0 -8\nv 0 0 -8\nf 1 2 3 4\n")
    with pytest.raises(InputError, match=r"lots\.obj: has heights that are no metres on Earth"):
        read_lots(path)


@pytest.mark.parametrize("kind", [[], {}, 3, None])
def test_cityjson_with_a_type_that_is_no_word(kind: object, tmp_path: Path) -> None:
    geometry = [{"type": "MultiSurface", "lod": "0", "boundaries": [[[0, 1, 2, 3]]]}]
    document = {
        "type": "CityJSON",
        "version": "2.0",
        "transform": {"scale": [0.001] * 3, "translate": [0, 0, 0]},
        "CityObjects": {
            "a": {"type": kind, "geometry": geometry},
            "b": {"type": "Building", "geometry": geometry},
        },
        "vertices": SQUARE,
    }
    path = tmp_path / "town.city.json"
    path.write_text(json.dumps(document))
    assert [lot.id for lot in read_lots(path).lots] == ["b"]


def test_geopackage_with_a_name_that_is_not_utf8(tmp_path: Path) -> None:
    path = tmp_path / "lots.gpkg"
    base = sqlite3.connect(path)
    base.execute("PRAGMA application_id = 1196444487")
    base.execute(
        "CREATE TABLE gpkg_geometry_columns"
        " (table_name, column_name, geometry_type_name, srs_id, z, m)"
    )
    base.execute('CREATE TABLE "abcd" (id, geom)')
    base.execute("INSERT INTO gpkg_geometry_columns VALUES ('abcd', 'geom', 'POLYGON', 0, 0, 0)")
    base.commit()
    base.close()
    path.write_bytes(path.read_bytes().replace(b"abcd", b"ab\xff\xfe"))
    with pytest.raises(InputError, match=r"lots\.gpkg: "):
        read_lots(path)


def test_edits_with_a_number_of_5000_digits(tmp_path: Path) -> None:
    path = tmp_path / "edits.txt"
    path.write_text(f"lot0 /{'9' * 5000} delete\n")
    with pytest.raises(InputError, match=r"edits\.txt: line 1: .* is no path"):
        read_edits(path)


@pytest.mark.parametrize(
    ("scale", "tie"),
    [
        ((1e-300, 1.0, 0.0), (0.0, 0.0, 0.0, 5e5, 5e6, 0.0)),
        ((1.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1e300, 5e6, 0.0)),
        ((1.0, 1.0, 0.0), (0.0, 0.0, 0.0, float("nan"), 5e6, 0.0)),
        ((1.0,), (0.0, 0.0, 0.0, 5e5, 5e6, 0.0)),
        ((1.0, 1.0, 0.0), (0.0, 0.0)),
    ],
)
def test_terrain_that_lies_nowhere(
    scale: tuple[float, ...], tie: tuple[float, ...], tmp_path: Path
) -> None:
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    for number, values in ((33550, scale), (33922, tie)):
        tags[number] = values
        tags.tagtype[number] = 12
    tags[34735] = (1, 1, 0, 1, 3072, 0, 1, 25832)
    tags.tagtype[34735] = 3
    path = tmp_path / "terrain.tif"
    Image.fromarray(np.ones((4, 4), dtype=np.float32)).save(path, tiffinfo=tags)
    with pytest.raises(InputError, match=r"terrain\.tif: "):
        read_terrain(path, "EPSG:25832")
