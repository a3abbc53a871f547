"""The materials of a layout: a texture, its size in metres, how much of it mirrors."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic import panes, textures
from veduta.synthetic.layout import Layout, Opening
from veduta.synthetic.panes import Interior, WindowLook
from veduta.synthetic.seeds import stream

WINDOW_VARIANTS = 8


@dataclass(frozen=True)
class Look:
    """A material: sRGB `texture` (h, w, 3) uint8, `mirror` (h, w) uint8 or None for matt.

    `tile_m` is the size (right, up) of one repeat.
    """

    texture: NDArray[np.uint8]
    mirror: NDArray[np.uint8] | None = None
    tile_m: tuple[float, float] = (1.0, 1.0)


def make_looks(layout: Layout, seed: int) -> dict[str, Look]:
    """All materials that the builder refers to, by name."""
    paint = layout.paint
    rng = stream(seed, "looks")
    looks = {
        "wall": Look(_wall(layout, seed)),
        "trim": Look(textures.plain(rng, paint.trim, 0.03)),
        "side": Look(textures.render_coat(rng, 6.0, 6.0, (0.62, 0.58, 0.52)), None, (6.0, 6.0)),
        "iron": Look(textures.plain(rng, paint.iron)),
        "lead": Look(textures.plain(rng, (0.42, 0.44, 0.47), 0.05)),
        "stack": Look(
            textures.brick(rng, 2.25, 2.25, (0.60, 0.36, 0.27), paint.mortar), None, (2.25, 2.25)
        ),
        "pot": Look(textures.plain(rng, (0.68, 0.38, 0.24), 0.08)),
        "roof": _roof(layout, seed),
        "shutter": _glazed(panes.shutter(rng, 0.55, 1.7, paint.shutter)),
    }
    looks |= _windows(layout, seed)
    for number, opening in enumerate(layout.openings):
        if opening.class_ == "door":
            image = panes.door(
                rng, opening.rect.width_m, opening.rect.height_m, paint.door, opening.fanlight_m
            )
            looks[f"door {number}"] = _glazed(image)
        elif opening.class_ == "shop":
            image = panes.shop_front(
                rng, opening.rect.width_m, opening.rect.height_m, paint.shop, paint.sign
            )
            looks[f"shop {number}"] = _glazed(image)
    return looks


def opening_material(number: int, opening: Opening, seed: int) -> str:
    """The name of the material that fills an opening."""
    if opening.class_ == "window":
        return f"window {int(stream(seed, f'pane {number}').integers(WINDOW_VARIANTS))}"
    return f"{opening.class_} {number}"


def _glazed(image: panes.Glazed) -> Look:
    return Look(np.ascontiguousarray(image[..., :3]), np.ascontiguousarray(image[..., 3]))


def _windows(layout: Layout, seed: int) -> dict[str, Look]:
    rng = stream(seed, "windows")
    sizes = [o.rect for o in layout.openings if o.class_ == "window"]
    width = float(np.median([r.width_m for r in sizes])) if sizes else 1.2
    height = float(np.median([r.height_m for r in sizes])) if sizes else 1.8
    base = layout.paint.window
    choices: list[Interior] = [base.interior, base.interior, "dark", "drapes", "sheer"]
    looks = {}
    for variant in range(WINDOW_VARIANTS):
        interior = choices[int(rng.integers(len(choices)))]
        shade = rng.uniform(0.8, 1.05) + 0.02 * rng.standard_normal(3)
        fabric = tuple(np.clip(np.asarray(base.fabric) * shade, 0, 1).tolist())
        look: WindowLook = replace(base, interior=interior, fabric=fabric)
        looks[f"window {variant}"] = _glazed(panes.window(rng, width, height, look))
    return looks


def _wall(layout: Layout, seed: int) -> NDArray[np.uint8]:
    rng = stream(seed, "wall")
    paint, size = layout.paint, (layout.width_m, layout.height_m)
    if paint.wall == "ashlar":
        image = textures.ashlar(rng, *size, paint.wall_colour)
    elif paint.wall == "brick":
        image = textures.brick(rng, *size, paint.wall_colour, paint.mortar)
    elif paint.wall == "panels":
        image = textures.panels(rng, *size, paint.wall_colour, paint.panel_m)
    else:
        image = textures.render_coat(rng, *size, paint.wall_colour)
    drips = [
        (o.rect.x_m - 0.05, o.rect.right_m + 0.05, o.rect.y_m)
        for o in layout.openings
        if o.rect.y_m > 0.3
    ]
    return textures.weather(rng, image, size, drips)


def _roof(layout: Layout, seed: int) -> Look:
    rng = stream(seed, "roof")
    cover, colour = layout.roof.cover, layout.paint.roof
    if cover == "zinc":
        return Look(textures.zinc(rng), None, (2.4, 2.4))
    if cover == "slate":
        return Look(textures.slate(rng, colour), None, (2.0, 1.92))
    if cover == "tiles":
        return Look(textures.pantiles(rng, colour), None, (2.2, 2.31))
    return Look(textures.plain(rng, colour, 0.08))
