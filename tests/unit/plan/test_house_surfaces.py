"""What a house consists of: floors under rooms, leaves that open, classes, provenance."""

from __future__ import annotations

import math

import numpy as np
import pytest
import trimesh
from sample_plan import HEIGHT_M, opening, rectangle, room, sample_plan, sample_storey, wall
from shapely.geometry import MultiPoint, Polygon

from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Junction, Opening
from veduta.plan.house.build import House, build_house
from veduta.plan.house.eaves import UNDER_M
from veduta.plan.house.placing import place_of, visitor_start
from veduta.plan.options import HouseOptions

SLAB_M = 0.25


def built(**changes: object) -> House:
    return build_house(sample_plan(), HouseOptions(**changes))


def points_of(part: Part, name: str) -> np.ndarray:
    """(n, 3) corners of the polygons of one feature."""
    row = part.features.name.index(name)
    sizes = np.diff(part.ring_offsets[part.polygon_offsets])
    return part.positions_m[np.repeat(part.polygon_feature == row, sizes)]


def rows_of(part: Part, semantic: SemanticClass) -> list[int]:
    return np.flatnonzero(part.features.class_code == semantic.code).tolist()


def test_each_room_has_a_floor_that_fills_it_and_a_ceiling() -> None:
    house = built()
    for one in sample_storey().rooms:
        outline = Polygon(one.outline_m)
        floor = MultiPoint(points_of(house.part, f"ground floor {one.id} floor")[:, :2])
        assert floor.convex_hull.symmetric_difference(outline).area < 1e-4
        heights = points_of(house.part, f"ground floor {one.id} ceiling")[:, 2]
        assert heights.max() == pytest.approx(HEIGHT_M - SLAB_M)


def test_every_surface_says_where_it_comes_from() -> None:
    part = built().part
    of = {name: part.features.provenance(row) for row, name in enumerate(part.features.name)}
    assert of["ground floor living floor"] is Provenance.MEASURED
    assert of["ground floor living ceiling"] is Provenance.INFERRED
    assert of["ground floor wall south-1 in living"] is Provenance.INFERRED
    assert of["roof 1"] is Provenance.INVENTED
    assert len(rows_of(part, SemanticClass.WINDOW)) == 2
    assert len(rows_of(part, SemanticClass.DOOR)) == 2


def test_walls_know_their_rooms() -> None:
    part = built().part
    materials = {}
    for row, name in enumerate(part.features.name):
        used = {part.materials[m].name for m in part.polygon_material[part.polygon_feature == row]}
        materials[name] = used
    assert materials["ground floor wall middle in living"] == {"inner-wall"}
    assert materials["ground floor wall middle in bath"] == {"tiled-wall"}
    assert materials["ground floor wall west outside"] == {"facade"}
    assert "ground floor wall middle outside" not in materials


def leaf_tip(part: Part, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Where the far end of a leaf is when it is closed and when it is open, (2,) each."""
    mover = next(one for one in part.movers if one.name == name)
    sizes = np.diff(part.ring_offsets[part.polygon_offsets])
    chosen = np.zeros(len(sizes), dtype=bool)
    chosen[mover.polygons] = True
    points = part.positions_m[np.repeat(chosen, sizes)].astype(float)[:, :2]
    pivot = np.array(mover.pivot_m[:2])
    far = points[np.linalg.norm(points - pivot, axis=1).argmax()]
    turn = mover.turn_rad * mover.axis[2]
    cos, sin = math.cos(turn), math.sin(turn)
    about = far - pivot
    turned = [cos * about[0] - sin * about[1], sin * about[0] + cos * about[1]]
    return far, pivot + turned + np.array(mover.shift_m[:2])


@pytest.mark.parametrize("hinge", ["start", "end"])
@pytest.mark.parametrize("swing", ["left", "right"])
def test_a_leaf_opens_to_its_side_about_its_hinge(hinge: str, swing: str) -> None:
    door = opening("d", "middle", 1.0, 0.9, hinge=hinge, swing=swing)
    part = build_house(sample_plan(sample_storey(openings=[door])), HouseOptions()).part
    closed, opened = leaf_tip(part, "d leaf")
    # The wall goes north at x = 5: left is west.
    side = -1.0 if swing == "left" else 1.0
    assert abs(closed[0] - 5.0) < 0.15
    assert side * (opened[0] - 5.0) > 0.7
    hinge_y = 1.0 if hinge == "start" else 1.9
    assert abs(opened[1] - hinge_y) < 0.15
    assert abs(closed[1] - (2.9 - hinge_y)) < 0.15


@pytest.mark.parametrize(
    ("kind", "leaves"),
    [("double", 2), ("french", 2), ("folding", 2), ("sliding", 1), ("pocket", 1), ("garage", 1)],
)
def test_types_of_doors_have_their_leaves(kind: str, leaves: int) -> None:
    door = Opening.model_validate(
        opening("d", "south-1", 0.8, 2.0).model_dump() | {"type": kind, "swing": "left"}
    )
    part = build_house(sample_plan(sample_storey(openings=[door])), HouseOptions()).part
    assert len(part.movers) == leaves
    still_open = [one for one in part.movers if one.turn_rad == 0.0 and one.shift_m == (0, 0, 0)]
    assert not still_open
    every = np.concatenate([one.polygons for one in part.movers])
    assert len(np.unique(every)) == len(every)


@pytest.mark.parametrize(("where", "glazed"), [("south-1", True), ("middle", False)])
def test_sliding_doors_onto_a_terrace_are_of_glass(where: str, glazed: bool) -> None:
    door = opening("d", where, 0.8, 1.8, type="sliding", hinge="end", swing="left")
    part = build_house(sample_plan(sample_storey(openings=[door])), HouseOptions()).part
    (leaf,) = part.movers
    looks = {part.materials[row].name for row in part.polygon_material[leaf.polygons]}
    assert ("glass" in looks) is glazed


def test_two_leaves_slide_apart() -> None:
    door = opening("d", "south-1", 1.6, 2.0, type="sliding", hinge="both", swing="left")
    part = build_house(sample_plan(sample_storey(openings=[door])), HouseOptions()).part
    left, right = sorted(part.movers, key=lambda one: one.shift_m[0])
    assert left.shift_m[0] == pytest.approx(-right.shift_m[0])
    assert right.shift_m[0] == pytest.approx(1.0, abs=0.07)
    assert set(left.polygons).isdisjoint(right.polygons)


def test_a_plain_gap_has_no_leaf() -> None:
    gap = Opening.model_validate(opening("g", "middle", 1.0, 0.9).model_dump() | {"kind": "gap"})
    part = build_house(sample_plan(sample_storey(openings=[gap])), HouseOptions()).part
    assert part.movers == ()


def test_frames_are_of_the_kind_that_is_asked_for() -> None:
    def frames(**options: object) -> int:
        part = built(**options).part
        number = [m.name for m in part.materials].index("frame") if any(
            m.name == "frame" for m in part.materials
        ) else -1  # fmt: skip
        return int((part.polygon_material == number).sum())

    whole = frames()
    foot = frames(window_frames="bottom", door_frames="bottom")
    none = frames(window_frames="none", door_frames="none")
    assert whole > foot > none == 0


def test_a_second_storey_stands_on_the_first() -> None:
    upper = sample_storey(name="upper floor", elevation_m=HEIGHT_M)
    part = build_house(sample_plan(sample_storey(), upper), HouseOptions(roof="none")).part
    floor = points_of(part, "upper floor living floor")[:, 2]
    assert floor.min() == pytest.approx(HEIGHT_M)
    assert part.bounds_m[1][2] == pytest.approx(2 * HEIGHT_M)


def test_a_balcony_has_a_floor_and_no_roof() -> None:
    balcony = room("balcony", rectangle(8.15, 0.0, 9.6, 5.0), use="balcony", outdoors=True)
    storey = sample_storey(rooms=[*sample_storey().rooms, balcony])
    house = build_house(sample_plan(storey), HouseOptions(overhang=0.0))
    assert "ground floor balcony floor" in house.part.features.name
    assert "ground floor balcony ceiling" not in house.part.features.name
    roof = points_of(house.part, "roof 1")
    assert roof[:, 0].max() < 8.3


def test_roofs_that_cannot_be_built_are_flat_and_said() -> None:
    flat = built(roof="flat").part
    assert points_of(flat, "roof 1")[:, 2].max() == pytest.approx(HEIGHT_M + 0.12)
    hipped = built().part
    # 5.3 m wide at its outer faces, with 0.45 m of overhang that hangs down at the same slope.
    rise = 5.3 / 2 * math.tan(math.radians(32.0))
    assert points_of(hipped, "roof 1")[:, 2].max() == pytest.approx(HEIGHT_M + rise, abs=0.02)


def test_the_visitor_stands_before_the_front_door() -> None:
    house = built()
    place = place_of(house, "house.glb", "plan.json", HouseOptions(plinth=0.1))
    assert place.start is not None
    assert place.start.eye[1] < -4.0
    assert 0.6 <= place.start.eye[0] <= 1.6
    assert place.start.target[1] == pytest.approx(0.0)
    assert place.parts["house"].standing.transform[2, 3] == pytest.approx(0.1)


def test_the_visitor_comes_nearer_where_a_part_of_the_house_is_in_the_way() -> None:
    storey = sample_storey()
    # A shed 3.3 m before the front door, at y = -3.3.
    junctions = [
        Junction(id=f"s{index}", at_m=at, type="L")
        for index, at in enumerate([(0.0, -6.0), (3.0, -6.0), (3.0, -3.3), (0.0, -3.3)])
    ]
    walls = [wall(f"shed-{i}", f"s{i}", f"s{(i + 1) % 4}") for i in range(4)]
    shaded = sample_storey(junctions=[*storey.junctions, *junctions], walls=[*storey.walls, *walls])
    house = build_house(sample_plan(shaded), HouseOptions())
    start = visitor_start(house)
    # 3 m from the middle of the door's wall; the shed begins at 3.15 m.
    assert start.eye[1] == pytest.approx(-3.0)


def test_without_a_door_the_visitor_sees_the_whole_house() -> None:
    house = build_house(sample_plan(sample_storey(openings=[], rooms=[])), HouseOptions())
    start = visitor_start(house)
    # Its front is 8.3 m wide, between outer faces, and lies at y = -0.15.
    assert start.eye == pytest.approx((4.0, -0.15 - 0.7 * 8.3, 1.7))
    assert start.target[0] == pytest.approx(4.0)


def test_a_gap_is_a_way_in_where_there_is_no_door() -> None:
    gap = opening("gap", "west", 1.0, 1.0, kind="gap", type="plain", score=0.4)
    house = build_house(sample_plan(sample_storey(openings=[gap], rooms=[])), HouseOptions())
    start = visitor_start(house)
    # The western wall runs south from (0, 5): its middle of the gap is at y = 3.5.
    assert start.eye == pytest.approx((-5.0, 3.5, 1.7))


def test_the_same_plan_gives_the_same_house() -> None:
    first, second = built().part, built().part
    assert np.array_equal(first.positions_m, second.positions_m)
    assert first.features.id == second.features.id


def test_a_space_whose_walls_have_a_gap_is_floored_and_roofed() -> None:
    storey = sample_storey()
    junctions = [*storey.junctions, Junction(id="g", at_m=(8.0, 3.8), type="end")]
    # The eastern wall ends 1.2 m before the corner.
    walls = [
        one.model_copy(update={"end": "g"}) if one.id == "east" else one for one in storey.walls
    ]
    broken = sample_storey(junctions=junctions, walls=walls, rooms=storey.rooms[:1], openings=[])
    house = build_house(sample_plan(broken), HouseOptions(overhang=0.0))
    assert any("have a gap in their walls" in note for note in house.part.notes)
    assert "ground floor unnamed floor" in house.part.features.name
    roof = points_of(house.part, "roof 1")
    assert roof[:, 0].max() > 8.0


@pytest.mark.parametrize("overhang", [0.0, 0.45, 1.5])
def test_eaves_hang_outside_and_nothing_of_the_roof_is_in_rooms(overhang: float) -> None:
    part = built(overhang=overhang).part
    row = part.features.name.index("roof 1")
    triangles = part.triangles.indices[part.polygon_feature[part.triangles.polygon] == row]
    mesh = trimesh.Trimesh(part.positions_m.astype(float), triangles, process=False)
    mesh.merge_vertices()
    assert mesh.is_watertight
    # The eaves hang down by the slope.
    drop = overhang * math.tan(math.radians(32.0))
    assert mesh.bounds[0][2] == pytest.approx(HEIGHT_M + UNDER_M - drop, abs=1e-5)
    x, y = np.meshgrid(np.linspace(0.1, 7.9, 9), np.linspace(0.1, 4.9, 7))
    origins = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 0.1)])
    hits, *_ = mesh.ray.intersects_location(origins, np.tile([0.0, 0.0, 1.0], (x.size, 1)))
    assert hits[:, 2].min() >= HEIGHT_M
