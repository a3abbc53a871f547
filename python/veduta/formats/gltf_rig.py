"""A skinned glTF as programs for animation expect it: Blender, and the engines of games.

They look along glTF's +z, which is Blender's -y, and want one object over mesh and joints: an
armature, turned so that what goes along x in Veduta goes that way. Each clip is an action with
the root's way in it. Which feet stand is a track of its own for each foot: a node `contact FOOT`
that is 1 over the ground while the foot stands and 0 while it does not, in steps.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from veduta.formats.gltf_bin import GltfBin
from veduta.place.mesh import Mesh
from veduta.place.skin import Clip, Contact

_HALF = math.sqrt(0.5)
TURN = [0.0, -_HALF, 0.0, _HALF]
"""From +x to +z, about y."""


def rig_for_others(root: dict[str, Any], mesh: Mesh, binary: GltfBin) -> None:
    """Puts an armature over the nodes of the scene, and a track beside it for each foot."""
    nodes = root["nodes"]
    feet = list(dict.fromkeys(one.foot for clip in mesh.clips for one in clip.contacts))
    track = {}
    children = root["scenes"][0]["nodes"]
    for foot in feet:
        track[foot] = len(nodes)
        nodes.append({"name": f"contact {foot}", "translation": [0.0, 0.0, 0.0]})
    nodes.append({"name": f"{mesh.id} armature", "rotation": TURN, "children": children})
    root["scenes"][0]["nodes"] = [len(nodes) - 1, *track.values()]
    root["skins"][0]["skeleton"] = root["skins"][0]["joints"][0]
    for told, clip in zip(root.get("animations", []), mesh.clips, strict=True):
        for one in clip.contacts:
            _add_track(told, track[one.foot], one, clip, binary)


def _add_track(
    told: dict[str, Any], node: int, contact: Contact, clip: Clip, binary: GltfBin
) -> None:
    times, stands = track_of(contact, float(clip.times_s[-1]))
    values = np.zeros((len(times), 3), dtype=np.float32)
    values[:, 1] = stands
    clock = np.array(times, dtype=np.float32)[:, None]
    told["samplers"].append(
        {
            "input": binary.add_array(clock, "SCALAR", bounds=True, of_vertices=False),
            "output": binary.add_array(values, "VEC3", of_vertices=False),
            "interpolation": "STEP",
        }
    )
    target = {"node": node, "path": "translation"}
    told["channels"].append({"sampler": len(told["samplers"]) - 1, "target": target})


def track_of(contact: Contact, end_s: float) -> tuple[list[float], list[float]]:
    """Times at which a foot comes down (1) or goes up (0), from 0 to the clip's end."""
    changes = {0.0: 0.0}
    for down, up in contact.down_s:
        changes[down] = 1.0
        if up < end_s:
            changes[up] = 0.0
    times = sorted(changes)
    if times[-1] < end_s:
        changes[end_s] = changes[times[-1]]
        times.append(end_s)
    return times, [changes[time] for time in times]
