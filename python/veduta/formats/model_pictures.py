"""The pictures that models of other programs name: where they are, and what is in them.

A picture is named by the path of its file, or as `MODEL.glb#K` where it is image K in such a file.
"""

from __future__ import annotations

import base64
import binascii
import json
import os
import re
import struct
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.read import read_picture as pixels_and_alpha
from veduta.place.material import Texture
from veduta.run.errors import InputError
from veduta.run.inputs import require_file
from veduta.run.names import real_path

MOST_BYTES = 128 * 2**20
"""Of a picture's file."""
MOST_PIXELS = 2**26
_IN_MODEL = re.compile(r"(?P<file>.+\.glb)#(?P<number>\d{1,6})", re.IGNORECASE | re.DOTALL)
_ABSOLUTE = re.compile(r"/|[A-Za-z]:|file:", re.IGNORECASE)
_OPAQUE = 128
"""Of 255: what is less opaque is seen through."""
_REMEDY = "Save the picture as PNG or JPEG, or export the model again."
_HEAD = struct.Struct("<4sIII4s")
_WEBP, _GLOSSY = "EXT_texture_webp", "KHR_materials_pbrSpecularGlossiness"


def file_of(where: str) -> tuple[Path, int | None]:
    """The file of a picture, and its number in it where that is a model."""
    named = _IN_MODEL.fullmatch(where)
    return (Path(named["file"]), int(named["number"])) if named else (Path(where), None)


def beside(name: str, folder: Path, root: Path) -> Path | None:
    """The picture that a model in `folder` names; None where none lies below `root`.

    A path of the machine that the model comes from is looked for by its last name alone.
    """
    plain = name.replace("\\", "/")
    last = plain.rpartition("/")[2]
    tried = [last] if _ABSOLUTE.match(plain) else [plain, last]
    if not last or "\0" in plain or len(plain) > 1_000:
        return None
    inside = str(real_path(root))
    for one in tried:
        real = str(real_path(folder / one))
        if os.path.isfile(real) and os.path.commonpath([inside, real]) == inside:
            return Path(real)
    return None


def colour_texture(material: dict[str, Any]) -> dict[str, Any] | None:
    """What a material of glTF says of its picture of colours; None where it has none."""
    glossy = material.get("extensions", {}).get(_GLOSSY, {})
    told = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
    found = told if told is not None else glossy.get("diffuseTexture")
    return found if isinstance(found, dict) else None


def image_number(root: dict[str, Any], material: dict[str, Any]) -> int | None:
    """The number of a material's image in a document of glTF; None where it has none."""
    told = colour_texture(material)
    if told is None:
        return None
    texture = root["textures"][told["index"]]
    webp = texture.get("extensions", {}).get(_WEBP, {})
    number = webp.get("source", texture.get("source"))
    known = isinstance(number, int) and 0 <= number < len(root.get("images", ()))
    return number if known else None


def read_picture(where: str) -> Texture:
    """The picture; where it has alpha, one sees through what is less than half opaque.

    InputError where it cannot be read.
    """
    path, number = file_of(where)
    try:
        require_file(path, MOST_BYTES)
        data = path.read_bytes()
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", "Check its name.") from error
    shows_through = True
    if number is not None:
        try:
            data, shows_through = _image(data, number)
        except (
            ValueError, KeyError, IndexError, TypeError, AttributeError, struct.error,
            RecursionError,
        ) as error:  # fmt: skip
            raise InputError(path, f"has no image {number} ({error})", _REMEDY) from error
    pixels, alpha = pixels_and_alpha(Path(where), data)
    if pixels.shape[0] * pixels.shape[1] > MOST_PIXELS:
        raise InputError(where, f"has more than {MOST_PIXELS} pixels", "Make it smaller.")
    return _texture(pixels, alpha if shows_through else None)


def _image(data: bytes, number: int) -> tuple[bytes, bool]:
    """The bytes of an image in a binary glTF, and whether a material lets its alpha count."""
    magic, _, _, size, kind = _HEAD.unpack_from(data)
    if magic != b"glTF" or kind != b"JSON":
        raise ValueError("the file is no binary glTF")
    root = json.loads(data[_HEAD.size : _HEAD.size + size])
    image = root["images"][number]
    shown = [one for one in root.get("materials", ()) if image_number(root, one) == number]
    shows_through = any(one.get("alphaMode", "OPAQUE") != "OPAQUE" for one in shown)
    if "bufferView" not in image:
        return _inline(image["uri"]), shows_through
    view = root["bufferViews"][image["bufferView"]]
    first = _HEAD.size + size + 8 + int(view.get("byteOffset", 0))
    last = first + int(view["byteLength"])
    if not _HEAD.size + size <= first <= last <= len(data) or view.get("buffer", 0) != 0:
        raise ValueError("it lies outside of the file")
    return data[first:last], shows_through


def _inline(uri: str) -> bytes:
    """The bytes of a `data:` URI."""
    head, _, body = uri.partition(",")
    if not (head.startswith("data:") and head.endswith(";base64")):
        raise ValueError("it lies in another file")
    try:
        return base64.b64decode(body)
    except binascii.Error as error:
        raise ValueError("its bytes are no base64") from error


def _texture(pixels: NDArray[np.uint8], alpha: NDArray[np.uint8] | None) -> Texture:
    """Where nothing is to be seen, the pixels have the mean of the others: filters mix both."""
    hidden = np.zeros(pixels.shape[:2], dtype=np.bool_) if alpha is None else alpha < _OPAQUE
    if not hidden.any() or hidden.all():
        return Texture(pixels, np.zeros(pixels.shape[:2], dtype=np.bool_))
    filled = pixels.copy()
    filled[hidden] = pixels[~hidden].mean(axis=0).round().astype(np.uint8)
    return Texture(filled, hidden, cut=True)
