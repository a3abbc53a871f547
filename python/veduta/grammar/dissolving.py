"""A part whose surfaces splits have cut into cells, as the faces that they were cut from.

Cells share no corners with their neighbours (the corner of one lies on the edge of another). As
faces they do, so that what the rules close is closed in the part, to the last bit.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.place.part import Part

# Corners of cells that are nearer to each other are one (m).
NEAR_M = 1e-6
# Places are whole multiples of this (m): what the engine leaves beside 0 is 0.
GRID_M = 1e-6


def dissolved(part: Part, positions_m: NDArray[np.float64]) -> Part:
    """The part with the cells of one surface, material and plane as one polygon.

    positions_m: (v, 3), those of the part in double precision.
    """
    count = len(part.materials)
    group = part.polygon_feature.astype(np.int64) * count + part.polygon_material
    textured = np.array([material.texture is not None for material in part.materials])
    corners = np.diff(part.ring_offsets[part.polygon_offsets])
    shown = np.repeat(textured[part.polygon_material], corners)
    places, uv, rings, polygons, groups = _core.dissolve_polygons(
        positions_m,
        np.where(shown[:, None], part.uv.astype(np.float64), 0.0),
        part.ring_offsets,
        part.polygon_offsets,
        group.astype(np.uint32),
        part.features.shell[part.polygon_feature].astype(np.uint32),
        NEAR_M,
    )
    feature, material = np.divmod(groups.astype(np.int64), count)
    return replace(
        part,
        positions_m=(np.round(places / GRID_M) * GRID_M + 0.0).astype(np.float32),
        uv=uv.astype(np.float32),
        ring_offsets=rings,
        polygon_offsets=polygons,
        polygon_feature=feature.astype(np.int32),
        polygon_material=material.astype(np.int32),
    )
