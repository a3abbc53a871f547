"""Lamps: AV3D's figures, sight by a ray caster of the test's own, and rooms of any shape."""

from __future__ import annotations

import math
from dataclasses import replace

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
from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.house.furniture import footprint
from veduta.plan.house.space import space_of
from veduta.plan.lights.ceiling import ceiling_lamps, wall_angles
from veduta.plan.lights.furnished import furniture_lamps, relit
from veduta.plan.lights.lighting import darkness, light_house
from veduta.plan.lights.needs import LUX, UTILISATION
from veduta.plan.lights.sight import CORNER, Field
from veduta.plan.lights.walls import FROM_WALL_M, outline_of, wall_lamps
from veduta.plan.options import HouseOptions

EDGE = 1e-6
OPTIONS = HouseOptions()


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
    sofa = Furniture(
        id="f1", object="sofa-slim", room="living", at_m=(3.0, 4.3), size_m=(1.8, 0.9, 0.8)
    )
    storey = sample_storey(furniture=[sofa])
    lit = light_house(sample_plan(storey), HouseOptions()).document.storeys[0]
    standing = [light for light in lit.lights or [] if light.kind == "floor"]
    assert [light.room for light in standing] == ["living"]
    at = Point(standing[0].at_m)
    assert 0.0 < footprint(sofa).distance(at) < 0.5
    lamp = Furniture(
        id="f2", object="table-lamp-vase", room="bath", at_m=(6.0, 2.0), size_m=(0.3, 0.3, 0.4),
        above_m=0.5, on="f3",
    )  # fmt: skip
    lit = light_house(sample_plan(sample_storey(furniture=[lamp])), HouseOptions())
    found = [light for light in lit.document.storeys[0].lights or [] if light.kind == "table"]
    assert [(light.at_m, light.above_m) for light in found] == [((6.0, 2.0), pytest.approx(0.84))]


def lamp_at(name: str, at_m: tuple[float, float], **more: object) -> Furniture:
    values = {"object": "floor-lamp-stem", "room": "living", "size_m": (0.4, 0.4, 1.6)} | more
    return Furniture.model_validate({"id": name, "at_m": at_m, **values})


def test_the_light_of_a_lamp_goes_where_the_lamp_goes() -> None:
    lit = light_house(sample_plan(sample_storey(furniture=[lamp_at("f1", (1.0, 1.0))])), OPTIONS)
    storey = lit.document.storeys[0]
    before = {light.id: light for light in storey.lights or []}
    dimmed = [light.model_copy(update={"lumen": 123.0}) for light in storey.lights or []]
    changed = {"furniture": [lamp_at("f1", (6.5, 3.0), room="bath")], "lights": dimmed}
    for kind in ("ceiling", "none"):
        again = light_house(
            sample_plan(storey.model_copy(update=changed)), HouseOptions(lights=kind)
        )
        after = {light.id: light for light in again.document.storeys[0].lights or []}
        assert set(after) == set(before)
        moved = after.pop("f1-light")
        assert (moved.room, moved.at_m, moved.lumen) == ("bath", (6.5, 3.0), 123.0)
        assert all(light.at_m == before[name].at_m for name, light in after.items())
        assert "ground floor: light f1-light goes with its lamp f1" in again.notes


def test_the_light_of_a_lamp_goes_away_with_it() -> None:
    lit = light_house(sample_plan(sample_storey(furniture=[lamp_at("f1", (1.0, 1.0))])), OPTIONS)
    storey = lit.document.storeys[0].model_copy(update={"furniture": []})
    again = light_house(sample_plan(storey), OPTIONS)
    assert len(storey.lights or []) - len(again.document.storeys[0].lights or []) == 1
    assert not [one for one in again.document.storeys[0].lights or [] if one.thing]
    assert [note for note in again.notes if "no lamp 'f1'" in note]


def test_new_furniture_has_its_own_lights() -> None:
    """Ids of old lamps are those of other things now, and of a lamp elsewhere."""
    old = [lamp_at("f1", (1.0, 1.0)), lamp_at("f2", (2.0, 1.0))]
    lit = light_house(sample_plan(sample_storey(furniture=old)), OPTIONS).document
    bare = lit.storeys[0].model_copy(update={"furniture": None})
    stool = lamp_at("f1", (2.0, 2.0), object="stool", size_m=(0.4, 0.4, 0.5))
    new = [stool, lamp_at("f2", (6.5, 3.0), room="bath"), lamp_at("f3", (3.0, 1.0))]
    full = bare.model_copy(update={"furniture": new})
    done, notes = relit(sample_plan(bare), sample_plan(full), builtin_catalogue())
    again = light_house(done, OPTIONS).document.storeys[0].lights or []
    shining = {light.thing: (light.room, light.at_m) for light in again if light.thing}
    assert shining == {"f2": ("bath", (6.5, 3.0)), "f3": ("living", (3.0, 1.0))}
    assert [light for light in again if not light.thing] == [
        light for light in lit.storeys[0].lights or [] if not light.thing
    ]
    assert "the 2 lamps of its new furniture" in notes[0]
    dark = full.model_copy(update={"lights": []})
    for before, after in ((full, full), (bare.model_copy(update={"lights": []}), dark)):
        same = relit(sample_plan(before), sample_plan(after), builtin_catalogue())
        assert same == (sample_plan(after), [])


def test_lamps_and_seats_are_told_by_the_catalogue() -> None:
    """Of names, neither says it: wing-chair is an armchair, and a poster may be of a lamp."""
    chair = lamp_at("f1", (3.0, 4.2), object="wing-chair", size_m=(0.8, 0.8, 1.1))
    catalogue = builtin_catalogue()
    poster = replace(catalogue.entries["wing-chair"], name="lamp-poster", kind="decoration")
    known = replace(catalogue, entries={**catalogue.entries, "lamp-poster": poster})
    shown = lamp_at("f2", (1.0, 1.0), object="lamp-poster")
    assert furniture_lamps("living", [chair, shown], known) == []
    assert furniture_lamps("living", [lamp_at("f3", (1.0, 1.0))], known)[0].kind == "floor"
    lit = light_house(sample_plan(sample_storey(furniture=[chair])), OPTIONS).document.storeys[0]
    assert [light.room for light in lit.lights or [] if light.kind == "floor"] == ["living"]


def test_each_seat_has_its_lamp_where_a_room_is_in_two_pieces() -> None:
    """The wall between parts the living room; ids that clash would take a lamp away."""
    whole = rectangle(0.15, 0.15, 7.85, 4.85)
    storey = sample_storey(rooms=[room("living", whole), room("z", rectangle(0.2, -4, 7, -0.2))])
    seats = [
        lamp_at(f"f{number}", at, object="wing-chair", size_m=(0.8, 0.8, 1.1), room=where)
        for number, (at, where) in enumerate(
            [((1.0, 4.2), "living"), ((6.8, 4.2), "living"), ((2.0, -2.0), "z")]
        )
    ]
    lamps = [lamp_at("f9", (4.0, -2.0), room="z"), lamp_at("f10", (4.5, 0.5), room="living")]
    lit = light_house(
        sample_plan(storey.model_copy(update={"furniture": [*lamps, *seats]})), OPTIONS
    )
    lights = lit.document.storeys[0].lights or []
    assert len({light.id for light in lights}) == len(lights)
    standing = [light for light in lights if light.kind == "floor"]
    for seat in seats:
        assert min(math.dist(seat.at_m, light.at_m) for light in standing) <= 2.0


def test_a_lamp_elsewhere_lights_no_room() -> None:
    """A convex room, and one with a niche; the lamp hangs behind the wall."""
    square = box(0.0, 0.0, 4.0, 3.0)
    for shape in (square, square.difference(box(3.0, 2.0, 4.0, 3.0))):
        lamps = np.array([[2.0, 1.5], [4.3, 1.0]])
        lit = Field(shape).lit_by(lamps, 3.0)
        assert lit[:, 0].all()
        assert not lit[:, 1].any()


def test_balconies_have_lamps_on_the_house() -> None:
    balcony = room("balcony", rectangle(0.15, -1.8, 5.0, -0.15), use="balcony", outdoors=True)
    storey = sample_storey()
    storey = storey.model_copy(update={"rooms": [*storey.rooms, balcony]})
    lights = light_house(sample_plan(storey), HouseOptions()).document.storeys[0].lights or []
    own = [light for light in lights if light.room == "balcony"]
    assert own
    assert all(light.kind == "wall" and light.at_m[1] > -0.3 for light in own)
