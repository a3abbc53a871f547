"""Lamps: AV3D's figures, sight by a ray caster of the test's own, and rooms of any shape."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from sample_plan import rectangle, room, sample_plan, sample_storey
from shapely.affinity import rotate
from shapely.geometry import Point, Polygon, box
from shapely.ops import unary_union

from veduta.plan.document import Furniture
from veduta.plan.house.furniture import footprint
from veduta.plan.house.space import space_of
from veduta.plan.lights.ceiling import ceiling_lamps, wall_angles
from veduta.plan.lights.lighting import darkness, light_house
from veduta.plan.lights.needs import LUX, UTILISATION
from veduta.plan.lights.sight import CORNER
from veduta.plan.lights.walls import FROM_WALL_M, outline_of, wall_lamps
from veduta.plan.options import HouseOptions

EDGE = 1e-6


def sees(region: Polygon, first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Whether no edge of the room crosses the way: by signs of areas, without shapely."""

    def side(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]) -> float:
        return float((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))

    for ring in (region.exterior, *region.interiors):
        corners = np.array(ring.coords)
        for start, end in zip(corners[:-1], corners[1:], strict=True):
            apart = side(first, second, start) * side(first, second, end)
            across = side(start, end, first) * side(start, end, second)
            if apart < -EDGE and across < -EDGE:
                return False
    return True


def unlit(region: Polygon, lamps: NDArray[np.float64], reach_m: float) -> list[tuple[float, float]]:
    """Points of the room, drawn at random, that no lamp within reach sees."""
    rng = np.random.default_rng(5)
    left, bottom, right, top = region.bounds
    inner = region.buffer(-0.15)
    points = [p for p in rng.uniform((left, bottom), (right, top), (400, 2)) if
              inner.contains(Point(p))]  # fmt: skip
    return [
        (float(p[0]), float(p[1]))
        for p in points
        if not any(
            math.dist(p, lamp) <= CORNER * reach_m + 0.2 and sees(region, p, lamp) for lamp in lamps
        )
    ]


def test_rows_are_those_of_the_paper() -> None:
    """AV3D's example: a room 20 m high, lamps that light 12 m: rows at 5 and 15 m."""
    lamps = ceiling_lamps(box(0.0, 0.0, 12.0, 20.0), 6.0)
    assert sorted(lamps[:, 1]) == pytest.approx([5.0, 15.0])
    assert lamps[:, 0] == pytest.approx([6.0, 6.0])


def test_one_lamp_in_the_middle_of_a_small_room() -> None:
    turned = rotate(box(0.0, 0.0, 4.0, 3.0), 30.0, origin=(0.0, 0.0))
    lamps = ceiling_lamps(turned, 3.0)
    assert len(lamps) == 1
    assert math.dist(lamps[0], turned.centroid.coords[0]) < 1e-6


def test_a_turned_room_has_the_lamps_of_the_straight_one() -> None:
    """A row along the walls: without turning it, a slanted room would need more lamps."""
    straight = box(0.0, 0.0, 14.0, 3.0)
    expected = len(ceiling_lamps(straight, 2.0))
    for angle in (17.0, 45.0, 61.0):
        turned = rotate(straight, angle, origin=(0.0, 0.0))
        assert len(ceiling_lamps(turned, 2.0)) == expected


def test_directions_of_walls_are_found_once() -> None:
    triangle = Polygon([(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)])
    assert np.degrees(wall_angles(triangle)) == pytest.approx([0.0, 90.0, 45.0, 135.0])


def test_each_leg_of_an_l_is_lit() -> None:
    """In an L of narrow legs, a lamp in the one does not see into the other."""
    shape = unary_union([box(0.0, 0.0, 8.0, 1.2), box(0.0, 0.0, 1.2, 8.0)])
    lamps = ceiling_lamps(shape, 3.0)
    assert all(shape.contains(Point(lamp)) for lamp in lamps)
    assert unlit(shape, lamps, 3.0) == []
    assert len(lamps) <= 4


def test_a_pillar_throws_no_dark_corner() -> None:
    shape = box(0.0, 0.0, 6.0, 6.0).difference(box(2.0, 2.0, 4.0, 4.0))
    lamps = ceiling_lamps(shape, 4.0)
    assert unlit(shape, lamps, 4.0) == []
    assert len(lamps) >= 2


@settings(max_examples=12, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.floats(0.0, 6.0), st.floats(0.0, 6.0), st.floats(1.0, 6.0), st.floats(1.0, 6.0)
        ),
        min_size=1, max_size=4,
    ),
    st.floats(0.0, 90.0),
    st.floats(1.5, 4.0),
)  # fmt: skip
def test_every_room_is_lit(
    rooms: list[tuple[float, float, float, float]], angle: float, reach_m: float
) -> None:
    whole = unary_union([box(x, y, x + width, y + depth) for x, y, width, depth in rooms])
    pieces = getattr(whole, "geoms", [whole])
    shape = rotate(max(pieces, key=lambda piece: piece.area), angle, origin=(0.0, 0.0))
    lamps = ceiling_lamps(shape, reach_m)
    assert unlit(shape, lamps, reach_m) == []
    assert all(shape.buffer(EDGE).covers(Point(lamp)) for lamp in lamps)


def test_lamps_on_walls_are_beside_what_takes_the_wall() -> None:
    shape = box(0.0, 0.0, 9.0, 6.0)
    window = box(2.0, -0.2, 5.0, 0.2)
    usable = shape.exterior.buffer(0.06).difference(window)
    outline = outline_of(shape, usable, Point(0.0, 3.0))
    lamps = wall_lamps(shape, outline, 4.0, 3.0)
    # 30 m at 4 m each are 8 lamps; the jump over the window costs the last one.
    assert 7 <= len(lamps) <= 8
    for lamp in lamps:
        assert shape.exterior.distance(Point(lamp)) == pytest.approx(FROM_WALL_M, abs=1e-3)
        assert not window.buffer(0.1).contains(Point(lamp))
    assert unlit(shape, lamps, 3.0) == []


def test_no_lamp_where_no_wall_can_have_one() -> None:
    shape = box(0.0, 0.0, 2.0, 2.0)
    outline = outline_of(shape, Point(50.0, 50.0).buffer(1.0), None)
    assert len(wall_lamps(shape, outline, 4.0, 3.0)) == 0


@pytest.mark.parametrize("kind", ["ceiling", "wall"])
def test_a_house_is_lit_as_brightly_as_its_rooms_ask_for(kind: str) -> None:
    lit = light_house(sample_plan(), HouseOptions(lights=kind))
    assert lit.dark == 0
    assert lit.points > 300
    storey = lit.document.storeys[0]
    for one in storey.rooms:
        own = [light for light in storey.lights or [] if light.room == one.id]
        assert {light.kind for light in own} == {kind}
        given_lumen = sum(light.lumen for light in own)
        needed = LUX[one.use] * one.area_m2 / UTILISATION
        assert needed <= given_lumen <= 1.5 * needed


def test_dark_rooms_are_seen() -> None:
    space = space_of(sample_storey(), 2.55)
    assert [(one.id, seen == dark) for one, seen, dark in darkness(space, [])] == [
        ("living", True), ("bath", True)
    ]  # fmt: skip


def test_what_a_document_has_is_left() -> None:
    dark = sample_plan(sample_storey(lights=[]))
    assert light_house(dark, HouseOptions()).document == dark
    assert light_house(dark, HouseOptions()).notes
    assert light_house(sample_plan(), HouseOptions(lights="none")).document == sample_plan()


def test_a_seat_gets_a_lamp_beside_it_and_lamps_of_the_furniture_shine() -> None:
    sofa = Furniture(id="f1", object="sofa", room="living", at_m=(3.0, 4.3), size_m=(1.8, 0.9, 0.8))
    storey = sample_storey(furniture=[sofa])
    lit = light_house(sample_plan(storey), HouseOptions()).document.storeys[0]
    standing = [light for light in lit.lights or [] if light.kind == "floor"]
    assert [light.room for light in standing] == ["living"]
    at = Point(standing[0].at_m)
    assert 0.0 < footprint(sofa).distance(at) < 0.5
    lamp = Furniture(
        id="f2", object="table-lamp", room="bath", at_m=(6.0, 2.0), size_m=(0.3, 0.3, 0.4),
        above_m=0.5, on="f3",
    )  # fmt: skip
    lit = light_house(sample_plan(sample_storey(furniture=[lamp])), HouseOptions())
    found = [light for light in lit.document.storeys[0].lights or [] if light.kind == "table"]
    assert [(light.at_m, light.above_m) for light in found] == [((6.0, 2.0), pytest.approx(0.84))]


def test_balconies_have_lamps_on_the_house() -> None:
    balcony = room("balcony", rectangle(0.15, -1.8, 5.0, -0.15), use="balcony", outdoors=True)
    storey = sample_storey()
    storey = storey.model_copy(update={"rooms": [*storey.rooms, balcony]})
    lights = light_house(sample_plan(storey), HouseOptions()).document.storeys[0].lights or []
    own = [light for light in lights if light.room == "balcony"]
    assert own
    assert all(light.kind == "wall" and light.at_m[1] > -0.3 for light in own)
