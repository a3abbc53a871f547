"""MATLAB files of version 5 (`save -v6`, `-v7`): numbers, words, cells and structures.

A reader of our own, because a damaged file must end in a message and not in the process.
"""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np

LARGEST_BYTES = 1_000_000_000
DEEPEST = 8
_HEAD = 128
_MATRIX, _COMPRESSED = 14, 15
_CELL, _STRUCT, _CHAR = 1, 2, 4
_NUMBERS = {
    1: "i1",
    2: "u1",
    3: "i2",
    4: "u2",
    5: "i4",
    6: "u4",
    7: "f4",
    9: "f8",
    12: "i8",
    13: "u8",
    16: "u1",
    17: "u2",
    18: "u4",
}
_NUMERIC = range(6, 16)


class DamagedError(ValueError):
    """The bytes are not as the format says."""


@dataclass
class _Bytes:
    """Elements one after the other."""

    data: bytes
    order: str
    place: int = 0

    @property
    def left(self) -> int:
        return len(self.data) - self.place

    def element(self) -> tuple[int, bytes]:
        """The type and the bytes of the next element."""
        if self.left < 8:
            raise DamagedError("it ends in the middle of an element")
        first, size = struct.unpack_from(self.order + "II", self.data, self.place)
        start = self.place + 8
        if first >> 16:  # a small one, which lies in its own head
            first, size, start = first & 0xFFFF, first >> 16, self.place + 4
            if size > 4:
                raise DamagedError("an element is larger than its place")
            self.place += 8
        else:
            padded = size if first == _COMPRESSED else -(-size // 8) * 8
            if size > len(self.data) - start:
                raise DamagedError("an element is longer than the file")
            self.place = min(start + padded, len(self.data))
        return int(first), self.data[start : start + size]

    def numbers(self) -> Any:
        kind, data = self.element()
        if kind not in _NUMBERS:
            raise DamagedError(f"an element has the type {kind}, which holds no numbers")
        dtype = np.dtype(self.order + _NUMBERS[kind])
        return np.frombuffer(data[: len(data) // dtype.itemsize * dtype.itemsize], dtype=dtype)


def parse_mat(data: bytes) -> dict[str, Any]:
    """The variables by their names, as scipy gives them: arrays; cells as arrays of objects;
    structures as arrays with named fields; words as an array of one string. DamagedError.
    """
    if len(data) < _HEAD or data[126:128] not in (b"IM", b"MI"):
        raise DamagedError("it has not the head of a MATLAB file")
    source = _Bytes(data, "<" if data[126:128] == b"IM" else ">", _HEAD)
    found: dict[str, Any] = {}
    while source.left >= 8:
        kind, inner = source.element()
        if kind == _COMPRESSED:
            kind, inner = _Bytes(_unpacked(inner), source.order).element()
        if kind == _MATRIX:
            name, value = _matrix(_Bytes(inner, source.order), 0)
            found[name] = value
    return found


def _unpacked(data: bytes) -> bytes:
    try:
        packed = zlib.decompressobj()
        found = packed.decompress(data, LARGEST_BYTES)
    except zlib.error as error:
        raise DamagedError(str(error)) from None
    if packed.unconsumed_tail:
        raise DamagedError("a variable is larger than 1 GB")
    return found


def _matrix(source: _Bytes, depth: int) -> tuple[str, Any]:
    if depth > DEEPEST:
        raise DamagedError("it is nested too deep")
    if source.left == 0:  # an empty cell may have no content at all
        return "", np.zeros((0, 0))
    flags = source.numbers()
    shape = tuple(int(side) for side in source.numbers())
    if not len(flags) or not 2 <= len(shape) <= 8 or min(shape) < 0:
        raise DamagedError("an array has no shape")
    count = 1
    for side in shape:
        count *= side
    name = source.element()[1].decode("utf-8", "replace")
    kind = int(flags[0]) & 0xFF
    if kind == _CELL:
        return name, _cells(source, shape, count, depth)
    if kind == _STRUCT:
        return name, _structures(source, shape, count, depth)
    if kind == _CHAR:
        codes = source.numbers()
        return name, np.array(["".join(map(chr, codes[:100_000].astype(np.uint16).tolist()))])
    if kind not in _NUMERIC:
        return name, np.zeros((0, 0))  # sparse matrices and objects: nothing of ours
    values = source.numbers()
    if len(values) != count:
        raise DamagedError(f"an array of {count} numbers has {len(values)}")
    native = values.astype(values.dtype.newbyteorder("="))
    return name, native.reshape(shape, order="F")


def _cells(source: _Bytes, shape: tuple[int, ...], count: int, depth: int) -> Any:
    if count * 8 > source.left:
        raise DamagedError("it has fewer cells than it says")
    cells = np.empty(count, dtype=object)
    for number in range(count):
        cells[number] = _inner(source, depth)
    return cells.reshape(shape, order="F")


def _structures(
    source: _Bytes,
    shape: tuple[int, ...],
    count: int,
    depth: int,
) -> Any:
    length = source.numbers()
    size = int(length[0]) if len(length) else 0
    _, names = source.element()
    if not 0 < size <= 128 or len(names) // size * count * 8 > source.left:
        raise DamagedError("it has fewer fields than it says")
    fields = [
        names[start : start + size].split(b"\0")[0].decode("ascii", "replace")
        for start in range(0, len(names) // size * size, size)
    ]
    if not fields or len(set(fields)) < len(fields) or not all(fields):
        raise DamagedError("a structure has no names of fields")
    rows = np.empty(count, dtype=[(field, object) for field in fields])
    for number in range(count):
        for field in fields:
            rows[field][number] = _inner(source, depth)
    return rows.reshape(shape, order="F")


def _inner(source: _Bytes, depth: int) -> Any:
    kind, data = source.element()
    if kind != _MATRIX:
        raise DamagedError("a cell holds no array")
    return _matrix(_Bytes(data, source.order), depth + 1)[1]
