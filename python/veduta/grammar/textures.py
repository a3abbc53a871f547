"""The pictures that rule files name in `texture`: where they are, and what is in them.

They are looked for below the folder of the rule file, and nowhere else. A picture may have a mask
beside it, `NAME.invented.png`, in which white says what nobody has photographed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

import numpy as np
from pydantic import JsonValue

from veduta.imaging.read import read_image
from veduta.place.material import Texture
from veduta.run.digests import file_digest
from veduta.run.errors import InputError

MAX_TEXTURES = 256
MAX_PIXELS = 2**26
"""Of one picture: 67 megapixels."""
_NAMED = re.compile(r'"([^"\n\0]{1,400}\.(?:jpe?g|png|webp|tiff?))"', re.IGNORECASE)


def find_textures(rules: Path, texts: Sequence[str]) -> dict[str, str]:
    """The files of the pictures that the texts name, by those names; what is not there is not."""
    folder = os.path.realpath(rules.parent)
    found: dict[str, str] = {}
    for name in dict.fromkeys(name for text in texts for name in _NAMED.findall(text)):
        path = os.path.realpath(os.path.join(folder, name))
        if os.path.isfile(path) and os.path.commonpath([folder, path]) == folder:
            found[name] = path
        if len(found) > MAX_TEXTURES:
            raise InputError(rules, f"names more than {MAX_TEXTURES} pictures", "Use fewer.")
    return found


def mask_name(name: str) -> str:
    """The name of the mask beside a picture."""
    return f"{Path(name).stem}.invented.png"


def textures_digests(files: Mapping[str, str]) -> dict[str, JsonValue]:
    """What the pictures and their masks are: a result of others is not taken for theirs."""
    told: dict[str, JsonValue] = {}
    for name, path in files.items():
        mask = Path(path).with_name(mask_name(path))
        told[name] = [file_digest(each) for each in (Path(path), mask) if each.is_file()]
    return told


def read_textures(files: Mapping[str, str]) -> dict[str, Texture]:
    """The pictures by the names that rules have for them; InputError where one cannot be read."""
    return {name: _read(path, *_changed(path)) for name, path in files.items()}


def _changed(path: str) -> tuple[int, int]:
    """When a picture and its mask were last written (ns); 0 where there is none."""
    mask = Path(path).with_name(mask_name(path))
    return os.stat(path).st_mtime_ns, mask.stat().st_mtime_ns if mask.is_file() else 0


@lru_cache(maxsize=16)
def _read(path: str, _written: int, _mask_written: int) -> Texture:
    """Read once in each process, unless it changes."""
    pixels = read_image(Path(path)).pixels
    height, width = pixels.shape[:2]
    if height * width > MAX_PIXELS:
        raise InputError(path, f"is {width} x {height} pixels large", "Make it smaller.")
    mask = Path(path).with_name(mask_name(path))
    invented = np.zeros((height, width), dtype=np.bool_)
    if mask.is_file():
        white = read_image(mask).pixels[:, :, 0] > 127
        if white.shape != invented.shape:
            raise InputError(mask, f"is not as large as {Path(path).name}", "Make it as large.")
        invented = white
    return Texture(pixels=pixels, invented=invented)
