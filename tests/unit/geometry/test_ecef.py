"""Earth-centred frames of projections: against closed forms, published points and our own UTM."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from veduta.geometry.ecef import Grid, ecef, ecef_from_grid, grid_of_crs, lonlat_of
from veduta.geometry.utm import utm

A, B = 6_378_137.0, 6_356_752.314245
METRE_DEG = 1 / 111_000


def grid(code: int) -> Grid:
    found = grid_of_crs(f"EPSG:{code}")
    assert found is not None
    return found


def lonlat(code: int, east: float, north: float) -> list[float]:
    found: list[float] = lonlat_of(grid(code), np.array([[east, north]]))[0].tolist()
    return found


def at(lon: float, lat: float, height: float = 0.0) -> NDArray[np.float64]:
    return ecef(np.array([[lon, lat]]), height)[0]


def test_the_axes_of_the_ellipsoid() -> None:
    assert at(0, 0) == pytest.approx([A, 0, 0])
    assert at(90, 0, 10) == pytest.approx([0, A + 10, 0], abs=1e-6)
    assert at(0, 90, 5) == pytest.approx([0, 0, B + 5], abs=1e-5)


def test_projections_in_metres_and_no_others() -> None:
    assert grid(32631).name == "WGS 84 / UTM zone 31N"
    assert grid(7415).name == "Amersfoort / RD New"  # with heights above NAP
    assert grid(28992).accuracy_m == pytest.approx(1.0)
    # Longitude and latitude, US feet, no code, no known code, a file name, mirrored.
    for other in ("EPSG:4326", "EPSG:2263", None, "EPSG:999999", "lots.prj", "EPSG:2065"):
        assert grid_of_crs(other) is None


@given(st.floats(-3, 3), st.floats(-79, 83))
def test_utm_is_our_own(off_deg: float, lat: float) -> None:
    code = 32731 if lat < 0 else 32631
    ((east, north),) = utm(np.array([[3 + off_deg, lat]]), 31, south=lat < 0)
    assert lonlat(code, east, north) == pytest.approx([3 + off_deg, lat], abs=1e-8)


@pytest.mark.parametrize(
    ("code", "point", "truth", "within_m"),
    [
        # Schreutelkamp and Strang van Hees, Benaderingsformules voor de transformatie tussen RD- en
        # WGS84-kaartcoordinaten (2001): Amersfoort and the Westertoren in Amsterdam.
        (28992, (155_000.0, 463_000.0), (5.38720621, 52.15517440), 1.0),
        (28992, (120_700.723, 487_525.502), (4.88352559, 52.37453253), 1.0),
        # Where the definitions of Lambert-93 and of the conic zone 49 put their origins.
        (2154, (700_000.0, 6_600_000.0), (3.0, 46.5), 0.01),
        (3949, (1_700_000.0, 8_200_000.0), (3.0, 49.0), 0.01),
        # Ordnance Survey, A guide to coordinate systems in Great Britain: the tower of Caister,
        # by the grid of corrections that is not there; its seven parameters are good to 5 m.
        (
            27700,
            (651_409.804, 313_177.450),
            (1 + 42 / 60 + 57.8663 / 3600, 52 + 39 / 60 + 28.8282 / 3600),
            5.0,
        ),
    ],
)
def test_published_points(
    code: int, point: tuple[float, float], truth: tuple[float, float], within_m: float
) -> None:
    off = at(*lonlat(code, *point)) - at(*truth)
    assert np.linalg.norm(off) < within_m


def test_lambert_93_by_its_formulas() -> None:
    """EPSG Guidance Note 7-2, Lambert conic conformal with two standard parallels, on GRS 80."""
    f = 1 / 298.257222101
    e = np.sqrt(2 * f - f * f)

    def m(lat: float) -> float:
        return float(np.cos(lat) / np.sqrt(1 - (e * np.sin(lat)) ** 2))

    def t(lat: float) -> float:
        inner = ((1 - e * np.sin(lat)) / (1 + e * np.sin(lat))) ** (e / 2)
        return float(np.tan(np.pi / 4 - lat / 2) / inner)

    first, second, origin = np.radians([49.0, 44.0, 46.5])
    n = (np.log(m(first)) - np.log(m(second))) / (np.log(t(first)) - np.log(t(second)))
    scale = m(first) / (n * t(first) ** n)
    for lon, lat in ((2.3488, 48.8534), (-4.5, 48.4), (9.4, 42.2)):
        radius = A * scale * t(np.radians(lat)) ** n
        theta = n * np.radians(lon - 3.0)
        east = 700_000 + radius * np.sin(theta)
        north = 6_600_000 + A * scale * t(origin) ** n - radius * np.cos(theta)
        assert lonlat(2154, east, north) == pytest.approx([lon, lat], abs=0.01 * METRE_DEG)


def test_other_transverse_mercators() -> None:
    """MGA zone 55 is UTM on an ellipsoid that differs by a tenth of a millimetre."""
    ((east, north),) = utm(np.array([[145.5, -37.8]]), 55, south=True)
    assert lonlat(28355, east, north) == pytest.approx([145.5, -37.8], abs=0.01 * METRE_DEG)
    # Gauss-Krueger about 9 degrees east: the meridian's easting; its datum lies some 150 m away.
    lon, lat = lonlat(31467, 3_500_000.0, 5_540_000.0)
    assert abs(lon - 9.0) < 200 * METRE_DEG
    assert abs(lat - 50.0) < 0.02


@pytest.mark.parametrize("code", [32631, 28992, 2154, 27700, 31370])
def test_neighbours_on_the_grid_are_neighbours_on_earth(code: int) -> None:
    """The frame's axes follow the grid: 50 m along it lead to where the projection says."""
    homes = {32631: (450_000.0, 5_410_000.0), 28992: (84_825.0, 447_456.0)}
    homes |= {2154: (652_000.0, 6_862_000.0), 27700: (530_000.0, 180_000.0)}
    east, north = homes.get(code, (150_000.0, 170_000.0))
    frame = ecef_from_grid(grid(code), (east, north, 20.0))
    for step in ([50.0, 0.0, 0.0], [0.0, 50.0, 0.0], [-30.0, 40.0, 7.0]):
        told = (frame @ [*step, 1.0])[:3]
        there = lonlat(code, east + step[0], north + step[1])
        assert np.linalg.norm(told - at(*there, 20.0 + step[2])) < 1.5e-3  # the Earth is round
    turned = frame[:3, :3] / np.linalg.norm(frame[:3, :3], axis=0)
    assert turned.T @ turned == pytest.approx(np.eye(3), abs=3e-5)  # conformal
    assert np.linalg.det(turned) == pytest.approx(1.0)


def test_convergence_east_of_the_central_meridian() -> None:
    """tan(gamma) = tan(dlon) sin(lat), on the sphere: the grid's north leans to the west there."""
    ((east, north),) = utm(np.array([[5.0, 50.0]]), 31, south=False)
    frame = ecef_from_grid(grid(32631), (east, north, 0.0))
    lam, phi = np.radians(5.0), np.radians(50.0)
    to_east = np.array([-np.sin(lam), np.cos(lam), 0.0])
    to_north = np.array([-np.sin(phi) * np.cos(lam), -np.sin(phi) * np.sin(lam), np.cos(phi)])
    grid_north = frame[:3, 1] / np.linalg.norm(frame[:3, 1])
    lean = np.arctan2(grid_north @ to_east, grid_north @ to_north)
    expected = np.arctan(np.tan(np.radians(2.0)) * np.sin(phi))
    assert abs(lean) == pytest.approx(expected, abs=2e-5)


def test_places_outside_of_a_projection_are_refused() -> None:
    with pytest.raises(ValueError, match="UTM zone 31N has no place"):
        lonlat_of(grid(32631), np.array([[1e12, 1e12]]))
