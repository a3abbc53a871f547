"""Where a visitor begins: at the fronts, in a street, and never in a house or at the backs."""

from __future__ import annotations

import math

import numpy as np
import pytest

from veduta.grammar.first_view import FirstView, first_view
from veduta.grammar.lot import Lot

WIDE_M, DEEP_M, HIGH_M = 10.0, 12.0, 18.0


def lot(left: tuple[float, float], turn_deg: float) -> Lot:
    """A lot whose front begins at `left` and runs that way; it looks to the right of it."""
    turn = math.radians(turn_deg)
    along = np.array([math.cos(turn), math.sin(turn)])
    back = np.array([-along[1], along[0]])
    corners = [0 * along, WIDE_M * along, WIDE_M * along + DEEP_M * back, DEEP_M * back]
    return Lot("", "", (np.array(corners),), (*left, 0.0))


def row(turn_deg: float, count: int, begin: tuple[float, float] = (0.0, 0.0)) -> list[Lot]:
    turn = math.radians(turn_deg)
    step = WIDE_M * np.array([math.cos(turn), math.sin(turn)])
    return [
        lot(tuple((np.array(begin) + number * step).tolist()), turn_deg) for number in range(count)
    ]


def looked(lots: list[Lot]) -> tuple[FirstView, np.ndarray]:
    view = first_view(lots, HIGH_M)
    assert view is not None
    way = np.subtract(view.target_m, view.eye_m)
    return view, way / np.linalg.norm(way)


def inside(point: tuple[float, float], lots: list[Lot]) -> bool:
    """By the signs of the edges' cross products: lots are convex."""
    for one in lots:
        ring = one.rings_m[0] + one.anchor_m[:2]
        along, to = np.roll(ring, -1, axis=0) - ring, np.array(point) - ring
        if (along[:, 0] * to[:, 1] - along[:, 1] * to[:, 0] > 0).all():
            return True
    return False


@pytest.mark.parametrize("turn_deg", [0.0, 90.0, 180.0, 37.0, -120.0])
def test_a_row_is_seen_from_where_its_fronts_look(turn_deg: float) -> None:
    lots = row(turn_deg, 9)
    view, way = looked(lots)
    turn = math.radians(turn_deg)
    outward = np.array([math.sin(turn), -math.cos(turn)])
    assert way @ outward < -0.85  # three-quarter: 22 degrees beside the straight look
    middle = 4.5 * WIDE_M * np.array([math.cos(turn), math.sin(turn)])
    assert view.target_m == pytest.approx(middle, abs=1e-6)
    assert np.subtract(view.eye_m, view.target_m) @ outward == pytest.approx(1.4 * HIGH_M)
    assert not inside(view.eye_m, lots)


@pytest.mark.parametrize("turn_deg", [0.0, 90.0, 30.0])
def test_a_street_of_two_sides_is_seen_along_from_its_beginning(turn_deg: float) -> None:
    street_m = 14.0
    turn = math.radians(turn_deg)
    along = np.array([math.cos(turn), math.sin(turn)])
    across = np.array([-along[1], along[0]])
    north = tuple((street_m / 2 * across).tolist())
    south = tuple((-street_m / 2 * across + 8 * WIDE_M * along).tolist())
    lots = row(turn_deg, 8, north) + row(turn_deg + 180.0, 8, south)
    view, way = looked(lots)
    assert abs(way @ along) > 0.9
    # In the middle of the carriageway, but for boxes of lots that stand askew.
    assert abs(np.array(view.eye_m) @ across) < (0.3 if turn_deg % 90 == 0 else 1.5)
    assert abs(view.eye_m @ along - 1.0) < 1e-6 or abs(view.eye_m @ along - 79.0) < 1e-6
    assert not inside(view.eye_m, lots)


def test_the_rows_of_a_town_stand_back_to_back() -> None:
    """Blocks of two rows, 12 m between blocks: the eye is in one of the streets between them."""
    lots: list[Lot] = []
    for block in range(4):
        y = block * 40.0
        lots += row(0.0, 10, (0.0, y)) + row(180.0, 10, (100.0, y + 28.0))
    view, way = looked(lots)
    assert abs(way[0]) > 0.9
    assert min(abs(view.eye_m[1] - (34.0 + 40.0 * k)) for k in range(3)) < 0.5
    assert not inside(view.eye_m, lots)


def test_one_does_not_step_back_into_the_house_behind() -> None:
    lots = [*row(0.0, 5), lot((0.0, -22.0), 0.0), lot((20.0, -22.0), 0.0), lot((10.0, -22.0), 0.0)]
    view, _ = looked(lots)
    assert not inside(view.eye_m, lots)


def test_lots_without_a_front_say_nothing() -> None:
    nothing = Lot("", "", (np.zeros((4, 2)),), (0.0, 0.0, 0.0))
    assert first_view([nothing], HIGH_M) is None
    assert first_view([], HIGH_M) is None
