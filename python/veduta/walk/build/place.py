"""The walk as a place: pictures, a glTF for each end of each transition, and the index."""

from __future__ import annotations

from dataclasses import dataclass
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image as PillowImage

from veduta.formats.mesh_glb import mesh_glb_bytes
from veduta.place.features import feature_table
from veduta.place.manifest import Walk, WalkKey, WalkTransition
from veduta.place.material import Material
from veduta.place.mesh import Mesh, Morph
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.atomic import write_bytes
from veduta.walk.build.fewer import fewer_triangles
from veduta.walk.build.mesh import GRASS, MOVING, WATER, MeshSettings, MorphMesh
from veduta.walk.build.screen import Screen
from veduta.walk.build.way import Way
from veduta.walk.rig import Image

Matrix = NDArray[np.float64]
FOLDER = "walk"
Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
"""A frame with z up (x right, y ahead) from the camera's (x right, y down, z ahead)."""
SEEN, TORN, MOVES = 0, 1, 2
"""Materials: what was seen, what spans a break in depth, and what is elsewhere in the other view."""
MATERIALS = ("seen", "between", "moving")


@dataclass(frozen=True, eq=False)
class Station:
    """A key position in the world. world_from_camera: (4, 4)."""

    id: str
    screen: Screen
    world_from_camera: Matrix


def picture_name(number: int) -> str:
    """The path of a key position's picture in the place."""
    return f"{FOLDER}/key-{number:04d}.webp"


def write_picture(path: Path, image: Image, quality: int) -> None:
    """Write a key position's picture as WebP."""
    file = BytesIO()
    PillowImage.fromarray(image).save(file, "WEBP", quality=quality, method=4)
    path.parent.mkdir(parents=True, exist_ok=True)
    write_bytes(path, file.getvalue())


def write_way(
    folder: Path, number: int, way: Way, pictures: tuple[str, str], screen: Screen,
    made: MeshSettings = MeshSettings(),
) -> tuple[str, str]:  # fmt: skip
    """Write the models of a transition that morphs; their paths in the place. screen: of an end.

    made: the settings of the meshes.
    """
    size_px, focal_px = (screen.width_px, screen.height_px), screen.focal_px[0]
    names = []
    back = np.linalg.inv(np.vstack([way.second_from_first, [0.0, 0.0, 0.0, 1.0]]))[:3]
    ends = (("forth", way.forth, back, pictures), ("back", way.back, way.second_from_first, pictures[::-1]))
    for kind, mesh, own_from_other, shown in ends:
        if mesh is None:
            continue
        name = f"{FOLDER}/way-{number:04d}-{kind}.glb"
        simple = fewer_triangles(mesh, size_px, focal_px, made=made)
        model = model_of(f"way-{number:04d}-{kind}", simple, own_from_other, shown)
        write_bytes(folder / name, mesh_glb_bytes(model))
        names.append(name)
    return names[0], names[1]


def model_of(name: str, mesh: MorphMesh, own_from_other: Matrix, pictures: tuple[str, str]) -> Mesh:
    """One end's model as a mesh with a morph target, in its camera's frame with z up.

    `extras.walk.pictures`: what the first and the second set of texture coordinates are of.
    `_PSI`: how far a vertex takes part in the photometric morph. Water and grass are features.
    """
    arrived = mesh.destinations @ own_from_other[:, :3].T + own_from_other[:, 3]
    rows = [
        (SemanticClass.OTHER, Provenance.MEASURED, "seen"),
        (SemanticClass.OTHER, Provenance.INVENTED, "between"),
        *((SemanticClass.OTHER, Provenance.MEASURED, name) for name in ("moving", "water", "grass")),
    ]
    kinds = mesh.torn.astype(np.int32)
    moves = mesh.marked(MOVING)
    kinds[moves] = MOVES
    materials = MATERIALS if moves.any() else MATERIALS[:MOVES]
    marks = kinds.copy()
    for number, bit in ((3, WATER), (4, GRASS)):
        marks[(kinds == SEEN) & mesh.marked(bit)] = number
    return Mesh(
        id=name,
        positions_m=(mesh.points @ Z_UP.T).astype(np.float32),
        triangles=mesh.triangles[:, ::-1].copy(),
        features=feature_table(name, rows),
        materials=tuple(Material(material, unlit=True) for material in materials),
        triangle_feature=marks,
        triangle_material=kinds,
        uv=mesh.uv,
        uv_second=mesh.uv_second,
        morphs=(Morph("next", (arrived @ Z_UP.T).astype(np.float32)),),
        extras={"walk": {"pictures": list(pictures)}},
        values={"psi": mesh.psi},
        pictures={material: Path(pictures[0]).name for material in materials},
    )


def walk_of(
    title: str, document: str, stations: list[Station], pictures: list[str],
    ways: list[WalkTransition], speed_m_s: float,
) -> Walk:  # fmt: skip
    """The entry of the manifest."""
    keys = [
        WalkKey(
            id=one.id, picture=picture, width_px=one.screen.width_px, height_px=one.screen.height_px,
            focal_px=one.screen.focal_px, centre_px=one.screen.centre_px,
            transform=tuple(one.world_from_camera.T.ravel().tolist()),
            projection="cylinder" if one.screen.round else "plane",
        )
        for one, picture in zip(stations, pictures, strict=True)
    ]  # fmt: skip
    return Walk(
        id="walk", name=title, document=document, speed_m_s=speed_m_s, keys=keys, transitions=ways
    )


def world_from_first() -> Matrix:
    """(4, 4) the first camera looks north and stands level at the origin."""
    matrix = np.eye(4)
    matrix[:3, :3] = Z_UP
    return matrix
