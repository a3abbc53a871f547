"""3D Tiles 1.1: `tileset.json`, an explicit tree of tiles.

https://docs.ogc.org/cs/22-025r4/22-025r4.html - a tile has a bounding box, a geometric error (the
metres by which its content differs from the truth) and perhaps a content; its children replace it
where that error is seen. Boxes are z-up in the tile's own frame; contents are glTF (y-up), which a
reader turns.
"""

from __future__ import annotations

import json
import posixpath
import struct
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from veduta.run.atomic import write_bytes

Box = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Lower and upper corner (m, z up)."""


@dataclass(frozen=True)
class Tile:
    """A tile of the tree.

    transform: (4, 4) parent_from_tile. world_m: where the tile's frame begins in the flat frame of
    the place; kept beside the transform, which may follow the curvature of the Earth. refine:
    whether its children are shown beside its content or instead of it; None: as its parent's.
    """

    box: Box
    error_m: float
    content: str | None = None
    children: tuple[Tile, ...] = ()
    transform: NDArray[np.float64] | None = field(default=None, compare=False)
    world_m: tuple[float, float, float] | None = None
    refine: Literal["ADD", "REPLACE"] | None = None


def union(boxes: Iterable[Box]) -> Box:
    """The box around boxes."""
    every = np.array(list(boxes))
    low, high = every[:, 0].min(axis=0).tolist(), every[:, 1].max(axis=0).tolist()
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])


def write_tileset(root: Tile, path: Path) -> None:
    """Write the tree; the file appears whole or not at all."""
    text = json.dumps(tileset(root), separators=(",", ":"), allow_nan=False)
    write_bytes(path, text.encode())


def tileset(root: Tile) -> dict[str, Any]:
    """The JSON of a tree."""
    return {
        "asset": {"version": "1.1"},
        "geometricError": max(root.error_m, 1.0),
        "root": _tile(root) | {"refine": root.refine or "REPLACE"},
    }


def _tile(tile: Tile) -> dict[str, Any]:
    made: dict[str, Any] = {
        "boundingVolume": {"box": _box(tile.box)},
        "geometricError": tile.error_m,
    }
    if tile.transform is not None:
        made["transform"] = column_major(tile.transform)
    if tile.content is not None:
        made["content"] = {"uri": tile.content}
    if tile.refine is not None:
        made["refine"] = tile.refine
    if tile.children:
        made["children"] = [_tile(child) for child in tile.children]
    if tile.world_m is not None:
        made["extras"] = {"veduta": {"world_m": list(tile.world_m)}}
    return made


def column_major(matrix: NDArray[np.float64]) -> list[float]:
    """(4, 4) as the sixteen numbers that glTF and 3D Tiles have."""
    flat: list[float] = (matrix.T.reshape(-1) + 0.0).tolist()
    return flat


def _box(box: Box) -> list[float]:
    """Centre and three half axes; none without length."""
    low, high = np.array(box[0]), np.array(box[1])
    centre, half = (low + high) / 2, np.maximum((high - low) / 2, 1e-3)
    axes = np.diag(half).reshape(-1)
    return [round(value, 6) for value in [*centre.tolist(), *axes.tolist()]]


def contents(folder: Path, name: str = "tileset.json") -> list[str]:
    """All files of a tileset, by path below the folder; ValueError for a name that leads out."""
    found: list[str] = []
    pictures: dict[str, None] = {}
    waiting = [name]
    while waiting:
        current = waiting.pop()
        found.append(current)
        base = current.rpartition("/")[0]
        document = json.loads((folder / current).read_bytes())
        for uri in _uris([document["root"]]):
            path = f"{base}/{uri}" if base else uri
            if ".." in path.split("/") or ":" in path or path.startswith("/"):
                raise ValueError(f"{uri!r} leads out of the folder")
            if path.endswith(".json"):
                waiting.append(path)
            else:
                found.append(path)
                pictures |= dict.fromkeys(_pictures(folder, path))
    return found + sorted(pictures)


def _pictures(folder: Path, glb: str) -> list[str]:
    """The images that lie beside a GLB, by path below the folder."""
    with (folder / glb).open("rb") as file:
        head = file.read(20)
        if len(head) < 20 or head[:4] != b"glTF":
            raise ValueError(f"{glb!r} is no GLB")
        document = json.loads(file.read(struct.unpack_from("<I", head, 12)[0]))
    found = []
    for uri in (image["uri"] for image in document.get("images", ()) if "uri" in image):
        path = posixpath.normpath(posixpath.join(posixpath.dirname(glb), uri))
        if path.startswith("..") or ":" in uri or path.startswith("/"):
            raise ValueError(f"{uri!r} leads out of the folder")
        found.append(path)
    return found


def _uris(tiles: Sequence[dict[str, Any]]) -> list[str]:
    found = []
    waiting = list(tiles)
    while waiting:
        tile = waiting.pop()
        if "content" in tile:
            found.append(str(tile["content"]["uri"]))
        waiting.extend(tile.get("children", ()))
    return found
