"""Reading back what moves in a GLB file of Veduta's: see `formats.gltf_movers`.

How far and about which axis something moves is told by its animation alone.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_chunks import Glb
from veduta.place.mover import Mover, Vector

_LEAST_TURN_RAD = 1e-6


def mover_nodes(glb: Glb) -> Iterator[tuple[int, dict[str, Any]]]:
    """The nodes of what moves, with their numbers."""
    for number, node in enumerate(glb.root["nodes"]):
        if "mover" in node.get("extras", {}).get("veduta", {}):
            yield number, node


def read_mover(glb: Glb, number: int, polygons: NDArray[np.int64]) -> Mover:
    """What moves by the node of this number. polygons: its rows in the part."""
    from scipy.spatial.transform import Rotation  # here: most files need none, and it is slow

    node = glb.root["nodes"][number]
    turns, places = (_keys(glb, number, path) for path in ("rotation", "translation"))
    step = Rotation.from_quat(turns[1].astype(np.float64)).as_rotvec()
    turn = float(np.linalg.norm(step)) * (len(turns) - 1)
    x, y, z = step / np.linalg.norm(step) if turn > _LEAST_TURN_RAD else (0.0, 1.0, 0.0)
    return Mover(
        name=node["name"],
        polygons=polygons,
        pivot_m=_z_up(places[0]),
        axis=_z_up(np.array([x, y, z])),
        turn_rad=turn if turn > _LEAST_TURN_RAD else 0.0,
        shift_m=_z_up(places[-1] - places[0]),
        opened=float(node["extras"]["veduta"]["mover"]["opened"]),
    )


def pivot_of(glb: Glb, number: int) -> NDArray[np.float32]:
    """(3,) the point (glTF's axes) that the corners of what moves are about."""
    first: NDArray[np.float32] = _keys(glb, number, "translation")[0]
    return first


def _keys(glb: Glb, number: int, path: str) -> NDArray[np.float32]:
    for animation in glb.root.get("animations", ()):
        for channel in animation["channels"]:
            if channel["target"] == {"node": number, "path": path}:
                keys: NDArray[np.float32] = glb.array(
                    animation["samplers"][channel["sampler"]]["output"]
                )
                if len(keys) < 2:
                    raise ValueError(f"node {number} moves by too few keys")
                return keys
    raise ValueError(f"node {number} moves, and no animation says how")


def _z_up(vector: NDArray[Any]) -> Vector:
    x, y, z = (float(value) + 0.0 for value in vector)
    return (x, -z + 0.0, y)
