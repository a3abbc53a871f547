"""The pictures of what is seen around a house: as they are given, and as they lie beside plan.json.

AV3D, Surrounding Environment Creation: one picture that is wrapped around the house, or four, of
the north, east, south and west. They are kept in OUT, so that a rebuild has them.
"""

from __future__ import annotations

import hashlib
import io
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from veduta.imaging.encode import jpeg_bytes
from veduta.imaging.read import read_image
from veduta.plan.document import Panorama
from veduta.run.errors import InputError

Pixels = NDArray[np.uint8]
DIRECTIONS = {"N": "north", "E": "east", "S": "south", "W": "west"}
FILES: dict[Panorama, tuple[str, ...]] = {
    "round": ("panorama.jpg",),
    "directions": tuple(f"panorama-{name}.jpg" for name in DIRECTIONS.values()),
}
"""Their names in OUT; directions in the order of `DIRECTIONS`."""
MOST_PX: dict[Panorama, int] = {"round": 8192, "directions": 2048}
"""A side that is longer is made smaller: no graphics card takes more."""
LEAST_PX = 64
LEAST_ASPECT = 1.9
"""A picture that shows all around is wider than this; spherical ones are twice as wide as high."""
_NARROW = 16.0
JPEG_QUALITY = 92
_FOUR = "N=a.jpg,E=b.jpg,S=c.jpg,W=d.jpg"
_PART = re.compile(r",(?=[NESW]=)")


@dataclass(frozen=True, eq=False)
class Pictures:
    """kind: what the document calls them. contents: JPEG files in the order of `FILES`.

    pixels: what they hold, (h, w, 3) each.
    """

    kind: Panorama
    contents: tuple[bytes, ...]
    pixels: tuple[Pixels, ...]

    @property
    def digest(self) -> str:
        """Of all that they hold."""
        return hashlib.sha256(b"".join([self.kind.encode(), *self.contents])).hexdigest()

    @property
    def files(self) -> dict[str, bytes]:
        """The contents by their names in OUT."""
        return dict(zip(FILES[self.kind], self.contents, strict=True))


def given_pictures(text: str) -> Pictures:
    """Those that the option names; InputError where one is missing, broken, or no panorama."""
    paths = _paths(text)
    kind: Panorama = "round" if len(paths) == 1 else "directions"
    contents = tuple(_as_kept(path, kind) for path in paths)
    return Pictures(kind, contents, tuple(_decoded(content) for content in contents))


def kept_pictures(kind: Panorama, folder: Path) -> Pictures:
    """Those beside a document that names them; InputError where one is missing or broken."""
    contents, pixels = [], []
    for name in FILES[kind]:
        path = folder / name
        if not path.is_file():
            raise InputError(
                path,
                f"is missing, and {folder / 'plan.json'} has panorama: {kind!r}",
                "Put it there, give --panorama again, or write null for panorama.",
            )
        seen = read_image(path).pixels
        _check_size(path, seen.shape[:2], seen.shape[:2])
        if kind == "round":
            # A picture that was made smaller is so to a pixel.
            _check_aspect(path, seen.shape[:2], slack_px=1)
        pixels.append(seen)
        contents.append(path.read_bytes())
    return Pictures(kind, tuple(contents), tuple(pixels))


def _paths(text: str) -> list[Path]:
    """One path, or those of the four directions in the order of `DIRECTIONS`."""
    if re.match(r"[NESW]=", text) is None:
        return [Path(text)]
    parts = [part.partition("=") for part in _PART.split(text)]
    named = {name: Path(path) for name, _, path in parts if path}
    if len(named) < len(DIRECTIONS) or len(parts) > len(DIRECTIONS):
        raise InputError("--panorama", f"{text!r} names not each direction once", f"Write {_FOUR}.")
    return [named[name] for name in DIRECTIONS]


def _as_kept(path: Path, kind: Panorama) -> bytes:
    pixels = read_image(path).pixels
    image = Image.fromarray(pixels)
    image.thumbnail((MOST_PX[kind], MOST_PX[kind]), Image.Resampling.LANCZOS)
    # As it is kept it is read again by each rebuild.
    _check_size(path, pixels.shape[:2], (image.height, image.width))
    if kind == "round":
        _check_aspect(path, pixels.shape[:2])
    return jpeg_bytes(image, JPEG_QUALITY, optimize=True)


def _check_size(path: Path, given: tuple[int, ...], kept: tuple[int, ...]) -> None:
    """InputError where a picture is too small as it is kept. given, kept: height and width."""
    if min(kept) >= LEAST_PX:
        return
    size = f"is {_size(given)}"
    if kept != given:
        size += f", and {_size(kept)} at the size at which it is used"
    raise InputError(path, f"{size}: too small to be seen", f"Give one of {LEAST_PX} px or more.")


def _check_aspect(path: Path, shape: tuple[int, ...], slack_px: int = 0) -> None:
    """InputError where a picture does not show all around. slack_px: of its height."""
    height, width = shape
    if width < LEAST_ASPECT * (height - slack_px):
        raise InputError(
            path,
            f"is {_size(shape)}: it does not show all around,"
            " being less than twice as wide as high",
            f"Give a panorama of 360 degrees, or four pictures: {_FOUR}.",
        )
    if width > _NARROW * (height + slack_px):
        raise InputError(
            path,
            f"is {_size(shape)}: so flat a strip shows no sky",
            f"Give a panorama that is at most {_NARROW:g} times as wide as high.",
        )


def _size(shape: tuple[int, ...]) -> str:
    height, width = shape
    return f"{width} x {height} px"


def _decoded(content: bytes) -> Pixels:
    with Image.open(io.BytesIO(content)) as image:
        return np.asarray(image.convert("RGB"), dtype=np.uint8)
