"""Earth-centred frames: against closed forms and against the projection itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.geometry.ecef import UtmZone, ecef, ecef_from_grid, lonlat_of, zone_of_crs
from veduta.geometry.utm import utm

A, B = 6_378_137.0, 6_356_752.314245


def test_the_axes_of_the_ellipsoid() -> None:
    assert ecef(0, 0, 0) == pytest.approx([A, 0, 0])
    assert ecef(90, 0, 10) == pytest.approx([0, A + 10, 0], abs=1e-6)
    assert ecef(0, 90, 5) == pytest.approx([0, 0, B + 5], abs=1e-5)


def test_codes_of_utm_and_no_others() -> None:
    assert zone_of_crs("EPSG:32631") == UtmZone(31, south=False)
    assert zone_of_crs("EPSG:32756") == UtmZone(56, south=True)
    assert zone_of_crs("EPSG:25832") == UtmZone(32, south=False)
    for other in (None, "EPSG:28992", "EPSG:32600", "EPSG:32661", "EPSG:25801", "EPSG:4326"):
        assert zone_of_crs(other) is None


@given(st.floats(-3, 3), st.floats(-79, 83))
def test_the_way_back_from_the_grid(off_deg: float, lat: float) -> None:
    zone = UtmZone(31, south=lat < 0)
    ((east, north),) = utm(np.array([[3 + off_deg, lat]]), 31, south=zone.south)
    assert lonlat_of(zone, east, north) == pytest.approx((3 + off_deg, lat), abs=1e-10)


@pytest.mark.parametrize(("lon", "lat"), [(0.2, 49.0), (5.5, 60.0), (3.0, 10.0), (1.0, -33.0)])
def test_neighbours_on_the_grid_are_neighbours_on_earth(lon: float, lat: float) -> None:
    """The frame's axes follow the grid: 50 m along it lead to where the projection says."""
    zone = UtmZone(31, south=lat < 0)
    ((east, north),) = utm(np.array([[lon, lat]]), 31, south=zone.south)
    frame = ecef_from_grid(zone, (east, north, 20.0))
    for step in ([50.0, 0.0, 0.0], [0.0, 50.0, 0.0], [-30.0, 40.0, 7.0]):
        told = (frame @ [*step, 1.0])[:3]
        there = lonlat_of(zone, east + step[0], north + step[1])
        assert np.linalg.norm(told - ecef(*there, 20.0 + step[2])) < 1.5e-3  # the Earth is round


def test_convergence_east_of_the_central_meridian() -> None:
    """tan(gamma) = tan(dlon) sin(lat), on the sphere: the grid's north leans to the west there."""
    zone = UtmZone(31, south=False)
    ((east, north),) = utm(np.array([[5.0, 50.0]]), 31, south=False)
    frame = ecef_from_grid(zone, (east, north, 0.0))
    lam, phi = np.radians(5.0), np.radians(50.0)
    to_east = np.array([-np.sin(lam), np.cos(lam), 0.0])
    to_north = np.array([-np.sin(phi) * np.cos(lam), -np.sin(phi) * np.sin(lam), np.cos(phi)])
    grid_north = frame[:3, 1] / np.linalg.norm(frame[:3, 1])
    lean = np.arctan2(grid_north @ to_east, grid_north @ to_north)
    expected = np.arctan(np.tan(np.radians(2.0)) * np.sin(phi))
    assert abs(lean) == pytest.approx(expected, abs=2e-5)
    assert lean > 0  # towards the pole along the grid is clockwise of true north here
