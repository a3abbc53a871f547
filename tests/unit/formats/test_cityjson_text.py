"""CityJSON from the texts of geometry: what closes is a Solid, and vertices are shared."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

from veduta import _core
from veduta.formats.cityjson_joined import write_joined
from veduta.formats.cityjson_text import (
    CLASSES,
    KINDS,
    Tint,
    feature_line,
    forms_of,
    header,
)

BOX = """
Lot --> extrude(world.up, 3) comp(f) { top : Roof | bottom : Floor | all : Wall }
Wall --> set(material.name, "wall") W.
Roof --> set(material.name, "roof") R.
Floor --> set(material.name, "ground") F.
"""
OPEN = BOX.replace("bottom : Floor", "bottom : NIL")
SHELF = """
Lot --> extrude(world.up, 3) comp(f) { front : Front | all : NIL }
Front --> [ set(material.name, "wall") W. ] t(0, 1, 0.001) s('1, 0.2, 0) Shelf
Shelf --> set(material.name, "cornice") extrude(0.3)
"""
SQUARE = [[(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 5.0, 0.0), (0.0, 5.0, 0.0)]]


def no_image(number: int, tint: Tint) -> str:
    raise AssertionError((number, tint))


def line(rules: str, name: str = "a", x: float = 0.0) -> dict[str, Any]:
    derived = _core.derive_lots(
        _core.GrammarRules([("a.cga", rules)]), [SQUARE], [0], attributes=[{}], edits=[[]]
    )
    assert derived.fault(0) is None
    text = feature_line(
        name, {"street": 'Rue "A"'}, derived.city(0, (x, 0.0, 0.0), CLASSES, KINDS), no_image
    )
    assert text is not None
    feature: dict[str, Any] = json.loads(text)
    return feature


def test_a_closed_box_is_a_solid() -> None:
    feature = line(BOX)
    (geometry,) = feature["CityObjects"]["a"]["geometry"]
    assert geometry["type"] == "Solid"
    (shell,) = geometry["boundaries"]
    assert len(shell) == 6
    assert sorted(feature["vertices"]) == [
        [x, y, z] for x in (0, 4000) for y in (0, 5000) for z in (0, 3000)
    ]
    (values,) = geometry["semantics"]["values"]
    kinds = [geometry["semantics"]["surfaces"][value]["type"] for value in values]
    assert sorted(kinds) == ["GroundSurface", "RoofSurface", *["WallSurface"] * 4]
    points = np.array(feature["vertices"]) / 1000
    volume = sum(
        float(np.dot(points[face[0][0]], np.cross(points[face[0][k]], points[face[0][k + 1]]))) / 6
        for face in shell
        for k in range(1, len(face[0]) - 1)
    )
    assert volume == 60.0  # seen from outside


def test_an_open_one_is_a_surface() -> None:
    (geometry,) = line(OPEN)["CityObjects"]["a"]["geometry"]
    assert (geometry["type"], len(geometry["boundaries"])) == ("MultiSurface", 5)


def test_a_cornice_is_an_installation() -> None:
    objects = line(SHELF)["CityObjects"]
    assert objects["a"]["children"] == ["a/0"]
    part = objects["a/0"]
    assert (part["type"], part["parents"]) == ("BuildingInstallation", ["a"])
    assert part["geometry"][0]["type"] == "Solid"
    assert part["attributes"]["class"] == "cornice"


def test_neighbours_share_vertices(tmp_path: Path) -> None:
    piece = tmp_path / "piece.jsonl"
    both = [line(BOX, "a"), line(BOX, "b", x=4.0)]
    piece.write_text("".join(json.dumps(one) + "\n" for one in both))
    write_joined(tmp_path / "city.json", header("t", "EPSG:28992", (1.0, 2.0, 3.0)), [piece])
    city = json.loads((tmp_path / "city.json").read_text())
    assert len(city["vertices"]) == 12  # of sixteen, four are shared
    assert city["metadata"]["referenceSystem"].endswith("/EPSG/0/28992")
    for name, feature in zip("ab", both, strict=True):
        shell = feature["CityObjects"][name]["geometry"][0]["boundaries"][0]
        joined = city["CityObjects"][name]["geometry"][0]["boundaries"][0]
        for face, same in zip(shell, joined, strict=True):
            told = [feature["vertices"][vertex] for vertex in face[0]]
            assert told == [city["vertices"][vertex] for vertex in same[0]]


HOUSE = """
Lot --> extrude(world.up, 3) comp(f) { top : roofGable(45) R | bottom : NIL | all : Wall }
Wall --> set(material.name, "wall") W.
R --> comp(f) { bottom : NIL | all : set(material.name, "roof") Roof. }
"""


def volumes(rules: str) -> tuple[dict[str, Any], dict[str, trimesh.Trimesh]]:
    """The line of a lot whose lowest level is what these rules make, and its solids by LoD."""
    derived = _core.derive_lots(
        _core.GrammarRules([("a.cga", rules)]), [SQUARE], [0], attributes=[{}], edits=[[]]
    )
    assert derived.fault(0) is None
    texts = derived.city(0, (0.0, 0.0, 0.0), CLASSES, KINDS, volumes=derived)
    feature = json.loads(feature_line("a", {}, texts, no_image) or "")
    points = np.array(feature["vertices"]) / 1000
    found = {}
    for geometry in feature["CityObjects"]["a"]["geometry"][1:]:
        assert geometry["type"] == "Solid"
        (shell,) = geometry["boundaries"]
        assert all(len(face) == 1 for face in shell)
        triangles = [
            (ring[0], ring[k], ring[k + 1]) for (ring,) in shell for k in range(1, len(ring) - 1)
        ]
        found[geometry["lod"]] = trimesh.Trimesh(points, triangles, process=False)
    return feature, found


def test_volumes_are_closed_solids() -> None:
    """A house of 4 m by 5 m, 3 m high, under a roof of 45 degrees: 2 m more."""
    feature, solids = volumes(HOUSE)
    assert sorted(solids) == ["1.2", "2.2"]
    assert all(solid.is_watertight and solid.is_winding_consistent for solid in solids.values())
    assert np.isclose(solids["1.2"].volume, 4 * 5 * 5)
    assert np.isclose(solids["2.2"].volume, 4 * 5 * 3 + 4 * 2 / 2 * 5)
    vertices = [tuple(vertex) for vertex in feature["vertices"]]
    assert len(set(vertices)) == len(vertices)
    for geometry in feature["CityObjects"]["a"]["geometry"][1:]:
        kinds = [surface["type"] for surface in geometry["semantics"]["surfaces"]]
        (values,) = geometry["semantics"]["values"]
        normals = solids[geometry["lod"]]
        assert len(values) == len(geometry["boundaries"][0])
        assert [kinds[value] for value in values].count("GroundSurface") == 1
        assert normals.volume > 0


def test_what_has_no_ground_has_no_volume() -> None:
    """Two walls enclose nothing."""
    walls = "Lot --> extrude(3) comp(f) { front : W. | back : W. | all : NIL }"
    _, solids = volumes(walls)
    assert solids == {}


def test_forms_are_those_of_the_building() -> None:
    derived = _core.derive_lots(
        _core.GrammarRules([("a.cga", BOX)]), [SQUARE], [0], attributes=[{}], edits=[[]]
    )
    texts = derived.city(0, (0.0, 0.0, 0.0), CLASSES, KINDS, volumes=derived)
    assert forms_of(texts) == ["Solid 3", "Solid 2.2"]


SHOWN = """
Lot --> extrude(world.up, 3) comp(f) { front : Front | top : Roof | all : NIL }
Front --> set(material.name, "wall") color("#808080") setupProjection(0, scope.xy, 2, 1)
    projectUV(0) texture("brick.jpg") F.
Roof --> set(material.name, "roof") color("#402010") R.
"""


def shown(name: str, x: float) -> dict[str, Any]:
    derived = _core.derive_lots(
        _core.GrammarRules([("a.cga", SHOWN)]), [SQUARE], [0], attributes=[{}], edits=[[]]
    )
    assert derived.fault(0) is None
    known = [("other.jpg", (1.0, 1.0, 1.0)), ("brick.jpg", (0.5, 0.25, 0.25))]
    texts = derived.city(0, (x, 0.0, 0.0), CLASSES, KINDS, known)
    made: dict[str, Any] = json.loads(
        feature_line(name, {}, texts, lambda number, tint: f"{number}-{tint}.jpg") or ""
    )
    return made


def corners_of(city: dict[str, Any], name: str) -> dict[tuple[float, ...], list[float]]:
    """Where each corner (mm, from the left of the front) of the face with a picture lies on it."""
    (geometry,) = city["CityObjects"][name]["geometry"]
    at = city["appearance"]["vertices-texture"]
    found = {}
    for face, mapped in zip(
        geometry["boundaries"], geometry["texture"]["rules"]["values"], strict=True
    ):
        for ring, (picture, *corners) in zip(face, mapped, strict=True):
            if picture is None:
                assert corners == []
                continue
            assert city["appearance"]["textures"][picture]["image"].startswith("1-(127")
            for vertex, corner in zip(ring, corners, strict=True):
                x, _, z = city["vertices"][vertex]
                found[x % 10_000, z] = at[corner]
    return found


def test_a_picture_lies_as_the_rules_say() -> None:
    """Four metres by three, of a picture of two metres by one."""
    feature = shown("a", 0.0)
    assert corners_of(feature, "a") == {
        (0, 0): [0, 0],
        (4000, 0): [2, 0],
        (4000, 3000): [2, 3],
        (0, 3000): [0, 3],
    }
    looks = feature["appearance"]
    assert looks["default-theme-texture"] == looks["default-theme-material"] == "rules"
    assert [one["image"] for one in looks["textures"]] == ["1-(127, 127, 127).jpg"]
    (geometry,) = feature["CityObjects"]["a"]["geometry"]
    kinds = [
        geometry["semantics"]["surfaces"][value]["type"]
        for value in geometry["semantics"]["values"]
    ]
    names = [looks["materials"][row]["name"] for row in geometry["material"]["rules"]["values"]]
    told = dict(zip(kinds, names, strict=True))
    assert told == {"WallSurface": "#402020", "RoofSurface": "#402010"}  # of afar: half, a quarter


def test_neighbours_share_pictures_and_keep_their_own_corners(tmp_path: Path) -> None:
    piece = tmp_path / "piece.jsonl"
    piece.write_text("".join(json.dumps(shown(n, x)) + "\n" for n, x in (("a", 0), ("b", 10))))
    write_joined(tmp_path / "city.json", header("t", None, (0.0, 0.0, 0.0)), [piece])
    city = json.loads((tmp_path / "city.json").read_text())
    assert len(city["appearance"]["textures"]) == 1
    assert len(city["appearance"]["materials"]) == 2
    assert corners_of(city, "a") == corners_of(city, "b") == corners_of(shown("a", 0), "a")


def test_a_line_without_pictures_names_no_textures() -> None:
    feature = line(BOX)
    assert "textures" not in feature["appearance"]
    assert len(feature["appearance"]["materials"]) == 1
