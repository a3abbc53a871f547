"""Photo, elements, filled texture and building beside each other, with the eyes and without.

    python docs/facade_picture.py [--seed 5]

The photo is a render of `veduta.synthetic` with a tree, a lamp and a car before the front.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from pictures import save
from PIL import Image, ImageDraw, ImageFont

from veduta.facade.demo import what_the_user_knows
from veduta.facade.demo_options import DemoOptions
from veduta.facade.options import EyesOptions
from veduta.facade.overlay import overlay
from veduta.facade.pipeline import Building, reconstruct
from veduta.facade.rule_head import WALL_TEXTURE
from veduta.place.part import Part
from veduta.synthetic.camera import look_at
from veduta.synthetic.facade import SyntheticFacade, make_facade
from veduta.synthetic.light import daylight
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene

CELL_PX = 310, 420
GAP_PX, HEAD_PX = 10, 26
COLUMNS = ("photo", "elements", "filled texture", "building")
ROWS: tuple[Literal["learned", "plain"], ...] = ("learned", "plain")
Pixels = NDArray[np.uint8]


def main() -> None:
    """Render, read twice, draw."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=5)
    seed = parser.parse_args().seed
    made = make_facade(seed, SyntheticOptions(style="stucco", occluders=True, perspective="mild"))
    with tempfile.TemporaryDirectory() as folder:
        photo = Path(folder) / "street.jpg"
        photo.write_bytes(made.jpeg)
        rows = [cells_of(photo, made, eyes) for eyes in ROWS]
    save(sheet(rows), "facade-halves.jpg")


def cells_of(photo: Path, made: SyntheticFacade, eyes: Literal["learned", "plain"]) -> list[Pixels]:
    """The four pictures of one way to read the photo."""
    known = what_the_user_knows(made, DemoOptions())
    options = known.model_copy(update={"eyes": EyesOptions(eyes=eyes)})
    building = reconstruct(photo, options, "street", [])
    return [
        made.photo,
        _found(building),
        building.model.textures[WALL_TEXTURE].pixels,
        seen_from_the_street(building.part),
    ]


def _found(building: Building) -> Pixels:
    """The overlay without the legend beside it."""
    drawn = overlay(building.document, building.pixels)
    scale = drawn.shape[0] / building.pixels.shape[0]
    return np.asarray(drawn[:, : round(scale * building.pixels.shape[1])], np.uint8)


def seen_from_the_street(part: Part) -> Pixels:
    """A render of a building, obliquely from its left."""
    low, high = (np.array(corner, np.float64) for corner in part.bounds_m)
    middle = 0.5 * (low + high)
    far = 1.9 * float(max(high[0] - low[0], high[2] - low[2]))
    eye = (middle[0] - 0.55 * far, low[1] - 0.8 * far, 0.35 * high[2])
    size = 2 * CELL_PX[0], 2 * CELL_PX[1]
    camera = look_at(eye, (middle[0], low[1] + 2.0, 0.5 * high[2]), size, 2.2 * size[0])
    light = daylight(3, False, -2.2, 0.8)
    radiance = render(RayScene([(part, np.eye(4))]), camera, light, 1, 3)
    exposed = np.clip(radiance / np.percentile(radiance, 97), 0.0, 1.0)
    return np.asarray(np.rint(255.0 * exposed ** (1 / 2.2)), np.uint8)


def sheet(rows: list[list[Pixels]]) -> Image.Image:
    """A row of cells for each way to read it, under a line of names."""
    wide, high = CELL_PX
    size = len(COLUMNS) * (wide + GAP_PX) + HEAD_PX, HEAD_PX + len(rows) * (high + GAP_PX)
    made = Image.new("RGB", size, "white")
    font = ImageFont.load_default(18)
    ink = ImageDraw.Draw(made)
    for column, name in enumerate(COLUMNS):
        ink.text((HEAD_PX + column * (wide + GAP_PX), 2), name, "black", font)
    for row, cells in enumerate(rows):
        top = HEAD_PX + row * (high + GAP_PX)
        made.paste(_upright(f"--eyes {ROWS[row]}", font), (2, top))
        for column, pixels in enumerate(cells):
            image = Image.fromarray(pixels)
            image.thumbnail(CELL_PX, Image.Resampling.LANCZOS)
            made.paste(image, (HEAD_PX + column * (wide + GAP_PX), top))
    return made


def _upright(words: str, font: ImageFont.FreeTypeFont | ImageFont.ImageFont) -> Image.Image:
    strip = Image.new("RGB", (CELL_PX[1], HEAD_PX - 4), "white")
    ImageDraw.Draw(strip).text((0, 0), words, "black", font)
    return strip.rotate(90, expand=True)


if __name__ == "__main__":
    main()
