"""The rings of a lot: numbers from a file, and polygons that can be built on."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.geometry.polygon import signed_area

MAX_VERTICES = 10_000
MIN_STEP_M = 1e-3
"""Corners nearer to each other are one."""
MIN_AREA_M2 = 0.5
MAX_SIDE_M = 10_000.0


class RingFault(ValueError):
    """What is wrong with a polygon."""


def numbers_of(ring: Any) -> NDArray[np.float64]:
    """(n, 3) of a GeoJSON ring, without the closing point; z is 0 where the file has none."""
    if not isinstance(ring, list):
        raise RingFault("a ring is no list of points")
    if len(ring) > MAX_VERTICES:
        raise RingFault(f"a ring has {len(ring)} points, more than {MAX_VERTICES}")
    try:
        points = np.array(ring)
    except ValueError as error:
        raise RingFault("a point is no list of two or three numbers") from error
    if points.ndim != 2 or points.shape[1] < 2 or points.dtype.kind not in "iuf":
        raise RingFault("a point is no list of two or three numbers")
    points = closed_ring(points.astype(np.float64))
    heights = points[:, 2:3] if points.shape[1] > 2 else np.zeros((len(points), 1))
    return np.concatenate([points[:, :2], heights], axis=1)


def closed_ring(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """(n, d) without the point that closes it; RingFault where it is no ring of finite numbers."""
    if not np.isfinite(points).all():
        raise RingFault("a coordinate is not finite")
    if len(points) > 1 and (points[0] == points[-1]).all():
        points = points[:-1]
    if len(points) < 3:
        raise RingFault("a ring has fewer than three corners")
    return points


def clean_rings(rings_m: list[NDArray[np.float64]]) -> list[NDArray[np.float64]]:
    """Rings of (n, 2) metres that bound an area: the outline left about, holes right about.

    The first edge of the outline stays its first. RingFault where lines cross or nothing is
    enclosed.
    """
    total = sum(len(ring) for ring in rings_m)
    if total > MAX_VERTICES:
        raise RingFault(f"has {total} corners, more than {MAX_VERTICES}")
    found = []
    for number, ring in enumerate(rings_m):
        kept = _apart(ring)
        if len(kept) < 3:
            raise RingFault("a ring has fewer than three corners")
        if float(np.ptp(kept, axis=0).max()) > MAX_SIDE_M:
            raise RingFault(f"is more than {MAX_SIDE_M / 1000:.0f} km wide")
        is_outline = number == 0
        if (signed_area(kept) > 0) != is_outline:
            kept = np.roll(kept[::-1], 2, axis=0)
        found.append(kept)
    _require_area(found)
    return found


def _apart(ring: NDArray[np.float64]) -> NDArray[np.float64]:
    """Without corners that lie on the one before."""
    steps = np.linalg.norm(ring - ring[np.arange(-1, len(ring) - 1)], axis=1)
    kept: NDArray[np.float64] = ring[steps >= MIN_STEP_M]
    return kept


def _require_area(rings: list[NDArray[np.float64]]) -> None:
    """The triangulation of models says whether it is a polygon, and how large."""
    points = np.concatenate(rings)
    offsets = np.cumsum([0, *(len(ring) for ring in rings)])
    try:
        *_, areas = _core.triangulate_polygons(
            np.column_stack([points, np.zeros(len(points))]),
            offsets.astype(np.int64),
            np.array([0, len(rings)], dtype=np.int64),
            MIN_STEP_M,
        )
    except _core.SelfCrossingError as error:
        raise RingFault("its outline crosses itself, or a hole crosses it") from error
    except _core.NoAreaError as error:
        raise RingFault("its outline encloses nothing, or crosses itself") from error
    except _core.PolygonFault as error:
        raise RingFault(f"is not a polygon ({error})") from error
    if areas[0] < MIN_AREA_M2:
        raise RingFault(f"encloses {areas[0]:.2g} m², less than {MIN_AREA_M2} m²")
