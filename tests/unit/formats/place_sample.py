"""A place to be written in all formats: a textured house that stands turned, a ball, a door."""

from __future__ import annotations

import functools

import numpy as np
import trimesh
from sample_document import sample_document, sample_photo

from veduta.facade.model import build_part
from veduta.place.builder import PartBuilder
from veduta.place.instances import InstanceGroup, Instances, SharedMesh
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.mover import Mover
from veduta.place.part import Part
from veduta.place.place import Place, Standing
from veduta.place.semantics import Provenance, SemanticClass

TURN_RAD = 0.5
MOVE_M = (10.0, 20.0, 1.5)


def turned() -> np.ndarray:
    matrix = np.eye(4)
    c, s = np.cos(TURN_RAD), np.sin(TURN_RAD)
    matrix[:2, :2] = [[c, -s], [s, c]]
    matrix[:3, 3] = MOVE_M
    return matrix


@functools.cache
def house() -> Part:
    document = sample_document()
    return build_part(document, sample_photo(document), "house")


def ball() -> Mesh:
    sphere = trimesh.creation.icosphere(subdivisions=2, radius=2.0)
    colours = np.full((len(sphere.vertices), 3), (200, 100, 50), dtype=np.uint8)
    return Mesh.simple("ball", sphere.vertices, sphere.faces, colours=colours)


def open_door() -> Part:
    """A leaf of 1 x 2 m that stands open by half of a right angle."""
    builder = PartBuilder("door")
    leaf = builder.feature(SemanticClass.DOOR, Provenance.INVENTED, "leaf")
    material = builder.material(Material("wood", (0.5, 0.3, 0.1)))
    builder.polygon([[(0, 0, 0), (1, 0, 0), (1, 0, 2), (0, 0, 2)]], leaf, material)
    builder.polygon([[(0, 0, 2), (1, 0, 2), (1, 0.1, 2), (0, 0.1, 2)]], leaf, material)
    builder.mover(Mover("leaf", np.array([0]), (0.0, 0.0, 0.0), turn_rad=np.pi / 2, opened=0.5))
    return builder.build()


def posts() -> Part:
    """Three cubes that are one mesh, stretched, beside a square."""
    builder = PartBuilder("posts")
    ground = builder.feature(SemanticClass.GROUND, Provenance.MEASURED, "ground")
    post = builder.feature(SemanticClass.FURNITURE, Provenance.INVENTED, "post")
    stone = builder.material(Material("stone", (0.6, 0.6, 0.6)))
    builder.polygon([[(0, 0, 0), (9, 0, 0), (9, 9, 0), (0, 9, 0)]], ground, stone)
    part = builder.build()
    cube = trimesh.creation.box((1.0, 1.0, 1.0))
    cube.unmerge_vertices()
    mesh = SharedMesh(
        "cube",
        np.asarray(cube.vertices, dtype=np.float32),
        np.asarray(cube.vertex_normals, dtype=np.float32),
        np.asarray(cube.faces, dtype=np.uint32),
        np.zeros(len(cube.faces), dtype=np.int32),
        ("body",),
    )
    places = np.zeros((3, 3, 4))
    places[:, :, :3] = np.diag([0.2, 0.2, 2.0])
    places[:, :, 3] = [(1, 1, 1), (2, 1, 1), (3, 1, 1)]
    group = InstanceGroup(0, (stone,), places, np.full(3, post, dtype=np.int32))
    columns = {name: getattr(part, name) for name in part.__dataclass_fields__}
    return Part(**(columns | {"instances": Instances((mesh,), (group,))}))


def sample_place(crs: str | None = None) -> Place:
    place = Place(title="A sample", author="Nobody", crs=crs)
    if crs is not None:
        place.origin_m = (389_000.0, 5_819_000.0, 34.0)
    place.add(house(), Standing(name="The house", transform=turned()))
    for part in (ball(), open_door(), posts()):
        place.add(part)
    return place


def corners_of(place: Place) -> np.ndarray:
    """(v, 3) corners in the world by the simplest way: parts with neither movers nor instances."""
    found = []
    for placed in place.parts.values():
        points = placed.content.positions_m.astype(float)
        matrix = placed.standing.transform
        found.append(points @ matrix[:3, :3].T + matrix[:3, 3])
    return np.concatenate(found)


def area_of(place: Place) -> float:
    return float(sum(one.content.feature_area_m2.sum() for one in place.parts.values()))
