"""The materials of rooms of which there are photos."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Texture
from veduta.plan.document import PlanDocument, Tiling, WallColour
from veduta.plan.house.finishes import paint_name, rooms_of, tiles_name
from veduta.plan.house.looks import LOOKS, Look

TilePictures = Mapping[str, NDArray[np.uint8]]
"""(h, w, 3) sRGB textures of tiles, by the file names that the document has for them."""
_PAINT_ROUGHNESS = 0.9
_TILE_ROUGHNESS = 0.4


def room_looks(document: PlanDocument, pictures: TilePictures) -> dict[str, Look]:
    """Of each paint and each tiling, by name; a picture that is missing leaves the usual look."""
    found: dict[str, Look] = {}
    rooms = rooms_of(document)
    photographed = {
        tiling.picture for room in rooms for tiling in room.tilings if tiling.origin == "measured"
    }
    textures = {
        name: _texture(pixels, invented=name not in photographed)
        for name, pixels in pictures.items()
    }
    for room in rooms:
        if room.wall_colour is not None:
            found[paint_name(room.wall_colour)] = _paint(room.wall_colour)
        for tiling in room.tilings:
            found[tiles_name(tiling)] = _tiles(tiling, textures.get(tiling.picture))
    return found


def _paint(colour: WallColour) -> Look:
    red, green, blue = (channel / 255.0 for channel in colour.srgb)
    return Look((red, green, blue), roughness=_PAINT_ROUGHNESS)


def _tiles(tiling: Tiling, texture: Texture | None) -> Look:
    if texture is None:
        return LOOKS["tile floor" if tiling.surface == "floor" else "tiled wall"]
    covers = (tiling.tiles[0] * tiling.size_m[0], tiling.tiles[1] * tiling.size_m[1])
    return Look((1.0, 1.0, 1.0), roughness=_TILE_ROUGHNESS, picture=texture, picture_m=covers)


def _texture(pixels: NDArray[np.uint8], *, invented: bool) -> Texture:
    """Nobody knows whether a picture that somebody wrote is of a photo: then it counts as none."""
    return Texture(pixels, np.full(pixels.shape[:2], invented, dtype=np.bool_))
