"""DXF files: exact walls from lines, units, and what is refused."""

from __future__ import annotations

import contextlib
from pathlib import Path

import ezdxf
import numpy as np
import pytest
from drawn_dxf import WALLS, saved, two_rooms
from sample_plan import sample_storey
from shapely.affinity import affine_transform, translate
from shapely.geometry import Polygon, box

from veduta.plan import analyse
from veduta.plan.analyse import read_drawings
from veduta.plan.document import Storey
from veduta.plan.drawing import draw
from veduta.plan.house.lines import footprint, wall_lines
from veduta.plan.house.space import space_of
from veduta.plan.options import PlanOptions, ScaleOptions
from veduta.plan.outputs.dxf import plan_dxf
from veduta.plan.pages import Drawing, find_drawings
from veduta.plan.vector.entities import Entities, entities_of
from veduta.plan.vector.faces import bounds_of, extent_of, solid_walls
from veduta.plan.vector.layers import Role, role_of
from veduta.plan.vector.open_dxf import is_dxf, open_dxf
from veduta.plan.vector.read import read_vectors
from veduta.plan.vector.units import unit_notes, unit_scale
from veduta.run.errors import InputError, NotFoundError
from veduta.run.progress import no_progress

PLAN = Path("plan.dxf")
SOLID = box(0, 0, 8, 5).difference(box(0.3, 0.3, 7.7, 4.7)).union(box(3.95, 0.3, 4.05, 4.7))
HOLES = box(1.2, 0, 2.7, 0.3).union(box(3.95, 1.0, 4.05, 1.9))


def _moved(shape: Polygon) -> Polygon:
    """In the storey's frame, which begins at the corner of the centre lines."""
    return translate(shape, -0.15, -0.15)


def storey_of(path: Path, scale: float | None = None) -> Storey:
    options = PlanOptions(scale=ScaleOptions(scale=scale))
    return read_drawings([Drawing(path)], options, [], no_progress).document.storeys[0]


@pytest.fixture(scope="module")
def storey(tmp_path_factory: pytest.TempPathFactory) -> Storey:
    """In inches, far from the origin, though the header says millimetres."""
    folder = tmp_path_factory.mktemp("dxf")
    document = two_rooms(0.0254, insunits=4, at=(5_400_000.0, 91_000.0))
    return storey_of(saved(document, folder / "house.dxf"))


def test_walls_are_exact(storey: Storey) -> None:
    found = footprint(wall_lines(storey).values())
    assert found.symmetric_difference(_moved(SOLID)).area < 2e-3
    thickness = sorted({round(wall.thickness_m, 4) for wall in storey.walls})
    assert thickness == [0.1, 0.3]


def test_openings_and_rooms_are_exact(storey: Storey) -> None:
    door = next(one for one in storey.openings if one.kind == "door")
    window = next(one for one in storey.openings if one.kind == "window")
    assert (door.type, door.width_m) == ("swing", pytest.approx(0.9, abs=1e-4))
    assert window.width_m == pytest.approx(1.5, abs=1e-4)
    areas = {room.name: room.area_m2 for room in storey.rooms}
    expected = {"Bedroom": 3.65 * 4.4, "Kitchen": 3.65 * 4.4}
    assert areas == {name: pytest.approx(area, abs=0.03) for name, area in expected.items()}
    assert {room.use for room in storey.rooms} == {"bedroom", "kitchen"}


def test_a_wrong_unit_of_the_header_is_told(storey: Storey) -> None:
    assert "The drawing is in inches, though $INSUNITS says millimetres." in storey.notes
    assert storey.scale.basis == "evidence"


def test_the_sheet_leads_back_to_drawing_units(storey: Storey) -> None:
    clean = np.array(storey.sheet.clean_from_scan)
    corner = clean @ [5_400_000.0, 91_000.0, 1.0]
    # The plan's origin is the lower left corner of the centre lines.
    half = 0.15 / storey.sheet.metres_per_px
    assert storey.sheet.origin_px == pytest.approx((corner[0] + half, corner[1] - half), abs=0.01)


def test_walls_of_lines_alone_are_found_without_layers(tmp_path: Path) -> None:
    document = two_rooms(1.0, ("0", "0", "0"), insunits=6)
    found = storey_of(saved(document, tmp_path / "plain.dxf"))
    assert any("no layer is named" in note for note in found.notes)
    body = footprint(wall_lines(found).values())
    whole = _moved(SOLID)
    assert body.intersection(whole).area / body.union(whole).area > 0.9
    assert {round(wall.thickness_m, 4) for wall in found.walls} <= {0.1, 0.3}


def test_what_the_verb_draws_it_reads_again(tmp_path: Path) -> None:
    before = sample_storey()
    path = tmp_path / "plan.dxf"
    path.write_bytes(plan_dxf([draw(space_of(before, 2.5))]))
    after = storey_of(path)
    walls = [footprint(wall_lines(one).values()) for one in (before, after)]
    assert walls[0].symmetric_difference(walls[1]).area < 2e-3
    for kind in ("door", "window"):
        widths = [
            sorted(round(one.width_m, 3) for one in storey.openings if one.kind == kind)
            for storey in (before, after)
        ]
        assert widths[0] == widths[1]
    assert {room.name.split()[0] for room in after.rooms} == {"Living", "Bath"}


def test_blocks_of_nothing_but_blocks_come_to_an_end() -> None:
    """Ten in each of ten, eleven deep, and an array of 10^9 copies: none of them shows anything."""
    document = ezdxf.new("R2010")
    document.blocks.new("nothing")
    for depth in range(11):
        block = document.blocks.new(f"b{depth}")
        for _ in range(10):
            block.add_blockref("nothing" if depth == 0 else f"b{depth - 1}", (0, 0))
    array = {"row_count": 32_000, "column_count": 32_000, "row_spacing": 1, "column_spacing": 1}
    space = document.modelspace()
    space.add_line((0, 0), (1, 0))
    space.add_blockref("b10", (0, 0))
    found = entities_of(document, most=400)
    assert (len(found.strokes), found.more) == (1, True)
    space.add_blockref("nothing", (0, 0), dxfattribs=array)
    space.delete_entity(space[1])
    found = entities_of(document, most=400)
    assert (len(found.strokes), found.more) == (1, True)


@pytest.mark.parametrize(("times", "told"), [(1.0, False), (2.0, True)])
def test_sizes_that_contradict_the_unit_are_told(tmp_path: Path, times: float, told: bool) -> None:
    """Each room is 3.65 m by 4.40 m."""
    document = two_rooms(0.001)
    size = f"{3.65 * times:.2f} x {4.4 * times:.2f}"
    for x in (1200, 5200):
        text = document.modelspace().add_text(size, height=250, dxfattribs={"layer": "A-ANNO"})
        text.set_placement((x, 1500))
    found = storey_of(saved(document, tmp_path / "house.dxf"))
    assert found.scale.metres_per_px == pytest.approx(found.sheet.metres_per_px)
    said = [note for note in found.notes if "written in the drawing" in note]
    assert [f"2 of 2 sizes written in the drawing ({size}" in note for note in said] == [
        True
    ] * told
    assert all("2 times as large" in note for note in said)


def test_a_drawing_that_is_no_house_in_any_unit_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"tiny\.dxf: is 0\.0008 units wide"):
        storey_of(saved(two_rooms(10_000.0), tmp_path / "tiny.dxf"))


def test_a_drawing_of_more_than_a_house_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The house is 7.7 m long between centre lines."""
    monkeypatch.setattr(analyse, "LARGEST_M", 5.0)
    with pytest.raises(InputError, match=r"large\.dxf: is 8 m from end to end; 5 m are the most"):
        storey_of(saved(two_rooms(), tmp_path / "large.dxf"))


def test_faces_between_lines_are_the_walls() -> None:
    found = entities_of(two_rooms(0.01))
    walls = solid_walls(found, 0.01)
    expected = SOLID.difference(HOLES)
    assert walls.by_name
    metres = affine_transform(walls.solid, [0.01, 0, 0, 0.01, 0, 0])
    assert metres.symmetric_difference(expected).area < 1e-3


def test_single_lines_are_walls_of_an_assumed_thickness() -> None:
    document = ezdxf.new()
    space = document.modelspace()
    space.add_lwpolyline([(0, 0), (8, 0), (8, 5), (0, 5)], close=True, dxfattribs={"layer": "Mur"})
    space.add_line((4, 0), (4, 5), dxfattribs={"layer": "Mur"})
    walls = solid_walls(entities_of(document), 1.0)
    assert walls.single
    assert walls.solid.area == pytest.approx(0.1 * (26 + 5), abs=0.1)


def test_blocks_are_taken_apart_with_their_layers() -> None:
    document = ezdxf.new()
    leaf = document.blocks.new("leaf")
    leaf.add_line((0, 0), (1, 0))
    pair = document.blocks.new("pair")
    pair.add_blockref("leaf", (0, 0))
    pair.add_blockref("leaf", (0, 0), dxfattribs={"rotation": 90})
    document.modelspace().add_blockref(
        "pair", (10, 20), dxfattribs={"layer": "TÜREN", "xscale": 2, "yscale": 2}
    )
    found = entities_of(document)
    assert {stroke.role for stroke in found.strokes} == {"door"}
    ends = sorted(tuple(np.round(stroke.points[-1], 6)) for stroke in found.strokes)
    assert ends == [(10, 22), (12, 20)]


def test_curves_and_bulges_keep_their_place() -> None:
    document = ezdxf.new()
    space = document.modelspace()
    space.add_lwpolyline([(0, 0, 1.0), (2, 0, 0.0)], format="xyb", dxfattribs={"layer": "wall"})
    space.add_arc((5, 5), 3, 30, 150)
    found = entities_of(document)
    bow, arc = found.strokes
    assert np.hypot(*(bow.points - [1, 0]).T) == pytest.approx(np.ones(len(bow.points)), abs=0.005)
    assert np.hypot(*(arc.points - [5, 5]).T) == pytest.approx(
        np.full(len(arc.points), 3.0), abs=0.02
    )
    assert arc.arc == pytest.approx((3, 5, 5, 120))


def test_layers_that_are_off_are_not_shown() -> None:
    document = ezdxf.new()
    document.layers.add("WAND-ALT").off()
    document.modelspace().add_line((0, 0), (1, 0), dxfattribs={"layer": "WAND-ALT"})
    assert entities_of(document).strokes == []


@pytest.mark.parametrize(
    ("name", "role"),
    [
        ("A-WALL", "wall"), ("A-WALL-PATT", "annotation"), ("S-STEM-WALL", "annotation"),
        ("xref-house$0$A-WALL", "wall"), ("house|A-DOOR", "door"), ("A-DOOR-IDEN", "annotation"),
        ("Aussenwände", "wall"), ("TUEREN", "door"), ("Fenster_EG", "window"), ("MURS", "wall"),
        ("Cloisons", "wall"), ("Menuiseries", "opening"), ("PAREDES", "wall"),
        ("ikkunat", "window"), ("A-FLOR-STRS", "stairs"), ("Treppe", "stairs"),
        ("väliseinät", "wall"), ("A-FURN", "thing"),
        ("0", "other"), ("Layer7", "other"), ("Bemassung", "annotation"),
    ],
)  # fmt: skip
def test_names_of_layers(name: str, role: Role) -> None:
    assert role_of(name) == role


@pytest.mark.parametrize(
    ("unit_m", "insunits", "expected"),
    [
        (0.001, 4, 0.001), (0.01, 5, 0.01), (1.0, 6, 1.0), (0.0254, 1, 0.0254), (0.3048, 2, 0.3048),
        (0.01, 0, 0.01), (1.0, 0, 1.0), (0.001, 0, 0.001), (1.0, 4, 1.0), (0.001, 6, 0.001),
    ],
)  # fmt: skip
def test_units(unit_m: float, insunits: int, expected: float) -> None:
    document = two_rooms(unit_m, insunits=insunits)
    found = entities_of(document)
    assert unit_scale(PLAN, document, found, extent_of(found)).metres_per_px == expected


def test_units_that_nothing_tells_are_assumed_and_said() -> None:
    document = ezdxf.new()
    document.header["$INSUNITS"] = 0
    space = document.modelspace()
    for line in WALLS:
        space.add_lwpolyline([(1000 * x, 1000 * y) for x, y in line], dxfattribs={"layer": "wall"})
    found = entities_of(document)
    scale = unit_scale(PLAN, document, found, extent_of(found))
    assert (scale.basis, scale.metres_per_px) == ("assumed", 0.001)
    assert "Nothing in the drawing says its units" in unit_notes(scale, extent_of(found))[0]


def test_a_scale_that_is_given_goes_first() -> None:
    document = two_rooms(0.001)
    found = entities_of(document)
    scale = unit_scale(PLAN, document, found, extent_of(found), given_m=0.002)
    assert (scale.basis, scale.metres_per_px) == ("given", 0.002)
    with pytest.raises(InputError, match=r"--scale: makes plan\.dxf 8e\+04 m wide"):
        unit_scale(PLAN, document, found, extent_of(found), given_m=10.0)


def test_a_stray_far_away_does_not_shrink_the_house() -> None:
    document = two_rooms(1.0)
    document.modelspace().add_line((9e6, 9e6), (9e6, 9.1e6), dxfattribs={"layer": "A-WALL"})
    low, high = bounds_of(entities_of(document))
    assert [*low, *high] == pytest.approx([0, 0, 8, 5])


def test_other_files_are_refused(tmp_path: Path) -> None:
    def refused(name: str, content: bytes) -> str:
        path = tmp_path / name
        path.write_bytes(content)
        assert is_dxf(path)
        with pytest.raises(InputError) as caught:
            open_dxf(path)
        return str(caught.value)

    assert "is a DWG file. Save it as DXF" in refused("house.dwg", b"AC1027\0\0\0")
    assert "is a DWG file" in refused("renamed.dxf", b"AC1032\0\0\0")
    assert "is empty" in refused("empty.dxf", b"")
    assert "is no DXF file" in refused("picture.dxf", b"\x89PNG\r\n")
    assert "is a damaged DXF file" in refused("odd.dxf", b"0\nSECTION\nx\nENTITIES\ny\nLINE\n")


def test_a_file_that_breaks_off_is_mended_or_refused(tmp_path: Path) -> None:
    """Cut at any place it is read as far as it goes, or named: nothing else happens."""
    whole = saved(two_rooms(0.001), tmp_path / "whole.dxf").read_bytes()
    path = tmp_path / "part.dxf"
    start = whole.index(b"ENTITIES")
    read = []
    for share in (-0.5, 0.3, 0.6, 0.9):
        path.write_bytes(whole[: int(start + share * (len(whole) - start))])
        with contextlib.suppress(InputError):
            read.append(len(entities_of(open_dxf(path)).strokes))
    assert read == sorted(read)
    assert read[-1] in range(1, 12)


def test_drawings_without_lines_are_told_apart(tmp_path: Path) -> None:
    blank = saved(ezdxf.new(), tmp_path / "blank.dxf")
    with pytest.raises(NotFoundError, match=r"blank\.dxf has no lines in its model space"):
        read_vectors(blank)
    axes = ezdxf.new()
    for x in range(12):
        axes.modelspace().add_line((x, 0), (x, 9), {"layer": "GRID"})
    with pytest.raises(NotFoundError, match=r"axes\.dxf has no lines that may be of a house"):
        read_vectors(saved(axes, tmp_path / "axes.dxf"))
    model = ezdxf.new()
    for z in range(6):
        model.modelspace().add_3dface([(0, 0, z), (1, 0, z), (1, 1, z)])
    with pytest.raises(InputError, match="has 6 3D faces or solids and no lines"):
        read_vectors(saved(model, tmp_path / "model.dxf"))
    outer = ezdxf.new()
    outer.add_xref_def("ground.dwg", "ground")
    outer.modelspace().add_blockref("ground", (0, 0))
    with pytest.raises(InputError, match=r"refers to ground\.dwg for its content"):
        read_vectors(saved(outer, tmp_path / "outer.dxf"))


def test_blocks_in_blocks_end(tmp_path: Path) -> None:
    """Ten blocks, each with the next one ten times, are ten thousand million lines."""
    document = ezdxf.new()
    for depth in range(10):
        block = document.blocks.new(f"b{depth}")
        if depth == 9:
            block.add_line((0, 0), (1, 0))
        else:
            for number in range(10):
                block.add_blockref(f"b{depth + 1}", (number, depth))
    document.modelspace().add_blockref("b0", (0, 0))
    found: Entities = entities_of(document, most=100)
    assert found.more
    assert len(found.strokes) == 100


def test_a_dxf_is_one_drawing(tmp_path: Path) -> None:
    path = saved(two_rooms(), tmp_path / "house.dxf")
    assert [one.label for one in find_drawings([path])] == ["house.dxf"]
