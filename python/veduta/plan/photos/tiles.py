"""The tiles that a photo shows: on the floor and on a wall, the texture of each and its size."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.geometry import homography
from veduta.plan.photos.lattice import Lattice, find_lattices, origins
from veduta.plan.photos.plane import Plane, Size, likely_size, plane_of
from veduta.plan.photos.rectangles import Pixels, find_rectangles
from veduta.plan.photos.texture import Block, best_block, block_texture

WORK_PX = 1400
"""Contours are searched at this length of the longer side."""

Surface = Literal["floor", "wall"]


@dataclass(frozen=True)
class TilesSeen:
    """Tiles of one plane in a photo.

    texture: (h, w, 3) sRGB of `block`. size_m: width and height of a tile with its joint, invented.
    lattice: in pixels of the photo.
    """

    surface: Surface
    plane: Plane
    lattice: Lattice
    block: Block
    texture: Pixels
    size_m: Size

    @property
    def corners_px(self) -> NDArray[np.float64]:
        """(4, 2) the block in the photo, clockwise from its upper left."""
        return homography.apply(self.lattice.photo_from_tiles, self.block.corners)

    @property
    def rings_px(self) -> NDArray[np.float64]:
        """(n, 4, 2) the outline of each tile with half of its joints, in the photo."""
        square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        rings = origins(self.lattice.cells, self.lattice.bond)[:, None] + square
        matrix = self.lattice.photo_from_tiles
        return homography.apply(matrix, rings.reshape(-1, 2)).reshape(-1, 4, 2)


@dataclass(frozen=True)
class Looked:
    """What was found in a photo, and how many rectangles there were in all."""

    tiles: tuple[TilesSeen, ...]
    rectangles: int


def find_tiles(pixels: Pixels, focal_px: float | None, room_m: float) -> Looked:
    """The tiles of the floor and of a wall in (h, w, 3) sRGB: of each the lattice of most tiles.

    room_m: how wide the room is about; it bounds how far a wall is, and so how large its tiles are.
    """
    height, width = pixels.shape[:2]
    shrink = min(1.0, WORK_PX / max(height, width))
    size = (max(1, round(width * shrink)), max(1, round(height * shrink)))
    small = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA) if shrink < 1.0 else pixels
    rectangles = find_rectangles(np.asarray(small, dtype=np.uint8))
    photo_from_small = homography.scaling(width / size[0], height / size[1])
    found: dict[Surface, TilesSeen] = {}
    for lattice in find_lattices(rectangles):
        seen = _seen(pixels, lattice, photo_from_small, focal_px, room_m)
        if seen is not None and seen.surface not in found:
            found[seen.surface] = seen
    return Looked(tuple(found.values()), len(rectangles))


def _seen(
    pixels: Pixels,
    small: Lattice,
    photo_from_small: homography.Matrix,
    focal_px: float | None,
    room_m: float,
) -> TilesSeen | None:
    """The tiles of a lattice; None on ceilings, and where no block of it is whole."""
    block = best_block(small)
    height, width = pixels.shape[:2]
    matrix = photo_from_small @ small.photo_from_tiles
    plane = plane_of(matrix, (width, height), focal_px)
    if block is None or plane.surface == "ceiling":
        return None
    scale = np.diag(photo_from_small)[:2]
    lattice = Lattice(
        matrix, small.cells, small.corners_px * scale, small.bond, small.joint, small.residual
    )
    size = likely_size(plane, room_m)
    texture = block_texture(pixels, matrix, block, size[0] / size[1])
    return TilesSeen(plane.surface, plane, lattice, block, texture, size)
