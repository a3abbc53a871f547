"""Walking: gaps against the width of a person, and what doors need."""

from __future__ import annotations

import numpy as np
import pytest
from sample_plan import opening, rectangle, room, sample_storey, wall, window
from shapely.geometry import Point, box

from veduta.plan.document import Junction
from veduta.plan.furnish.arrangement import Piece, Variant, fixed
from veduta.plan.furnish.catalogue.read import builtin_catalogue
from veduta.plan.furnish.layout import Layout
from veduta.plan.furnish.place import place
from veduta.plan.furnish.room import room_spaces
from veduta.plan.furnish.walk import WalkGrid, Ways
from veduta.plan.house.space import space_of

HEIGHT_M = 2.55


@pytest.mark.parametrize(("gap", "goes"), [(0.40, False), (0.48, False), (0.62, True), (0.8, True)])
def test_one_goes_through_gaps_wider_than_a_person(gap: float, goes: bool) -> None:
    """Two halves of a room, a wall between with a gap; a person is 0.5 m wide."""
    grid = WalkGrid(box(0.0, 0.0, 6.0, 3.0))
    wall = box(2.9, 0.0, 3.1, 3.0).difference(box(2.9, 1.0, 3.1, 1.0 + gap))
    regions = grid.regions(grid.covered(wall))
    numbers = grid.numbers_at(regions, np.array([[1.0, 1.5], [5.0, 1.5]]))
    assert (numbers[0] == numbers[1]) is goes


def test_ways_ask_for_nothing_that_the_empty_room_has_not() -> None:
    narrow = box(0.0, 0.0, 2.0, 2.0).union(box(2.0, 0.8, 3.0, 1.1)).union(box(3.0, 0.0, 5.0, 2.0))
    ways = Ways(narrow, np.array([[0.5, 1.0], [4.5, 1.0]]))
    nothing = np.zeros(ways.grid.floor.shape, dtype=np.bool_)
    assert ways.main_region(nothing) is not None
    assert ways.main_region(ways.grid.covered(box(3.9, 0.0, 5.0, 2.0))) is None


def test_doors_keep_their_sweep_and_windows_their_front_free() -> None:
    """The front door of the sample hangs at x = 0.6 and opens to the north, into the living."""
    storey = sample_storey(
        openings=[
            opening("front", "south-1", 0.6, 1.0, hinge="start", swing="left"),
            window("w1", "south-1", 2.6, 1.8),
        ]
    )
    spaces = room_spaces(space_of(storey, HEIGHT_M), HEIGHT_M)
    living = next(one for one in spaces if one.room.id == "living")
    hinge, face = 0.6, 0.15
    for angle in np.radians([5, 30, 60, 85]):
        tip = (hinge + 0.95 * np.cos(angle), face + 0.95 * np.sin(angle))
        assert living.blocked.covers(Point(tip))
    assert not living.blocked.covers(Point(hinge + 1.0, face + 1.0))
    assert len(living.windows) == 1
    assert living.windows[0].zone.covers(Point(3.5, face + 0.3))
    assert living.windows[0].low_m == pytest.approx(0.9)
    assert living.floor.area == pytest.approx(4.79 * 4.7, abs=0.01)


def test_walls_of_a_room_have_the_room_on_their_left() -> None:
    spaces = room_spaces(space_of(sample_storey(), HEIGHT_M), HEIGHT_M)
    for space in spaces:
        for stretch in space.stretches:
            assert space.floor.covers(Point(stretch.at(stretch.length / 2, 0.05)))
            # Things there look into the room: (0, -1) turned by `turn`.
            ahead = (np.sin(stretch.turn), -np.cos(stretch.turn))
            assert ahead == pytest.approx(tuple(stretch.inward), abs=1e-9)


@pytest.mark.parametrize(("width_m", "stand"), [(1.3, ["rug"]), (2.6, ["rug", "coffee-table"])])
def test_what_stands_on_a_rug_leaves_the_way_from_door_to_door(
    width_m: float, stand: list[str]
) -> None:
    """A room between a door in the south and one in the north, a table in its middle."""
    corners = {"a": (0.0, 0.0), "b": (width_m, 0.0), "c": (width_m, 4.0), "d": (0.0, 4.0)}
    storey = sample_storey(
        junctions=[Junction(id=name, at_m=at, type="L") for name, at in corners.items()],
        walls=[wall(name, name[0], name[1]) for name in ("ab", "bc", "cd", "da")],
        openings=[opening(name, name, 0.25, 0.8, type="plain") for name in ("ab", "cd")],
        rooms=[room("living", rectangle(0.15, 0.15, width_m - 0.15, 3.85))],
    )
    (space,) = room_spaces(space_of(storey, HEIGHT_M), HEIGHT_M)
    layout = Layout(space, Ways(space.floor, space.doors))
    entries = {one.type: one for one in builtin_catalogue().entries.values()}
    rug = Piece(entries["rug"], (0.8, 0.8, 0.01), 0.0, 0.0)
    table = Piece(
        entries["coffee-table"], (0.7, 0.7, 0.4), 0.0, 0.0, above_m=0.01, needed=False, on=0
    )
    variant = Variant(0.8, fixed([rug, table]), free=True)
    assert place(variant, layout, np.random.default_rng(0), 1)
    assert [one.entry.type for one in layout.stood] == stand


def test_one_comes_past_a_leaf_that_stands_open() -> None:
    """The leaf stands 0.9 m into the room; a thing ahead of its tip shuts one side of it off."""
    room, doors = box(0.0, 0.0, 4.0, 4.0), np.array([[0.6, 0.3], [3.5, 3.5]])
    leaf = box(1.0, 0.0, 1.06, 0.9)
    thing = box(0.0, 1.3, 1.4, 1.6)
    ways = Ways(room, doors, leaf)
    assert ways.main_region(ways.grid.covered(thing)) is None
    assert ways.main_region(ways.grid.covered(box(0.0, 1.7, 1.4, 2.0))) is not None
    # Without the leaf one goes where it stands.
    ways = Ways(room, doors)
    assert ways.main_region(ways.grid.covered(thing)) is not None
    # Nothing is asked that the empty room has not.
    shut = Ways(room, doors, box(1.0, 0.0, 1.06, 4.0))
    assert shut.main_region(np.zeros(shut.grid.floor.shape, dtype=np.bool_)) is not None
