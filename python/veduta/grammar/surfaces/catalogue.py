"""The built-in textures by name: `builtin/textures/ashlar`, each with its size in metres."""

from __future__ import annotations

import difflib
import hashlib
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from veduta.grammar.surfaces import brick, coats, ground, roofing, stone, wood
from veduta.grammar.surfaces.canvas import Canvas, Image
from veduta.run.errors import InputError

PREFIX = "builtin/textures/"


@dataclass(frozen=True)
class Surface:
    """How a texture is made, and the metres that it covers to the right and up."""

    paint: Callable[[Canvas], Image]
    size_m: tuple[float, float]

    @property
    def told(self) -> str:
        """One line about it."""
        return (self.paint.__doc__ or "").split("\n", maxsplit=1)[0].rstrip(".")


SURFACES: dict[str, Surface] = {
    "ashlar": Surface(stone.ashlar, (2.88, 2.88)),
    "rusticated": Surface(stone.rusticated, (3.2, 3.22)),
    "stone": Surface(stone.smooth, (1.6, 1.6)),
    "brick": Surface(brick.stretcher, (2.25, 2.25)),
    "brick-flemish": Surface(brick.flemish, (2.3625, 2.25)),
    "brick-red": Surface(brick.red, (2.3625, 2.25)),
    "brick-yellow": Surface(brick.yellow, (2.3625, 2.25)),
    "brick-brown": Surface(brick.brown, (2.25, 2.25)),
    "plaster": Surface(coats.plaster, (3.0, 3.0)),
    "roughcast": Surface(coats.roughcast, (2.0, 2.0)),
    "concrete": Surface(coats.concrete, (2.4, 2.4)),
    "concrete-panels": Surface(coats.panels, (4.8, 5.6)),
    "slate": Surface(roofing.slate, (2.64, 2.7)),
    "clay-tile": Surface(roofing.clay_tile, (2.55, 2.4)),
    "pantile": Surface(roofing.pantile, (2.64, 2.97)),
    "concrete-tile": Surface(roofing.concrete_tile, (3.0, 3.1)),
    "zinc": Surface(roofing.zinc, (3.0, 4.0)),
    "gravel": Surface(roofing.gravel, (1.6, 1.6)),
    "felt": Surface(roofing.felt, (3.0, 3.0)),
    "siding": Surface(wood.siding, (2.4, 2.4)),
    "boards": Surface(wood.boards, (2.24, 2.24)),
    "shingles": Surface(wood.shingles, (1.96, 1.96)),
    "wood": Surface(wood.planed, (1.2, 1.2)),
    "cobbles": Surface(ground.cobbles, (2.13, 2.13)),
    "paving": Surface(ground.paving, (2.4, 2.4)),
    "asphalt": Surface(ground.asphalt, (2.0, 2.0)),
}


def texture_names() -> list[str]:
    """All names, as rule files have them."""
    return [PREFIX + name for name in SURFACES]


def size_m(name: str) -> tuple[float, float]:
    """The metres that a texture covers to the right and up; InputError for none of them."""
    return _surface(name).size_m


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
