"""A place as X3D 4.0: a transform for each part, a shape for each look, textures in the file.

Plans and animals write X3D of their own, with doors that open and skeletons that move; this has the
surfaces of any place.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import y_up
from veduta.formats.shapes import Look, Shape, shapes
from veduta.formats.x3d import Element, X3dScene
from veduta.place.place import Place
from veduta.run.atomic import write_bytes


def write_x3d(place: Place, path: Path) -> None:
    """Write the file; the part's place is in its points."""
    scene = X3dScene(place.title or path.stem, ())
    looks: dict[str, str] = {}
    for shape in shapes(place):
        above = scene.node(scene.scene, "Group", shape.placed.id)
        for look, chosen in shape.by_look():
            _add(scene, above, shape, look, chosen, looks)
    write_bytes(path, scene.content())


def _add(
    scene: X3dScene, above: Element, shape: Shape, look: Look, chosen: NDArray[np.int64],
    looks: dict[str, str],
) -> None:  # fmt: skip
    own = shape.triangles
    used, corners = np.unique(own.corners[chosen].reshape(-1), return_inverse=True)
    made = scene.node(above, "Shape")
    if look.name in looks:
        scene.node(made, "Appearance", USE=looks[look.name])
    else:
        looks[look.name] = scene.appearance(made, look.material, look.name)
    faces = scene.node(made, "IndexedTriangleSet", index=corners.reshape(-1), solid=False)
    scene.node(faces, "Coordinate", point=y_up(own.positions_m[used].astype(np.float32)))
    scene.node(faces, "Normal", vector=y_up(own.normals[used].astype(np.float32)))
    if own.colours is not None:
        scene.node(faces, "Color", color=own.colours[used].astype(np.float64) / 255.0)
    if look.material.texture is not None:
        uv = own.uv[used] * np.array([1.0, -1.0]) + np.array([0.0, 1.0])
        scene.node(faces, "TextureCoordinate", point=uv)
