"""A part without the surfaces that are none in single precision: slivers, lines that cross."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.place.part import PLANE_TOLERANCE_M, Part
from veduta.place.subset import with_polygons

_SHOWN = 6


def sound_part(part: Part) -> Part:
    """The part with its unsound polygons left out and noted; the same part where there are none."""
    try:
        _ = part.triangles
    except _core.PolygonFault:
        return _without_unsound(part)
    return part


def _without_unsound(part: Part) -> Part:
    kept = _core.sound_polygons(
        part.positions_m.astype(np.float64),
        part.ring_offsets,
        part.polygon_offsets,
        PLANE_TOLERANCE_M,
    )
    return replace(
        with_polygons(part, kept),
        notes=(*part.notes, _left_out(part, kept)),
    )


def _left_out(part: Part, kept: NDArray[np.bool_]) -> str:
    """The note: how many polygons, and of which features."""
    rows = np.unique(part.polygon_feature[~kept])
    names = ", ".join(part.features.name[row] for row in rows[:_SHOWN])
    more = f" and {len(rows) - _SHOWN} more" if len(rows) > _SHOWN else ""
    return f"{int((~kept).sum())} slivers of surfaces are left out, of {names}{more}"
