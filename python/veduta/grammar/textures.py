"""The pictures that rule files name in `texture`: where they are, and what is in them.

A name that begins with `builtin/textures/` is a texture that Veduta brings along (`surfaces`).
Others are files, looked for in the folders of the rule file's project (`project`). A file may have
a mask beside it, `NAME.invented.png`, in which white says what nobody has photographed. Pictures of
assets are among them under names of their own (`assets/pictures.py`).
"""

from __future__ import annotations

import re
from collections import OrderedDict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from threading import Lock

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pydantic import JsonValue

from veduta.grammar.picture_sources import source_of
from veduta.grammar.project import SearchPath
from veduta.grammar.surfaces.catalogue import PREFIX, mean_colour, sizes_m
from veduta.grammar.surfaces.patterns import PREFIX as PATTERN
from veduta.grammar.surfaces.patterns import pattern_of
from veduta.imaging.encode import jpeg_bytes, png_bytes
from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.place.material import Colour, Texture
from veduta.run.errors import InputError
from veduta.run.names import real_path

MAX_TEXTURES = 256
MAX_KEPT = 2**28
"""Bytes of the pictures that a process keeps, if they are several."""
JPEG_QUALITY = 85
Tint = tuple[int, int, int]
WHITE: Tint = (255, 255, 255)
_SAMPLES = 512
"""Rows and columns that a mean colour is taken of."""
_NAMED = re.compile(
    rf'"({PREFIX}[^"\n\0]{{1,100}}|{PATTERN}\w{{1,40}}|'
    r'[^"\n\0]{1,400}\.(?:jpe?g|png|webp|tiff?|bmp|tga))"',
    re.IGNORECASE,
)

_PICTURE = re.compile(r"\.(?:jpe?g|png|webp|tiff?|bmp|tga)$", re.IGNORECASE)
_SHOWN = re.compile(
    r'//[^\n]*|#[^\n]*|/\*.*?\*/|\btexture\s*\(\s*"(?P<name>[^"\n]*)"\s*\)|"[^"\n]*"', re.DOTALL
)
"""Comments, other strings, and `texture` with a name that is not computed."""
_KEPT: OrderedDict[tuple[str, int, int], Texture] = OrderedDict()
_LOCK = Lock()


class Textures(Mapping[str, Texture]):
    """The pictures by the names that rules have for them, read or painted when they are asked for.

    All built-in ones are among them, whether rules write their names or compute them. Asking raises
    InputError where a file cannot be read.
    """

    def __init__(self, files: Mapping[str, str]) -> None:
        self._files = dict(files)

    def add(self, files: Mapping[str, str]) -> None:
        """Make more of them known."""
        self._files |= files

    def __getitem__(self, name: str) -> Texture:
        path = name if is_known(name) else self._files[name]
        return _read(path, *source_of(path).changed())

    def __contains__(self, name: object) -> bool:
        return name in self._files or (isinstance(name, str) and is_known(name))

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)


def is_builtin(name: str) -> bool:
    """Whether a texture is one that Veduta brings along."""
    return name.startswith(PREFIX)


def is_known(name: str) -> bool:
    """Whether there is a built-in texture of this name."""
    return name in sizes_m()


def find_textures(
    rules: Path,
    texts: Sequence[str],
    search: SearchPath | None = None,
    listed: Iterable[str] = (),
) -> dict[str, str]:
    """The pictures that the texts name, by those names: files, or the names of built-in ones.

    search: where they are looked for; below the folder of the rule file where it is None. listed:
    names that the rules may compute from the files of the project; those that are pictures count.

    A file that is not there is not among them; InputError for a built-in one that is not there.
    """
    places = search or SearchPath.of(rules.parent)
    found: dict[str, str] = {}
    computed = [name for name in listed if _PICTURE.search(name)][:MAX_TEXTURES]
    for name in dict.fromkeys([*_named(texts), *computed]):
        if is_builtin(name):
            mean_colour(name)
            found[name] = name
        elif pattern_of(name) is not None:
            found[name] = name
        elif (path := places.find(name)) is not None:
            found[name] = str(real_path(path))
        if len(found) > MAX_TEXTURES:
            raise InputError(rules, f"names more than {MAX_TEXTURES} pictures", "Use fewer.")
    return found


def _named(texts: Iterable[str]) -> Iterable[str]:
    """What the texts name as pictures, each once."""
    return dict.fromkeys(name for text in texts for name in _NAMED.findall(text))


def with_builtin(files: Mapping[str, str]) -> dict[str, str]:
    """The pictures of `find_textures`, and all built-in ones: rules may compute their names."""
    return {name: name for name in sizes_m()} | dict(files)


def texture_faults(texts: Iterable[str]) -> list[str]:
    """What is wrong with the built-in textures that the texts name."""
    told = []
    for name in _named(texts):
        try:
            _ = is_builtin(name) and mean_colour(name)
        except InputError as error:
            told.append(str(error))
    return told


def missing_textures(
    rules: Path, files: Iterable[tuple[str, str]], search: SearchPath | None = None
) -> list[str]:
    """Where the files, by name and text, write `texture` with a picture that is not there."""
    files = list(files)
    found = find_textures(rules, [text for _, text in files], search)
    told = []
    for file, text in files:
        for match in _SHOWN.finditer(text):
            name = match["name"]
            if name and not is_builtin(name) and name not in found:
                line = text.count("\n", 0, match.start()) + 1
                why = f"no picture `{name}` lies where {rules.name} or its project has pictures"
                told.append(f"{file}:{line}: {why}")
    return told


def textures_digests(files: Mapping[str, str]) -> dict[str, JsonValue]:
    """What the pictures and their masks are: a result of others is not taken for theirs."""
    return {name: [*source_of(path).digests()] for name, path in files.items()}


def read_textures(files: Mapping[str, str]) -> Textures:
    """The pictures of `find_textures`; InputError where a file cannot be read."""
    textures = Textures(files)
    for name, path in files.items():
        # Those of assets are read when an asset is: a faulty one is no fault of the rules.
        if source_of(path).is_given:
            _ = textures[name]
    return textures


def is_cut(path: str) -> bool:
    """Whether one sees through a picture somewhere: only those of assets may be so."""
    return source_of(path).may_be_cut and Textures({path: path})[path].cut


def as_file(path: str, most_px: int | None = None, tint: Tint = WHITE) -> bytes:
    """A picture as JPEG, made smaller where a side has more than `most_px`; as PNG with alpha where
    one sees through it.

    tint: what its sRGB values are multiplied by, of 255. InputError where it cannot be read.
    """
    texture = Textures({path: path})[path]
    image = Image.fromarray(texture.pixels)
    if texture.cut:
        image.putalpha(Image.fromarray(np.where(texture.invented, 0, 255).astype(np.uint8)))
    if most_px is not None:
        image.thumbnail((most_px, most_px), Image.Resampling.LANCZOS)
    if tint != WHITE:
        factor = np.array([*tint, 255][: len(image.getbands())]) / 255.0
        seen = np.asarray(image) * factor
        image = Image.fromarray(np.round(seen).astype(np.uint8))
    if texture.cut:
        return png_bytes(image, optimize=True)
    return jpeg_bytes(image, JPEG_QUALITY, optimize=True)


def mean_of(path: str) -> Colour:
    """The mean colour (sRGB, 0..1) of a picture of `find_textures`: what it is from afar."""
    if is_builtin(path):
        return mean_colour(path)
    return _mean_read(path, *source_of(path).changed())


def mean_light(pixels: NDArray[np.uint8]) -> Colour:
    """The sRGB colour of the mean light of (h, w, 3) sRGB pixels (IEC 61966-2-1)."""
    rows, columns = (-(-size // _SAMPLES) for size in pixels.shape[:2])
    some = pixels[::rows, ::columns].reshape(-1, 3) / 255.0
    light = linear_of_srgb(some).mean(axis=0)
    told = srgb_of_linear(light)
    red, green, blue = told.tolist()
    return red, green, blue


@lru_cache(maxsize=MAX_TEXTURES)
def _mean_read(path: str, written: int, mask_written: int) -> Colour:
    """Taken once in each process, unless the picture changes."""
    return mean_light(_read(path, written, mask_written).pixels)


def _read(path: str, written: int, mask_written: int) -> Texture:
    """Read once in each process, unless it changes, or many others are read after it.

    The last one is kept however large it is, others while all take no more than MAX_KEPT.
    """
    key = (path, written, mask_written)
    with _LOCK:
        known = _KEPT.get(key)
        if known is not None:
            _KEPT.move_to_end(key)
            return known
    texture = source_of(path).read()
    with _LOCK:
        _KEPT[key] = texture
        while len(_KEPT) > 1 and sum(map(_bytes_of, _KEPT.values())) > MAX_KEPT:
            _KEPT.popitem(last=False)
    return texture


def _bytes_of(texture: Texture) -> int:
    return texture.pixels.nbytes + texture.invented.nbytes
