"""Whole tours: all rooms, no wall, no quick turn; and what is said where it cannot be done."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from plan_documents import document_of
from plan_tour import furnished, judge
from sample_plan import opening, room, sample_plan, sample_storey, wall
from shapely.geometry import LineString, Point
from shapely.ops import unary_union

from veduta.plan.document import Furniture, Junction, PlanDocument, Stairs, Storey
from veduta.plan.house.build import House, build_house
from veduta.plan.house.entrance import entrances
from veduta.plan.house.placing import place_of
from veduta.plan.options import HouseOptions
from veduta.plan.steps import tour_step
from veduta.plan.tour import find
from veduta.plan.tour.clear_view import before_eyes
from veduta.plan.tour.find import EYE_M, INDOORS, Tour, find_tour
from veduta.plan.tour.free import BODY_M
from veduta.plan.tour.leaves import leaves_as_toured, with_shut
from veduta.plan.tour.outside import outside_of
from veduta.plan.tour.pace import TURN_RAD_S, travelled
from veduta.plan.tour.placing import placed_tour
from veduta.plan.tour.planned import plan_for
from veduta.plan.tour.stretches import Stretch, outdoor_share
from veduta.run.report import StepRecord
from veduta.synthetic.plans.layout import make_house

SPEED_M_S = 1.2
SEEDS = range(21_000, 21_010)


def toured(document: PlanDocument, speed_m_s: float = SPEED_M_S) -> tuple[House, Tour]:
    house = build_house(document, HouseOptions())
    tour = find_tour(house, speed_m_s)
    assert tour is not None
    return house, tour


@pytest.mark.parametrize("seed", SEEDS)
def test_tours_of_houses_keep_what_they_promise(seed: int) -> None:
    """Against the model as it is written, by rays: see benchmarks/plan/plan_tour.py."""
    drawn = make_house(seed, storeys=1)
    document = document_of(drawn)
    house, tour = toured(furnished(document, seed) if seed % 2 else document)
    found = judge(house, tour)
    assert found.visited == found.rooms
    assert tour.notes == ()
    assert found.clear_m > 0.15
    assert 20.0 < found.turn_deg_s <= np.degrees(TURN_RAD_S)
    assert 1.0 < found.speed_m_s <= SPEED_M_S + 1e-6


def shares(tour: Tour) -> float:
    """How much of the tour is outdoors."""
    outdoors = sum(one.end_s - one.start_s for one in tour.stretches if one.title == "Outside")
    return float(outdoors / tour.path.times_s[-1])


def nearest_walls(house: House, tour: Tour) -> np.ndarray:
    """At each second, how far the nearest wall is in the direction of the gaze, by exact lines."""
    times = np.arange(0.5, tour.path.times_s[-1], 1.0)
    eyes = np.stack([np.interp(times, tour.path.times_s, x) for x in tour.path.eyes_m.T], axis=1)
    ways = np.stack([np.interp(times, tour.path.times_s, x) for x in tour.path.directions.T], 1)
    ways = ways[:, :2] / np.linalg.norm(ways[:, :2], axis=1)[:, None]
    space = house.spaces[0]
    solid = space.walls.difference(unary_union([hole.outline for hole in space.holes]))
    rays = [LineString([eye[:2], eye[:2] + 5.0 * way]) for eye, way in zip(eyes, ways, strict=True)]
    met = [ray.intersection(solid) for ray in rays]
    away = [one.distance(Point(eye[:2])) for one, eye in zip(met, eyes, strict=True)]
    return np.array([5.0 if np.isnan(one) else one for one in away])


def test_the_tour_begins_and_ends_before_the_door() -> None:
    house, tour = toured(sample_plan())
    assert [stretch.title for stretch in tour.stretches][:2] == ["Outside", "Living"]
    assert tour.stretches[-1].title == "Outside"
    eyes = tour.path.eyes_m
    assert (eyes[:, 2] == EYE_M).all()
    slab = house.spaces[0].slab
    assert all(slab.distance(Point(eyes[row][:2])) > 0.5 for row in (0, -1))


@pytest.mark.parametrize("seed", [21_001, 21_004, 21_007])
def test_a_fifth_is_outdoors_at_most_and_no_wall_is_before_ones_eyes(seed: int) -> None:
    house, tour = toured(document_of(make_house(seed, storeys=1)))
    assert 0.02 < shares(tour) <= 0.2
    walls = nearest_walls(house, tour)
    # Doorways and corners are passed: of a hundred looks a few meet a wall that is nearer.
    assert float((walls < 1.0).mean()) < 0.05


def test_what_slow_turns_add_outdoors_is_taken_off_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """As much as if half as much again had been planned as there may be."""
    house = build_house(document_of(make_house(21_002, storeys=1)), HouseOptions())
    monkeypatch.setattr(find, "SPARED", 1.5)
    monkeypatch.setattr(find, "TRIES", 1)
    much = find_tour(house, SPEED_M_S)
    monkeypatch.setattr(find, "TRIES", 4)
    less = find_tour(house, SPEED_M_S)
    assert much is not None
    assert less is not None
    assert shares(much) > find.OUTDOORS >= shares(less) > 0.5 * find.OUTDOORS
    assert find.outdoor_notes(less.stretches) == []


def test_a_tour_that_is_longer_outdoors_than_aimed_at_says_so_in_its_step() -> None:
    """Of a house this small: one begins and ends a metre before its door."""
    steps: list[StepRecord] = []
    tour, _ = tour_step(build_house(with_wardrobe(), HouseOptions()), HouseOptions(), steps, silent)
    assert tour is not None
    assert shares(tour) > find.OUTDOORS
    assert "outdoors, where 20% are the most" in steps[0].rejected[0]


def silent(step: str, share: float) -> None:
    """A progress that nobody sees."""


def test_a_room_whose_name_is_outside_is_none_of_the_outdoors() -> None:
    walked = (Stretch("den", "Outside", 0, 0.0, 9.0), Stretch(None, "Outside", None, 9.0, 10.0))
    assert outdoor_share(walked) == pytest.approx(0.1)


def with_wardrobe() -> PlanDocument:
    """The sample with a wardrobe for its bath: one room is left to visit."""
    storey = sample_storey()
    rooms = [
        one.model_copy(update={"use": "wardrobe", "area_m2": 2.0}) if one.id == "bath" else one
        for one in storey.rooms
    ]
    return sample_plan(storey.model_copy(update={"rooms": rooms}))


def test_cupboards_are_not_visited() -> None:
    _, tour = toured(with_wardrobe())
    assert "bath" not in {stretch.room for stretch in tour.stretches}
    assert tour.notes == ()


def test_it_looks_at_the_house_from_outside_and_into_rooms() -> None:
    house, tour = toured(sample_plan())
    path = tour.path
    outside = path.times_s < 0.8 * tour.stretches[0].end_s
    to_house = np.array([4.0, 2.5]) - path.eyes_m[outside][:, :2]
    to_house /= np.linalg.norm(to_house, axis=1)[:, None]
    assert ((path.directions[outside][:, :2] * to_house).sum(axis=1) > 0.5).all()
    # In each room one sees to both sides: directions span more than half a turn.
    for name in ("Living", "Bath"):
        times = [(one.start_s, one.end_s) for one in tour.stretches if one.title == name]
        inside = np.any([(path.times_s >= a) & (path.times_s <= b) for a, b in times], axis=0)
        yaw = np.unwrap(np.arctan2(*path.directions[inside][:, 1::-1].T))
        assert yaw.max() - yaw.min() > np.pi / 2
    assert len(house.spaces) == 1


def test_rooms_without_a_door_are_named() -> None:
    openings = [opening("front", "south-1", 0.6, 1.0, hinge="start", swing="left")]
    _, tour = toured(sample_plan(sample_storey(openings=openings)))
    assert tour.notes == (
        "the tour leaves out Bath (bath) of ground floor: no door that is wide enough leads to it",
    )
    assert "bath" not in {stretch.room for stretch in tour.stretches}


def behind_a_leaf() -> PlanDocument:
    """A bedroom before whose door the leaf of a wardrobe stands when it is open."""
    more = {"g": (5.0, 1.3), "h": (6.2, 1.3), "i": (6.2, 0.0)}
    base = sample_storey()
    junctions = [*base.junctions,
                 *(Junction(id=name, at_m=at, type="T") for name, at in more.items())]  # fmt: skip
    kept = [one for one in base.walls if one.id not in {"middle", "south-2"}]
    walls = [
        *kept, wall("middle", "g", "e", outer=False), wall("low", "b", "g", outer=False),
        wall("top", "g", "h", outer=False), wall("side", "i", "h", outer=False),
        wall("south-2", "b", "i"), wall("south-3", "i", "c"),
    ]  # fmt: skip
    openings = [
        opening("front", "south-1", 0.6, 1.0, hinge="start", swing="left"),
        opening("inner", "middle", 0.2, 0.8, hinge="end", swing="left"),
        opening("robe", "top", 0.15, 0.8, hinge="start", swing="left"),
    ]
    corner = [(5.06, 1.36), (6.26, 1.36), (6.26, 0.15), (7.85, 0.15), (7.85, 4.85), (5.06, 4.85)]
    rooms = [
        base.rooms[0], room("bed", corner, use="bedroom", name="Bedroom"),
        room("robe", [(5.06, 0.15), (6.14, 0.15), (6.14, 1.24), (5.06, 1.24)], use="wardrobe"),
    ]  # fmt: skip
    changes: dict[str, Any] = {"junctions": junctions, "walls": walls, "rooms": rooms}
    return sample_plan(sample_storey(openings=openings, **changes))


def test_a_leaf_in_the_way_to_a_bedroom_is_kept_closed() -> None:
    house, tour = toured(behind_a_leaf())
    assert "bed" in {stretch.room for stretch in tour.stretches}
    assert placed_tour(tour, 0.0).shut == ["house/ground-floor-door-robe"]
    assert tour.notes == (
        "the tour keeps ground floor door robe closed: open, its leaf bars the way to a room",
    )
    as_toured = with_shut(house.part, tour.shut)
    stand = {mover.name.split()[0]: mover.opened for mover in as_toured.movers}
    assert stand["robe"] == 0.0 < min(stand["front"], stand["inner"])
    assert judge(replace(house, part=as_toured), tour).clear_m > 0.15
    # As it was, with all doors open, nobody of his size gets in.
    assert planned_with_all_open(house) == {"living"}


def planned_with_all_open(house: House) -> set[str]:
    """The rooms that one reaches who closes no door."""
    found = plan_for(house, outside_of(house.spaces[0], entrances(house.spaces[0])[0]), BODY_M)
    assert found is not None
    return {stop.room.id for stop in found.found.stops}


def test_no_door_is_closed_where_that_opens_no_room() -> None:
    walled_up = [one for one in behind_a_leaf().storeys[0].openings if one.id != "inner"]
    storey = behind_a_leaf().storeys[0].model_copy(update={"openings": walled_up})
    for document in (sample_plan(), sample_plan(storey)):
        assert toured(document)[1].shut == ()


def test_wardrobes_and_open_leaves_are_before_ones_eyes_and_tables_are_not() -> None:
    house, _ = toured(sample_plan())
    space = house.spaces[0]
    leaf = next(one for one in leaves_as_toured(house.part) if one.low_m < 1.0)
    place = leaf.footprint.centroid
    assert not before_eyes(space).contains(place)
    assert before_eyes(space, [leaf]).buffer(1e-6).contains(place)
    for high, seen in ((2.0, True), (0.8, False)):
        item = Furniture(room="living", id="f", object="wardrobe", at_m=(2.5, 2.5), turn_rad=0.0,
                         size_m=(1.0, 0.6, high))  # fmt: skip
        changed = space.storey.model_copy(update={"furniture": [item]})
        assert before_eyes(replace(space, storey=changed)).contains(Point(2.5, 2.5)) is seen


def test_a_house_without_a_way_in_is_toured_indoors() -> None:
    openings = [opening("inner", "middle", 1.0, 0.9, hinge="end", swing="right")]
    _, tour = toured(sample_plan(sample_storey(openings=openings)))
    assert tour.notes == (INDOORS,)
    assert {stretch.room for stretch in tour.stretches} == {"living", "bath"}


def test_no_tour_where_nobody_can_stand() -> None:
    tiny = [room("cell", [(0.2, 0.2), (0.3, 0.2), (0.3, 0.3), (0.2, 0.3)])]
    house = build_house(sample_plan(sample_storey(rooms=tiny, openings=[])), HouseOptions())
    assert find_tour(house, SPEED_M_S) is None


def two_storeys() -> PlanDocument:
    """A flight along the north wall of the living room leads to the storey above."""
    outline = [(1.2, 3.8), (4.0, 3.8), (4.0, 4.8), (1.2, 4.8)]
    flight = Stairs(id="s", outline_m=outline, treads=15, up=(1.0, 0.0), score=1.0)
    changes: dict[str, Any] = {"name": "first floor", "elevation_m": 2.8}
    inner = [opening("inner", "middle", 1.0, 0.9, hinge="end", swing="right")]
    upper: Storey = sample_storey(openings=inner, **changes)
    return sample_plan(sample_storey(stairs=[flight]), upper)


def test_stairs_lead_to_the_storey_above_and_back() -> None:
    _, tour = toured(two_storeys())
    assert tour.notes == ()
    heights = tour.path.eyes_m[:, 2] - EYE_M
    assert heights.max() == pytest.approx(2.8)
    assert heights[-1] == 0.0
    # Between the storeys one is on the flight, at the height of its slope.
    between = (heights > 0.01) & (heights < 2.79)
    on = tour.path.eyes_m[between]
    assert between.sum() >= 4
    assert (np.abs(on[:, 1] - 4.3) < 0.1).all()
    slope = np.polyfit(on[:, 0], heights[between], 1)
    assert slope[0] == pytest.approx(2.8 / (2.8 + 2 * 0.3), rel=0.05)
    upstairs = {
        stretch.room
        for stretch in tour.stretches
        if np.interp(stretch.start_s, tour.path.times_s, heights) > 2.7
    }
    assert upstairs == {"living", "bath"}
    # Rooms of both storeys have the same ids, and are not one.
    assert len({(one.storey, one.room) for one in tour.stretches if one.room}) == 4


def test_a_storey_without_stairs_is_named() -> None:
    document = two_storeys()
    lower = document.storeys[0].model_copy(update={"stairs": []})
    _, tour = toured(document.model_copy(update={"storeys": [lower, document.storeys[1]]}))
    assert tour.notes == ("the tour leaves out first floor: no way leads to it",)


def test_the_speed_is_that_of_the_option() -> None:
    _, slow = toured(sample_plan(), 0.6)
    _, usual = toured(sample_plan())
    speeds = np.linalg.norm(np.diff(slow.path.eyes_m, axis=0), axis=1) / np.diff(slow.path.times_s)
    assert 0.55 < speeds.max() <= 0.6 + 1e-6
    assert slow.path.times_s[-1] > 1.3 * usual.path.times_s[-1]


@pytest.mark.parametrize("length", [0.05, 0.5, 1.44, 7.3])
def test_walking_starts_and_stops_softly(length: float) -> None:
    at = travelled(length, SPEED_M_S)
    assert (at[0], at[-1]) == (0.0, pytest.approx(length))
    speed = np.gradient(at)
    assert (np.diff(at) >= 0.0).all()
    assert speed[0] < speed.max()
    assert speed[-1] < speed.max()


def test_the_place_has_the_tour_in_its_own_frame() -> None:
    _, tour = toured(sample_plan())
    placed = placed_tour(tour, 0.25)
    assert placed.eyes[0][2] == pytest.approx(EYE_M + 0.25)
    assert placed.stretches[0].room is None
    assert placed.stretches[-1].end_s == pytest.approx(placed.times_s[-1], abs=1e-3)


def test_a_house_over_a_basement_is_entered_above_it() -> None:
    """The doors of a basement lead into the earth; one goes down by the stairs."""
    above, below = two_storeys().storeys[::-1]
    cellar = below.model_copy(update={"name": "Keller", "elevation_m": -2.8})
    ground = above.model_copy(
        update={
            "elevation_m": 0.0,
            "name": "Erdgeschoss",
            "openings": [one.model_copy(update={"along_m": 0.4}) if one.id == "front" else one
                         for one in sample_storey().openings],
        }
    )  # fmt: skip
    house, tour = toured(sample_plan(cellar, ground))
    assert house.part.attributes["storeysAboveGround"] == 1
    assert house.part.attributes["storeysBelowGround"] == 1
    eyes = tour.path.eyes_m
    assert eyes[0, 2] == eyes[-1, 2] == EYE_M
    assert tour.stretches[0].title == "Outside"
    assert eyes[:, 2].min() == pytest.approx(EYE_M - 2.8)
    place = place_of(house, "house.glb", None, HouseOptions())
    # The floor at ground level lies on the plinth, and one begins before its door.
    assert place.parts["house"].standing.transform[2, 3] == pytest.approx(HouseOptions().plinth)
    assert place.start is not None
    assert place.start.target[:2] == pytest.approx(entrances(house.spaces[1])[0].middle)
