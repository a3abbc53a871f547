"""Flights against closed forms and rays: steps, headroom, wells, rails, and which way they rise."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh
from closed_shells import shells
from sample_plan import HEIGHT_M, rectangle, room, sample_plan, sample_storey
from shapely.geometry import Polygon

from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Stairs
from veduta.plan.house.build import build_house
from veduta.plan.house.flights import stairwells
from veduta.plan.house.headroom import HEADROOM_M
from veduta.plan.house.space import space_of
from veduta.plan.options import HouseOptions

TREADS, RUN_M, SLAB_M = 14, 3.5, 0.25
FLIGHT = rectangle(1.0, 3.85, 1.0 + RUN_M, 4.85)
"""Along the northern wall of the living room: its right side is free."""
RISER_M = HEIGHT_M / (TREADS + 1)


def flight(up: tuple[float, float] = (1.0, 0.0)) -> Stairs:
    return Stairs(id="s1", outline_m=FLIGHT, treads=TREADS, up=up, score=0.9)


def house(*, below: bool = True, above: bool = True, up: tuple[float, float] = (1.0, 0.0)) -> Part:
    ground = sample_storey(stairs=[flight(up)] if below else [])
    first = sample_storey(
        name="first floor", elevation_m=HEIGHT_M, stairs=[flight(up)] if above else []
    )
    return build_house(sample_plan(ground, first), HouseOptions(slab=SLAB_M)).part


def test_a_void_has_no_floor_and_no_ceiling_below_it() -> None:
    void = room("void", rectangle(0.2, 0.2, 2.2, 2.2), open_below=True)
    rest = room("rest", rectangle(2.2, 0.2, 6.0, 2.2))
    ground = sample_storey()
    shapes = [ground, *(sample_storey(name="first floor", elevation_m=HEIGHT_M, rooms=rooms)
                        for rooms in ([void, rest], [rest]))]  # fmt: skip
    spaces = [space_of(one, HEIGHT_M - SLAB_M) for one in shapes]
    opened, whole = (stairwells([spaces[0], one], SLAB_M)[0].opening for one in spaces[1:])
    assert whole.is_empty
    inside = Polygon(rectangle(0.2, 0.2, 2.2, 2.2)).difference(spaces[1].walls)
    assert opened.symmetric_difference(inside.difference(spaces[0].walls)).area < 0.05
    house = build_house(sample_plan(ground, shapes[1]), HouseOptions(slab=SLAB_M)).part
    down = mesh_of(house).ray
    heights = [
        down.intersects_location([[x, 1.2, HEIGHT_M + 1.0]], [[0.0, 0.0, -1.0]])[0][:, 2].max()
        for x in (1.2, 4.5)
    ]
    assert heights[0] < 0.5 < HEIGHT_M - 0.1 < heights[1]


def mesh_of(part: Part, *names: str) -> trimesh.Trimesh:
    """The triangles of features; of all where none is named."""
    rows = [row for row, name in enumerate(part.features.name) if not names or name in names]
    triangles = part.triangles
    owner = part.polygon_feature[triangles.polygon]
    kept = triangles.indices[np.isin(owner, rows)]
    return trimesh.Trimesh(part.positions_m.astype(float), kept, process=False)


@pytest.fixture(scope="module")
def part() -> Part:
    return house()


def test_a_flight_is_a_closed_solid_of_steps(part: Part) -> None:
    mesh = mesh_of(part, "ground floor stairs s1", "ground floor stairs s1 body")
    mesh.merge_vertices()
    assert mesh.is_watertight
    going = RUN_M / TREADS
    # Steps are triangles on the pitch and the wedge below it, cut by the underside and the floor.
    under = 1.2 * going
    stepped = sum(number * RISER_M * going for number in range(1, TREADS + 1))
    void = 0.5 * (RUN_M - under) * (TREADS - 1.2) * RISER_M
    width = 1.0 - 0.01
    assert mesh.volume == pytest.approx((stepped - void) * width, rel=1e-4)
    low, high = mesh.bounds
    assert high[2] - low[2] == pytest.approx(HEIGHT_M - RISER_M, abs=1e-5)


def test_a_head_has_room_over_every_tread(part: Part) -> None:
    mesh = mesh_of(part)
    going = RUN_M / TREADS
    at = 1.0 + going * (np.arange(TREADS) + 0.5)
    heights = RISER_M * (np.arange(TREADS) + 1)
    for y in (3.95, 4.35, 4.75):
        origins = np.column_stack([at, np.full(TREADS, y), heights + 0.02])
        hits, rays, _ = mesh.ray.intersects_location(
            origins, np.tile([0.0, 0.0, 1.0], (TREADS, 1)), multiple_hits=False
        )
        room = np.full(TREADS, np.inf)
        room[rays] = hits[:, 2] - heights[rays]
        assert room.min() >= HEADROOM_M


def test_the_slab_is_open_no_farther_than_a_head_needs_it(part: Part) -> None:
    slab = mesh_of(part, "ground floor slab")
    steps = int((HEIGHT_M - SLAB_M - HEADROOM_M) // RISER_M) - 1
    solid = 1.0 + steps * RUN_M / TREADS - 0.05
    hits, rays, _ = slab.ray.intersects_location(
        np.array([[solid, 4.35, 1.0], [solid + 0.1, 4.35, 1.0]]), np.tile([0.0, 0.0, 1.0], (2, 1))
    )
    assert set(rays.tolist()) == {0}
    assert len(hits) == 2


def test_free_sides_have_rails_and_the_arrival_is_open(part: Part) -> None:
    names = part.features.name
    assert "ground floor stairs s1 right rail" in names
    assert "ground floor stairs s1 left rail" not in names  # there stands the wall
    guard = [name for name in names if name.startswith("first floor stairwell rail")]
    assert len(guard) == 2  # the long free side, and the end over the foot
    mesh = mesh_of(part, *guard)
    # Nobody climbs over a rail to arrive.
    assert mesh.bounds[1][0] < 1.0 + RUN_M + 0.06
    top = mesh_of(part, *guard).bounds[1][2]
    assert top == pytest.approx(HEIGHT_M + 0.95, abs=0.02)


def test_surfaces_say_what_they_are(part: Part) -> None:
    row = part.features.name.index("ground floor stairs s1")
    assert part.features.class_code[row] == SemanticClass.FLOOR.code
    assert part.features.provenance(row) is Provenance.INFERRED
    rail = part.features.name.index("ground floor stairs s1 right rail")
    assert part.features.provenance(rail) is Provenance.INVENTED
    # What one treads on looks up.
    triangles = part.triangles
    treads = triangles.indices[part.polygon_feature[triangles.polygon] == row]
    corners = part.positions_m[treads].astype(float)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 2] > 0).all()
    assert normals[:, 2].sum() / 2 == pytest.approx(RUN_M * 0.99, rel=1e-4)


def test_slabs_stairs_and_rails_are_closed(part: Part) -> None:
    of = part.features.shell.tolist()
    closed = 0
    for number, shell in enumerate(shells(part)):
        name = part.features.name[of.index(number)] if number in of else ""
        if any(word in name for word in ("stair", "slab", "ceiling")):
            assert shell.is_watertight, name
            closed += 1
    assert closed == 1 + 1 + 2 + 3 + 4  # flight, its rail, guards, slabs, ceilings


def test_a_flight_that_only_the_upper_storey_shows_comes_up_from_below() -> None:
    part = house(below=False)
    assert "ground floor stairs s1" in part.features.name
    assert any("drawn in the upper storey only" in note for note in part.notes)


@pytest.mark.parametrize("drawn_in", ["ground floor", "first floor"])
def test_stairs_that_are_too_small_are_told_where_they_are_drawn(drawn_in: str) -> None:
    small = flight().model_copy(update={"outline_m": rectangle(1.0, 1.0, 1.3, 1.5)})
    storeys = [
        sample_storey(name=name, elevation_m=up, stairs=[small] if name == drawn_in else [])
        for name, up in (("ground floor", 0.0), ("first floor", HEIGHT_M))
    ]
    wells = stairwells([space_of(one, HEIGHT_M - SLAB_M) for one in storeys], SLAB_M)
    (note,) = wells[0].notes
    assert note.startswith(f"stairs s1 of {drawn_in} are left out")


def test_without_an_arrow_the_foot_is_at_the_free_end() -> None:
    part = house(up=(0.0, 0.0))
    row = part.features.name.index("ground floor stairs s1")
    assert part.features.provenance(row) is Provenance.INVENTED
    assert any("nothing tells which way they rise" in note for note in part.notes)
    # Half a metre before the flight's right end stands the middle wall: it rises to there.
    low = mesh_of(part, "ground floor stairs s1").triangles_center
    assert low[np.argmin(low[:, 2]), 0] < low[np.argmax(low[:, 2]), 0]


def test_steep_and_stray_flights_are_told() -> None:
    few = flight().model_copy(update={"treads": 7})
    out = flight().model_copy(update={"outline_m": rectangle(20.0, 20.0, 21.0, 23.0), "id": "s2"})
    storeys = (
        sample_storey(stairs=[few, out]),
        sample_storey(name="first floor", elevation_m=HEIGHT_M),
    )
    spaces = [space_of(storey, HEIGHT_M - SLAB_M) for storey in storeys]
    wells = stairwells(spaces, SLAB_M)
    assert wells[1].flights == ()
    notes = " ".join(wells[0].notes)
    assert "steep, 8 steps of 35 cm" in notes
    assert "s2 from ground floor to first floor end outside the upper storey" in notes
    assert Polygon(FLIGHT).buffer(1e-6).contains(wells[0].opening)


def test_a_single_storey_has_none() -> None:
    part = build_house(sample_plan(sample_storey(stairs=[flight()])), HouseOptions()).part
    assert not any("stairs" in name for name in part.features.name)
