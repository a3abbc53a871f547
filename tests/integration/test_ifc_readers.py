"""`house.ifc` by web-ifc and by ifcopenshell: both find the same, and what was written."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections import Counter
from itertools import pairwise
from pathlib import Path
from typing import Any

import ifcopenshell
import ifcopenshell.geom
import ifcopenshell.util.element
import ifcopenshell.util.shape
import numpy as np
import pytest
from sample_plan import (
    DEPTH_M,
    HEIGHT_M,
    INNER_M,
    OUTER_M,
    WIDTH_M,
    rectangle,
    sample_plan,
    sample_storey,
)

from veduta.plan.document import Furniture, Light, Stairs
from veduta.plan.house.build import build_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.ifc import house_ifc

ROOT = Path(__file__).resolve().parents[2]
COUNTER = Path(__file__).with_name("ifc_counter.mjs")
SHOWN = ("IfcWall", "IfcDoor", "IfcWindow", "IfcSlab", "IfcRoof", "IfcStairFlight", "IfcFurniture")
"""Classes whose extents are compared: openings and spaces are drawn by one reader alone."""


def _thing(name: str, kind: str, room: str, x: float, **more: object) -> Furniture:
    values = {"id": name, "object": kind, "room": room, "at_m": (x, 4.2)}
    return Furniture.model_validate({**values, "size_m": (0.5, 0.6, 0.8), **more})


THINGS = [
    _thing("f1", "toilet", "bath", 7.0, origin="measured"),
    _thing("f2", "sofa-slim", "living", 2.0),
    _thing("f3", "washing-machine", "bath", 6.0),
    _thing("f4", "floor-lamp-stem", "living", 0.6),
]


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    around = {
        "living": ["south-1", "west", "north-1", "middle"],
        "bath": ["south-2", "east", "north-2", "middle"],
    }
    flight = rectangle(0.2, 1.5, 4.0, 2.5)
    lamp = Light(id="l1", kind="ceiling", room="bath", at_m=(6.5, 2.5), above_m=2.3, lumen=900)
    below = sample_storey(
        stairs=[Stairs(id="s1", outline_m=flight, treads=14, up=(1, 0), score=0.9)],
        furniture=THINGS,
        lights=[lamp],
    )
    upper = sample_storey(name="upper floor", elevation_m=HEIGHT_M)
    storeys = []
    for one in (below, upper):
        rooms = [room.model_copy(update={"walls": around[room.id]}) for room in one.rooms]
        storeys.append(one.model_copy(update={"rooms": rooms}))
    house = build_house(sample_plan(*storeys), HouseOptions())
    file = tmp_path_factory.mktemp("house") / "house.ifc"
    file.write_bytes(house_ifc(house, HouseOptions()))
    return file


@pytest.fixture(scope="module")
def by_web_ifc(path: Path) -> dict[str, Any]:
    modules = ROOT / "studio" / "node_modules"
    node = shutil.which("node")
    if node is None or not (modules / "web-ifc").is_dir():
        pytest.skip("no web-ifc: make setup")
    done = subprocess.run(
        [node, str(COUNTER), str(modules), str(path)], capture_output=True, text=True, check=True
    )
    found: dict[str, Any] = json.loads(done.stdout)
    return found


@pytest.fixture(scope="module")
def model(path: Path) -> Any:
    return ifcopenshell.open(str(path))


def _elements(model: Any) -> Counter[str]:
    return Counter(one.is_a() for one in model.by_type("IfcProduct"))


def _materials(model: Any) -> Counter[str]:
    return Counter(
        f"{one.is_a()} {material.Name}"
        for one in model.by_type("IfcElement")
        for material in ifcopenshell.util.element.get_materials(one)
    )


def _types(model: Any) -> Counter[str]:
    kinds = [(one, ifcopenshell.util.element.get_type(one)) for one in model.by_type("IfcElement")]
    return Counter(f"{one.is_a()} {kind.is_a()} {kind.Name}" for one, kind in kinds if kind)


def _properties(model: Any) -> Counter[str]:
    found: Counter[str] = Counter()
    for one in model.by_type("IfcProduct"):
        for name, values in ifcopenshell.util.element.get_psets(one, psets_only=True).items():
            for key, value in values.items():
                is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
                said = str(value).lower() if isinstance(value, bool) else str(value)
                if key != "id":
                    found[f"{one.is_a()} {name} {key}" + ("" if is_number else f" {said}")] += 1
    return found


def _quantities(model: Any) -> dict[str, float]:
    found: Counter[str] = Counter()
    for one in model.by_type("IfcProduct"):
        for name, values in ifcopenshell.util.element.get_psets(one, qtos_only=True).items():
            for key, value in values.items():
                if key != "id":
                    found[f"{one.is_a()} {name} {key}"] += value
    return dict(found)


def _axes(model: Any) -> dict[str, float]:
    found: Counter[str] = Counter()
    for wall in model.by_type("IfcWall"):
        for shape in wall.Representation.Representations:
            if shape.RepresentationIdentifier == "Axis":
                points = np.array([one.Coordinates for one in shape.Items[0].Points])
                found["IfcWall"] += 1
                found["metres"] += sum(float(np.hypot(*(b - a))) for a, b in pairwise(points))
    return dict(found)


def _connections(model: Any) -> Counter[str]:
    return Counter(
        f"{one.RelatingConnectionType} {one.RelatedConnectionType}"
        for one in model.by_type("IfcRelConnectsPathElements")
    )


def _boundaries(model: Any) -> Counter[str]:
    return Counter(
        f"{one.RelatedBuildingElement.is_a()} {one.InternalOrExternalBoundary}"
        for one in model.by_type("IfcRelSpaceBoundary")
    )


def _colours(model: Any) -> Counter[str]:
    return Counter(style.Name for one in model.by_type("IfcStyledItem") for style in one.Styles)


COUNTS = {
    "elements": _elements, "materials": _materials, "types": _types, "properties": _properties,
    "quantities": _quantities, "axes": _axes, "connections": _connections,
    "boundaries": _boundaries, "colours": _colours,
}  # fmt: skip


@pytest.mark.parametrize("part", list(COUNTS))
def test_both_readers_count_the_same(part: str, by_web_ifc: dict[str, Any], model: Any) -> None:
    own = COUNTS[part](model)
    assert own
    assert by_web_ifc[part] == pytest.approx(dict(own), abs=1e-3)


def test_both_readers_know_the_schema_and_the_view(by_web_ifc: dict[str, Any], model: Any) -> None:
    assert by_web_ifc["schema"] == model.schema == "IFC4"
    assert tuple(by_web_ifc["view"]) == model.header.file_description.description
    assert by_web_ifc["view"] == ["ViewDefinition [ReferenceView_V1.2]"]


def test_web_ifc_finds_what_was_written(by_web_ifc: dict[str, Any]) -> None:
    elements, storeys = by_web_ifc["elements"], 2
    assert elements["IfcWall"] == 7 * storeys
    assert elements["IfcDoor"] == elements["IfcWindow"] == elements["IfcSpace"] == 2 * storeys
    assert elements["IfcStair"] == elements["IfcRoof"] == elements["IfcSanitaryTerminal"] == 1
    properties = by_web_ifc["properties"]
    assert properties["IfcWall Pset_WallCommon IsExternal true"] == 6 * storeys
    assert properties["IfcWall Pset_WallCommon IsExternal false"] == storeys
    assert properties["IfcDoor Pset_DoorCommon IsExternal true"] == storeys
    assert properties["IfcWindow Pset_WindowCommon IsExternal true"] == 2 * storeys
    assert properties["IfcSanitaryTerminal Veduta_Provenance Origin measured"] == 1
    assert properties["IfcFurniture Veduta_Provenance Origin invented"] >= 1
    lengths = 2 * (WIDTH_M + DEPTH_M) + DEPTH_M
    assert by_web_ifc["axes"] == pytest.approx(
        {"IfcWall": 7 * storeys, "metres": lengths * storeys}, abs=1e-6
    )
    length = by_web_ifc["quantities"]["IfcWall Qto_WallBaseQuantities Length"]
    assert length == pytest.approx(lengths * storeys, abs=1e-3)
    # Four corners, and three walls that meet at each of two junctions.
    assert sum(by_web_ifc["connections"].values()) == (4 + 3 + 3) * storeys
    assert by_web_ifc["boundaries"]["IfcWall EXTERNAL"] == 6 * storeys
    assert by_web_ifc["boundaries"]["IfcWall INTERNAL"] == 2 * storeys


def test_every_element_has_what_an_architect_asks_for(by_web_ifc: dict[str, Any]) -> None:
    """One material, one type and one origin at least for each element of a class."""

    def total(part: str, start: str) -> int:
        return sum(n for key, n in by_web_ifc[part].items() if key.startswith(start))

    for kind in SHOWN:
        number = by_web_ifc["elements"][kind]
        assert total("materials", f"{kind} ") >= number
        assert total("types", f"{kind} {kind}Type ") == number
        assert total("properties", f"{kind} Veduta_Provenance Origin ") == number


def test_both_readers_draw_the_same_house(by_web_ifc: dict[str, Any], model: Any) -> None:
    settings = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    for kind in SHOWN:
        shapes = [
            ifcopenshell.util.shape.get_vertices(
                ifcopenshell.geom.create_shape(settings, one).geometry
            )
            for one in model.by_type(kind)
        ]
        points = np.concatenate(shapes)
        drawn = by_web_ifc["extents"][kind]
        assert drawn["shapes"] == len(shapes)
        assert drawn["low"] == pytest.approx(points.min(axis=0), abs=2e-3)
        assert drawn["high"] == pytest.approx(points.max(axis=0), abs=2e-3)
    walls = by_web_ifc["extents"]["IfcWall"]
    assert walls["low"] == pytest.approx([-OUTER_M / 2, -OUTER_M / 2, 0.0], abs=2e-3)
    assert walls["high"][:2] == pytest.approx(
        [WIDTH_M + OUTER_M / 2, DEPTH_M + OUTER_M / 2], abs=2e-3
    )


def test_walls_are_cut_for_who_subtracts_nothing(by_web_ifc: dict[str, Any], model: Any) -> None:
    """As the Reference View has it: the body of a wall is that of its stones alone."""
    outer = 2 * (WIDTH_M + DEPTH_M) * OUTER_M + (DEPTH_M - OUTER_M) * INNER_M
    openings = [(one, OUTER_M) for one in sample_storey().openings if one.wall != "middle"]
    openings += [(one, INNER_M) for one in sample_storey().openings if one.wall == "middle"]
    cut = sum(one.width_m * one.height_m * thick for one, thick in openings)
    heights = HEIGHT_M - HouseOptions().slab
    settings = ifcopenshell.geom.settings()
    settings.set("disable-opening-subtractions", True)
    shapes = [ifcopenshell.geom.create_shape(settings, one) for one in model.by_type("IfcWall")]
    volume = sum(ifcopenshell.util.shape.get_volume(one.geometry) for one in shapes)
    assert volume == pytest.approx(2 * (outer * heights - cut), abs=1e-3)
    assert by_web_ifc["extents"]["IfcWall"]["volume"] == pytest.approx(volume, abs=1e-2)
    told = {
        shape.RepresentationIdentifier
        for one in model.by_type("IfcOpeningElement")
        for shape in one.Representation.Representations
    }
    assert told == {"Reference"}
    assert len(model.by_type("IfcMaterialLayerSetUsage")) == 0
