"""A photo of a room beside what was found in it: the colour, its pixels, and the tiles."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from veduta.geometry import homography
from veduta.plan.photos.dbce import Densest, in_ball
from veduta.plan.photos.rectangles import Pixels
from veduta.plan.photos.tiles import TilesSeen

PHOTO_PX = 760
COLUMN_PX = 300
_GAP_PX = 14
_SWATCH_PX = 90
_PAPER = (250, 249, 246)
_INK = (31, 42, 55)
_TILE = (225, 40, 60)
_BLOCK = (255, 205, 0)
_REPEATS = 2


def look_picture(pixels: Pixels, colour: Densest | None, seen: Sequence[TilesSeen]) -> Pixels:
    """(h, w, 3) sRGB: the photo with the tiles outlined, at its right what was taken of it.

    pixels: of the whole photo.
    """
    height, width = pixels.shape[:2]
    scale = PHOTO_PX / max(height, width)
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    photo = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    column = [] if colour is None else _colour_panels(pixels, colour)
    for tiles in seen:
        column += [_texture_panel(tiles)]
        _outline(photo, tiles, homography.scaling(size[0] / width, size[1] / height))
    if not column:
        column = [_titled(np.zeros((1, COLUMN_PX, 3), dtype=np.uint8), "neither colour nor tiles")]
    tall = max(size[1], sum(len(panel) + _GAP_PX for panel in column))
    canvas = np.full((tall, size[0] + _GAP_PX + COLUMN_PX, 3), _PAPER, dtype=np.uint8)
    canvas[: size[1], : size[0]] = photo
    top = 0
    for panel in column:
        canvas[top : top + len(panel), -COLUMN_PX:] = panel
        top += len(panel) + _GAP_PX
    return canvas


def _colour_panels(pixels: Pixels, colour: Densest) -> list[Pixels]:
    """The colour, and where in the photo it is."""
    told = "#" + "".join(f"{channel:02x}" for channel in colour.srgb)
    swatch = np.full((_SWATCH_PX, COLUMN_PX, 3), colour.srgb, dtype=np.uint8)
    height = max(1, round(COLUMN_PX * pixels.shape[0] / pixels.shape[1]))
    near = in_ball(pixels, colour.srgb).astype(np.float32)
    share = cv2.resize(near, (COLUMN_PX, height), interpolation=cv2.INTER_AREA)[..., None]
    where = share * np.array(colour.srgb) + (1.0 - share) * np.array((70, 74, 80))
    return [
        _titled(swatch, f"walls {told}"),
        _titled(where.round().astype(np.uint8), f"{100 * colour.share:.0f} % have this colour"),
    ]


def _texture_panel(tiles: TilesSeen) -> Pixels:
    """The texture as it repeats, at a width of the column."""
    repeated = np.tile(tiles.texture, (_REPEATS, _REPEATS, 1))
    shape = tiles.block.tiles[1] * tiles.size_m[1] / (tiles.block.tiles[0] * tiles.size_m[0])
    size = (COLUMN_PX, max(1, round(COLUMN_PX * min(shape, 1.2))))
    shown = np.asarray(cv2.resize(repeated, size, interpolation=cv2.INTER_AREA), dtype=np.uint8)
    width, height = (round(100 * side, 1) for side in tiles.size_m)
    return _titled(shown, f"{tiles.surface} tiles, {width:g} x {height:g} cm (invented)")


def _titled(panel: Pixels, title: str) -> Pixels:
    head = Image.new("RGB", (COLUMN_PX, 24), _PAPER)
    ImageDraw.Draw(head).text((0, 3), title, fill=_INK, font=ImageFont.load_default(15))
    return np.concatenate([np.asarray(head, dtype=np.uint8), panel])


def _outline(photo: Pixels, tiles: TilesSeen, scale: NDArray[np.float64]) -> None:
    """All tiles that were found, and the block of which the texture is."""
    for ring in tiles.rings_px:
        _line(photo, homography.apply(scale, ring), _TILE, 1)
    _line(photo, homography.apply(scale, tiles.corners_px), _BLOCK, 3)


def _line(
    photo: Pixels, ring: NDArray[np.float64], colour: tuple[int, int, int], thick: int
) -> None:
    fine = ((ring - 0.5) * 16.0).round().astype(np.int32)
    cv2.polylines(photo, [fine], True, colour, thick, cv2.LINE_AA, 4)
