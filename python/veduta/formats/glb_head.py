"""The JSON of a binary glTF file without its geometry, and what it says besides."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

_HEAD = struct.Struct("<4sIIII")
_JSON = 0x4E4F534A
Plain = bool | float | str
List = Sequence[float] | Sequence[bool] | Sequence[str]


def head_of(path: Path, most_bytes: int) -> dict[str, Any] | None:
    """The document of a file; None where it is none, or longer than that."""
    try:
        with path.open("rb") as file:
            start = file.read(_HEAD.size)
            if len(start) < _HEAD.size:
                return None
            magic, _, _, size, kind = _HEAD.unpack(start)
            if magic != b"glTF" or kind != _JSON or size > most_bytes:
                return None
            root = json.loads(file.read(size))
    except (OSError, ValueError, RecursionError):
        return None
    return root if isinstance(root, dict) else None


def extras_of(root: dict[str, Any]) -> Iterator[dict[str, Plain | List]]:
    """The `extras` of the asset, of the first scene and of its first nodes: values and lists of one
    kind; keys of objects within follow a dot.
    """
    scenes, nodes = root.get("scenes"), root.get("nodes")
    first = scenes[0] if isinstance(scenes, list) and scenes else None
    numbers = first.get("nodes") if isinstance(first, dict) else None
    own = [root.get("asset"), first]
    if isinstance(numbers, list) and isinstance(nodes, list):
        own += [nodes[row] for row in numbers[:4] if isinstance(row, int) and 0 <= row < len(nodes)]
    for one in own:
        extras = one.get("extras") if isinstance(one, dict) else None
        if isinstance(extras, dict):
            yield _flat(extras)


def _flat(extras: dict[str, Any], depth: int = 0) -> dict[str, Plain | List]:
    found: dict[str, Plain | List] = {}
    for key, value in extras.items():
        if isinstance(value, bool | str):
            found[key] = value
        elif isinstance(value, int | float):
            found[key] = float(value)
        elif isinstance(value, dict) and depth < 4:
            found |= {f"{key}.{name}": own for name, own in _flat(value, depth + 1).items()}
        elif isinstance(value, list) and value and (kept := _alike(value)) is not None:
            found[key] = kept
    return found


def _alike(values: list[Any]) -> List | None:
    if all(isinstance(value, bool) for value in values):
        return values
    if all(isinstance(value, str) for value in values):
        return values
    if all(isinstance(value, int | float) and not isinstance(value, bool) for value in values):
        return [float(value) for value in values]
    return None
