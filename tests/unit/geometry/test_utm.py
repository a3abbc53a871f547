"""UTM against what defines it: true to scale along the meridian, and conformal everywhere."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from veduta.geometry.utm import (
    EQUATORIAL_RADIUS_M,
    FLATTENING,
    SCALE,
    epsg_of,
    utm,
    zone_of,
)

E2 = FLATTENING * (2 - FLATTENING)


def _meridian_radius(latitude: float) -> float:
    return float(EQUATORIAL_RADIUS_M * (1 - E2) / (1 - E2 * np.sin(latitude) ** 2) ** 1.5)


@pytest.mark.parametrize("latitude_deg", [-60.0, 0.0, 12.5, 48.85, 83.0])
def test_meridian_is_as_long_as_its_arc(latitude_deg: float) -> None:
    arc, _ = quad(_meridian_radius, 0.0, np.radians(latitude_deg), epsabs=1e-8)
    south = latitude_deg < 0
    east, north = utm(np.array([[3.0, latitude_deg]]), 31, south=south)[0]
    assert east == pytest.approx(500_000.0, abs=1e-9)
    assert north == pytest.approx(SCALE * arc + (1e7 if south else 0.0), abs=1e-5)


@given(st.floats(0.1, 6.0), st.floats(1.0, 80.0))
def test_small_shapes_keep_their_form(longitude_deg: float, latitude_deg: float) -> None:
    """A step east and one north of equal length on the ellipsoid stay equal and square."""
    latitude, step = np.radians(latitude_deg), 1e-6
    normal = EQUATORIAL_RADIUS_M / np.sqrt(1 - E2 * np.sin(latitude) ** 2)
    here = np.array([longitude_deg, latitude_deg])
    east = np.array([np.degrees(step) / (normal * np.cos(latitude)), 0.0]) * 1e6
    north = np.array([0.0, np.degrees(step) / _meridian_radius(latitude)]) * 1e6
    points = np.stack([here + east, here - east, here + north, here - north])
    moved = utm(points, 31, south=False)
    along, up = moved[0] - moved[1], moved[2] - moved[3]
    assert np.allclose(up, [-along[1], along[0]], atol=1e-6)


def test_a_known_point() -> None:
    """The Eiffel Tower: 448252 m east, 5411935 m north in zone 31."""
    found = utm(np.array([[2.2945, 48.8583]]), 31, south=False)[0]
    assert np.allclose(found, [448252, 5411935], atol=20.0)


def test_zones() -> None:
    assert [zone_of(degrees) for degrees in (-180.0, -0.1, 0.0, 2.35, 179.9)] == [1, 30, 31, 31, 60]
    assert epsg_of(31, south=False) == 32631
    assert epsg_of(19, south=True) == 32719
