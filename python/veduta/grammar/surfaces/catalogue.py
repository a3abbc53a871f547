"""The built-in textures by name: `builtin/textures/ashlar`, each with its size in metres."""

from __future__ import annotations

import difflib
import hashlib
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from veduta.grammar.surfaces import brick, coats, glass, ground, roofing, stone, wood
from veduta.grammar.surfaces.canvas import Canvas, Image
from veduta.place.material import Colour
from veduta.run.errors import InputError

PREFIX = "builtin/textures/"


@dataclass(frozen=True)
class Surface:
    """How a texture is made, the metres that it covers to the right and up, its mean (sRGB).

    The mean is that of the light, which is what the texture looks like from afar.
    """

    paint: Callable[[Canvas], Image]
    size_m: tuple[float, float]
    mean: Colour

    @property
    def told(self) -> str:
        """One line about it."""
        return (self.paint.__doc__ or "").split("\n", maxsplit=1)[0].rstrip(".")


SURFACES: dict[str, Surface] = {
    "ashlar": Surface(stone.ashlar, (2.88, 2.88), (0.91, 0.91, 0.90)),
    "rusticated": Surface(stone.rusticated, (3.2, 3.22), (0.90, 0.89, 0.89)),
    "stone": Surface(stone.smooth, (1.6, 1.6), (0.94, 0.93, 0.92)),
    "brick": Surface(brick.stretcher, (2.25, 2.25), (0.87, 0.87, 0.87)),
    "brick-flemish": Surface(brick.flemish, (2.3625, 2.25), (0.87, 0.87, 0.87)),
    "brick-red": Surface(brick.red, (2.3625, 2.25), (0.62, 0.39, 0.33)),
    "brick-yellow": Surface(brick.yellow, (2.3625, 2.25), (0.72, 0.64, 0.49)),
    "brick-brown": Surface(brick.brown, (2.25, 2.25), (0.46, 0.38, 0.34)),
    "plaster": Surface(coats.plaster, (3.0, 3.0), (0.93, 0.93, 0.93)),
    "roughcast": Surface(coats.roughcast, (2.0, 2.0), (0.90, 0.90, 0.89)),
    "concrete": Surface(coats.concrete, (3.0, 3.0), (0.92, 0.92, 0.91)),
    "concrete-boards": Surface(coats.boarded, (2.4, 2.4), (0.89, 0.89, 0.88)),
    "concrete-panels": Surface(coats.panels, (4.8, 5.6), (0.90, 0.91, 0.91)),
    "slate": Surface(roofing.slate, (2.64, 2.7), (0.85, 0.86, 0.86)),
    "clay-tile": Surface(roofing.clay_tile, (2.55, 2.4), (0.86, 0.86, 0.85)),
    "pantile": Surface(roofing.pantile, (2.64, 2.97), (0.83, 0.82, 0.81)),
    "concrete-tile": Surface(roofing.concrete_tile, (3.0, 3.1), (0.84, 0.84, 0.84)),
    "zinc": Surface(roofing.zinc, (3.0, 4.0), (0.88, 0.89, 0.90)),
    "gravel": Surface(roofing.gravel, (1.6, 1.6), (0.83, 0.83, 0.83)),
    "felt": Surface(roofing.felt, (3.0, 3.0), (0.86, 0.86, 0.86)),
    "siding": Surface(wood.siding, (2.4, 2.4), (0.93, 0.93, 0.92)),
    "boards": Surface(wood.boards, (2.24, 2.24), (0.89, 0.88, 0.86)),
    "shingles": Surface(wood.shingles, (1.96, 1.96), (0.85, 0.85, 0.83)),
    "wood": Surface(wood.planed, (1.2, 1.2), (0.93, 0.92, 0.92)),
    "glass": Surface(glass.window, (2.4, 2.7), (0.61, 0.66, 0.71)),
    "cobbles": Surface(ground.cobbles, (2.13, 2.13), (0.77, 0.77, 0.77)),
    "paving": Surface(ground.paving, (2.4, 2.4), (0.88, 0.87, 0.86)),
    "lawn": Surface(ground.lawn, (2.0, 2.0), (0.84, 0.85, 0.83)),
    "asphalt": Surface(ground.asphalt, (2.0, 2.0), (0.81, 0.81, 0.81)),
}


def texture_names() -> list[str]:
    """All names, as rule files have them."""
    return [PREFIX + name for name in SURFACES]


def sizes_m() -> dict[str, tuple[float, float]]:
    """The metres that each texture covers to the right and up, by the names of rule files."""
    return {PREFIX + name: surface.size_m for name, surface in SURFACES.items()}


def mean_colour(name: str) -> Colour:
    """The mean (sRGB, 0..1) of a texture, without painting it; InputError for none of them."""
    return _surface(name).mean


@lru_cache(maxsize=len(SURFACES))
def painted(name: str) -> Image:
    """(h, w, 3) sRGB of a built-in texture; InputError for none of them."""
    surface = _surface(name)
    image = surface.paint(Canvas(surface.size_m, zlib.crc32(name.encode())))
    image.setflags(write=False)
    return image


@lru_cache(maxsize=1)
def sources_digest() -> str:
    """The digest of what paints the textures: a result of others is not taken for theirs."""
    total = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        total.update(path.read_bytes())
    return total.hexdigest()


def _surface(name: str) -> Surface:
    found = SURFACES.get(name.removeprefix(PREFIX))
    if found is not None and name.startswith(PREFIX):
        return found
    near = difflib.get_close_matches(name, texture_names(), n=1, cutoff=0.5)
    hint = f"Did you mean `{near[0]}`?" if near else "docs/textures.md lists those there are."
    raise InputError(name, "is no texture that Veduta brings along", hint)
