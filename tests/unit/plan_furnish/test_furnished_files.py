"""Furniture in the files of a house: model, drawings, building model, and the document's faults."""

from __future__ import annotations

import io
import logging
from pathlib import Path

import ezdxf.recover
import ifcopenshell
import ifcopenshell.validate
import numpy as np
import pytest
from sample_plan import sample_plan

from veduta.place.semantics import SemanticClass
from veduta.plan.document import PlanDocument
from veduta.plan.drawing import draw
from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.furnish.furnish import furnish
from veduta.plan.house.build import build_house
from veduta.plan.house.furniture import check_objects
from veduta.plan.house.space import space_of
from veduta.plan.load import load_document
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.dxf import plan_dxf
from veduta.plan.outputs.ifc import house_ifc
from veduta.plan.outputs.svg import plan_svg
from veduta.run.errors import InputError


@pytest.fixture(scope="module")
def document() -> PlanDocument:
    return furnish(sample_plan(), builtin_catalogue(), 1, 0.25)[0]


def test_each_thing_is_a_feature_of_the_house_where_the_document_says(
    document: PlanDocument,
) -> None:
    part = build_house(document, HouseOptions(furniture_detail="coarse")).part
    things = document.storeys[0].furniture or []
    rows = np.flatnonzero(part.features.class_code == SemanticClass.FURNITURE.code)
    assert len(rows) == len(things) > 10
    assert part.instances is not None
    at = {
        int(row): place[:, 3]
        for group in part.instances.groups
        for row, place in zip(group.feature, group.part_from_mesh, strict=True)
    }
    for row, thing in zip(rows.tolist(), things, strict=True):
        assert at[row][:2] == pytest.approx(thing.at_m)
        assert at[row][2] == pytest.approx(thing.above_m, abs=0.02)


def test_the_building_model_has_the_furniture_and_is_valid(document: PlanDocument) -> None:
    house = build_house(document, HouseOptions(furniture_detail="coarse"))
    model = ifcopenshell.file.from_string(house_ifc(house, HouseOptions()).decode())
    logger = ifcopenshell.validate.json_logger()
    logging.disable(logging.CRITICAL)
    ifcopenshell.validate.validate(model, logger)
    logging.disable(logging.NOTSET)
    assert logger.statements == []
    kinds = ("IfcFurniture", "IfcSanitaryTerminal", "IfcElectricAppliance", "IfcLightFixture",
             "IfcBuildingElementProxy")  # fmt: skip
    count = sum(len(model.by_type(kind)) for kind in kinds)
    assert count == len(document.storeys[0].furniture or [])
    toilets = [one for one in model.by_type("IfcSanitaryTerminal") if "toilet" in one.ObjectType]
    assert [one.PredefinedType for one in toilets] == ["TOILETPAN"]


def test_drawings_have_what_things_cover(document: PlanDocument) -> None:
    things = document.storeys[0].furniture or []
    drawing = draw(space_of(document.storeys[0], 2.55))
    found, auditor = ezdxf.recover.read(io.BytesIO(plan_dxf([drawing])))
    assert not auditor.errors
    rings = [
        line for line in found.modelspace().query('LWPOLYLINE[layer=="A-FURN"]') if line.closed
    ]
    assert len(rings) == len(things)
    first = np.array(rings[0].get_points("xy"))
    thing = next(one for one in sorted(things, key=lambda one: one.above_m))
    sides = sorted(np.linalg.norm(first - np.roll(first, 1, axis=0), axis=1))
    assert sides == pytest.approx(sorted([*thing.size_m[:2], *thing.size_m[:2]]))
    assert b'class="furniture"' in plan_svg([drawing])


@pytest.mark.parametrize(
    ("change", "fault"),
    [
        ({"room": "attic"}, r"furniture\[0\]\.room: there is no 'attic'"),
        ({"on": "nothing"}, r"furniture\[0\]\.on: there is no 'nothing'"),
        ({"on": "f1"}, r"furniture\[0\]\.on: things stand on each other in a circle"),
        ({"size_m": (1.0, 0.0, 1.0)}, r"furniture\[0\]\.size_m: a side is less than"),
        ({"id": "f2"}, r"furniture\[1\]\.id: 'f2' is there twice"),
    ],
)
def test_faults_of_edited_furniture_are_named(
    document: PlanDocument, tmp_path: Path, change: dict[str, object], fault: str
) -> None:
    things = list(document.storeys[0].furniture or [])
    things[0] = things[0].model_copy(update=change)
    storey = document.storeys[0].model_copy(update={"furniture": things})
    path = tmp_path / "plan.json"
    path.write_text(PlanDocument(storeys=[storey]).model_dump_json(by_alias=True))
    with pytest.raises(InputError, match=fault):
        load_document(path)


def test_an_unknown_object_is_named_with_the_nearest_one(document: PlanDocument) -> None:
    things = list(document.storeys[0].furniture or [])
    things[0] = things[0].model_copy(update={"object": "sofa-rold"})
    storey = document.storeys[0].model_copy(update={"furniture": things})
    with pytest.raises(InputError, match=r"storeys\[0\]\.furniture\[0\]\.object.*sofa-rolled"):
        check_objects(PlanDocument(storeys=[storey]), builtin_catalogue(), Path("plan.json"))
