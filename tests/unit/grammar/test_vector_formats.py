"""Lots from archives, tables, drawings and databases; roads of layers beside; what is not read."""

from __future__ import annotations

import json
import zipfile
from pathlib import Path

import numpy as np
import pyogrio
import pytest
import shapely
from tiny_pbf import pbf

from veduta.grammar.lots import Lots, read_lots
from veduta.grammar.options import LotOptions
from veduta.run.errors import InputError

METRES = (shapely.box(500_000, 5_500_000, 500_012, 5_500_009),)
DEGREES = (shapely.box(9.0, 48.0, 9.0002, 48.0001),)
ODD = (
    "+proj=lcc +lat_1=44.1 +lat_2=48.9 +lat_0=46.5 +lon_0=3.5 +x_0=700123 +y_0=6600000 +ellps=GRS80"
)
"""A projection that is like Lambert-93, and is none that has a code."""
STREET = shapely.LineString([(499_980, 5_500_020), (500_040, 5_500_020)])


def write(
    path: Path, driver: str, shapes: tuple[shapely.Geometry, ...] = METRES, **options: object
) -> Path:
    """Shapes with a height."""
    told: dict[str, object] = {"crs": "EPSG:25832", "geometry_type": "Polygon", "driver": driver}
    pyogrio.raw.write(
        path,
        np.array([shapely.to_wkb(shape) for shape in shapes], dtype=object),
        [np.array([9.0] * len(shapes))],
        ["height"],
        **(told | options),
    )
    return path


def the_lot(found: Lots, area_m2: float = 108.0) -> None:
    """One lot of this area, and its height."""
    (lot,) = found.lots
    assert shapely.Polygon(lot.rings_m[0]).area == pytest.approx(area_m2, rel=0.01)
    assert lot.attributes["height"] == 9.0


def test_a_shapefile_in_an_archive(tmp_path: Path) -> None:
    write(tmp_path / "a.shp", "ESRI Shapefile")
    with zipfile.ZipFile(tmp_path / "a.zip", "w") as archive:
        for path in sorted(tmp_path.glob("a.*")):
            if path.suffix != ".zip":
                archive.write(path, path.name)
    the_lot(read_lots(tmp_path / "a.zip"))


def test_a_geodatabase_is_a_folder(tmp_path: Path) -> None:
    the_lot(read_lots(write(tmp_path / "a.gdb", "OpenFileGDB")))
    (tmp_path / "empty.gdb").mkdir()
    with pytest.raises(InputError, match=r"empty\.gdb: cannot be read"):
        read_lots(tmp_path / "empty.gdb")


def test_an_archive_of_kml(tmp_path: Path) -> None:
    path = write(tmp_path / "a.kmz", "LIBKML", DEGREES, crs="EPSG:4326")
    the_lot(read_lots(path), 14.92 * 11.12)


@pytest.mark.parametrize("column", ["WKT", "geom", "the_geom"])
def test_a_table_with_a_column_of_wkt(tmp_path: Path, column: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f'height,{column}\n9,"{METRES[0].wkt}"\n')
    the_lot(read_lots(path))
    assert read_lots(path, LotOptions(crs="EPSG:25832")).crs == "EPSG:25832"
    path.write_text("height,x,y\n9,1,2\n")
    with pytest.raises(InputError, match="no lot that can be used"):
        read_lots(path)


def test_topojson(tmp_path: Path) -> None:
    ring = [[9, 48], [9.0002, 48], [9.0002, 48.0001], [9, 48.0001], [9, 48]]
    lot = {"type": "Polygon", "properties": {"height": 9}, "arcs": [[0]]}
    objects = {"lots": {"type": "GeometryCollection", "geometries": [lot]}}
    path = tmp_path / "a.topojson"
    path.write_text(json.dumps({"type": "Topology", "objects": objects, "arcs": [ring]}))
    the_lot(read_lots(path), 14.92 * 11.12)


def test_closed_lines_of_a_drawing_are_lots_and_open_ones_no_roads(tmp_path: Path) -> None:
    corners = "".join(f"10\n{x}\n20\n{y}\n" for x, y in [(0, 0), (12, 0), (12, 9), (0, 9)])
    closed = f"0\nLWPOLYLINE\n8\nLOTS\n90\n4\n70\n1\n{corners}"
    line = "0\nLINE\n8\nAXIS\n10\n-5\n20\n15\n11\n50\n21\n15\n"
    path = tmp_path / "a.dxf"
    path.write_text(f"0\nSECTION\n2\nENTITIES\n{closed}{line}0\nENDSEC\n0\nEOF\n")
    found = read_lots(path)
    (lot,) = found.lots
    assert shapely.Polygon(lot.rings_m[0]).area == pytest.approx(108.0)
    assert lot.attributes["Layer"] == "LOTS"
    assert not found.roads
    assert "left out, for they are no polygons: 1 open line, point or text" in found.notes


def test_the_binary_form_of_openstreetmap(tmp_path: Path) -> None:
    corners = [(9.0, 48.0), (9.0002, 48.0), (9.0002, 48.0001), (9.0, 48.0001)]
    road = [(8.9995, 47.9998), (9.0006, 47.9998)]
    building = ([1, 2, 3, 4, 1], {"building": "house", "height": "9 m", "building:levels": "3"})
    street = ([5, 6], {"highway": "residential"})
    path = tmp_path / "a.osm.pbf"
    path.write_bytes(pbf([*corners, *road], [building, street]))
    found = read_lots(path)
    (lot,) = found.lots
    assert shapely.Polygon(lot.rings_m[0]).area == pytest.approx(14.92 * 11.12, rel=0.01)
    assert lot.attributes["building:levels"] == "3"
    assert len(found.roads) == 1
    assert np.asarray(lot.rings_m[0])[:2, 1].max() < 1.0, "the front looks south, to the street"
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(InputError, match=r"a\.osm\.pbf"):
        read_lots(path)


@pytest.mark.parametrize(
    ("suffix", "driver"), [(".shp", "ESRI Shapefile"), (".fgb", "FlatGeobuf"), (".gpkg", "GPKG")]
)
def test_the_call_settles_a_crs_without_a_code(tmp_path: Path, suffix: str, driver: str) -> None:
    path = write(tmp_path / f"odd{suffix}", driver, crs=ODD)
    with pytest.raises(InputError, match=r"without EPSG code.* Give --crs"):
        read_lots(path)
    assert read_lots(path, LotOptions(crs="EPSG:2154")).crs == "EPSG:2154"


@pytest.mark.parametrize(
    ("layer", "roads", "told"),
    [("streets", 1, "1 road line says"), ("Zaun", 0, "lines of Zaun"), ("railroads", 0, "rail")],
)
def test_layers_of_roads_beside_lots(tmp_path: Path, layer: str, roads: int, told: str) -> None:
    path = write(tmp_path / "town.gpkg", "GPKG", layer="lots")
    of_lines = {"layer": layer, "geometry_type": "LineString", "append": True}
    write(path, "GPKG", (STREET,), **of_lines)
    found = read_lots(path)
    assert len(found.roads) == roads
    assert any(told in note for note in found.notes)
    assert len(read_lots(path, LotOptions(roads=path)).roads) == 1, "named, they are read once"


def test_roads_of_another_layer_in_another_crs_are_told(tmp_path: Path) -> None:
    path = write(tmp_path / "town.gpkg", "GPKG", layer="lots")
    street = shapely.LineString([(9.0, 49.65), (9.001, 49.65)])
    of_lines = {"layer": "streets", "geometry_type": "LineString", "append": True}
    write(path, "GPKG", (street,), crs="EPSG:4326", **of_lines)
    found = read_lots(path)
    assert not found.roads
    assert any("--roads" in note for note in found.notes)


def test_the_call_settles_roads_without_a_code_too(tmp_path: Path) -> None:
    lots = write(tmp_path / "odd.gpkg", "GPKG", crs=ODD)
    roads = write(tmp_path / "roads.gpkg", "GPKG", (STREET,), crs=ODD, geometry_type="LineString")
    found = read_lots(lots, LotOptions(crs="EPSG:2154", roads=roads))
    (road,) = found.roads
    north = 5_500_020 - 5_500_000
    assert road.points[:, 1].tolist() == pytest.approx([north, north])
    known = write(tmp_path / "known.gpkg", "GPKG")
    with pytest.raises(InputError, match=r"roads\.gpkg.*without EPSG code.*--crs"):
        read_lots(known, LotOptions(roads=roads))


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("a.dwg", b"AC1032\0\xff", "Save it as DXF"),
        ("a.parquet", b"PAR1\xff", "ogr2ogr -f GPKG lots.gpkg a.parquet"),
        ("a.osm.bz2", b"BZh9\xff", "bunzip2 --keep a.osm.bz2"),
        ("a.unknown", b"\xff\xfe\0", "ogr2ogr -f GPKG lots.gpkg a.unknown"),
        ("a.xml", b"<plan/>", "is XML, but of no kind that is read"),
        ("a.kmz", b"PK\3\4\xff", "cannot be read"),
        ("a.zip", b"PK\3\4\xff", "cannot be read"),
        ("a.dxf", b"0\nSECTION\n", "cannot be read"),
        ("a.citygml", b"<core:CityModel/>", "a.citygml"),
    ],
)
def test_other_formats_are_refused_with_what_converts_them(
    tmp_path: Path, name: str, content: bytes, told: str
) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_lots(tmp_path / name)
    assert told in str(caught.value)
    assert "/tmp/tmp" not in str(caught.value)


def test_xml_is_what_its_first_element_says(tmp_path: Path) -> None:
    path = tmp_path / "map.xml"
    nodes = [(48.0, 9.0), (48.0, 9.0002), (48.0001, 9.0002), (48.0001, 9.0)]
    each = [f'<node id="{n}" lat="{y}" lon="{x}"/>' for n, (y, x) in enumerate(nodes, 1)]
    refs = "".join(f'<nd ref="{n}"/>' for n in (1, 2, 3, 4, 1))
    tags = '<tag k="building" v="yes"/>'
    path.write_text(f'<osm version="0.6">{"".join(each)}<way id="7">{refs}{tags}</way></osm>')
    assert len(read_lots(path).lots) == 1
