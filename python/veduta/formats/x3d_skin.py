"""A mesh with a skeleton as X3D 4.0: an HAnim humanoid, and interpolators for each of its clips.

A joint's centre is where it is at rest; what it turns and moves beside that is what the clip
says. Each clip has a clock of its own; the first one runs, others are started by their `startTime`.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from veduta.formats.x3d import X3dScene
from veduta.place.mesh import Mesh
from veduta.place.skin import Clip, Skin
from veduta.run.atomic import write_bytes

Floats = NDArray[np.float64]
_STILL = 1e-6
"""A joint that moves by less (m, or rad) has no interpolator."""


def write_mesh_x3d(mesh: Mesh, path: Path) -> None:
    """Write the mesh; the file appears whole or not at all. ValueError: see `mesh_x3d`."""
    write_bytes(path, mesh_x3d(mesh))


def mesh_x3d(mesh: Mesh) -> bytes:
    """The content of the file; ValueError of a mesh without a skeleton, or whose joints are
    turned at rest: HAnim has no words for that.
    """
    skin = mesh.skin
    if skin is None:
        raise ValueError(f"{mesh.id} has no skeleton")
    if np.abs(skin.rest[:, :3, :3] - np.eye(3)).max(initial=0.0) > 1e-9:
        raise ValueError(f"a joint of {mesh.id} is turned at rest")
    scene = X3dScene(mesh.id, (("Followers", 1), ("HAnim", 3)))
    low, high = mesh.positions_m.min(axis=0), mesh.positions_m.max(axis=0)
    middle, size = 0.5 * (low + high), float(np.ptp(mesh.positions_m, axis=0).max())
    scene.node(
        scene.scene, "Viewpoint", "beside", description="beside", fieldOfView=0.8,
        position=_words(_up(middle[None] + [0.0, -2.2 * size, 0.0])),
        centerOfRotation=_words(_up(middle[None])),
    )  # fmt: skip
    body = scene.node(
        scene.scene, "HAnimHumanoid", mesh.id, name_=mesh.id, version="2.0", loa="0",
    )  # fmt: skip
    joints = _joints(scene, body, skin)
    for joint in joints:
        scene.node(body, "HAnimJoint", USE=joint.attrib["DEF"], containerField="joints")
    points = scene.node(
        body, "Coordinate", "skin", point=_words(_up(mesh.positions_m)),
        containerField="skinCoord",
    )  # fmt: skip
    for row in range(len(mesh.materials)):
        _shape(scene, body, mesh, row, points.attrib["DEF"])
    for number, clip in enumerate(mesh.clips):
        _add_clip(scene, skin, joints, clip, runs=number == 0)
    return scene.content()


def _joints(scene: X3dScene, body: Element, skin: Skin) -> list[Element]:
    """The tree of the joints, each with the vertices that follow it."""
    found: list[Element] = []
    for row, (name, parent) in enumerate(zip(skin.names, skin.parent.tolist(), strict=True)):
        vertex, slot = np.nonzero((skin.joints == row) & (skin.weights > 0.0))
        fields = {
            "name_": name,
            "center": _words(_up(skin.rest[row, None, :3, 3])),
            "skinCoordIndex": " ".join(map(str, vertex.tolist())),
            "skinCoordWeight": _words(skin.weights[vertex, slot]),
            "containerField": "skeleton" if parent < 0 else "children",
        }
        found.append(
            scene.node(body if parent < 0 else found[parent], "HAnimJoint", name, **fields)
        )
    return found


def _shape(scene: X3dScene, body: Element, mesh: Mesh, row: int, points: str) -> None:
    """The triangles of a material; they share the skin's points."""
    faces = mesh.triangles[mesh.triangle_material == row]
    if not len(faces):
        return
    shape = scene.node(body, "Shape", containerField="skin")
    scene.appearance(shape, mesh.materials[row])
    own = scene.node(shape, "IndexedTriangleSet", index=faces.reshape(-1).astype(np.int64))
    own.set("solid", "false")
    scene.node(own, "Coordinate", USE=points)
    if mesh.uv is not None:
        uv = mesh.uv * np.array([1.0, -1.0]) + np.array([0.0, 1.0])
        scene.node(own, "TextureCoordinate", point=_words(uv))


def _add_clip(
    scene: X3dScene, skin: Skin, joints: list[Element], clip: Clip, *, runs: bool
) -> None:
    """A clock and an interpolator for each turn and each move that the clip has."""
    end = float(clip.times_s[-1])
    clock = scene.node(
        scene.scene, "TimeSensor", f"clock {clip.name}", cycleInterval=max(end, 1e-3),
        loop=clip.loops, enabled=runs, description=clip.name,
    )  # fmt: skip
    key = _words(clip.times_s / max(end, 1e-12))
    rest = skin.rest_in_parent()[:, :3, 3]
    for row, joint in enumerate(joints):
        moved = clip.translations_m[:, row] - rest[row]
        turned = Rotation.from_quat(clip.rotations_xyzw[:, row]).as_rotvec()
        for values, kind, field in (
            (_words(_up(moved)), "Position", "translation"),
            (_words(_axis_angles(turned)), "Orientation", "rotation"),
        ):
            if np.abs(moved if kind == "Position" else turned).max() < _STILL:
                continue
            way = scene.node(
                scene.scene, f"{kind}Interpolator", f"{clip.name} {skin.names[row]} {field}",
                key=key, keyValue=values,
            )  # fmt: skip
            scene.route(clock, "fraction_changed", way, "set_fraction")
            scene.route(way, "value_changed", joint, f"set_{field}")


def _axis_angles(vectors: Floats) -> Floats:
    """(t, 4) axis and angle in X3D's axes of turns (t, 3); each axis near to that of the one
    before.
    """
    angle = np.linalg.norm(vectors, axis=1)
    axis = _up(vectors / np.maximum(angle, 1e-12)[:, None])
    axis[angle < 1e-9] = [0.0, 1.0, 0.0]
    along = np.concatenate([[1.0], (axis[1:] * axis[:-1]).sum(axis=1)])
    sign = np.cumprod(np.where(along < 0.0, -1.0, 1.0))
    return np.column_stack([axis * sign[:, None], angle * sign])


def _up(values: NDArray[np.floating]) -> Floats:
    """(n, 3) in X3D's axes."""
    return np.stack([values[:, 0], values[:, 2], -values[:, 1]], axis=1).astype(np.float64)


def _words(values: NDArray[np.floating]) -> str:
    """Numbers by six digits: animals are small, and X3D's metres are not."""
    flat = np.asarray(values, dtype=np.float64).reshape(-1) + 0.0
    return " ".join(f"{value:.6g}" for value in flat.tolist())
