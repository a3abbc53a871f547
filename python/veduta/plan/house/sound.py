"""A part without the surfaces that are none in single precision: slivers, lines that cross."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.place.part import PLANE_TOLERANCE_M, Part

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
    ring_counts, point_counts = np.diff(part.polygon_offsets), np.diff(part.ring_offsets)
    ring_kept = np.repeat(kept, ring_counts)
    vertices = np.repeat(ring_kept, point_counts)
    row_of = np.cumsum(kept) - 1
    movers = tuple(
        replace(mover, polygons=row_of[mover.polygons[kept[mover.polygons]]])
        for mover in part.movers
    )
    return replace(
        part,
        positions_m=part.positions_m[vertices],
        uv=part.uv[vertices],
        ring_offsets=np.concatenate([[0], np.cumsum(point_counts[ring_kept])]).astype(np.int64),
        polygon_offsets=np.concatenate([[0], np.cumsum(ring_counts[kept])]).astype(np.int64),
        polygon_feature=part.polygon_feature[kept],
        polygon_material=part.polygon_material[kept],
        movers=tuple(mover for mover in movers if len(mover.polygons)),
        notes=(*part.notes, _left_out(part, kept)),
    )


def _left_out(part: Part, kept: NDArray[np.bool_]) -> str:
    """The note: how many polygons, and of which features."""
    rows = np.unique(part.polygon_feature[~kept])
    names = ", ".join(part.features.name[row] for row in rows[:_SHOWN])
    more = f" and {len(rows) - _SHOWN} more" if len(rows) > _SHOWN else ""
    return f"{int((~kept).sum())} slivers of surfaces are left out, of {names}{more}"
