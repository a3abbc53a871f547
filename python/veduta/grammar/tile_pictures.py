"""The pictures of rule files as tiles have them: stored once for all tiles of a place."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from veduta.grammar.textures import as_jpeg, mean_of
from veduta.place.material import Colour

FOLDER = "textures"
MAX_SIDE = 1024
"""Of a stored picture (px): what a graphics card holds of many."""


@dataclass(frozen=True)
class TilePicture:
    """A picture: its name in the rules, its file in OUT, and its mean colour (sRGB, 0 to 1).

    The mean is what the picture looks like from afar.
    """

    name: str
    file: str
    mean: Colour

    @property
    def named(self) -> tuple[str, Colour]:
        """What the engine wants to know."""
        return self.name, self.mean


def tile_pictures(textures: Mapping[str, str]) -> list[TilePicture]:
    """The pictures of `find_textures`; the paths of their files depend on their names alone."""
    return [TilePicture(name, _file(name), mean_of(path)) for name, path in textures.items()]


def picture_files(textures: Mapping[str, str], names: Iterable[str]) -> dict[str, bytes]:
    """The files of these pictures, JPEG, by their paths in OUT."""
    return {_file(name): as_jpeg(textures[name], MAX_SIDE) for name in names}


def _file(name: str) -> str:
    """A path that other names do not have, on any system."""
    stem = re.sub(r"[^A-Za-z0-9]+", "-", name.rpartition("/")[2].partition(".")[0]).strip("-")
    return f"{FOLDER}/{stem[:40] or 'picture'}-{hashlib.sha256(name.encode()).hexdigest()[:8]}.jpg"
