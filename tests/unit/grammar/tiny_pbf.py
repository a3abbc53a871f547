"""A file of OpenStreetMap in its binary form (wiki: PBF Format), as small as it can be."""

from __future__ import annotations

import struct
import zlib
from collections.abc import Sequence

Field = tuple[int, bytes | int]


def varint(number: int) -> bytes:
    """A whole number in groups of seven bits, the lowest first."""
    out = bytearray()
    while number > 127:
        out.append(number & 127 | 128)
        number >>= 7
    return bytes([*out, number])


def zigzag(number: int) -> int:
    """Signs in the lowest bit."""
    return number * 2 if number >= 0 else -number * 2 - 1


def message(*fields: Field) -> bytes:
    """Fields by their numbers: bytes with their length, numbers as they are."""
    out = b""
    for number, value in fields:
        is_bytes = isinstance(value, bytes)
        out += varint(number << 3 | (2 if is_bytes else 0))
        out += varint(len(value)) + value if isinstance(value, bytes) else varint(value)
    return out


def packed(numbers: Sequence[int]) -> bytes:
    """Several numbers in one field."""
    return b"".join(varint(number) for number in numbers)


def blob(kind: bytes, content: bytes) -> bytes:
    """A block with its header before it."""
    body = message((2, len(content)), (3, zlib.compress(content)))
    head = message((1, kind), (3, len(body)))
    return struct.pack(">I", len(head)) + head + body


def pbf(
    nodes: Sequence[tuple[float, float]], ways: Sequence[tuple[list[int], dict[str, str]]]
) -> bytes:
    """nodes: longitude and latitude (degrees), numbered from 1. ways: their nodes, and tags."""
    words = [""]
    for _, tags in ways:
        words += [word for pair in tags.items() for word in pair]
    table = message(*((1, word.encode()) for word in words))
    group: list[Field] = [
        (1, message((1, zigzag(number)), (8, zigzag(round(y * 1e7))), (9, zigzag(round(x * 1e7)))))
        for number, (x, y) in enumerate(nodes, 1)
    ]
    for number, (refs, tags) in enumerate(ways, 1):
        steps = [b - a for a, b in zip([0, *refs], refs, strict=False)]
        keys, values = ([words.index(word) for word in some] for some in (tags, tags.values()))
        way: list[Field] = [(1, number), (2, packed(keys)), (3, packed(values))]
        group.append((3, message(*way, (8, packed([zigzag(step) for step in steps])))))
    head = message((4, b"OsmSchema-V0.6"))
    return blob(b"OSMHeader", head) + blob(b"OSMData", message((1, table), (2, message(*group))))
