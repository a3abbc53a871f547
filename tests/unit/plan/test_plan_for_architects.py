"""What an architect expects of `house.ifc` and `plan.dxf`, counted by readers of others."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import ezdxf
import ifcopenshell
import ifcopenshell.util.element
import pyogrio
import pyogrio.raw
import pytest
import shapely
from sample_plan import DEPTH_M, OUTER_M, WIDTH_M, sample_plan, sample_storey

from veduta.plan.drawing import draw
from veduta.plan.flat_walls import external_walls
from veduta.plan.house.build import build_house
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.dxf import plan_dxf
from veduta.plan.outputs.ifc import house_ifc


@pytest.fixture(scope="module")
def model() -> ifcopenshell.file:
    upper = sample_storey(name="upper floor", elevation_m=2.8)
    house = build_house(sample_plan(sample_storey(), upper), HouseOptions())
    content = house_ifc(house, HouseOptions()).decode()
    return ifcopenshell.file.from_string(content)


def test_the_header_names_the_reference_view(model: ifcopenshell.file) -> None:
    assert model.header.file_description.description == ("ViewDefinition [ReferenceView_V1.2]",)


@pytest.mark.parametrize("kind", ["IfcWall", "IfcDoor", "IfcWindow", "IfcSlab"])
def test_each_element_has_material_colour_type_and_properties(
    model: ifcopenshell.file, kind: str
) -> None:
    elements = model.by_type(kind)
    styled = {one.Item.id() for one in model.by_type("IfcStyledItem")}
    assert elements
    for one in elements:
        assert ifcopenshell.util.element.get_material(one) is not None
        assert ifcopenshell.util.element.get_type(one).is_a(f"{kind}Type")
        sets = ifcopenshell.util.element.get_psets(one)
        assert isinstance(sets[f"Pset_{kind[3:]}Common"]["IsExternal"], bool)
        assert sets["Veduta_Provenance"]["Origin"] in {"measured", "inferred", "invented"}
        bodies = [
            s for s in one.Representation.Representations if s.RepresentationIdentifier == "Body"
        ]
        assert all(item.id() in styled for shape in bodies for item in shape.Items)


def test_doors_and_windows_have_their_sizes_as_quantities(model: ifcopenshell.file) -> None:
    drawn = {one.id: one for one in sample_storey().openings}
    for kind, word in (("IfcDoor", "Door"), ("IfcWindow", "Window")):
        for one in model.by_type(kind):
            opening = drawn[one.Name.split()[-1]]
            sizes = ifcopenshell.util.element.get_psets(one)[f"Qto_{word}BaseQuantities"]
            assert sizes["Width"] == pytest.approx(opening.width_m, abs=1e-3)
            assert sizes["Height"] == pytest.approx(opening.height_m, abs=1e-3)
            assert sizes["Area"] == pytest.approx(opening.width_m * opening.height_m, abs=1e-2)


def test_walls_have_quantities_axes_and_connections(model: ifcopenshell.file) -> None:
    for wall in model.by_type("IfcWall"):
        sizes = ifcopenshell.util.element.get_psets(wall)["Qto_WallBaseQuantities"]
        assert sizes["GrossSideArea"] == pytest.approx(sizes["Length"] * sizes["Height"], abs=1e-3)
        assert sizes["NetSideArea"] <= sizes["GrossSideArea"]
        assert sizes["NetVolume"] == pytest.approx(sizes["NetSideArea"] * sizes["Width"], abs=1e-3)
        kinds = [one.RepresentationIdentifier for one in wall.Representation.Representations]
        assert kinds == ["Axis", "Body"]
        assert wall.ConnectedTo or wall.ConnectedFrom
    external = [
        ifcopenshell.util.element.get_psets(one)["Pset_WallCommon"]["IsExternal"]
        for one in model.by_type("IfcWall")
    ]
    assert external.count(True) == 12
    assert external.count(False) == 2


@pytest.mark.parametrize(
    ("flat", "external"),
    [(False, ["east", "north-1", "north-2", "south-1", "south-2", "west"]),
     (True, ["north-1", "north-2", "south-1", "south-2"])],
)  # fmt: skip
def test_blank_walls_of_a_flat_are_not_external(flat: bool, external: list[str]) -> None:
    options = HouseOptions(flat=flat)
    house = build_house(sample_plan(), options)
    model = ifcopenshell.file.from_string(house_ifc(house, options).decode())
    found = [
        one.Name.split()[-1]
        for one in model.by_type("IfcWall")
        if ifcopenshell.util.element.get_psets(one)["Pset_WallCommon"]["IsExternal"]
    ]
    assert sorted(found) == external


def test_a_door_to_the_landing_makes_no_wall_external() -> None:
    openings = [one for one in sample_storey().openings if one.id in ("front", "inner", "w2")]
    storey = sample_storey(openings=openings)
    assert external_walls(storey, flat=True) == {"north-1", "north-2"}
    party = [one.model_copy(update={"party": one.id == "east"}) for one in storey.walls]
    walls = external_walls(storey.model_copy(update={"walls": party}), flat=False)
    assert walls == {"north-1", "north-2", "south-1", "south-2", "west"}


def test_rooms_are_bounded_by_their_walls_and_openings() -> None:
    around = {
        "living": ["south-1", "west", "north-1", "middle"],
        "bath": ["south-2", "east", "north-2", "middle"],
    }
    storey = sample_storey()
    rooms = [one.model_copy(update={"walls": around[one.id]}) for one in storey.rooms]
    house = build_house(sample_plan(storey.model_copy(update={"rooms": rooms})), HouseOptions())
    model = ifcopenshell.file.from_string(house_ifc(house, HouseOptions()).decode())
    spaces = model.by_type("IfcSpace")
    assert len(spaces) == 2
    for space in spaces:
        kinds = [one.RelatedBuildingElement.is_a() for one in space.BoundedBy]
        assert kinds.count("IfcWall") == 4
        assert "IfcDoor" in kinds
        assert "IfcWindow" in kinds


def test_doors_and_windows_are_blocks_with_attributes() -> None:
    storey = sample_storey()
    house = build_house(sample_plan(storey), HouseOptions())
    content = plan_dxf([draw(space) for space in house.spaces])
    document = ezdxf.read(io.StringIO(content.decode()))
    assert not document.audit().errors
    placed = document.modelspace().query("INSERT")
    told = {one.get_attrib_text("ID"): one for one in placed}
    assert set(told) == {one.id for one in storey.openings if one.kind != "gap"}
    for opening in storey.openings:
        width = float(told[opening.id].get_attrib_text("WIDTH"))
        assert width == pytest.approx(opening.width_m, abs=0.002)
    assert plan_dxf([draw(space) for space in house.spaces]) == content


def test_dimensions_say_how_large_the_house_is() -> None:
    house = build_house(sample_plan(), HouseOptions())
    document = ezdxf.read(io.StringIO(plan_dxf([draw(one) for one in house.spaces]).decode()))
    found = sorted(one.get_measurement() for one in document.modelspace().query("DIMENSION"))
    assert found[-1] == pytest.approx(WIDTH_M + OUTER_M, abs=1e-3)
    assert any(one == pytest.approx(DEPTH_M + OUTER_M, abs=1e-3) for one in found)


@pytest.fixture
def by_gdal(tmp_path: Path) -> list[dict[str, Any]]:
    """What GDAL, which shares no code with the writer, reads; blocks stay references."""
    house = build_house(sample_plan(), HouseOptions())
    path = tmp_path / "plan.dxf"
    path.write_bytes(plan_dxf([draw(one) for one in house.spaces]))
    pyogrio.set_gdal_config_options({"DXF_INLINE_BLOCKS": False})
    try:
        meta, _, geometry, fields = pyogrio.raw.read(path, layer="entities")
    finally:
        pyogrio.set_gdal_config_options({"DXF_INLINE_BLOCKS": None})
    columns = dict(zip(meta["fields"], fields, strict=True))
    shapes = shapely.from_wkb(geometry)
    return [
        {"shape": shape, **{name: values[row] for name, values in columns.items()}}
        for row, shape in enumerate(shapes)
    ]


def test_a_second_reader_finds_the_walls(by_gdal: list[dict[str, Any]]) -> None:
    walls = shapely.union_all([one["shape"] for one in by_gdal if one["Layer"] == "A-WALL"])
    half = OUTER_M / 2
    assert walls.bounds == pytest.approx((-half, -half, WIDTH_M + half, DEPTH_M + half), abs=1e-3)


def test_a_second_reader_finds_doors_and_windows_as_blocks(by_gdal: list[dict[str, Any]]) -> None:
    placed = [one for one in by_gdal if one["BlockName"]]
    told = {}
    for one in placed:
        values = dict(text.split(" ", 1) for text in one["BlockAttributes"])
        told[values["ID"]] = (one["Layer"], values["TYPE"], float(values["WIDTH"]))
    layers = {"door": "A-DOOR", "window": "A-GLAZ"}
    assert told == {
        one.id: (layers[one.kind], one.type, pytest.approx(one.width_m, abs=0.002))
        for one in sample_storey().openings
        if one.kind in layers
    }
    # The front door stands at the south wall, 0.6 m along it, and the inner one is turned.
    at = {one["BlockAttributes"][0]: one for one in placed}
    assert at["ID front"]["BlockOCSCoords"][:2] == pytest.approx([0.6, 0.0], abs=1e-6)
    assert at["ID inner"]["BlockAngle"] == pytest.approx(90.0)


def test_a_second_reader_finds_the_dimensions(by_gdal: list[dict[str, Any]]) -> None:
    """In centimetres, beside the house, along two of its sides."""
    rows = [one for one in by_gdal if one["Layer"] == "A-ANNO-DIMS" and one["Text"]]
    centimetres = [round(100 * (side + OUTER_M)) for side in (DEPTH_M, WIDTH_M)]
    assert sorted(int(one["Text"]) for one in rows) == centimetres
    lines = [one["shape"].length for one in by_gdal if one["Layer"] == "A-ANNO-DIMS"]
    for side in (DEPTH_M, WIDTH_M):
        assert any(length == pytest.approx(side + OUTER_M, abs=0.01) for length in lines)
