"""What shops and doors become by the floor they are on, and gables that windows stand beside."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from veduta.facade.above_eaves import Surfaces, is_wall_above
from veduta.facade.evidence import gather
from veduta.facade.extent import Skyline, find_skyline
from veduta.facade.eyes import Seen, SeenElement
from veduta.facade.options import FacadeOptions
from veduta.facade.seen_boxes import on_their_floors, with_panes_of_shops
from veduta.facade.seen_front import BEFORE, FrontParameters, require_front, sides_of
from veduta.facade.seen_storeys import storeys_of
from veduta.facade.sides import whole
from veduta.run.errors import NotFoundError

FLOORS = [20, 60, 100]


def element(kind: str, x: float, y: float, high: float = 20.0, score: float = 0.9) -> SeenElement:
    return SeenElement(kind, x, y, x + 10.0, y + high, score)


def test_a_shop_above_the_ground_floor_is_left_out_and_a_door_there_is_a_window() -> None:
    awning, french = element("shop", 0.0, 40.0), element("door", 20.0, 65.0, 30.0)
    shop, door = element("shop", 40.0, 110.0), element("door", 60.0, 95.0, 40.0)
    kept = on_their_floors([awning, french, shop, door], FLOORS)
    assert [(e.kind, e.x0) for e in kept] == [("window", 20.0), ("shop", 40.0), ("door", 60.0)]


def test_a_shop_lower_than_a_door_is_a_sign_or_a_vehicle() -> None:
    """Of storeys of 40 px a fifth is 8."""
    door = element("door", 60.0, 110.0, 30.0)
    for high, is_kept in ((7.0, False), (9.0, True)):
        shop = element("shop", 20.0, 120.0, high)
        assert (shop in on_their_floors([door, shop], FLOORS)) == is_kept
        assert shop in on_their_floors([door, shop], [20])


def test_a_front_without_floors_keeps_both_wherever_they_are() -> None:
    some = [element("shop", 0.0, 40.0), element("door", 20.0, 50.0)]
    assert on_their_floors(some, [20]) == some
    assert on_their_floors(some, FLOORS) == some


def test_a_balcony_on_the_ground_floor_does_not_make_it_known() -> None:
    """Where the ground floor shows no opening it may be hidden, and both stay as they are."""
    awning, door = element("shop", 0.0, 40.0), element("door", 20.0, 65.0, 30.0)
    balcony, window = element("balcony", 40.0, 110.0), element("window", 40.0, 90.0)
    assert on_their_floors([awning, door, balcony], FLOORS) == [awning, door, balcony]
    kept = on_their_floors([awning, door, window], FLOORS)
    assert kept == [replace(door, kind="window"), window], "its middle is at the boundary"


def test_marks_of_which_few_are_sure_are_no_front() -> None:
    classes = np.ones((1, 8, 8), np.float32)
    names = ("window", "wall", "balcony", "door", "shop", "cornice", "sill", "ornament", "pillar")
    every = np.concatenate([classes, np.zeros((9, 8, 8), np.float32)])
    none = np.zeros((4, 4, 4), np.float32)
    seen = Seen((*names, "blind"), ("window",), every, none, none, 1.0, 1.0, 32, 32)
    sure = [element("window", 10.0 * k, 10.0) for k in range(3)]
    marks = [element("window", 10.0 * k, 60.0, score=0.4) for k in range(7)]
    require_front(seen, [*sure, *marks], sure, FrontParameters())
    with pytest.raises(NotFoundError, match="only 3 of them surely are"):
        require_front(seen, [*sure, *marks, marks[0]], sure, FrontParameters())


def gabled(*, beside: bool) -> tuple[Skyline, list[SeenElement]]:
    """A gable 200 px wide over eaves at row 120; `beside` puts windows where its sky is."""
    across = np.abs(np.arange(200) + 0.5 - 100.0) / 100.0
    rows = np.round(20.0 + 100.0 * across).astype(np.int64)
    windows = [
        SeenElement("window", x, y, x + 20.0, y + 30.0, 0.9)
        for y in (140.0, 200.0, 260.0)
        for x in (30.0, 90.0, 150.0)
    ]
    own = [SeenElement("window", 90.0, 70.0, 110.0, 100.0, 0.9)]
    corners = [SeenElement("window", x, 40.0, x + 20.0, 70.0, 0.9) for x in (5.0, 175.0)]
    return Skyline(rows, 20), [*windows, *own, *(corners if beside else [])]


@pytest.mark.parametrize("beside", [False, True])
def test_no_gable_has_windows_beside_its_slopes(beside: bool) -> None:
    skyline, elements = gabled(beside=beside)
    evidence = gather(np.full((320, 200, 3), 180, np.uint8), np.ones((320, 200), np.bool_))
    wall = np.ones((evidence.height, evidence.width), np.float32)
    assert (evidence.height, evidence.width) == (320, 200)
    surfaces = Surfaces(wall, 0 * wall, 0 * wall)
    found = storeys_of(evidence, skyline, elements, surfaces, FacadeOptions())
    assert (found.gable is None) == beside


def test_a_corner_of_no_photo_is_no_slope_of_a_gable() -> None:
    skyline, elements = gabled(beside=False)
    inside = np.arange(320)[:, None] >= skyline.rows[None] - 1
    evidence = gather(np.full((320, 200, 3), 180, np.uint8), inside)
    wall = np.ones((evidence.height, evidence.width), np.float32)
    surfaces = Surfaces(wall, 0 * wall, 0 * wall)
    assert storeys_of(evidence, skyline, elements, surfaces, FacadeOptions()).gable is None


def test_the_eyes_tell_a_white_wall_from_a_white_sky() -> None:
    pixels = np.full((300, 200, 3), 245, np.uint8)
    pixels[150:] = 120
    evidence = gather(pixels, np.ones((300, 200), np.bool_))
    sky = np.zeros((evidence.height, evidence.width), np.float32)
    sky[: round(0.2 * evidence.height)] = 1.0
    alone, both = find_skyline(evidence), find_skyline(evidence, sky)
    assert alone.level > 0.45 * evidence.height
    assert both.level == pytest.approx(0.2 * evidence.height, abs=3)


def test_windows_beside_a_shop_that_look_like_one_are_panes_of_shops() -> None:
    """Not above the ground floor, not in the shop itself, and not where no shop is."""
    shop = SeenElement("shop", 0.0, 105.0, 30.0, 125.0, 0.9)
    inner, pane = element("window", 10.0, 105.0), element("window", 40.0, 105.0)
    plain, upper = element("window", 60.0, 105.0), element("window", 40.0, 70.0)
    chance = np.zeros((130, 80), np.float32)
    chance[:, :52] = 0.2
    some = [shop, inner, pane, plain, upper]
    kinds = [e.kind for e in with_panes_of_shops(some, FLOORS, chance)]
    assert kinds == ["shop", "window", "shop", "window", "window"]
    assert with_panes_of_shops(some[1:], FLOORS, chance) == some[1:]


def test_a_pane_alone_is_a_shop_where_it_is_wide_and_looks_like_one() -> None:
    upper = element("window", 40.0, 70.0)
    pane = replace(upper, x0=10.0, x1=30.0, y0=105.0, y1=125.0)
    for least, wide, kind in ((0.25, 20.0, "shop"), (0.15, 20.0, "window"), (0.25, 11.0, "window")):
        some = [replace(pane, x1=pane.x0 + wide), upper]
        chance = np.full((130, 80), least, np.float32)
        assert [e.kind for e in with_panes_of_shops(some, FLOORS, chance)] == [kind, "window"]


@pytest.mark.parametrize(
    ("above", "goes_on"),
    [
        ((150, 148, 144), True),
        ((196, 194, 190), True),
        ((60, 64, 72), False),
        ((210, 120, 80), False),
    ],
    ids=["the wall's colour", "as light as another part of it", "slate", "tiles in the sun"],
)
def test_a_parapet_of_the_walls_colour_is_no_roof(above: tuple[int, ...], goes_on: bool) -> None:
    """The wall is of two colours, a third of it as light as a parapet in the sun."""
    pixels = np.full((300, 200, 3), 230, np.uint8)
    pixels[40:70] = above
    pixels[70:], pixels[70:, :60] = (150, 148, 144), (196, 194, 190)
    evidence = gather(pixels, np.ones((300, 200), np.bool_))
    rows = evidence.height / 300
    skyline = Skyline(np.full(evidence.width, round(40 * rows)), round(40 * rows))
    none = np.zeros((evidence.height, evidence.width), np.float32)
    wall = none.copy()
    wall[round(70 * rows) :] = 0.9
    surfaces = Surfaces(wall, none, none)
    assert is_wall_above(evidence, skyline, 70 * rows, 60 * rows, surfaces) == goes_on
    # What is high and looks like a roof is one, whatever its colour.
    roof = Surfaces(wall, 1.0 - wall, none)
    assert not is_wall_above(evidence, skyline, 70 * rows, 40 * rows, roof)


def test_a_lid_in_the_street_is_no_window_of_the_front() -> None:
    evidence = gather(np.full((320, 200, 3), 180, np.uint8), np.ones((320, 200), np.bool_))
    names = ("wall", "ground", *BEFORE)
    seen = np.zeros((len(names), 40, 25), np.float32)
    seen[0, :30], seen[1, 30:] = 0.9, 0.9
    none = np.zeros((1, 8, 8), np.float32)
    eyes = Seen(names, ("window",), seen, none, none, 1.0, 1.0, 200, 320)
    windows = [SeenElement("window", 20.0, y, 60.0, y + 50.0, 0.9) for y in (40.0, 130.0)]
    lid = SeenElement("window", 90.0, 285.0, 110.0, 300.0, 0.9)
    for some in (windows, [*windows, lid]):
        sides = sides_of(whole(evidence), evidence, eyes, some, FrontParameters())
        assert sides.bottom == pytest.approx(240, abs=8)
