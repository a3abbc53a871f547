"""The pages of letting agents and surveys: their truth is sound, and it is what is drawn."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from shapely.geometry import LineString, Point, Polygon

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.brochure import brochure_page
from veduta.synthetic.plans.canvas import Image
from veduta.synthetic.plans.foreign.coloured import coloured_page
from veduta.synthetic.plans.foreign.hairline import hairline_sheet
from veduta.synthetic.plans.foreign.listing import listing_page
from veduta.synthetic.plans.foreign.permit import permit_drawing
from veduta.synthetic.plans.foreign.print_drawing import print_drawing
from veduta.synthetic.plans.foreign.squared_paper import squared_sketch
from veduta.synthetic.plans.hands import HANDS, hand_drawn
from veduta.synthetic.plans.japanese import japanese_flat
from veduta.synthetic.plans.labelled import labelled_sheet
from veduta.synthetic.plans.measured import measured_sheet
from veduta.synthetic.plans.stock_plan import stock_plan
from veduta.synthetic.plans.truth_file import SheetTruth
from veduta.synthetic.plans.working_drawing import working_drawing

Make = Callable[[int], tuple[Image, list[SheetTruth]]]
MAKERS = (brochure_page, measured_sheet, working_drawing)


def any_hand(seed: int) -> tuple[Image, list[SheetTruth]]:
    """Each hand in turn."""
    return hand_drawn(seed, HANDS[seed % len(HANDS)])


def any_floor(seed: int) -> tuple[Image, list[SheetTruth]]:
    """Of a builder's catalogue, a house on one floor and an upper floor in turn."""
    return stock_plan(seed, ("ranch", "gallery")[seed % 2])


FOREIGN = (
    hairline_sheet, coloured_page, print_drawing, permit_drawing, listing_page, squared_sketch,
)  # fmt: skip
DRAWN = [*MAKERS, any_hand, any_floor, japanese_flat, labelled_sheet, *FOREIGN]


@pytest.mark.parametrize("make", DRAWN)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_openings_lie_in_their_walls_clear_of_each_other(make: Make, seed: int) -> None:
    for truth in make(seed)[1]:
        for wall in truth.storey.walls:
            ends = sorted(
                (one.along_m, one.along_m + one.width_m)
                for one in truth.storey.openings
                if one.wall == wall.id
            )
            flat = [0.0, *(end for pair in ends for end in pair), curves.wall_length(wall)]
            assert flat == sorted(flat)


@pytest.mark.parametrize("make", DRAWN)
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_every_room_is_reached(make: Make, seed: int) -> None:
    for truth in make(seed)[1]:
        storey = truth.storey
        reached, ways = set(), [
            {storey.wall(one.wall).left, storey.wall(one.wall).right}
            for one in storey.openings
            if one.kind != "window"
        ]  # fmt: skip
        edge = {None} if storey.number == 0 else {"r0"}  # upstairs one comes by the landing
        while edge:
            reached |= edge
            edge = set().union(*(way for way in ways if way & reached)) - reached
        assert {room.id for room in storey.rooms} <= reached


@pytest.mark.parametrize("make", MAKERS)
@pytest.mark.parametrize("seed", [1, 2])
def test_walls_are_dark_or_hatched_and_rooms_are_light_where_the_truth_says(
    make: Make, seed: int
) -> None:
    picture, truths = make(seed)
    grey = picture.mean(axis=2)
    for truth in truths:
        walls = [LineString([one.start_m, one.end_m]) for one in truth.storey.walls]
        free = [Polygon(one.outline_m) for one in truth.storey.rooms]
        gaps = {one.wall for one in truth.storey.openings}
        solid = [
            _mean(grey, truth, line.interpolate(share, normalized=True), 0.05)
            for line, wall in zip(walls, truth.storey.walls, strict=True)
            if wall.id not in gaps and line.length > 1.0
            for share in (0.3, 0.5, 0.7)
        ]
        light = [_mean(grey, truth, room.representative_point(), 0.05) for room in free]
        assert np.median(solid) < np.median(light) - 10.0


def _mean(grey: np.ndarray, truth: SheetTruth, at: Point, reach_m: float) -> float:
    x, y = truth.px_from_m[:2] @ (at.x, at.y, 1.0)
    reach = round(reach_m / truth.metres_per_px)
    box = grey[round(y) - reach : round(y) + reach + 1, round(x) - reach : round(x) + reach + 1]
    return float(box.mean())


@pytest.mark.parametrize("make", [*MAKERS, *FOREIGN])
def test_a_seed_gives_the_same_sheet_again_and_another_seed_another(make: Make) -> None:
    first, again, other = make(5)[0], make(5)[0], make(6)[0]
    assert np.array_equal(first, again)
    assert first.shape != other.shape or not np.array_equal(first, other)


@pytest.mark.parametrize("hand", sorted(set(HANDS) - {"madori"}))
def test_hands_draw_walls_darker_than_rooms(hand: str) -> None:
    picture, (truth,) = hand_drawn(3, hand)
    grey = picture.mean(axis=2)
    storey = truth.storey
    gaps = {one.wall for one in storey.openings}
    lines = [LineString([one.start_m, one.end_m]) for one in storey.walls if one.id not in gaps]
    reach = 0.6 * truth.metres_per_px
    solid = [_mean(grey, truth, line.interpolate(0.5, normalized=True), reach) for line in lines]
    rooms = [Polygon(one.outline_m).representative_point() for one in storey.rooms]
    assert np.median(solid) < np.median([_mean(grey, truth, at, 0.05) for at in rooms]) - 40.0


@pytest.mark.parametrize("make", FOREIGN)
def test_faces_of_walls_are_seen_where_the_truth_says(make: Make) -> None:
    picture, (truth,) = make(4)
    grey = picture.astype(float)
    storey, pairs = truth.storey, []
    gaps = {one.wall for one in storey.openings}
    for wall in storey.walls:
        if wall.id in gaps or wall.bulge or curves.wall_length(wall) < 1.0:
            continue
        half = wall.thickness_m / 2.0
        for share in (0.3, 0.5, 0.7):
            near = [curves.at(wall.start_m, wall.end_m, 0.0, np.array([share]), off)[0]
                    for off in np.linspace(-half - 0.06, half + 0.06, 15)]  # fmt: skip
            pixels = [truth.px_from_m[:2] @ (x, y, 1.0) for x, y in near]
            values = np.array([grey[int(y), int(x)] for x, y in pixels])
            pairs.append(np.ptp(values, axis=0).max())
    assert np.median(pairs) > 40.0


@pytest.mark.parametrize("seed", [2, 4])
def test_what_is_open_to_below_is_no_room_and_has_no_wall_at_its_railing(seed: int) -> None:
    _, (truth,) = stock_plan(seed, "gallery")
    storey = truth.storey
    landing = next(room for room in storey.rooms if room.use == "hall")
    assert "r1" not in {room.id for room in storey.rooms}
    assert not [one for one in storey.walls if {one.left, one.right} == {landing.id, "r1"}]
    # The landing's edge is where the railing is drawn, and beyond it lies no room.
    edge = Polygon(landing.outline_m)
    beyond = Point(edge.centroid.x, edge.bounds[3] + 0.5)
    assert not any(Polygon(room.outline_m).contains(beyond) for room in storey.rooms)


def test_tubs_of_a_catalogue_fill_their_alcoves() -> None:
    _, (truth,) = stock_plan(1, "ranch")
    tubs = [one.box_m for one in truth.fittings or () if one.kind == "bathtub"]
    baths = [Polygon(room.outline_m).bounds for room in truth.storey.rooms if room.id == "r4"]
    assert any(np.allclose((tub[0], tub[2]), (at[0], at[2])) for tub in tubs for at in baths)
    assert len(tubs) == 2
