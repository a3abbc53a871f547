"""Where the pixels of a picture come from: a file, an asset's file, or what Veduta paints.

A source is told by one text, as calls hand it to other processes: the path of a file, `asset:` and
the picture as `formats.model_pictures` names it, or the name of a built-in texture.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from veduta.formats.model_pictures import file_of, read_picture
from veduta.grammar.surfaces.catalogue import PREFIX, painted, sources_digest
from veduta.grammar.surfaces.patterns import PATTERNS, pattern_of
from veduta.imaging.read import read_image
from veduta.place.material import Texture
from veduta.run.digests import file_digest
from veduta.run.errors import InputError

MAX_PIXELS = 2**26
"""Of one picture: 67 megapixels."""
_OF_ASSET = "asset:"


class Source(Protocol):
    """One picture."""

    @property
    def is_given(self) -> bool:
        """Whether it is the rule file's own, which has to be sound."""

    @property
    def may_be_cut(self) -> bool:
        """Whether one may see through it somewhere."""

    def changed(self) -> tuple[int, int]:
        """When it and its mask were last written (ns); 0 where there is none."""

    def digests(self) -> list[str]:
        """What is in it: a result of another is not taken for its."""

    def read(self) -> Texture:
        """Its pixels; InputError where they cannot be read."""


def source_of(told: str) -> Source:
    """The source that a text tells."""
    if told.startswith(_OF_ASSET):
        return _OfAsset(told.removeprefix(_OF_ASSET))
    return _Painted(told) if is_painted(told) else _File(Path(told))


def as_texture(picture: str) -> str:
    """The text of a picture of an asset, as `formats.model_pictures` names it."""
    return f"{_OF_ASSET}{picture}"


def is_painted(name: str) -> bool:
    """Whether a texture is no file: built-in, or a test picture."""
    return name.startswith(PREFIX) or pattern_of(name) is not None


def mask_name(name: str) -> str:
    """The name of the mask beside a picture."""
    return f"{Path(name).stem}.invented.png"


@dataclass(frozen=True)
class _Painted:
    name: str
    is_given: bool = False
    may_be_cut: bool = False

    def changed(self) -> tuple[int, int]:
        return 0, 0

    def digests(self) -> list[str]:
        return [sources_digest()]

    def read(self) -> Texture:
        """Nobody has photographed it."""
        pattern = pattern_of(self.name)
        pixels = painted(self.name) if pattern is None else PATTERNS[pattern]()
        return Texture(pixels=pixels, invented=np.ones(pixels.shape[:2], dtype=np.bool_))


@dataclass(frozen=True)
class _OfAsset:
    """Its alpha is what one sees through."""

    picture: str
    is_given: bool = False
    may_be_cut: bool = True

    @property
    def _path(self) -> Path:
        return file_of(self.picture)[0]

    def changed(self) -> tuple[int, int]:
        return os.stat(self._path).st_mtime_ns, 0

    def digests(self) -> list[str]:
        return [file_digest(self._path)]

    def read(self) -> Texture:
        return read_picture(self.picture)


@dataclass(frozen=True)
class _File:
    path: Path
    is_given: bool = True
    may_be_cut: bool = False

    @property
    def _mask(self) -> Path:
        return self.path.with_name(mask_name(str(self.path)))

    def changed(self) -> tuple[int, int]:
        mask = self._mask
        return os.stat(self.path).st_mtime_ns, mask.stat().st_mtime_ns if mask.is_file() else 0

    def digests(self) -> list[str]:
        return [file_digest(each) for each in (self.path, self._mask) if each.is_file()]

    def read(self) -> Texture:
        """The mask says what nobody has photographed."""
        pixels = read_image(self.path).pixels
        height, width = pixels.shape[:2]
        if height * width > MAX_PIXELS:
            raise InputError(self.path, f"is {width} x {height} pixels large", "Make it smaller.")
        invented = np.zeros((height, width), dtype=np.bool_)
        mask = self._mask
        if mask.is_file():
            white = read_image(mask).pixels[:, :, 0] > 127
            if white.shape != invented.shape:
                raise InputError(mask, f"is not as large as {self.path.name}", "Make it as large.")
            invented = white
        return Texture(pixels=pixels, invented=invented)
