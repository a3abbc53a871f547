"""A camera that moves, as a node with a camera and an animation of its place and its turn.

glTF's cameras look along -z with +y up. The animation has the node's name.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import GltfBin, y_up
from veduta.place.camera_path import CameraPath

NEAR_M = 0.08
"""What is nearer to the camera is not drawn."""


def add_camera(root: dict[str, Any], path: CameraPath, binary: GltfBin) -> None:
    """Adds the camera, a node where it begins, and its animation. Aspect and far end are free."""
    cameras = root.setdefault("cameras", [])
    cameras.append(
        {
            "name": path.name,
            "type": "perspective",
            "perspective": {"yfov": path.fov_rad, "znear": NEAR_M},
        }
    )
    places = y_up(path.eyes_m.astype(np.float32))
    turns = _turns(path.directions)
    node = len(root["nodes"])
    root["scenes"][0]["nodes"].append(node)
    root["nodes"].append(
        {
            "name": path.name,
            "camera": len(cameras) - 1,
            "translation": places[0].tolist(),
            "rotation": turns[0].tolist(),
        }
    )
    times = binary.add_array(
        path.times_s.astype(np.float32)[:, None], "SCALAR", bounds=True, of_vertices=False
    )
    samplers: list[dict[str, Any]] = []
    channels: list[dict[str, Any]] = []
    for target, kind, values in (("translation", "VEC3", places), ("rotation", "VEC4", turns)):
        output = binary.add_array(values, kind, of_vertices=False)
        channels.append({"sampler": len(samplers), "target": {"node": node, "path": target}})
        samplers.append({"input": times, "output": output, "interpolation": "LINEAR"})
    root.setdefault("animations", []).append(
        {"name": path.name, "samplers": samplers, "channels": channels}
    )


def _turns(directions: NDArray[np.float64]) -> NDArray[np.float32]:
    """(n, 4) quaternions (x, y, z, w) of upright cameras; neighbours on the shorter way."""
    from scipy.spatial.transform import Rotation  # here: most calls need none, and it is slow

    back = -y_up(directions.astype(np.float32)).astype(np.float64)
    back /= np.linalg.norm(back, axis=1)[:, None]
    right = np.cross([0.0, 1.0, 0.0], back)
    right /= np.linalg.norm(right, axis=1)[:, None]
    axes = np.stack([right, np.cross(back, right), back], axis=2)
    turns = Rotation.from_matrix(axes).as_quat()
    opposite = np.cumsum((turns[1:] * turns[:-1]).sum(axis=1) < 0.0) % 2 == 1
    turns[1:][opposite] *= -1.0
    return turns.astype(np.float32)
