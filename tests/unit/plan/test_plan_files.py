"""The drawings and the building model of a plan, each through its format's own checks."""

from __future__ import annotations

import io
import logging
from xml.etree import ElementTree

import ezdxf
import ezdxf.recover
import ifcopenshell
import ifcopenshell.util.element
import ifcopenshell.validate
import numpy as np
import pytest
from ezdxf.entitydb import EntityDB
from sample_plan import MARGIN_PX, PIXEL_M, opening, rectangle, sample_plan, sample_storey
from shapely.geometry import Polygon

from veduta.plan.document import PlanDocument, Stairs
from veduta.plan.drawing import Drawing, draw
from veduta.plan.house.build import build_house
from veduta.plan.house.space import space_of
from veduta.plan.house.wall_regions import wall_regions
from veduta.plan.lights.lighting import light_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.dxf import plan_dxf
from veduta.plan.outputs.ifc import door_operation, house_ifc
from veduta.plan.outputs.overlay import overlay, pixels_of
from veduta.plan.outputs.svg import plan_svg

HEIGHT_M = 2.55
SVG = "{http://www.w3.org/2000/svg}"


def two_storeys() -> PlanDocument:
    upper = sample_storey(name="upper floor", elevation_m=2.8)
    return sample_plan(sample_storey(), upper)


def drawings(document: PlanDocument) -> list[Drawing]:
    return [draw(space_of(storey, HEIGHT_M)) for storey in document.storeys]


def test_dxf_audits_clean_and_has_the_walls_in_metres() -> None:
    content = plan_dxf(drawings(two_storeys()))
    document, auditor = ezdxf.recover.read(io.BytesIO(content))
    assert not auditor.errors
    assert not auditor.fixes
    assert document.units == ezdxf.units.M
    rings = [
        Polygon(line.get_points("xy"))
        for line in document.modelspace().query('LWPOLYLINE[layer=="A-WALL"]')
    ]
    expected = drawings(sample_plan())[0]
    areas = [Polygon(s.rings[0]).area for s in expected.shapes if s.layer == "walls"]
    assert sorted(ring.area for ring in rings) == pytest.approx(sorted(2 * areas))
    texts = [text.dxf.text for text in document.modelspace().query("TEXT")]
    assert texts.count("Living") == 2
    assert plan_dxf(drawings(two_storeys())) == content


def test_dxf_does_not_depend_on_the_order_of_a_set(monkeypatch: pytest.MonkeyPatch) -> None:
    found = EntityDB.dxf_types_in_use
    contents = set()
    for turn in (False, True):
        monkeypatch.setattr(
            EntityDB,
            "dxf_types_in_use",
            lambda self, turn=turn: sorted(found(self), reverse=turn),
        )
        contents.add(plan_dxf(drawings(sample_plan())))
    assert len(contents) == 1


def test_svg_is_xml_with_a_group_for_each_layer_and_names_escaped() -> None:
    storey = sample_storey()
    rooms = [storey.rooms[0].model_copy(update={"name": "<Salon & Co>"}), storey.rooms[1]]
    content = plan_svg(drawings(sample_plan(sample_storey(rooms=rooms), two_storeys().storeys[1])))
    root = ElementTree.fromstring(content)
    assert [group.get("id") for group in root.findall(f"{SVG}g")] == ["ground floor", "upper floor"]
    layers = [group.get("class") for group in root.findall(f"{SVG}g/{SVG}g")]
    assert layers == 2 * ["rooms", "walls", "ids", "windows", "doors", "names"]
    titles = {title.text for title in root.iter(f"{SVG}title")}
    assert {f"{one.id}, from {one.start} to {one.end}" for one in storey.walls} <= titles
    assert any(told and told.startswith(f"{storey.junctions[0].id}, at ") for told in titles)
    assert "<Salon & Co>" in [text.text for text in root.iter(f"{SVG}text")]


def test_overlay_draws_walls_where_the_sheet_has_them() -> None:
    document = sample_plan()
    sheet = document.storeys[0].sheet
    corner = pixels_of(sheet, np.array([[0.0, 0.0], [8.0, 5.0]]))
    assert corner[0] == pytest.approx([MARGIN_PX, 5.0 / PIXEL_M + MARGIN_PX])
    assert corner[1] == pytest.approx([8.0 / PIXEL_M + MARGIN_PX, MARGIN_PX])
    paper = np.full((sheet.height_px, sheet.width_px, 3), 255, dtype=np.uint8)
    picture = overlay(drawings(document), [paper])
    scale = 1800 / max(paper.shape[:2])
    wall = (pixels_of(sheet, np.array([[0.0, 2.0]]))[0] * scale).astype(int)
    room = (pixels_of(sheet, np.array([[2.0, 4.0]]))[0] * scale).astype(int)
    assert picture[wall[1], wall[0]].mean() < 160
    assert picture[room[1], room[0]].mean() > 220
    assert (picture[5, 5] == 255).all()


def test_ifc_is_valid_and_has_everything() -> None:
    document = light_house(two_storeys(), HouseOptions()).document
    house = build_house(document, HouseOptions())
    content = house_ifc(house, HouseOptions())
    model = ifcopenshell.file.from_string(content.decode())
    logger = ifcopenshell.validate.json_logger()
    logging.disable(logging.CRITICAL)
    ifcopenshell.validate.validate(model, logger)
    logging.disable(logging.NOTSET)
    assert logger.statements == []
    counts = {
        "IfcBuildingStorey": 2, "IfcWall": 14, "IfcOpeningElement": 8, "IfcDoor": 4,
        "IfcWindow": 4, "IfcSpace": 4, "IfcSlab": 3, "IfcRoof": 1,
        "IfcLightFixture": 8,
    }  # fmt: skip
    assert {kind: len(model.by_type(kind)) for kind in counts} == counts
    for kind in ("IfcDoor", "IfcWindow"):
        for one in model.by_type(kind):
            assert len(one.FillsVoids) == 1
            assert one.FillsVoids[0].RelatingOpeningElement.VoidsElements
    areas = {
        one.LongName: ifcopenshell.util.element.get_psets(one)["Qto_SpaceBaseQuantities"]
        for one in model.by_type("IfcSpace")
    }
    living = areas["Living"]["NetFloorArea"]
    assert living == pytest.approx(4.79 * 4.7, abs=1e-3)
    assert house_ifc(house, HouseOptions()) == content


def test_stairs_of_the_building_model_are_flights_with_railings() -> None:
    flight = Stairs(
        id="s1", outline_m=rectangle(1.0, 3.85, 4.5, 4.85), treads=14, up=(1.0, 0.0), score=0.9
    )
    upper = sample_storey(name="upper floor", elevation_m=2.8)
    house = build_house(sample_plan(sample_storey(stairs=[flight]), upper), HouseOptions())
    model = ifcopenshell.file.from_string(house_ifc(house, HouseOptions()).decode())
    logger = ifcopenshell.validate.json_logger()
    logging.disable(logging.CRITICAL)
    ifcopenshell.validate.validate(model, logger)
    logging.disable(logging.NOTSET)
    assert logger.statements == []
    (stair,) = model.by_type("IfcStair")
    (parts,) = stair.IsDecomposedBy
    kinds = sorted(part.is_a() for part in parts.RelatedObjects)
    assert kinds == ["IfcRailing", "IfcStairFlight"]  # a wall stands on the other side
    (own,) = model.by_type("IfcStairFlight")
    assert (own.NumberOfRisers, own.NumberOfTreads) == (15, 14)
    assert own.RiserHeight == pytest.approx(2.8 / 15)
    meshes = own.Representation.Representations[0].Items
    points = np.concatenate([np.array(one.Coordinates.CoordList) for one in meshes])
    assert points.min(axis=0) == pytest.approx([1.0, 3.855, 0.0], abs=1e-4)
    assert points.max(axis=0) == pytest.approx([4.5, 4.845, 14 * 2.8 / 15], abs=1e-4)
    guards = [one for one in model.by_type("IfcRailing") if one.PredefinedType == "GUARDRAIL"]
    assert len(guards) == 2
    for guard in guards:
        assert guard.ContainedInStructure[0].RelatingStructure.Name == "upper floor"
        (shape,) = guard.Representation.Representations[0].Items
        assert np.array(shape.Coordinates.CoordList)[:, 2].min() == pytest.approx(0.0, abs=1e-4)


def test_walls_of_the_building_model_share_the_footprint() -> None:
    space = space_of(sample_storey(), HEIGHT_M)
    regions = wall_regions(space)
    assert sum(region.area for region in regions.values()) == pytest.approx(space.walls.area)
    assert set(regions) == {wall.id for wall in space.storey.walls}
    # Cut one after the other out of what is left, as one would by hand.
    rest = space.walls
    for name, line in space.lines.items():
        assert line.strip.intersection(rest).difference(regions[name]).area < 1e-9
        assert all(
            regions[name].intersection(other).area < 1e-9
            for key, other in regions.items()
            if key != name
        )
        rest = rest.difference(line.strip)


@pytest.mark.parametrize(
    ("hinge", "swing", "operation"),
    [
        ("start", "left", "SINGLE_SWING_LEFT"),
        ("end", "left", "SINGLE_SWING_RIGHT"),
        ("start", "right", "SINGLE_SWING_RIGHT"),
        ("end", "right", "SINGLE_SWING_LEFT"),
        ("none", "none", "NOTDEFINED"),
        ("both", "left", "DOUBLE_DOOR_SINGLE_SWING"),
    ],
)
def test_doors_open_as_ifc_calls_it(hinge: str, swing: str, operation: str) -> None:
    """Looking along the swing, hinges at the left are a left door (IfcDoorTypeOperationEnum)."""
    assert door_operation(opening("d", "w", 0.0, 0.9, hinge=hinge, swing=swing)) == operation


def test_ifc_names_sliding_doors_by_their_leaves() -> None:
    def named(hinge: str) -> str:
        return door_operation(
            opening("d", "w", 0.0, 1.6, type="sliding", hinge=hinge, swing="left")
        )

    assert [named("both"), named("start")] == ["DOUBLE_DOOR_SLIDING", "SLIDING_TO_LEFT"]
