"""Stairs that turn, built and walked: closed solids, headroom, rails, by rays and closed forms."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
import trimesh
from closed_shells import shells
from plan_documents import document_of
from plan_tour import judge
from scipy.spatial import KDTree
from shapely.geometry import Point, Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.place.part import Part
from veduta.plan.document import Stairs
from veduta.plan.house.build import House, build_house
from veduta.plan.house.flights import stairwells
from veduta.plan.house.headroom import HEADROOM_M
from veduta.plan.house.turning import TurningFlight, turning_flight
from veduta.plan.house.turning_solid import WAIST_M
from veduta.plan.options import HouseOptions
from veduta.plan.tour.climbs import climbs_of
from veduta.plan.tour.find import find_tour
from veduta.synthetic.plans import house as true
from veduta.synthetic.plans.layout import make_house

SEEDS = {
    "quarter-winding": 101, "half-winding": 104, "quarter-landing": 108, "half-landing": 112,
    "spiral": 116,
}  # fmt: skip
RISE_M = 2.8
SLAB_M = HouseOptions().slab


@cache
def drawn(kind: str) -> true.House:
    found = make_house(SEEDS[kind], storeys=2)
    assert found.storeys[0].stairs[0].kind == kind
    return found


@cache
def built(kind: str) -> House:
    return build_house(document_of(drawn(kind)), HouseOptions())


@cache
def flight_of(kind: str) -> TurningFlight:
    (flight,) = stairwells(built(kind).spaces, SLAB_M)[0].flights
    assert isinstance(flight, TurningFlight)
    return flight


def mesh_of(part: Part, *names: str) -> trimesh.Trimesh:
    """The triangles of features; of all where none is named."""
    rows = [row for row, name in enumerate(part.features.name) if not names or name in names]
    triangles = part.triangles
    kept = triangles.indices[np.isin(part.polygon_feature[triangles.polygon], rows)]
    return trimesh.Trimesh(part.positions_m.astype(float), kept, process=False)


@pytest.mark.parametrize("kind", SEEDS)
def test_the_steps_are_one_closed_solid(kind: str) -> None:
    """Its volume is that of prisms from each tread down to its underside."""
    part, flight = built(kind).part, flight_of(kind)
    mesh = mesh_of(part, "Ground floor stairs s0", "Ground floor stairs s0 body")
    mesh.merge_vertices()
    assert mesh.is_watertight
    riser = RISE_M / (flight.treads + 1)
    deep = riser + WAIST_M
    volume = sum(
        step.area * min(deep, (number + 1) * riser) for number, step in enumerate(flight.steps)
    )
    assert mesh.volume == pytest.approx(volume, rel=1e-3)
    assert mesh.bounds[1][2] == pytest.approx(RISE_M - riser, abs=1e-5)


@pytest.mark.parametrize("kind", SEEDS)
def test_a_head_has_room_over_every_step_of_the_way(kind: str) -> None:
    house, flight = built(kind), flight_of(kind)
    mesh = mesh_of(house.part)
    line = flight.line_m
    origins = line + np.array([0.0, 0.0, 0.1])
    hits, rays, _ = mesh.ray.intersects_location(
        origins, np.tile([0.0, 0.0, 1.0], (len(line), 1)), multiple_hits=False
    )
    assert (hits[:, 2] - line[rays, 2]).min(initial=np.inf) >= HEADROOM_M
    # The slab is not open over the lower steps.
    slab = mesh_of(house.part, "Ground floor slab")
    hits, _, _ = slab.ray.intersects_location(origins[:1], np.array([[0.0, 0.0, 1.0]]))
    assert len(hits) > 0


@pytest.mark.parametrize("kind", SEEDS)
def test_rails_stand_on_free_sides_and_not_in_the_way(kind: str) -> None:
    part, flight = built(kind).part, flight_of(kind)
    names = [name for name in part.features.name if "rail" in name and "stair" in name]
    assert any("stairwell rail" in name for name in names)
    assert any("stairs s0 rail" in name for name in names)
    assert ("Ground floor stairs s0 column" in part.features.name) == (kind == "spiral")
    rails = mesh_of(part, *names)
    # A body of 20 cm radius passes between all of them.
    places = np.concatenate([flight.line_m + np.array([0.0, 0.0, up]) for up in (0.5, 0.9)])
    points, _ = trimesh.sample.sample_surface(rails, 20_000, seed=0)
    away, _ = KDTree(points).query(places)
    assert np.min(away) > 0.2
    for number, shell in enumerate(shells(part)):
        owner = part.features.shell.tolist()
        name = part.features.name[owner.index(number)] if number in owner else ""
        assert "stair" not in name or shell.is_watertight, name


@pytest.mark.parametrize("kind", SEEDS)
def test_the_feet_are_on_the_tread_in_its_middle_and_never_drop(kind: str) -> None:
    flight = flight_of(kind)
    line, riser = flight.line_m, flight.riser_m
    assert (np.diff(line[:, 2]) >= -1e-9).all()
    for number, step in enumerate(flight.steps):
        on = [z for x, y, z in line if step.buffer(-0.03).contains(Point(x, y))]
        assert any(z == pytest.approx((number + 1) * riser, abs=1e-6) for z in on), number
        assert all(abs(z - (number + 1) * riser) <= riser / 2 + 1e-6 for z in on)


def test_one_is_level_on_a_landing() -> None:
    """Half of a tread is left on both sides of what is level."""
    flight = flight_of("quarter-landing")
    areas = [step.area for step in flight.steps]
    landing = int(np.argmax(areas))
    height = (landing + 1) * flight.riser_m
    level = flight.line_m[np.abs(flight.line_m[:, 2] - height) < 1e-9]
    assert np.hypot(*np.diff(level[:, :2], axis=0).T).sum() > 0.4


@pytest.mark.parametrize("kind", ["spiral"])
def test_the_tour_climbs_them_and_sees_all_rooms(kind: str) -> None:
    house = built(kind)
    tour = find_tour(house, 1.2)
    assert tour is not None
    found = judge(house, tour)
    assert found.visited == found.rooms
    assert found.missed == ()
    assert found.clear_m > 0.14
    assert found.turn_deg_s <= 60.0


def test_a_wall_above_the_foot_of_stairs_is_not_in_the_way() -> None:
    """Of the upper storey only walls count that a head comes up to."""
    house = built("half-winding")
    wells = stairwells(house.spaces, SLAB_M)
    (climb,) = climbs_of(house.spaces, wells)
    assert climb.line_m[-1, 2] == pytest.approx(RISE_M)
    lower, upper = house.spaces
    foot = Point(*climb.foot_m).buffer(0.1)
    high = Point(*climb.head_m).buffer(0.1)

    def with_wall(at: BaseGeometry) -> int:
        space = type(upper)(
            upper.storey, upper.lines, unary_union([upper.walls, at]), upper.holes, upper.notes
        )
        return len(climbs_of((lower, space), wells))

    assert with_wall(high) == 0
    flight = flight_of("half-winding")
    low = flight.steps[0].difference(flight.well(SLAB_M))
    assert with_wall(foot.intersection(low)) == 1


def one_stair(steps: list[Polygon], path: list[tuple[float, float]]) -> TurningFlight:
    stairs = Stairs(
        id="s", outline_m=[(0, 0), (1, 0), (1, 1)], treads=len(steps), up=(0.0, 1.0), score=1.0,
        steps_m=[list(step.exterior.coords)[:-1] for step in steps], path_m=path,
    )  # fmt: skip
    found = turning_flight(stairs, 3.0)
    assert found is not None
    return found


def test_edges_that_two_treads_share_are_the_same_corners() -> None:
    """A landing beside two flights has their corners on its side."""
    landing, left, right = box(0, 1, 2, 2), box(0, 0, 0.9, 1), box(1.1, 0, 2, 1)
    flight = one_stair([left, landing, right], [(0.45, 0), (0.45, 1.5), (1.55, 1.5), (1.55, 0)])
    shared = [edge for edge, owner in flight.owners.items() if edge[::-1] in flight.owners]
    assert len(shared) == 4
    assert {flight.owners[edge] for edge in shared} == {0, 1, 2}
    assert flight.starts_m == pytest.approx([0.0, 1.0, 3.1, 4.1], abs=0.01)
    assert flight.foot.length == pytest.approx(0.9)
    assert flight.arrival.bounds[1] == 0.0
    assert flight.riser_m == pytest.approx(0.75)


def test_no_stairs_without_a_height_to_climb() -> None:
    stairs = Stairs(
        id="s", outline_m=[(0, 0), (1, 0), (1, 1)], treads=1, up=(0.0, 1.0), score=1.0,
        steps_m=[[(0, 0), (1, 0), (1, 1)]], path_m=[(0.0, 0.0), (1.0, 1.0)],
    )  # fmt: skip
    assert turning_flight(stairs, 0.0) is None


@pytest.mark.parametrize("kind", SEEDS)
def test_one_can_step_on_and_off_the_drawn_stairs(kind: str) -> None:
    """A body of 40 cm stands before both ends, off the stairs, and comes to a door from there."""
    for storey in drawn(kind).storeys:
        stairs = storey.stairs[0]
        room = next(room for room in storey.rooms if room.use == "stairs")
        area = Polygon(room.outline_m)
        assert area.buffer(1e-3).contains(Polygon(stairs.outline_m))
        free = area.difference(Polygon(stairs.outline_m)).buffer(-0.2)
        for end, before in (stairs.path_m[:2], stairs.path_m[:-3:-1]):
            way = np.array(end) - np.array(before)
            at = np.array(end) + 0.3 * way / math.hypot(*way)
            assert free.buffer(0.01).contains(Point(*at))
    riser = RISE_M / (stairs.treads + 1)
    assert 0.15 < riser < 0.215
