"""Makes the picture of docs/textures.md: a piece of wall of each. Part of `make pictures`."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from pictures import small_jpeg
from PIL import Image, ImageDraw, ImageFont

from veduta.grammar.surfaces.catalogue import PREFIX, SURFACES, painted

IMAGES = Path(__file__).parent / "images"
COLUMNS, WALL_M, PX_PER_M = 6, (3.0, 2.2), 92
GAP_PX, TEXT_PX = 14, 17
MAX_BYTES = 300_000
COLOURS = {
    "ashlar": "#e6dcc4",
    "rusticated": "#e0d6be",
    "stone": "#efe8d8",
    "brick": "#b0614a",
    "brick-flemish": "#b5674d",
    "plaster": "#e9d9b4",
    "roughcast": "#d8d0c0",
    "concrete": "#cfccc4",
    "concrete-boards": "#bab7af",
    "concrete-panels": "#d8d6cf",
    "siding": "#e4e6dc",
    "cobbles": "#b5b0a8",
    "paving": "#c4bdb0",
    "lawn": "#7f9a52",
    "slate": "#6b737f",
    "clay-tile": "#b0654c",
    "pantile": "#c4744f",
    "concrete-tile": "#877068",
    "zinc": "#8f989f",
    "boards": "#9a7654",
    "shingles": "#a1927c",
    "wood": "#4d7560",
    "gravel": "#bab3a4",
    "felt": "#808284",
    "asphalt": "#85878a",
}
"""Typical ones for what is neutral; others are shown as they are."""


def main() -> None:
    """Lay each texture on a wall of some metres, in rows."""
    width, height = (round(side * PX_PER_M) for side in WALL_M)
    rows = -(-len(SURFACES) // COLUMNS)
    size = (COLUMNS * (width + GAP_PX) + GAP_PX, rows * (height + GAP_PX + TEXT_PX + 8) + GAP_PX)
    sheet = Image.new("RGB", size, (250, 249, 246))
    pen, font = ImageDraw.Draw(sheet), ImageFont.load_default(TEXT_PX)
    for number, name in enumerate(SURFACES):
        row, column = divmod(number, COLUMNS)
        x = GAP_PX + column * (width + GAP_PX)
        y = GAP_PX + row * (height + GAP_PX + TEXT_PX + 8)
        sheet.paste(Image.fromarray(_wall(name, (width, height))), (x, y))
        pen.text((x, y + height + 2), name, (38, 40, 44), font)
    path = IMAGES / "textures.jpg"
    path.write_bytes(small_jpeg(sheet, MAX_BYTES))
    print(f"{path.name}: {path.stat().st_size} bytes")


def _wall(name: str, size_px: tuple[int, int]) -> NDArray[np.uint8]:
    """(h, w, 3): the texture repeated in metres, times a colour."""
    own = SURFACES[name].size_m
    tile_px = round(own[0] * PX_PER_M), round(own[1] * PX_PER_M)
    tile = cv2.resize(painted(PREFIX + name), tile_px, interpolation=cv2.INTER_AREA)
    times = -(-size_px[1] // tile_px[1]), -(-size_px[0] // tile_px[0]), 1
    wall = np.tile(tile, times)[: size_px[1], : size_px[0]]
    text = COLOURS.get(name, "#ffffff")
    colour = np.array([int(text[at : at + 2], 16) for at in (1, 3, 5)]) / 255.0
    linear = (wall / 255.0) ** 2.2 * colour**2.2
    return np.asarray(np.rint(255.0 * linear ** (1 / 2.2)), np.uint8)


if __name__ == "__main__":
    main()
