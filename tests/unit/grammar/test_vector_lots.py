"""Lots from formats that GDAL reads, and what people call their attributes."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyogrio
import pytest
import shapely

from veduta.grammar.deriving import as_kind
from veduta.grammar.frames import given_crs
from veduta.grammar.lot_names import measured, property_of, read_names
from veduta.grammar.lots import read_lots
from veduta.grammar.options import LotOptions
from veduta.run.errors import InputError

DRIVERS = {
    ".shp": "ESRI Shapefile",
    ".fgb": "FlatGeobuf",
    ".tab": "MapInfo File",
    ".gml": "GML",
}
HOLED = shapely.Polygon([(0, 0), (20, 0), (20, 10), (0, 10)], [[(4, 4), (8, 4), (8, 8), (4, 8)]])
PLAIN = shapely.box(30, 0, 42, 9)


def written(path: Path, crs: str | None = "EPSG:25832", east_m: float = 500_000.0) -> Path:
    """Two lots of 200 - 16 and 108 m2, far from the CRS's origin."""
    moved = shapely.transform(
        np.array([HOLED, PLAIN]), lambda xy: xy + np.array([east_m, 5_500_000.0])
    )
    pyogrio.raw.write(
        path,
        geometry=shapely.to_wkb(moved),
        field_data=[np.array([12.5, 9.0]), np.array(["a", "b"], dtype=object)],
        fields=["hauteur", "name"],
        geometry_type="Polygon",
        crs=crs,
        driver=DRIVERS[path.suffix],
    )
    return path


def area_of(rings: tuple[np.ndarray, ...]) -> float:
    return float(shapely.Polygon(rings[0], list(rings[1:])).area)


@pytest.mark.parametrize("suffix", DRIVERS)
def test_polygons_with_their_holes_and_attributes(tmp_path: Path, suffix: str) -> None:
    found = read_lots(written(tmp_path / f"lots{suffix}"))
    assert found.crs == "EPSG:25832"
    # FlatGeobuf has an order of its own, and GML gives ids of its own.
    lots = {lot.attributes["name"]: lot for lot in found.lots}
    assert area_of(lots["a"].rings_m) == pytest.approx(184.0, abs=1e-3)
    assert area_of(lots["b"].rings_m) == pytest.approx(108.0, abs=1e-3)
    assert {name: lot.attributes["hauteur"] for name, lot in lots.items()} == {"a": 12.5, "b": 9.0}


def test_features_by_line(tmp_path: Path) -> None:
    path = tmp_path / "lots.geojsonl"
    ring = "[[9.0,48.0],[9.0002,48.0],[9.0002,48.0001],[9.0,48.0001],[9.0,48.0]]"
    shape = f'"geometry":{{"type":"Polygon","coordinates":[{ring}]}}'
    heights = ("12.5", "null")
    rows = [f'{{"type":"Feature","properties":{{"height":{h}}},{shape}}}' for h in heights]
    path.write_text("\n".join(rows))
    first, second = read_lots(path).lots
    assert (first.attributes.get("height"), second.attributes.get("height")) == (12.5, None)
    assert area_of(first.rings_m) == pytest.approx(14.92 * 11.12, rel=0.01)


@pytest.mark.filterwarnings("ignore:.crs. was not provided")
def test_a_crs_that_is_given_settles_what_a_file_leaves_open(tmp_path: Path) -> None:
    path = written(tmp_path / "lots.shp", crs=None)
    assert read_lots(path).crs is None
    assert read_lots(path, LotOptions(crs="EPSG:25832")).crs == "EPSG:25832"
    assert given_crs("EPSG: 32632") == 32632
    with pytest.raises(InputError, match="is no CRS with an EPSG code"):
        read_lots(path, LotOptions(crs="Lambert"))


OSM = """<?xml version="1.0"?><osm version="0.6">
<node id="1" lat="48.0" lon="9.0" version="1"/><node id="2" lat="48.0" lon="9.0002" version="1"/>
<node id="3" lat="48.0001" lon="9.0002" version="1"/>
<node id="4" lat="48.0001" lon="9.0" version="1"/>
<way id="7" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/>
<tag k="building" v="house"/><tag k="building:levels" v="3"/><tag k="height" v="9 m"/></way>
<way id="8" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/>
<tag k="landuse" v="grass"/></way></osm>"""


def test_buildings_of_openstreetmap_with_all_their_tags(tmp_path: Path) -> None:
    path = tmp_path / "map.osm"
    path.write_text(OSM)
    found = read_lots(path)
    (lot,) = found.lots
    assert lot.attributes["building:levels"] == "3"
    assert property_of("levels", lot.attributes, {}) == "3"
    assert as_kind(property_of("height", lot.attributes, {}) or "", "number") == 9.0
    assert any("area without the tag building" in note for note in found.notes)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("cut.osm", OSM[:420].encode()),
        ("cut.fgb", b"fgb\3fgb\0 and no more"),
        ("cut.shp", b"\0\0\x27\x0a"),
        ("cut.kml", b"<kml><Placemark>"),
    ],
)
def test_files_that_are_cut_are_refused_by_name(tmp_path: Path, name: str, content: bytes) -> None:
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=name):
        read_lots(tmp_path / name)


@pytest.mark.parametrize("suffix", [".kml", ".osm", ".geojsonl"])
def test_nothing_is_read_that_a_file_names(tmp_path: Path, suffix: str) -> None:
    """GDAL tells formats by their content, and a VRT reads whatever other file it names."""
    path = naming_another(tmp_path / f"lots{suffix}")
    with pytest.raises(InputError, match=f"lots{suffix}"):
        read_lots(path)


def naming_another(path: Path) -> Path:
    """A VRT under another name."""
    secret = written(path.with_name("secret.fgb"))
    path.write_text(
        f'<OGRVRTDataSource><OGRVRTLayer name="secret"><SrcDataSource>{secret}</SrcDataSource>'
        "</OGRVRTLayer></OGRVRTDataSource>"
    )
    return path


def test_nor_where_gdal_was_loaded_before_veduta(tmp_path: Path) -> None:
    """GDAL settles its formats when it is loaded, here by the caller; another process reads."""
    path = naming_another(tmp_path / "lots.kml")
    script = (
        "import pathlib, sys, pyogrio; path = pathlib.Path(sys.argv[1]);"
        "print(len(pyogrio.list_layers(path)));"
        "from veduta.grammar.lots import read_lots; read_lots(path)"
    )
    clean = {name: value for name, value in os.environ.items() if name != "GDAL_SKIP"}
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)], env=clean, capture_output=True, text=True
    )
    assert done.stdout == "1\n"  # GDAL by itself reads it
    assert "InputError" in done.stderr
    assert "lots.kml" in done.stderr


def test_a_file_of_points_has_no_lots(tmp_path: Path) -> None:
    path = tmp_path / "a.fgb"
    pyogrio.raw.write(
        path, shapely.to_wkb(np.array([shapely.Point(1, 2)])), [np.array([1.0])], ["h"],
        geometry_type="Point", crs="EPSG:25832", driver="FlatGeobuf",
    )  # fmt: skip
    with pytest.raises(InputError, match="no layer of polygons"):
        read_lots(path)


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        ("12", 12.0), ("12 m", 12.0), ("12,5m", 12.5), ("40'", 12.192), ("40 ft", 12.192),
        ("6' 6\"", 1.9812), ("350 cm", 3.5), ("2 metres", 2.0), ("1 foot", 0.3048),
        ("high", None), ("", None), ("3-4", None), ("10 storeys", None),
    ],
)  # fmt: skip
def test_lengths_as_people_write_them(text: str, metres: float | None) -> None:
    assert measured(text) == (None if metres is None else pytest.approx(metres))


def test_names_of_the_call_come_before_those_of_the_file_and_the_usual_ones() -> None:
    lot = {"height": 5.0, "hauteur": 7.0, "building:levels": "2"}
    assert read_names(["height=hauteur,levels=n"]) == {"height": "hauteur", "levels": "n"}
    assert property_of("height", lot, {"height": "hauteur"}) == 7.0
    assert property_of("height", lot, {}) == 5.0
    assert property_of("floors", lot, {}) == "2"
    assert property_of("height", {"hauteur": 7.0}, {}) == 7.0
    assert property_of("colour", lot, {}) is None
    with pytest.raises(InputError, match="--map height"):
        read_names(["height"])


def test_the_call_says_in_which_unit_bare_numbers_are() -> None:
    names = read_names(["height=HEIGHTROOF[ft], levels=n"])
    assert names == {"height": "HEIGHTROOF[ft]", "levels": "n"}
    assert property_of("height", {"HEIGHTROOF": 100.0}, names) == pytest.approx(30.48)
    assert property_of("height", {"HEIGHTROOF": "100"}, names) == pytest.approx(30.48)
    assert property_of("height", {"HEIGHTROOF": "12 m"}, names) == "12 m", (
        "a unit of its own counts"
    )
    assert property_of("height", {"HEIGHTROOF": None}, names) is None
    assert property_of("height", {"top [cm]": 7.0}, {"height": "top [cm]"}) == 7.0, "its own name"
    with pytest.raises(InputError, match="'cubits'"):
        read_names(["height=top[cubits]"])


def test_usual_names_are_known_in_any_case_and_with_umlauts() -> None:
    assert property_of("height", {"Höhe": "14,5 m"}, {}) == "14,5 m"
    assert property_of("height", {"Ho\u0308he": 31.5}, {}) == 31.5
    assert property_of("height", {"HEIGHTROOF": 100.0}, {}) is None  # of feet, as cities give it
    assert property_of("levels", {"NumFloors": 4, "floor_area": 900}, {}) == 4
    assert property_of("levels", {"Nb-Etages": 3}, {}) == 3
    assert property_of("height", {"heights": 9.0, "roof_height": 3.0}, {}) is None
    assert property_of("colour", {"Colour": "red"}, {}) is None, "own names are those of the file"


@pytest.mark.parametrize(
    ("crs", "corner", "unit_m"),
    [("EPSG:2263", (988_000.0, 210_000.0), 1200 / 3937), ("EPSG:4267", (-73.99, 40.74), None)],
)
def test_systems_in_feet_and_other_degrees_become_metres(
    tmp_path: Path, crs: str, corner: tuple[float, float], unit_m: float | None
) -> None:
    """A lot of 12 x 9 m in New York, in a system that counts otherwise."""
    across = (111_320 * np.cos(np.radians(corner[1])), 111_000) if unit_m is None else None
    size = (12 / across[0], 9 / across[1]) if across else (12 / unit_m, 9 / unit_m)
    lot = shapely.box(*corner, corner[0] + size[0], corner[1] + size[1])
    path = tmp_path / "lots.fgb"
    geometry, none = np.array([shapely.to_wkb(lot)], dtype=object), np.array([], dtype=str)
    pyogrio.raw.write(path, geometry, [], none, geometry_type="Polygon", crs=crs)
    lots = read_lots(path)
    assert lots.crs == "EPSG:32618"
    assert any("does not count in metres" in note for note in lots.notes)
    ring = np.asarray(lots.lots[0].rings_m[0])
    sides = np.sort(np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1))
    np.testing.assert_allclose(sides, [9, 9, 12, 12], rtol=0.01)
    east, north = lots.origin_m[:2]
    assert abs(east - 585_000) < 3000
    assert abs(north - 4_510_000) < 8000


def test_one_lot_far_off_does_not_move_the_zone_of_a_file_in_feet(tmp_path: Path) -> None:
    """Three at 72.3 degrees west, in the zone that ends at 72, and one 110 km to the east."""
    east = [1_456_000.0, 1_456_100.0, 1_456_200.0, 1_816_000.0]
    lots = [shapely.to_wkb(shapely.box(x, 210_000.0, x + 40, 210_030.0)) for x in east]
    geometry, none = np.array(lots, dtype=object), np.array([], dtype=str)
    path = tmp_path / "lots.fgb"
    pyogrio.raw.write(path, geometry, [], none, geometry_type="Polygon", crs="EPSG:2263")
    found = read_lots(path)
    assert found.crs == "EPSG:32618", "the middle of the box around all lies in the zone 19"
    assert any("[ft]" in note for note in found.notes)


def test_lines_of_a_kml_file_say_where_fronts_are(tmp_path: Path) -> None:
    def places(*points: tuple[float, float]) -> str:
        return " ".join(f"{8.54 + x / 75_000:.8f},{47.37 + y / 111_000:.8f},0" for x, y in points)

    outline = places((0, 0), (12, 0), (12, 10), (0, 10), (0, 0))
    line = places((-20, 15), (40, 15))
    (tmp_path / "lots.kml").write_text(
        '<kml xmlns="http://www.opengis.net/kml/2.2"><Document><name>a</name>'
        "<Placemark><name>house</name><Polygon><outerBoundaryIs><LinearRing><coordinates>"
        f"{outline}</coordinates></LinearRing></outerBoundaryIs></Polygon></Placemark>"
        f"<Placemark><LineString><coordinates>{line}</coordinates></LineString></Placemark>"
        "</Document></kml>"
    )
    lots = read_lots(tmp_path / "lots.kml")
    assert "1 road line says where the fronts of lots are" in lots.notes
    front = np.asarray(lots.lots[0].rings_m[0])[:2]
    assert front[:, 1].min() > 5, "the front looks north, to the line"
