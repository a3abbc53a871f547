"""What one photo says of its room: the colour of the walls, and tiles."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import read_image
from veduta.plan.document import Room
from veduta.plan.house.looks import TILED
from veduta.plan.photos.dbce import Densest, densest_colour
from veduta.plan.photos.given import RoomPhoto
from veduta.plan.photos.picture import look_picture
from veduta.plan.photos.rectangles import Pixels
from veduta.plan.photos.tiles import Surface, TilesSeen, find_tiles

LEAST_REST = 0.05
"""A wall's colour is asked of what is no tiles, if that is at least this share of the photo."""
FEW = 0.01
"""A colour that fewer of the pixels have is doubtful."""


@dataclass(frozen=True)
class Look:
    """colour: of the walls, None where they are tiled. tiles: one of a surface at most.

    picture: the photo, made smaller, beside both. notes: what is doubtful, or was not found.
    """

    photo: RoomPhoto
    picture: Pixels
    colour: Densest | None
    tiles: tuple[TilesSeen, ...]
    notes: tuple[str, ...]

    def of(self, surface: Surface) -> TilesSeen | None:
        """The tiles of a surface."""
        return next((one for one in self.tiles if one.surface == surface), None)


def look_at(photo: RoomPhoto, room: Room) -> Look:
    """Read a photo of a room and find both in it; InputError where it cannot be read."""
    image = read_image(photo.path)
    pixels = image.pixels
    found = find_tiles(pixels, image.focal_px, room.area_m2**0.5)
    notes = [f"{photo.path.name}: {note}" for note in image.notes]
    if len(found.tiles) == 1 and found.tiles[0].plane.head_on:
        notes.append(
            f"{photo.path.name}: tiles that are seen from straight before them are taken for those"
            " of a wall"
        )
    if not found.tiles:
        notes.append(
            f"{photo.path.name}: no tiles: of {found.rectangles} rectangles in it, no six lie as"
            " tiles do"
        )
    rest = ~_covered(found.tiles, pixels.shape[:2])
    wall = next((one for one in found.tiles if one.surface == "wall"), None)
    colour = None
    if wall is not None and room.use in TILED:
        notes.append(f"{photo.path.name}: the walls are tiled: no colour of paint")
    elif rest.mean() < LEAST_REST:
        notes.append(f"{photo.path.name}: shows nothing but tiles: no colour of paint")
    else:
        colour = densest_colour(pixels[rest])
        if colour.share < FEW:
            notes.append(
                f"{photo.path.name}: the colour of the walls is doubtful: only"
                f" {100 * colour.share:.1f} % of the pixels have about it"
            )
    # Not the photo itself: those of all rooms would lie in memory till the report is written.
    picture = look_picture(pixels, colour, found.tiles)
    return Look(photo, picture, colour, found.tiles, tuple(notes))


def _covered(tiles: tuple[TilesSeen, ...], shape: tuple[int, ...]) -> NDArray[np.bool_]:
    """(h, w) what tiles cover of the photo."""
    canvas = np.zeros(shape[:2], dtype=np.uint8)
    for one in tiles:
        cv2.fillPoly(canvas, list(one.rings_px.round().astype(np.int32)), 1)
    return canvas.astype(np.bool_)
