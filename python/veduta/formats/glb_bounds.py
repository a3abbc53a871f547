"""What a GLB file of anybody may ask for, checked before any reader takes memory for it.

A few hundred bytes can name two thousand million vertices (a count, a sparse accessor), a tree that
doubles at each level, or JSON that is nested a hundred thousand deep.
"""

from __future__ import annotations

import json
import struct
from typing import Any

MOST_NODES = 100_000
MOST_BUFFERLESS_BYTES = 64 * 2**20
"""Of all accessors that are zeros but for some values, together."""
_SIZES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_HEAD = 20


def require_bounded(data: bytes, most_corners: int) -> None:
    """ValueError where the file asks for more than it holds, or than `most_corners` in all.

    Other faults raise what they raise: KeyError, TypeError, IndexError, struct.error.
    """
    size, kind = struct.unpack_from("<I4s", data, 12)
    if data[:4] != b"glTF" or kind != b"JSON":
        raise ValueError("it is no binary glTF")
    try:
        root = json.loads(data[_HEAD : _HEAD + size])
    except RecursionError:
        raise ValueError("its JSON is nested too deep") from None
    if not isinstance(root, dict):
        raise ValueError("its JSON is no object")
    lengths = _accessors(root, len(data))
    _nodes(root, lengths, most_corners)


def _accessors(root: dict[str, Any], file_bytes: int) -> list[int]:
    """The counts of all accessors; ValueError where one has more than its view, or than memory."""
    views = [_whole(view["byteLength"]) for view in root.get("bufferViews", ())]
    counts, bufferless = [], 0
    for number, accessor in enumerate(root.get("accessors", ())):
        count = _whole(accessor["count"])
        size = count * _SIZES[accessor["componentType"]] * _WIDTHS[accessor["type"]]
        if "bufferView" not in accessor:
            bufferless += size
        elif size > min(views[accessor["bufferView"]], file_bytes) and not _is_meshopt(root):
            raise ValueError(f"accessor {number} has {count} items, more than its buffer view")
        if "sparse" in accessor and _whole(accessor["sparse"]["count"]) > count:
            raise ValueError(f"accessor {number} replaces more items than it has")
        counts.append(count)
    if bufferless > MOST_BUFFERLESS_BYTES:
        raise ValueError(f"accessors without a buffer view are {bufferless} bytes together")
    return counts


def _is_meshopt(root: dict[str, Any]) -> bool:
    """Compressed views are smaller than what is in them."""
    return "EXT_meshopt_compression" in root.get("extensionsUsed", ())


def _nodes(root: dict[str, Any], counts: list[int], most_corners: int) -> None:
    """ValueError where there are too many nodes, one hangs twice, or all show too much."""
    nodes = root.get("nodes", [])
    if len(nodes) > MOST_NODES:
        raise ValueError(f"it has {len(nodes)} nodes; {MOST_NODES} are the most")
    children = [child for node in nodes for child in node.get("children", ())]
    if len(set(children)) < len(children):
        raise ValueError("a node hangs below two others")
    corners = [_corners(mesh, counts) for mesh in root.get("meshes", ())]
    shown = sum(corners[node["mesh"]] for node in nodes if "mesh" in node)
    if max(shown, sum(corners)) > most_corners:
        raise ValueError(f"it shows {shown // 3} triangles; {most_corners // 3} are the most")


def _corners(mesh: dict[str, Any], counts: list[int]) -> int:
    total = 0
    for primitive in mesh["primitives"]:
        named = primitive.get("indices", primitive["attributes"].get("POSITION"))
        total += 0 if named is None else counts[named]
    return total


def _whole(value: Any) -> int:
    if not isinstance(value, int) or value < 0:
        raise ValueError(f"{value!r} is no count")
    return value
