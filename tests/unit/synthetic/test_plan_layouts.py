"""Synthetic houses hold together: rooms, walls, doors, by geometry that the layout does not use."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shapely import unary_union
from shapely.geometry import LineString, Point, Polygon

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.bodies import opening_area, solid_walls, whole_walls
from veduta.synthetic.plans.house import House, Opening, Storey, Wall
from veduta.synthetic.plans.layout import make_house

SEEDS = (4, 105, 109)


@pytest.fixture(scope="module", params=SEEDS)
def house(request: pytest.FixtureRequest) -> House:
    return make_house(request.param)


def test_rooms_and_walls_fill_the_house_without_overlap(house: House) -> None:
    for storey in house.storeys:
        rooms = [Polygon(room.outline_m) for room in storey.rooms]
        walls = whole_walls(storey.walls)
        together = unary_union([*rooms, walls]).buffer(1e-3).buffer(-1e-3)  # outlines are rounded
        assert isinstance(together, Polygon)
        total = sum(room.area for room in rooms) + walls.area
        assert together.area == pytest.approx(total, rel=2e-3)
        assert len(together.interiors) == 0
        for room, area in zip(storey.rooms, rooms, strict=True):
            assert room.area_m2 == pytest.approx(area.area, abs=1e-3)
            assert area.exterior.is_ccw


def _beside(storey: Storey, opening: Opening) -> set[str | None]:
    """The rooms on both sides of an opening, by their polygons alone."""
    middle = opening_area(storey.wall(opening.wall), opening, 0.05)
    touched = {
        room.id for room in storey.rooms if Polygon(room.outline_m).intersection(middle).area > 1e-3
    }
    return touched if len(touched) == 2 else {*touched, None}


def test_every_room_can_be_walked_to(house: House) -> None:
    for storey in house.storeys:
        links = [_beside(storey, o) for o in storey.openings if o.kind != "window"]
        stairs = {room.id for room in storey.rooms if room.use == "stairs"}
        reached: set[str | None] = {None} if storey.number == 0 else {*stairs}
        assert reached
        for _ in storey.rooms:
            for link in links:
                if link & reached:
                    reached |= link
        assert {room.id for room in storey.rooms} <= reached


def test_windows_look_outside_and_openings_keep_apart(house: House) -> None:
    for storey in house.storeys:
        for opening in storey.openings:
            wall = storey.wall(opening.wall)
            assert opening.along_m > 0.0
            assert opening.along_m + opening.width_m < curves.wall_length(wall)
            if opening.kind == "window":
                assert wall.outer
        holes = [opening_area(storey.wall(o.wall), o, 0.0) for o in storey.openings]
        assert unary_union(holes).area == pytest.approx(sum(h.area for h in holes), rel=1e-6)
        lost = whole_walls(storey.walls).area - solid_walls(storey).area
        assert lost == pytest.approx(sum(hole.area for hole in holes), rel=0.02)


def test_two_storeys_share_their_stairs_and_their_shell() -> None:
    house = make_house(4, storeys=2)
    below, above = (next(r for r in s.rooms if r.use == "stairs") for s in house.storeys)
    assert Polygon(below.outline_m).symmetric_difference(Polygon(above.outline_m)).area < 1e-6
    assert all(len(storey.stairs) == 1 for storey in house.storeys)
    flight = house.storeys[0].stairs[0]
    assert Polygon(below.outline_m).buffer(1e-6).contains(Polygon(flight.outline_m))
    assert math.hypot(*flight.up) == pytest.approx(1.0)


def test_the_same_seed_gives_the_same_house() -> None:
    assert make_house(11) == make_house(11)
    assert make_house(11) != make_house(12)


@pytest.mark.parametrize("bulge", [0.4, -0.4, 1.0])
def test_an_arc_is_one_as_dxf_defines_it(bulge: float) -> None:
    """By the bulge's definition: sagitta = bulge * half the chord, to the right where positive."""
    wall = Wall("w", (0.0, 0.0), (4.0, 0.0), bulge, 0.2, None, None)
    points = curves.line(wall)
    middle = curves.at(wall.start_m, wall.end_m, bulge, np.array([0.5]))[0]
    assert middle == pytest.approx([2.0, -2.0 * bulge])
    assert points[0] == pytest.approx(wall.start_m)
    assert points[-1] == pytest.approx(wall.end_m)
    fine = LineString(curves.at(wall.start_m, wall.end_m, bulge, np.linspace(0, 1, 20_001)))
    assert curves.wall_length(wall) == pytest.approx(fine.length, rel=1e-6)
    radius = (4.0 + (2.0 * bulge) ** 2) / (2 * 2.0 * abs(bulge))
    centre = Point(2.0, -2.0 * bulge + math.copysign(radius, bulge))
    assert all(centre.distance(Point(p)) == pytest.approx(radius) for p in points)
    band = curves.band(wall, 0.0, curves.wall_length(wall))
    assert band.area == pytest.approx(curves.wall_length(wall) * 0.2, rel=1e-3)


def test_corners_of_walls_close() -> None:
    """Four walls about a square: the ring's area in closed form."""
    corners = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)]
    walls = tuple(
        Wall(f"w{i}", corners[i], corners[(i + 1) % 4], 0.0, 0.3, "r", None) for i in range(4)
    )
    assert whole_walls(walls).area == pytest.approx(4.3 * 3.3 - 3.7 * 2.7)
