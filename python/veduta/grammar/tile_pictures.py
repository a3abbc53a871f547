"""The pictures of rule files as tiles have them: stored once for all tiles of a place."""

from __future__ import annotations

import hashlib
import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image

from veduta.grammar.surfaces.catalogue import mean_colour as known_mean
from veduta.grammar.surfaces.catalogue import sizes_m
from veduta.place.material import Colour, Texture

FOLDER = "textures"
MAX_SIDE = 1024
"""Of a stored picture (px): what a graphics card holds of many."""
JPEG_QUALITY = 88
_SAMPLES = 512
"""Rows and columns that the mean colour is taken of."""


@dataclass(frozen=True)
class TilePicture:
    """A picture: its name in the rules, its file in OUT, and its mean colour (sRGB, 0 to 1).

    The mean is that of the light, which is what the picture looks like from afar.
    """

    name: str
    file: str
    mean: Colour

    @property
    def named(self) -> tuple[str, Colour]:
        """What the engine wants to know."""
        return self.name, self.mean


def tile_pictures(textures: Mapping[str, Texture]) -> list[TilePicture]:
    """The pictures by the names that rules have for them; files depend on the name alone.

    Of those that Veduta brings along the mean is known: they are not painted for it.
    """
    return [
        TilePicture(
            name,
            _file(name),
            known_mean(name) if name in sizes_m() else mean_colour(textures[name]),
        )
        for name in textures
    ]


def picture_files(textures: Mapping[str, Texture], names: Sequence[str]) -> dict[str, bytes]:
    """The files of these pictures, JPEG, by their paths in OUT."""
    return {_file(name): _encoded(textures[name]) for name in names}


def mean_colour(texture: Texture) -> Colour:
    """The sRGB colour of the mean light of a picture (IEC 61966-2-1)."""
    rows, columns = (-(-size // _SAMPLES) for size in texture.pixels.shape[:2])
    some = texture.pixels[::rows, ::columns].reshape(-1, 3) / 255.0
    light = np.where(some <= 0.04045, some / 12.92, ((some + 0.055) / 1.055) ** 2.4).mean(axis=0)
    told = np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1 / 2.4) - 0.055)
    red, green, blue = told.tolist()
    return (red, green, blue)


def _file(name: str) -> str:
    """A path that other names do not have, on any system."""
    stem = re.sub(r"[^A-Za-z0-9]+", "-", name.rpartition("/")[2].partition(".")[0]).strip("-")
    return f"{FOLDER}/{stem[:40] or 'picture'}-{hashlib.sha256(name.encode()).hexdigest()[:8]}.jpg"


def _encoded(texture: Texture) -> bytes:
    image = Image.fromarray(texture.pixels)
    image.thumbnail((MAX_SIDE, MAX_SIDE), Image.Resampling.LANCZOS)
    memory = io.BytesIO()
    image.save(memory, "JPEG", quality=JPEG_QUALITY, optimize=True)
    return memory.getvalue()
