"""The binary chunk of a GLB file as it grows, with the views into it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

_FLOAT, _UINT = 5126, 5125
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
        values: NDArray[np.float32] | NDArray[np.uint32],
        kind: str,
        *,
        bounds: bool = False,
        of_vertices: bool = True,
    ) -> int:
        """Append an array; returns the accessor. What is not of vertices gets no buffer target."""
        is_index = values.dtype == np.uint32
        target = _ELEMENT_ARRAY_BUFFER if is_index else _ARRAY_BUFFER
        accessor: dict[str, Any] = {
            "bufferView": self.add(
                np.ascontiguousarray(values).tobytes(), target if of_vertices else None
            ),
            "componentType": _UINT if is_index else _FLOAT,
            "count": len(values),
            "type": kind,
        }
        if bounds:
            accessor["min"] = values.min(axis=0).tolist()
            accessor["max"] = values.max(axis=0).tolist()
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def y_up(vectors: NDArray[np.float32]) -> NDArray[np.float32]:
    """(x, y, z) with z up to glTF's (x, z, -y); no negative zeros."""
    return np.stack([vectors[:, 0], vectors[:, 2], -vectors[:, 1]], axis=1) + np.float32(0.0)
