"""The binary chunk of a GLB file as it grows, with the views into it, and the file around it."""

from __future__ import annotations

import json
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

_COMPONENTS = {"float32": 5126, "uint32": 5125, "uint16": 5123}
_JSON_CHUNK, _BIN_CHUNK = 0x4E4F534A, 0x004E4942
_ARRAY_BUFFER, _ELEMENT_ARRAY_BUFFER = 34962, 34963


class GltfBin:
    """The binary chunk and the views into it."""

    def __init__(self) -> None:
        self.content = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []

    def add(self, data: bytes, target: int | None = None) -> int:
        """Append bytes at a multiple of four; returns the buffer view."""
        self.content.extend(b"\0" * (-len(self.content) % 4))
        view = {"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)}
        if target is not None:
            view["target"] = target
        self.content.extend(data)
        self.views.append(view)
        return len(self.views) - 1

    def add_array(
        self,
        values: NDArray[np.float32] | NDArray[np.uint32] | NDArray[np.uint16],
        kind: str,
        *,
        bounds: bool = False,
        of_vertices: bool = True,
        normalized: bool = False,
    ) -> int:
        """Append an array; returns the accessor. What is not of vertices gets no buffer target.

        normalized: whole numbers stand for shares, the largest for 1.
        """
        is_index = values.dtype == np.uint32
        target = _ELEMENT_ARRAY_BUFFER if is_index else _ARRAY_BUFFER
        accessor: dict[str, Any] = {
            "bufferView": self.add(
                np.ascontiguousarray(values).tobytes(), target if of_vertices else None
            ),
            "componentType": _COMPONENTS[values.dtype.name],
            "count": len(values),
            "type": kind,
        }
        if normalized:
            accessor["normalized"] = True
        if bounds:
            accessor["min"] = values.min(axis=0).tolist()
            accessor["max"] = values.max(axis=0).tolist()
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def glb_container(root: Mapping[str, Any], content: bytes) -> bytes:
    """The file of a document and its binary chunk (glTF 2.0, section 4.4).

    content: as long as the document's buffer, a multiple of four bytes.
    """
    text = json.dumps(root, separators=(",", ":"), allow_nan=False).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(content)
    return b"".join(
        (
            struct.pack("<4sII", b"glTF", 2, total),
            struct.pack("<II", len(text), _JSON_CHUNK),
            text,
            struct.pack("<II", len(content), _BIN_CHUNK),
            content,
        )
    )


def y_up(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """(x, y, z) with z up to glTF's (x, z, -y); no negative zeros."""
    return np.stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]], axis=1) + np.float32(0.0)
