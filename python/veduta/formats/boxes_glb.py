"""A tile of plain boxes: buildings from afar, one instance each of the unit cube."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from veduta.formats.plain_tile import PlainLook, feature_ids, plain_tile
from veduta.formats.tile_glb import FLOAT, SHORT, USHORT, Binary, BuildingRow
from veduta.place.material import Colour
from veduta.place.semantics import SemanticClass

_ARRAY, _ELEMENTS = 34962, 34963
# The cube from (-1, 0, -1) to (1, 1, 1), y up, without its bottom.
_CORNERS = [(x, y, z) for y in (0, 1) for z in (-1, 1) for x in (-1, 1)]
_FACES = [
    (2, 3, 7, 6),
    (3, 1, 5, 7),
    (1, 0, 4, 5),
    (0, 2, 6, 4),
    (6, 7, 5, 4),
]


@dataclass(frozen=True)
class PlainBox:
    """A building as a box: the middle of its base (m, z up), half width and depth, height, heading.

    heading_rad: of the width, counter-clockwise from east.
    """

    base_m: tuple[float, float, float]
    half_m: tuple[float, float]
    height_m: float
    heading_rad: float


def boxes_glb(
    boxes: Sequence[PlainBox],
    buildings: Sequence[BuildingRow],
    colour: Colour,
) -> bytes:
    """The GLB of the boxes; surface and building of a box have its number."""
    binary = Binary()
    corners = b"".join(struct.pack("<4h", *corner, 0) for corner in _CORNERS)
    indices = [index for a, b, c, d in _FACES for index in (a, b, c, a, c, d)]
    count = len(boxes)
    base = np.array([box.base_m for box in boxes], dtype=np.float64)
    half = np.array([box.half_m for box in boxes], dtype=np.float64)
    height = np.array([box.height_m for box in boxes], dtype=np.float64)
    turn = np.array([box.heading_rad for box in boxes], dtype=np.float64) / 2
    zero = np.zeros(count)
    places = np.column_stack([base[:, 0], base[:, 2], -base[:, 1]]).astype("<f4")
    turned = np.round(np.column_stack([zero, np.sin(turn), zero, np.cos(turn)]) * 32767)
    sizes = np.column_stack([half[:, 0], height, half[:, 1]]).astype("<f4")
    numbers = np.arange(count)
    primitive = {
        "attributes": {
            "POSITION": binary.accessor(
                corners, SHORT, "VEC3", stride=8, target=_ARRAY, min=[-1, 0, -1], max=[1, 1, 1]
            )
        },
        "indices": binary.accessor(
            np.array(indices, dtype="<u2").tobytes(), USHORT, "SCALAR", target=_ELEMENTS
        ),
    }
    attributes = {
        "TRANSLATION": binary.accessor(places.tobytes(), FLOAT, "VEC3"),
        "ROTATION": binary.accessor(turned.astype("<i2").tobytes(), SHORT, "VEC4", normalized=True),
        "SCALE": binary.accessor(sizes.tobytes(), FLOAT, "VEC3"),
        "_FEATURE_ID_0": binary.accessor(numbers.astype("<u2").tobytes(), USHORT, "SCALAR"),
    }
    node = {
        "extensions": {
            "EXT_mesh_gpu_instancing": {"attributes": attributes},
            "EXT_instance_features": {"featureIds": feature_ids(count)},
        }
    }
    return plain_tile(
        PlainLook(SemanticClass.WALL, colour, roughness=0.9),
        buildings,
        np.column_stack([2 * half[:, 0], height]),
        primitive,
        binary,
        node=node,
        used=["EXT_instance_features"],
        required=["EXT_mesh_gpu_instancing", "KHR_mesh_quantization"],
    )
