"""CityGML 2.0 and 3.0: solids, surfaces with classes, parts, reference systems, hostile files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.formats.citygml_read import epsg_of_name, read_citygml
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

SPACES = {
    2: ("http://www.opengis.net/citygml/2.0", "http://www.opengis.net/citygml/building/2.0"),
    3: ("http://www.opengis.net/citygml/3.0", "http://www.opengis.net/citygml/building/3.0"),
}
RING = "0 0 1 0 4 1 3 4 1 3 0 1 0 0 1"


def polygon(ring: str = RING) -> str:
    return (
        "<gml:Polygon><gml:exterior><gml:LinearRing>"
        f"<gml:posList srsDimension='3'>{ring}</gml:posList>"
        "</gml:LinearRing></gml:exterior></gml:Polygon>"
    )


def city(building: str, version: int = 2, srs: str = "urn:ogc:def:crs:EPSG::25832") -> str:
    core, bldg = SPACES[version]
    construction = "http://www.opengis.net/citygml/construction/3.0"
    return (
        f"<core:CityModel xmlns:core='{core}' xmlns:bldg='{bldg}' xmlns:con='{construction}'"
        " xmlns:gml='http://www.opengis.net/gml' xmlns:xlink='http://www.w3.org/1999/xlink'>"
        f"<gml:boundedBy><gml:Envelope srsName='{srs}'/></gml:boundedBy>"
        f"<core:cityObjectMember>{building}</core:cityObjectMember></core:CityModel>"
    )


def solid(level: int, prefix: str, faces: str) -> str:
    return (
        f"<{prefix}:lod{level}Solid><gml:Solid><gml:exterior><gml:CompositeSurface>"
        f"<gml:surfaceMember>{faces}</gml:surfaceMember>"
        f"</gml:CompositeSurface></gml:exterior></gml:Solid></{prefix}:lod{level}Solid>"
    )


DIMENSION = "DIMENSION"
FLAT = solid(1, "bldg", polygon().replace("srsDimension='3'", f"srsDimension='{DIMENSION}'"))


def write(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "city.gml"
    path.write_text(text)
    return path


@pytest.mark.parametrize(("version", "prefix"), [(2, "bldg"), (3, "core")])
def test_a_solid(tmp_path: Path, version: int, prefix: str) -> None:
    inner = f"<bldg:measuredHeight>7.5</bldg:measuredHeight>{solid(1, prefix, polygon())}"
    text = city(f"<bldg:Building gml:id='b1'>{inner}</bldg:Building>", version)
    found = read_citygml(write(tmp_path, text))
    assert found.epsg == 25832
    (building,) = found.buildings
    assert (building.id, building.lod, building.solid) == ("b1", "1", True)
    assert building.attributes["measuredHeight"] == 7.5
    corners = [[0, 0, 1], [0, 4, 1], [3, 4, 1], [3, 0, 1]]
    assert building.polygons[0][0].tolist() == corners


@pytest.mark.parametrize(
    ("version", "opening", "closing", "level"),
    [
        (2, "<bldg:boundedBy><bldg:WallSurface>", "</bldg:WallSurface></bldg:boundedBy>", "bldg"),
        (3, "<core:boundary><con:WallSurface>", "</con:WallSurface></core:boundary>", "core"),
    ],
)
def test_surfaces_have_classes_and_the_finest_level_counts(
    tmp_path: Path, version: int, opening: str, closing: str, level: str
) -> None:
    surface = (
        f"{opening}<{level}:lod2MultiSurface><gml:MultiSurface><gml:surfaceMember>{polygon()}"
        f"</gml:surfaceMember></gml:MultiSurface></{level}:lod2MultiSurface>{closing}"
    )
    reference = f"<{level}:lod2Solid><gml:surfaceMember xlink:href='#p'/></{level}:lod2Solid>"
    coarse = solid(1, level, polygon() + polygon())
    text = city(f"<bldg:Building>{coarse}{surface}{reference}</bldg:Building>", version)
    (building,) = read_citygml(write(tmp_path, text)).buildings
    assert building.lod == "2"
    assert building.classes == (SemanticClass.WALL,)


def test_parts_are_buildings_and_their_whole_is_not_missed(tmp_path: Path) -> None:
    part = f"<bldg:BuildingPart gml:id='p1'>{solid(1, 'bldg', polygon())}</bldg:BuildingPart>"
    whole = f"<bldg:consistsOfBuildingPart>{part}</bldg:consistsOfBuildingPart>"
    found = read_citygml(write(tmp_path, city(f"<bldg:Building>{whole}</bldg:Building>")))
    assert [one.id for one in found.buildings] == ["p1"]
    assert found.left == ()


def test_latitude_comes_second(tmp_path: Path) -> None:
    text = city(
        f"<bldg:Building>{solid(1, 'bldg', polygon('52 4 0 52 5 0 53 5 0'))}</bldg:Building>",
        srs="urn:ogc:def:crs:EPSG::4326",
    )
    (building,) = read_citygml(write(tmp_path, text)).buildings
    assert np.array_equal(building.polygons[0][0][0], [4, 52, 0])


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("EPSG:28992", 28992),
        ("urn:ogc:def:crs:EPSG:6.12:31256", 31256),
        ("http://www.opengis.net/def/crs/EPSG/0/7415", 7415),
        ("urn:ogc:def:crs,crs:EPSG::25833,crs:EPSG::5783", 25833),
        ("urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", 25832),
        ("urn:adv:crs:DE_DHDN_3GK3", 31467),
        ("local", None),
    ],
)
def test_names_of_reference_systems(name: str, code: int | None) -> None:
    assert epsg_of_name(name) == code


@pytest.mark.parametrize(("outer", "is_read"), [("3", True), ("2", False)])
def test_a_dimension_holds_within_its_element(tmp_path: Path, outer: str, is_read: bool) -> None:
    """That of an envelope says nothing of the polygons behind it; that of a solid does."""
    faces = solid(1, "bldg", polygon().replace(" srsDimension='3'", ""))
    faces = faces.replace("<gml:Solid>", f"<gml:Solid srsDimension='{outer}'>")
    envelope = "<gml:boundedBy><gml:Envelope srsDimension='2'><gml:pos>0 0</gml:pos></gml:Envelope>"
    text = city(f"<bldg:Building>{envelope}</gml:boundedBy>{faces}</bldg:Building>")
    text = text.replace("<gml:Envelope srsName", "<gml:Envelope srsDimension='2' srsName")
    if is_read:
        (building,) = read_citygml(write(tmp_path, text)).buildings
        assert building.polygons[0][0].tolist() == [[0, 0, 1], [0, 4, 1], [3, 4, 1], [3, 0, 1]]
    else:
        with pytest.raises(InputError, match="dimensions"):
            read_citygml(write(tmp_path, text))


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", "DOCTYPE"),
        ("<a/>", "no CityModel"),
        ("<a>", "is no XML"),
        ("<a>" * 300, "deeper"),
        (city(f"<bldg:Building>{solid(1, 'bldg', polygon('1 2 x'))}</bldg:Building>"), "no number"),
        (city(f"<bldg:Building>{solid(1, 'bldg', polygon('1 2'))}</bldg:Building>"), "dimensions"),
        ("<?xml version='1.0' encoding='shift_jis'?><a/>", "encoding"),
        ("<?xml version='1.0' encoding='no-such'?><a/>", "encoding"),
        (city(f"<bldg:Building>{FLAT.replace(DIMENSION, '²')}</bldg:Building>"), "dimensions"),
        (city(f"<bldg:Building>{FLAT.replace(DIMENSION, 5000 * '9')}</bldg:Building>"),
         "dimensions"),
    ],
)  # fmt: skip
def test_hostile_and_broken_files_are_refused(tmp_path: Path, text: str, fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        read_citygml(write(tmp_path, text))
