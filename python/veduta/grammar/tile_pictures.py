"""The pictures of rule files as tiles have them: stored once for all tiles of a place.

CityJSON knows no colour that a picture is multiplied by: there, each tint is a picture of its own.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from veduta.grammar.textures import WHITE, Tint, as_file, is_cut, mean_of
from veduta.place.material import Colour

FOLDER = "textures"
MAX_SIDE = 1024
"""Of a stored picture (px): what a graphics card holds of many."""


@dataclass(frozen=True)
class TilePicture:
    """A picture: its name in the rules, its file in OUT, and its mean colour (sRGB, 0 to 1).

    The mean is what the picture looks like from afar. cut: whether one sees through it somewhere.
    """

    name: str
    file: str
    mean: Colour
    cut: bool = False

    @property
    def named(self) -> tuple[str, Colour]:
        """What the engine wants to know."""
        return self.name, self.mean


def tile_pictures(textures: Mapping[str, str]) -> list[TilePicture]:
    """The pictures of a call; the paths of their files depend on their names, and on whether one
    sees through them.
    """
    return [
        TilePicture(name, picture_file(name, cut=cut), mean_of(path), cut)
        for name, path in textures.items()
        for cut in [is_cut(path)]
    ]


def picture_files(
    textures: Mapping[str, str], shown: Iterable[tuple[str, Tint]]
) -> dict[str, bytes]:
    """The files of these pictures in these tints, JPEG or PNG, by their paths in OUT."""
    return {
        picture_file(name, tint, cut=is_cut(textures[name])): as_file(
            textures[name], MAX_SIDE, tint
        )
        for name, tint in shown
    }


def picture_file(name: str, tint: Tint = WHITE, *, cut: bool = False) -> str:
    """A path that other names and tints do not have, on any system."""
    stem = re.sub(r"[^A-Za-z0-9]+", "-", name.rpartition("/")[2].partition(".")[0]).strip("-")
    digest = hashlib.sha256(name.encode()).hexdigest()[:8]
    colour = "" if tint == WHITE else "-{:02x}{:02x}{:02x}".format(*tint)
    kind = "png" if cut else "jpg"
    return f"{FOLDER}/{stem[:40] or 'picture'}-{digest}{colour}.{kind}"
