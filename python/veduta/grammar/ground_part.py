"""The ground of a block as a part of the place, for those who read no tiles."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.place.material import Colour, Material
from veduta.place.part import NO_PARENT, PLANE_TOLERANCE_M, Features, Part
from veduta.place.semantics import Provenance, SemanticClass

COLOUR: Colour = (0.81, 0.8, 0.77)
NAME = "Ground"


def ground_part(part_id: str, points_m: NDArray[np.float64], triangles: NDArray[np.int32]) -> Part:
    """One surface, invented, of (n, 3) points about the part's origin and (m, 3) triangles.

    Triangles that are none in single precision are left out.
    """
    corners = points_m[triangles].reshape(-1, 3).astype(np.float32)
    offsets = 3 * np.arange(len(triangles) + 1, dtype=np.int64)
    each = np.arange(len(triangles) + 1, dtype=np.int64)
    sound = _core.sound_polygons(corners.astype(np.float64), offsets, each, PLANE_TOLERANCE_M)
    kept = int(sound.sum())
    return Part(
        id=part_id,
        positions_m=corners[np.repeat(sound, 3)],
        uv=np.zeros((3 * kept, 2), dtype=np.float32),
        ring_offsets=offsets[: kept + 1],
        polygon_offsets=each[: kept + 1],
        polygon_feature=np.zeros(kept, dtype=np.int32),
        polygon_material=np.zeros(kept, dtype=np.int32),
        features=Features(
            id=(f"{part_id}/{NAME}",),
            name=(NAME,),
            class_code=np.array([SemanticClass.GROUND.code], dtype=np.uint8),
            provenance_code=np.array([Provenance.INVENTED.code], dtype=np.uint8),
            parent=np.array([NO_PARENT], dtype=np.int32),
            shell=np.zeros(1, dtype=np.int32),
            width_m=np.full(1, np.nan),
            height_m=np.full(1, np.nan),
            photo_px=np.full((1, 4), np.nan),
            seen_height_m=np.full(1, np.nan),
            score=np.full(1, np.nan),
        ),
        materials=(Material(SemanticClass.GROUND.value, COLOUR, roughness=0.95),),
    )
