"""Islands: what hangs together in a texture, and pictures that have a mesh's own islands alone."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Texture
from veduta.place.mesh import Mesh
from veduta.surfaces.pieces import vertex_pieces
from veduta.surfaces.texturing.charts import TooLargeError, packed

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class IslandParameters:
    """padding_px: kept around an island in the new picture. least_share: TooLargeError below it."""

    padding_px: int = 2
    least_share: float = 0.01


@dataclass(frozen=True, eq=False)
class Islands:
    """texture: in which they lie. places: (v, 2) px of each vertex in it. of_vertex: (v,) the
    island of each vertex. lows, highs: (k, 2) px of their boxes.
    """

    texture: Texture
    places: Floats
    of_vertex: NDArray[np.int64]
    lows: Floats
    highs: Floats


def islands_of(mesh: Mesh) -> Islands:
    """What edges join in the texture of a mesh, which has `uv` and one texture.

    ValueError where it has none; each vertex is to be one of a triangle.
    """
    texture = mesh.materials[0].texture
    if mesh.uv is None or texture is None:
        raise ValueError(f"mesh {mesh.id!r} has no texture")
    height, width = texture.pixels.shape[:2]
    pieces = vertex_pieces(mesh.triangles, len(mesh.positions_m))
    _, of_vertex = np.unique(pieces, return_inverse=True)
    of_vertex = of_vertex.reshape(-1).astype(np.int64)
    places = mesh.uv.astype(np.float64) * [width, height]
    count = int(of_vertex.max()) + 1
    lows, highs = np.full((count, 2), np.inf), np.full((count, 2), -np.inf)
    np.minimum.at(lows, of_vertex, places)
    np.maximum.at(highs, of_vertex, places)
    return Islands(texture, places, of_vertex, lows, highs)


def own_texture(
    mesh: Mesh, share: float, largest_px: int, parameters: IslandParameters | None = None
) -> Mesh:
    """The mesh with a picture of its own: of its texture, what its triangles show and no more.

    share: the new picture's pixels along one of the old, at most 1; it is made coarser until
    the picture is `largest_px` a side at most. ValueError where the mesh has no texture,
    TooLargeError where it has too many islands for so small a picture.
    """
    rule = parameters or IslandParameters()
    found = islands_of(mesh)
    texture = found.texture
    area = float(np.prod(found.highs - found.lows, axis=1).sum())
    share = min(share, largest_px / max(np.sqrt(area), 1e-9))
    while share >= rule.least_share:
        lows, sizes, boxes = _boxes(found, share, rule)
        laid = packed(boxes, largest_px)
        if laid is not None:
            break
        share *= 0.84
    else:
        raise TooLargeError(f"{len(found.lows)} islands do not fit into {largest_px} px")
    corners, width, height = laid
    pixels = np.zeros((height, width, 3), dtype=np.uint8)
    invented = np.zeros((height, width), dtype=np.bool_)
    for low, size, box, corner in zip(lows, sizes, boxes, corners, strict=True):
        (x, y), (wide, high) = corner, box
        part = _crop(texture, low, size)
        pixels[y : y + high, x : x + wide] = _resized(part.pixels, wide, high)
        mask = part.invented.astype(np.float32)
        invented[y : y + high, x : x + wide] = _resized(mask, wide, high) > 0.5
    own = found.of_vertex
    moved = corners[own] + (found.places - lows[own]) * (boxes / sizes)[own]
    look = replace(mesh.materials[0], texture=replace(texture, pixels=pixels, invented=invented))
    return replace(mesh, uv=(moved / [width, height]).astype(np.float32), materials=(look,))


def _boxes(
    found: Islands, share: float, rule: IslandParameters
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """(k, 2) whole px: first of the old picture, how many of it, how many of the new."""
    margin = rule.padding_px / share if share < 1.0 else 1.0
    lows = np.floor(found.lows - margin).astype(np.int64)
    sizes = np.ceil(found.highs + margin).astype(np.int64) - lows
    return lows, sizes, np.ceil(sizes * share).astype(np.int64)


def _crop(texture: Texture, low: NDArray[np.int64], size: NDArray[np.int64]) -> Texture:
    """A box of the picture; beyond its border the last pixels go on."""
    height, width = texture.pixels.shape[:2]
    (left, top), (wide, high) = low, size
    rows = np.clip(np.arange(top, top + high), 0, height - 1)[:, None]
    columns = np.clip(np.arange(left, left + wide), 0, width - 1)
    return replace(
        texture, pixels=texture.pixels[rows, columns], invented=texture.invented[rows, columns]
    )


def _resized(values: NDArray[Any], wide: int, high: int) -> NDArray[Any]:
    if values.shape[:2] == (high, wide):
        return values
    return np.asarray(cv2.resize(values, (int(wide), int(high)), interpolation=cv2.INTER_AREA))
