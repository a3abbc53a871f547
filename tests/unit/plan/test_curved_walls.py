"""Curved walls on drawings: arcs, circles, bands that are arcs and those that are not, bows."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.optimize import least_squares
from shapely import get_coordinates
from shapely.geometry import LineString, Point, Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.geometry.arcs import Arc, bulge_through
from veduta.geometry.circle import fit_circle
from veduta.plan.drawn import Drawn, DrawnWall
from veduta.plan.reading import read_storey
from veduta.plan.walls.curved import curved_pieces
from veduta.plan.walls.meetings import meetings
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.tracks import find_tracks

FINE = 4
BULGES = st.floats(-1.0, 1.0).filter(lambda value: abs(value) > 0.02)


def arc(bulge: float) -> Arc:
    """From (100, 200) over 200 px to the right and 80 down."""
    return Arc(np.array([100.0, 200.0]), np.array([300.0, 280.0]), bulge)


def painted(shape: BaseGeometry, size: tuple[int, int] = (500, 700)) -> NDArray[np.float32]:
    """(h, w) share of each pixel that a region covers."""
    fine = np.zeros((size[0] * FINE, size[1] * FINE), np.uint8)
    for part in getattr(shape, "geoms", [shape]):
        for ring, value in ((part.exterior, 255), *((hole, 0) for hole in part.interiors)):
            points = np.round(np.array(ring.coords) * FINE - 0.5).astype(np.int32)
            cv2.fillPoly(fine, [points], value)
    small = cv2.resize(fine, size[::-1], interpolation=cv2.INTER_AREA)
    return np.asarray(small, np.float32) / np.float32(255)


@given(bulge=BULGES)
def test_an_arc_is_one_by_its_sagitta(bulge: float) -> None:
    one = arc(bulge)
    chord = math.hypot(200.0, 80.0)
    # To the right of who walks right and down is left and down, as y points down.
    right = np.array([-80.0, 200.0]) / chord
    tip = np.array([200.0, 240.0]) + bulge * chord / 2 * right
    assert one.at(one.length_px / 2) == pytest.approx(tip)
    radius = chord / 2 * (1 + bulge**2) / (2 * abs(bulge))
    places = one.at(np.linspace(0.0, one.length_px, 9))
    assert np.hypot(*(places - one.centre).T) == pytest.approx(radius)
    assert one.length_px == pytest.approx(radius * 4 * math.atan(abs(bulge)))
    assert bulge_through(one.start, tip, one.end) == pytest.approx(bulge)


@given(bulge=BULGES, share=st.floats(0.05, 0.95), across=st.floats(-30.0, 30.0))
def test_places_on_an_arc_are_found_again(bulge: float, share: float, across: float) -> None:
    one = arc(bulge)
    point = one.at(share * one.length_px, across)
    assert LineString(one.points(1e-3)).distance(Point(*point)) == pytest.approx(
        abs(across), abs=1e-2
    )
    along, beside = one.place(point)
    assert float(along) == pytest.approx(share * one.length_px)
    assert float(beside) == pytest.approx(across, abs=1e-6)
    step = one.at(share * one.length_px + 1e-4) - one.at(share * one.length_px)
    assert one.way(share * one.length_px) == pytest.approx(step / 1e-4, abs=1e-5)


@given(bulge=BULGES)
def test_parts_of_an_arc_lie_on_it(bulge: float) -> None:
    piece = Piece(arc(bulge).start, arc(bulge).end, 10.0, bulge=bulge)
    low, high = 0.2 * piece.length_px, 0.7 * piece.length_px
    part = piece.part(low, high)
    assert part.length_px == pytest.approx(high - low)
    assert part.arc.at(10.0) == pytest.approx(piece.arc.at(low + 10.0))


@settings(max_examples=20)
@given(turn=st.floats(0.5, 6.0), seed=st.integers(0, 1000))
def test_a_circle_is_that_of_least_squares(turn: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    angles = np.linspace(0.3, 0.3 + turn, 80)
    points = np.column_stack([np.cos(angles), np.sin(angles)]) * 90.0 + [40.0, -20.0]
    points += rng.normal(0.0, 0.3, points.shape)
    found = fit_circle(points)
    assert found is not None

    def away(guess: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(np.hypot(*(points - guess[:2]).T) - guess[2])

    best = least_squares(away, [40.0, -20.0, 90.0])
    assert [*found.centre, found.radius_px] == pytest.approx(best.x, abs=1e-3)


def test_points_on_a_line_have_no_circle() -> None:
    assert fit_circle(np.column_stack([np.arange(9.0), 2 * np.arange(9.0)])) is None


@pytest.mark.parametrize("bulge", [0.15, -0.3, 0.7, -0.95])
def test_a_band_that_is_an_arc_is_one_piece(bulge: float) -> None:
    true = arc(bulge)
    solid = painted(LineString(true.points(0.01)).buffer(6.0, cap_style="flat")) > 0.5
    found, rest = curved_pieces(find_tracks(solid), solid, 8.0)
    assert len(found) == 1
    assert sum(len(track.along) for track in rest) < 20
    assert found[0].thickness_px == pytest.approx(12.0, abs=0.7)
    assert found[0].arc.radius_px == pytest.approx(true.radius_px, rel=0.03)
    assert found[0].length_px == pytest.approx(true.length_px, abs=12.0)


@pytest.mark.parametrize(
    "corners",
    [
        [(60, 400), (250, 400), (330, 300), (520, 300)],  # slanted between straight
        [(60, 300), (250, 340), (600, 300)],  # a shallow corner
        [(100, 400), (160, 250), (310, 190), (460, 250), (520, 400)],  # half of an octagon
    ],
)
def test_straight_walls_that_turn_are_no_arc(corners: list[tuple[float, float]]) -> None:
    shape = LineString(corners).buffer(7.0, cap_style="flat", join_style="mitre")
    solid = painted(shape) > 0.5
    assert curved_pieces(find_tracks(solid), solid, 8.0)[0] == []


def test_an_arc_meets_a_wall_where_its_circle_does() -> None:
    one = Piece(np.array([100.0, 200.0]), np.array([300.0, 200.0]), 10.0, bulge=1.0)
    upright = Piece(np.array([150.0, 50.0]), np.array([150.0, 400.0]), 10.0)
    (found,) = meetings(one, upright)
    # The half circle about (200, 200) bows down, to the right of who walks right.
    assert found.point == pytest.approx([150.0, 200.0 + math.sqrt(100.0**2 - 50.0**2)], abs=0.02)
    assert found.first == pytest.approx(100.0 * math.acos(0.5), abs=0.05)
    level = Piece(np.array([20.0, 270.0]), np.array([380.0, 270.0]), 10.0)
    assert len(meetings(one, level)) == 2
    far = Piece(np.array([20.0, 330.0]), np.array([380.0, 330.0]), 10.0)
    assert meetings(one, far) == []


def house(curved: BaseGeometry, holes: BaseGeometry) -> BaseGeometry:
    """Walls of 20 px around 560 x 300 px, two rooms; `curved` walls more, `holes` less."""
    around = box(60, 90, 640, 410).difference(box(80, 110, 620, 390))
    return unary_union([around, curved]).difference(holes)


def sheet(solid: BaseGeometry, lines: list[LineString]) -> NDArray[np.uint8]:
    """A picture of it with thin lines, and a table and a bed so that there are some."""
    things = [box(110, 200, 170, 280).exterior, box(500, 150, 600, 210).exterior]
    thin = unary_union([line.buffer(1.0) for line in (*lines, *things)])
    ink = np.maximum(painted(solid), painted(thin))
    return np.repeat((255 * (1 - ink)).astype(np.uint8)[..., None], 3, axis=2)


def scale_of(drawn: Drawn) -> float:
    """Pixels of the cleaned sheet for one of the picture."""
    return float(drawn.cleaned.clean_from_scan[0, 0])


def curved_walls(drawn: Drawn) -> list[DrawnWall]:
    """Those whose bulge is not 0."""
    return [wall for wall in drawn.walls if wall.bulge]


def test_a_curved_wall_between_two_rooms_is_read_as_one() -> None:
    true = Arc(np.array([330.0, 100.0]), np.array([330.0, 400.0]), -0.25)
    inner = LineString(true.points(0.01)).buffer(6.0, cap_style="flat")
    drawn = read_storey(sheet(house(inner, Polygon()), []))
    (wall,) = curved_walls(drawn)
    ends = drawn.wall_ends(wall) / scale_of(drawn)
    bulge = wall.bulge if ends[0][1] < ends[1][1] else -wall.bulge
    assert bulge == pytest.approx(true.bulge, abs=0.01)
    assert sorted(ends[:, 1]) == pytest.approx([100.0, 400.0], abs=1.5)
    assert ends[:, 0] == pytest.approx([330.0, 330.0], abs=2.0)
    assert len(drawn.rooms) == 2
    scale = scale_of(drawn)
    free = box(80, 110, 620, 390).difference(inner)
    true_rooms = [part for part in getattr(free, "geoms", [free]) if part.area > 1000]
    assert len(true_rooms) == 2
    for part in true_rooms:
        best = max(
            drawn.rooms, key=lambda room: Polygon(room.outline_px / scale).intersection(part).area
        )
        shape = Polygon(best.outline_px / scale)
        assert shape.symmetric_difference(part).area < 0.02 * part.area


def test_a_bow_that_is_mostly_window_is_a_curved_wall_with_a_window() -> None:
    # To the right of who walks right is down.
    true = Arc(np.array([250.0, 400.0]), np.array([450.0, 400.0]), 0.4)
    band = LineString(true.points(0.01)).buffer(10.0, cap_style="flat")
    piece = Piece(true.start, true.end, 20.0, bulge=true.bulge)
    window = piece.part(0.25 * true.length_px, 0.75 * true.length_px)
    pane = LineString(window.arc.points(0.01))
    solid = house(band, Polygon())
    straight = Polygon([(255, 385), (445, 385), (445, 411), (255, 411)])
    inside = Polygon([tuple(point) for point in true.at(np.linspace(0, true.length_px, 60), 0.0)])
    solid = unary_union([solid.difference(straight.intersection(inside.buffer(11.0))), band])
    solid = solid.difference(pane.buffer(11.0, cap_style="flat"))
    faces = [LineString(get_coordinates(pane.offset_curve(side))) for side in (-9.0, 9.0)]
    drawn = read_storey(sheet(solid, faces))
    (wall,) = curved_walls(drawn)
    assert abs(wall.bulge) == pytest.approx(0.4, abs=0.05)
    (opening,) = [one for one in drawn.openings if one.wall == wall.id]
    assert opening.kind == "window"
    scale = scale_of(drawn)
    assert opening.width_px / scale == pytest.approx(0.5 * true.length_px, rel=0.08)
    (room,) = drawn.rooms
    assert Polygon(room.outline_px / scale).contains(Point(350, 425))


def test_a_bay_of_straight_walls_stays_straight() -> None:
    corners = [(240, 400), (290, 450), (410, 450), (460, 400)]
    bay = LineString(corners).buffer(10.0, cap_style="flat", join_style="mitre")
    solid = unary_union([house(Polygon(), box(250, 380, 450, 420)), bay])
    assert curved_walls(read_storey(sheet(solid, []))) == []


def test_a_half_round_end_is_parted_where_a_wall_ends_on_it() -> None:
    """Each part bows as its own stretch of the circle does; the arc ends where its walls begin."""
    circle = Point(400.0, 250.0).buffer(150.0, quad_segs=64)
    inner = box(100.0, 100.0, 400.0, 400.0).union(circle).buffer(-6.0)
    outer = inner.buffer(12.0)
    across = box(247.0, 106.0, 253.0, 394.0).buffer(3.0)
    end = box(250.0, 172.0, 540.0, 178.0).buffer(3.0)
    gaps = unary_union([box(235.0, 280.0, 265.0, 330.0), box(150.0, 380.0, 200.0, 420.0)])
    solid = outer.difference(inner).union(across).union(end.intersection(outer)).difference(gaps)
    drawn = read_storey(
        sheet(solid, [LineString([(120, 130 + k), (180, 130 + k)]) for k in (0, 15, 30)])
    )
    assert len(drawn.rooms) == 3
    bows = sorted(abs(wall.bulge) for wall in curved_walls(drawn))
    up = math.asin((250.0 - 175.0) / 150.0)  # of where the wall ends, above the middle
    shares = ((math.pi / 2 - up) / 4, (math.pi / 2 + up) / 4)
    assert bows == pytest.approx([math.tan(share) for share in shares], abs=0.04)
