"""A tile of ground: one surface, triangles between places whose heights are known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import y_up
from veduta.formats.plain_tile import PlainLook, feature_ids, plain_tile
from veduta.formats.tile_glb import FLOAT, UINT, Binary, BuildingRow
from veduta.place.material import Colour
from veduta.place.semantics import SemanticClass

_ARRAY, _ELEMENTS = 34962, 34963


def ground_glb(
    points_m: NDArray[np.float64], triangles: NDArray[np.int32], row: BuildingRow, colour: Colour
) -> bytes:
    """The GLB of (n, 3) points (m, z up) and (m, 3) triangles, counter-clockwise from above."""
    binary = Binary()
    places = y_up(points_m.astype(np.float32)).astype("<f4")
    low, high = places.min(axis=0).tolist(), places.max(axis=0).tolist()
    features = np.zeros(len(places), dtype="<f4").tobytes()
    corners = triangles.astype("<u4").tobytes()
    primitive = {
        "attributes": {
            "POSITION": binary.accessor(
                places.tobytes(), FLOAT, "VEC3", target=_ARRAY, min=low, max=high
            ),
            "_FEATURE_ID_0": binary.accessor(features, FLOAT, "SCALAR", target=_ARRAY),
        },
        "indices": binary.accessor(corners, UINT, "SCALAR", target=_ELEMENTS),
        "extensions": {"EXT_mesh_features": {"featureIds": feature_ids(1)}},
    }
    look = PlainLook(SemanticClass.GROUND, colour, roughness=0.95)
    no_size = np.full((1, 2), np.nan)
    return plain_tile(look, [row], no_size, primitive, binary, used=["EXT_mesh_features"])
