"""Whether the cells of a GeoTIFF are a grid in metres along north, as terrain is read."""

from __future__ import annotations

from pathlib import Path

from affine import Affine
from rasterio.crs import CRS

from veduta.run.errors import InputError

ALONG = 1e-6
"""By so much (share) the two sides of a square cell may differ."""
CELL_M = (0.005, 1000.0)
"""Smallest and largest side of a cell: of what is scanned, and of what lies on a whole country."""
FARTHEST_M = 1e8
"""No CRS in metres has places farther from its origin."""


def require_grid(path: Path, place: Affine, crs: CRS | None) -> None:
    """InputError where cells are not square, not along north, of no usual size, or in degrees.

    place: from columns and rows (down) to the CRS.
    """
    upright = place.b == 0.0 and place.d == 0.0 and place.a > 0.0 and place.e < 0.0
    if not upright or abs(place.a + place.e) > ALONG * place.a:
        fault = "has cells that are not square, or that do not lie along north"
        raise InputError(path, fault, "Warp it (gdalwarp -tr 1 1).")
    if crs is not None and crs.is_geographic:
        raise InputError(path, f"has degrees ({crs.to_string()})", "Project it to a CRS in metres.")
    there = all(abs(value) <= FARTHEST_M for value in (place.c, place.f))  # NaN is nowhere
    if not there or not CELL_M[0] <= place.a <= CELL_M[1]:
        fault = f"has cells of {place.a:g} m from ({place.c:g}, {place.f:g}) on"
        raise InputError(
            path, fault, "Check the place that it says, or warp it (gdalwarp -tr 1 1)."
        )
