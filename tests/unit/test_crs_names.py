"""How coordinate reference systems are named, against PROJ's registry."""

from __future__ import annotations

import pyproj
import pytest

from veduta.geometry.crs import epsg_named


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("EPSG:25832", 25832),
        ("EPSG: 32632", 32632),
        ("epsg 2154", 2154),
        ("urn:ogc:def:crs:EPSG::28992", 28992),
        ("urn:ogc:def:crs:EPSG:6.9:2154", 2154),
        ("https://www.opengis.net/def/crs/EPSG/0/7415", 7415),
        ("http://www.opengis.net/gml/srs/epsg.xml#4326", 4326),
        ("urn:ogc:def:crs:OGC:1.3:CRS84", 4326),
        ("urn:ogc:def:crs:OGC::CRS84", 4326),
        ("WGS84", 4326),
        ("WGS84 UTM 32N", 32632),
        ("WGS 84 / UTM zone 56S", 32756),
        ("+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs", 32631),
    ],
)
def test_names_that_people_write(text: str, code: int) -> None:
    assert epsg_named(text) == code


@pytest.mark.parametrize("code", [2154, 25832, 28992, 31370, 2056, 27700, 5514])
@pytest.mark.parametrize("version", ["WKT1_ESRI", "WKT1_GDAL", "WKT2_2019"])
def test_definitions_as_in_prj_files(code: int, version: str) -> None:
    found = epsg_named(pyproj.CRS.from_epsg(code).to_wkt(version))
    assert found is not None
    assert pyproj.CRS.from_epsg(found).equals(pyproj.CRS.from_epsg(code), ignore_axis_order=True)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "metres",
        "EPSG:999999",
        "EPSG:12",
        "WGS84 UTM 99N",
        "EPSG:25832 or so",
        "+proj=nothing",
        "[" * 5000,
        "W" * 50_000,
    ],
)
def test_what_names_none(text: str) -> None:
    assert epsg_named(text) is None
