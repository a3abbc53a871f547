"""The walls as a part of the place: a rectangle each, with its picture on it."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.photos.walls.document import WALLS
from veduta.photos.walls.grid import WallGrid
from veduta.photos.walls.pictures import WallPicture
from veduta.photos.walls.wall import Wall
from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.place import UNMOVED, ModelFile, Place, Standing
from veduta.place.semantics import Provenance, SemanticClass

LONGEST_PX = 1024
"""Longest side of a texture: the pictures themselves are finer."""
MODEL = f"{WALLS}/walls.glb"
DOCUMENT = "walls.json"
_UNSEEN = (0.62, 0.6, 0.57)


def walls_part(pictures: Sequence[WallPicture]) -> Part | None:
    """The part of all walls; None where there is none.

    Its frame is that of the structure, single precision about its origin. The rectangles are
    inferred: their planes are measured, their outlines follow from where points end.
    """
    if not pictures:
        return None
    builder = PartBuilder(WALLS)
    for picture in pictures:
        wall = picture.grid.wall
        feature = builder.feature(
            SemanticClass.WALL,
            Provenance.INFERRED,
            f"wall {wall.id}",
            size_m=(wall.width, wall.height),
        )
        material = builder.material(Material(wall.id, texture=_texture(picture)))
        builder.polygon([_corners(wall)], feature, material, _uv(picture.grid))
    return builder.build()


def add_walls(place: Place, part: Part) -> None:
    """Put them into the place, under a name that none of its parts has."""
    name = part.id
    while name in place.parts:  # a city model may call a building so
        name = f"{name}-found"
    standing = Standing("walls", UNMOVED, document=DOCUMENT)
    place.add(part, standing, ModelFile(MODEL), part_id=name)


def _corners(wall: Wall) -> NDArray[np.float64]:
    """(4, 3) counter-clockwise seen from outside."""
    return np.array(
        [
            [*wall.start, wall.bottom],
            [*wall.end, wall.bottom],
            [*wall.end, wall.top],
            [*wall.start, wall.top],
        ]
    )


def _uv(grid: WallGrid) -> UvMap:
    width, height = grid.pixel * grid.width_px, grid.pixel * grid.height_px

    def uv(points: NDArray[np.float64]) -> NDArray[np.float64]:
        across = (points[:, :2] - grid.wall.start) @ grid.wall.along - grid.left
        found = np.column_stack([across / width, (grid.upper - points[:, 2]) / height])
        return np.clip(found, 0.0, 1.0)

    return uv


def _texture(picture: WallPicture) -> Texture:
    """The picture with what no photo shows cut out, in the middle colour of what they show."""
    pixels, unseen = picture.pixels[..., :3].copy(), picture.pixels[..., 3] == 0
    shown = pixels[~unseen]
    fill = np.median(shown, axis=0) if len(shown) else 255.0 * np.array(_UNSEEN)
    pixels[unseen] = fill.astype(np.uint8)
    shrink = LONGEST_PX / max(unseen.shape)
    if shrink < 1.0:
        size = (max(1, round(shrink * unseen.shape[1])), max(1, round(shrink * unseen.shape[0])))
        pixels = cv2.resize(pixels, size, interpolation=cv2.INTER_AREA).astype(np.uint8)
        unseen = cv2.resize(unseen.astype(np.uint8), size, interpolation=cv2.INTER_NEAREST) > 0
    return Texture(pixels, np.asarray(unseen, dtype=np.bool_), cut=bool(unseen.any()))
