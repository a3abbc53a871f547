"""What the height of the cameras says for a placement."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.stats import norm

from veduta.photos.city.facades import Facades
from veduta.photos.world.eye_height import EYES_M, Feet, eye_height_nats


@pytest.fixture
def houses() -> Feet:
    """Fronts of two houses, whose feet are at 100 m and, 200 m away, at 120 m."""
    return Feet(
        Facades(
            start=np.array([[0.0, 0.0], [200.0, 0.0]]),
            end=np.array([[10.0, 0.0], [210.0, 0.0]]),
            bottom=np.array([100.0, 120.0]),
            top=np.array([109.0, 129.0]),
            hidden=np.zeros(2, dtype=np.bool_),
            names=("one", "other"),
            building=np.array([0, 1]),
        )
    )


def cameras(east: float, height: float, south: float = 6.0) -> NDArray[np.float64]:
    """Seven in a row before a front."""
    x = np.linspace(east, east + 10.0, 7)
    return np.column_stack([x, np.full(7, -south), np.full(7, height)])


@pytest.mark.parametrize(("east", "feet"), [(0.0, 100.0), (200.0, 120.0)])
def test_who_stands_before_a_house_speaks_for_it_by_the_ratio_of_densities(
    houses: Feet, east: float, feet: float
) -> None:
    """Against scipy's normal density: 0.7 of it over 0.1 per metre, and 0.3 for all others."""
    for above in (0.0, EYES_M, 2.4):
        expected = np.log(0.7 * norm.pdf(above, 1.6, 0.5) / 0.1 + 0.3)
        assert eye_height_nats(cameras(east, feet + above), houses) == pytest.approx(expected)


def test_a_drone_speaks_little_against_it_and_one_photo_from_a_roof_nothing(
    houses: Feet,
) -> None:
    assert eye_height_nats(cameras(0.0, 140.0), houses) == pytest.approx(np.log(0.3))
    street = cameras(0.0, 101.6)
    usual = eye_height_nats(street, houses)
    street[3, 2] = 112.0
    assert eye_height_nats(street, houses) == pytest.approx(usual)


def test_far_from_all_houses_it_says_nothing(houses: Feet) -> None:
    assert eye_height_nats(cameras(0.0, 101.6, south=80.0), houses) == 0.0


def test_a_bay_before_the_front_does_not_lift_the_ground(houses: Feet) -> None:
    """Its foot hangs 3 m up, 1 m nearer to the street than the front below it."""
    fronts = houses.facades
    bay = Facades(
        start=np.vstack([fronts.start, [[0.0, -1.0]]]),
        end=np.vstack([fronts.end, [[10.0, -1.0]]]),
        bottom=np.append(fronts.bottom, 103.0),
        top=np.append(fronts.top, 106.0),
        hidden=np.zeros(3, dtype=np.bool_),
        names=("one", "other", "bay"),
        building=np.array([0, 1, 0]),
    )
    street = cameras(0.0, 100.0 + EYES_M)
    assert eye_height_nats(street, Feet(bay)) == pytest.approx(eye_height_nats(street, houses))
