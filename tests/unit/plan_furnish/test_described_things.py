"""Materials, colours, types and provenance of stairs, rails, lamps and furniture in `house.ifc`."""

from __future__ import annotations

import ifcopenshell
import ifcopenshell.util.element
import pytest
from sample_plan import rectangle, sample_plan, sample_storey

from veduta.plan.document import Furniture, Light, Stairs
from veduta.plan.house.build import build_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.ifc import house_ifc

KINDS = (
    "IfcStair", "IfcStairFlight", "IfcRailing", "IfcRoof", "IfcLightFixture", "IfcFurniture",
    "IfcSanitaryTerminal", "IfcElectricAppliance",
)  # fmt: skip

FLIGHT = rectangle(0.2, 1.5, 4.0, 2.5)


@pytest.fixture(scope="module")
def model() -> ifcopenshell.file:
    def thing(name: str, kind: str, room: str, x: float, **more: object) -> Furniture:
        return Furniture.model_validate(
            {
                "id": name, "object": kind, "room": room, "at_m": (x, 4.2),
                "size_m": (0.5, 0.6, 0.8), **more,
            }
        )  # fmt: skip

    below = sample_storey(
        stairs=[
            Stairs(
                id="s1", outline_m=rectangle(0.2, 1.5, 4.0, 2.5), treads=14, up=(1, 0), score=0.9
            )
        ],
        furniture=[
            thing("f1", "toilet", "bath", 7.0, origin="measured"),
            thing("f2", "sofa-slim", "living", 2.0),
            thing("f3", "washing-machine", "bath", 6.0),
            thing("f4", "floor-lamp-stem", "living", 0.6),
        ],
        lights=[
            Light(id="l1", kind="ceiling", room="bath", at_m=(6.5, 2.5), above_m=2.3, lumen=900)
        ],
    )
    upper = sample_storey(name="upper floor", elevation_m=2.8)
    house = build_house(sample_plan(below, upper), HouseOptions())
    return ifcopenshell.file.from_string(house_ifc(house, HouseOptions()).decode())


@pytest.mark.parametrize("kind", KINDS)
def test_each_has_material_type_and_provenance(model: ifcopenshell.file, kind: str) -> None:
    elements = model.by_type(kind)
    assert elements
    for one in elements:
        assert ifcopenshell.util.element.get_material(one) is not None
        assert ifcopenshell.util.element.get_type(one).is_a(f"{kind}Type")
        sets = ifcopenshell.util.element.get_psets(one)
        assert sets["Veduta_Provenance"]["Origin"] in {"measured", "inferred", "invented"}
        assert any(name.startswith("Pset_") for name in sets)


@pytest.mark.parametrize("kind", KINDS[1:])
def test_each_piece_of_a_shape_has_its_colour(model: ifcopenshell.file, kind: str) -> None:
    styled = {one.Item.id() for one in model.by_type("IfcStyledItem")}
    for one in model.by_type(kind):
        (shape,) = one.Representation.Representations
        items = [
            inner
            for item in shape.Items
            for inner in (
                item.MappingSource.MappedRepresentation.Items
                if item.is_a("IfcMappedItem")
                else [item]
            )
        ]
        assert items
        assert all(item.id() in styled for item in items)


def test_measured_and_invented_furniture_are_told_apart(model: ifcopenshell.file) -> None:
    def origin(kind: str) -> set[str]:
        return {
            ifcopenshell.util.element.get_psets(one)["Veduta_Provenance"]["Origin"]
            for one in model.by_type(kind)
        }

    assert origin("IfcSanitaryTerminal") == {"measured"}
    assert origin("IfcFurniture") == {"invented"}
    assert origin("IfcStair") == {"measured"}
    assert origin("IfcRailing") == {"invented"}


def test_a_flight_says_its_steps(model: ifcopenshell.file) -> None:
    (flight,) = model.by_type("IfcStairFlight")
    said = ifcopenshell.util.element.get_psets(flight)["Pset_StairFlightCommon"]
    assert (said["NumberOfRiser"], said["NumberOfTreads"]) == (15, 14)
    assert said["RiserHeight"] == pytest.approx(2.8 / 15)
