"""Cells of a GeoTIFF that are no grid of metres are refused by what is wrong with them."""

from __future__ import annotations

from pathlib import Path

import pytest
from affine import Affine
from rasterio.crs import CRS

from veduta.formats.geotiff_grid import require_grid
from veduta.run.errors import InputError

PATH, METRES = Path("ground.tif"), CRS.from_epsg(25832)


def test_square_metres_along_north_are_a_grid() -> None:
    require_grid(PATH, Affine(0.5, 0.0, 500_000.0, 0.0, -0.5, 5_000_000.0), METRES)


@pytest.mark.parametrize(
    ("place", "crs", "fault"),
    [
        (Affine(1.0, 0.1, 0.0, 0.0, -1.0, 0.0), METRES, "not square, or that do not lie along"),
        (Affine(1.0, 0.0, 0.0, 0.0, -2.0, 0.0), METRES, "not square, or that do not lie along"),
        (Affine(1e-200, 0.0, 0.0, 0.0, -1e-200, 0.0), METRES, "cells of 1e-200 m"),
        (Affine(1e9, 0.0, 0.0, 0.0, -1e9, 0.0), METRES, r"cells of 1e\+09 m"),
        (Affine(1.0, 0.0, float("nan"), 0.0, -1.0, 0.0), METRES, r"from \(nan, 0\) on"),
        (Affine(1.0, 0.0, 0.0, 0.0, -1.0, float("nan")), METRES, r"from \(0, nan\) on"),
        (Affine(1e-4, 0.0, 0.0, 0.0, -1e-4, 0.0), CRS.from_epsg(4326), r"degrees \(EPSG:4326\)"),
    ],
)
def test_others_are_refused(place: Affine, crs: CRS, fault: str) -> None:
    with pytest.raises(InputError, match=rf"ground\.tif: has .*{fault}"):
        require_grid(PATH, place, crs)
