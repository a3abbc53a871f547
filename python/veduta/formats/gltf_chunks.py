"""The chunks of a binary glTF file that Veduta wrote, and the arrays in them."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

LARGEST_BYTES = 2**31
REMEDY = "Let Veduta write it again."
BROKEN = (
    ValueError, KeyError, IndexError, TypeError, AttributeError, OverflowError,
    struct.error, OSError, RecursionError,
)  # fmt: skip
"""What a file that is not as it should be raises."""
MOST_ROWS = 2**24
"""As far as single precision counts."""
_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")
_DTYPES = {5126: np.float32, 5125: np.uint32, 5123: np.uint16, 5121: np.uint8}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def glb_content(path: Path) -> bytes:
    """The content of a file of a bounded size; InputError where it cannot be read."""
    try:
        require_file(path, LARGEST_BYTES)
        return path.read_bytes()
    except OSError as error:
        raise InputError(path, f"cannot be read ({error.strerror})", REMEDY) from error


@dataclass(frozen=True)
class Glb:
    """The two chunks of a file."""

    root: dict[str, Any]
    content: bytes

    def one(self, kind: str, number: Any) -> dict[str, Any]:
        """What a number refers to in a list of the document; ValueError where it is not there."""
        every = self.root[kind]
        if type(number) is not int or not 0 <= number < len(every):
            raise ValueError(f"{json.dumps(number)[:60]} is none of its {len(every)} {kind}")
        found: dict[str, Any] = every[number]
        return found

    def view(self, number: int) -> bytes:
        """The bytes of a buffer view; ValueError where it lies outside."""
        view = self.one("bufferViews", number)
        start, size = int(view["byteOffset"]), int(view["byteLength"])
        if start < 0 or size < 0 or start + size > len(self.content):
            raise ValueError(f"buffer view {number} lies outside of the file")
        return self.content[start : start + size]

    def array(self, number: int) -> NDArray[Any]:
        """An accessor as (n,) or (n, width); ValueError where it does not fill its view."""
        accessor = self.one("accessors", number)
        width = _WIDTHS[accessor["type"]]
        dtype = np.dtype(_DTYPES[accessor["componentType"]])
        count = int(accessor["count"])
        data = self.view(accessor["bufferView"])
        if len(data) != count * width * dtype.itemsize:
            raise ValueError(f"accessor {number} does not fill its buffer view")
        return np.frombuffer(data, dtype=dtype).reshape((count, width) if width > 1 else (count,))


def glb_chunks(data: bytes) -> Glb:
    """The two chunks of a file's content; ValueError where it is not glTF 2.0."""
    magic, version, total = _HEADER.unpack_from(data, 0)
    if magic != b"glTF" or version != 2 or total != len(data):
        raise ValueError("the header is not glTF 2.0's, or the file is cut short")
    size, kind = _CHUNK.unpack_from(data, _HEADER.size)
    start = _HEADER.size + _CHUNK.size
    if kind != b"JSON":
        raise ValueError("the first chunk is not JSON")
    root = json.loads(data[start : start + size])
    size_bin, kind_bin = _CHUNK.unpack_from(data, start + size)
    if kind_bin != b"BIN\0":
        raise ValueError("the second chunk is not binary")
    first = start + size + _CHUNK.size
    return Glb(root, data[first : first + size_bin])


def feature_rows(column: NDArray[Any]) -> NDArray[np.int32]:
    """Rows of the feature table, which glTF has as floats; ValueError where one is no number."""
    if not np.isfinite(column).all() or (np.abs(column) > MOST_ROWS).any():
        raise ValueError("the row of a feature is no number")
    return column.astype(np.int32)
