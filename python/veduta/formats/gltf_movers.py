"""What moves in a part, as nodes of their own about their pivots, each with an animation.

A node stands as the part says (`Mover.opened`). Its animation has the node's name and takes a
second from closed to open; `extras.veduta.mover` says how far it is open without it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import GltfBin, y_up
from veduta.place.mover import Mover, Vector
from veduta.place.part import Part

OPENING_S = 1.0
_STEPS = 9
"""Keys of an animation: a leaf that turns by half a circle must not take the other way."""

Primitives = Callable[[NDArray[np.bool_], Vector], list[dict[str, Any]]]


def add_movers(
    root: dict[str, Any], part: Part, primitives_of: Primitives, binary: GltfBin
) -> None:
    """Adds a node, a mesh and an animation for each mover.

    primitives_of: those of some polygons of the part, with the corners about a point.
    """
    for mover in part.movers:
        chosen = np.zeros(len(part.polygon_feature), dtype=np.bool_)
        chosen[mover.polygons] = True
        root["meshes"].append(
            {"name": mover.name, "primitives": primitives_of(chosen, mover.pivot_m)}
        )
        node = len(root["nodes"])
        root["scenes"][0]["nodes"].append(node)
        root["nodes"].append(_node(mover, len(root["meshes"]) - 1))
        root.setdefault("animations", []).append(_animation(mover, node, binary))


def _node(mover: Mover, mesh: int) -> dict[str, Any]:
    turn, place = _poses(mover, np.array([mover.opened]))
    return {
        "name": mover.name,
        "mesh": mesh,
        "rotation": turn[0].tolist(),
        "translation": place[0].tolist(),
        "extras": {"veduta": {"mover": {"opened": mover.opened}}},
    }


def _animation(mover: Mover, node: int, binary: GltfBin) -> dict[str, Any]:
    share = np.linspace(0.0, 1.0, _STEPS)
    turn, place = _poses(mover, share)
    times = binary.add_array(
        (share * OPENING_S).astype(np.float32)[:, None], "SCALAR", bounds=True, of_vertices=False
    )
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    for path, kind, values in (("rotation", "VEC4", turn), ("translation", "VEC3", place)):
        output = binary.add_array(values, kind, of_vertices=False)
        channels.append({"sampler": len(samplers), "target": {"node": node, "path": path}})
        samplers.append({"input": times, "output": output, "interpolation": "LINEAR"})
    return {"name": mover.name, "samplers": samplers, "channels": channels}


def _poses(
    mover: Mover, share: NDArray[np.float64]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """(n, 4) turns as quaternions (x, y, z, w) and (n, 3) places of the pivot, y up."""
    from scipy.spatial.transform import Rotation  # here: most calls need none, and it is slow

    axis = y_up(np.array([mover.axis], dtype=np.float32))[0].astype(np.float64)
    turn = Rotation.from_rotvec(share[:, None] * mover.turn_rad * axis).as_quat()
    place = np.array(mover.pivot_m) + share[:, None] * np.array(mover.shift_m)
    return turn.astype(np.float32), y_up(place.astype(np.float32))
