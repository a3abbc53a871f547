"""Files of other programs as places: meshes, points, and the buildings of city models.

A material that is named after a class (`window`, `wall.brick`) gives its surfaces that class, as
Veduta's own writers name them; all other surfaces are `other`. glTF and OBJ are y-up, STL and PLY
are taken to be z-up.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.formats.building_faces import MOST_CORNERS, BuildingFaces, CityFile, SurfaceTold
from veduta.formats.citygml_read import read_citygml
from veduta.formats.cityjson_read import read_cityjson
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.gltf_chunks import BROKEN, glb_chunks, glb_content
from veduta.formats.mesh_glb_read import read_model
from veduta.formats.obj_read import ReadMesh, read_obj
from veduta.formats.triangles_read import ReadPoints, read_triangles
from veduta.place.builder import PartBuilder
from veduta.place.features import feature_table
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.part import PLANE_TOLERANCE_M, Part
from veduta.place.place import Cloud, Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError
from veduta.run.limits import limited

LEFT_OUT = "polygons_left_out"
"""Attribute of a building: how many cannot be drawn."""
MOST_TOLD = 20
"""Notes of a place that name what is left out one by one."""
WARPED_M = 0.005
"""A face whose corners leave its mean plane by more is cut into triangles between them."""
_CLASSES = {one.value: one for one in SemanticClass}


def read_glb_place(path: Path) -> Place:
    """A model of Veduta's as it was; of any other glTF its triangles and colours."""
    place = Place(title=path.stem)
    if _is_model(path):
        place.add(read_model(path))
    else:
        place.add(_part(read_glb_mesh(path, MOST_CORNERS), path.stem))
    return place


def read_obj_place(path: Path) -> Place:
    """The polygons of an OBJ file, with the colours of its MTL files."""
    place = Place(title=path.stem)
    place.add(_part(read_obj(path, path.parent), path.stem))
    return place


def read_trimesh_place(path: Path) -> Place:
    """The triangles of an STL or PLY file; of a PLY file without any, its points."""
    read = limited(read_triangles, path, path, "Export it again.")
    place = Place(title=path.stem)
    if isinstance(read, ReadPoints):
        place.clouds.append(Cloud(path.stem, read.points_m, read.colours))
        return place
    try:
        mesh = Mesh.simple(path.stem, read.vertices_m, read.triangles, colours=read.colours)
    except ValueError as error:
        raise InputError(path, f"is no mesh ({error})", "Export it again.") from error
    place.add(mesh)
    return place


def read_city_place(path: Path) -> Place:
    """The buildings of a CityJSON or CityGML file, each a part; its notes say what is left out."""
    city = (
        read_citygml(path)
        if path.suffix.lower() == ".gml"
        else read_cityjson(path, installations=True)
    )
    if not city.buildings:
        raise InputError(path, "has no building with polygons", "Choose a model of LoD1 or above.")
    place = Place(title=path.stem, crs=None if city.epsg is None else f"EPSG:{city.epsg}")
    left = list(city.left)
    low = _low(city)
    place.origin_m = (float(low[0]), float(low[1]), float(low[2]))
    for building in city.buildings:
        own = np.concatenate([ring for rings in building.polygons for ring in rings]).min(axis=0)
        matrix = np.eye(4)
        matrix[:3, 3] = own - low
        name = str(building.attributes.get("name", building.id))
        part = _building(building, own)
        if part is None:
            left.append((building.id, "has no polygon that can be drawn"))
            continue
        if part.notes:
            left.append((building.id, "; ".join(part.notes)))
        place.add(part, Standing(name=name, transform=matrix))
    if not place.parts:
        raise InputError(path, "has no polygon that can be drawn", "Check its coordinates.")
    place.notes += [*city.notes, *_named(left)]
    return place


def _named(left: Sequence[tuple[str, str]]) -> Iterator[str]:
    """What is not in the place, as notes."""
    yield from (f"left out: {name}: {reason}" for name, reason in left[:MOST_TOLD])
    if len(left) > MOST_TOLD:
        yield f"left out: {len(left) - MOST_TOLD:,} more"


def _is_model(path: Path) -> bool:
    """Whether a GLB file is one part of Veduta's."""
    try:
        root = glb_chunks(glb_content(path)).root
        return "features" in root["scenes"][0]["extras"]["veduta"]
    except (*BROKEN, RecursionError):
        return False


def _low(city: CityFile) -> NDArray[np.float64]:
    low = [ring.min(axis=0) for one in city.buildings for rings in one.polygons for ring in rings]
    least: NDArray[np.float64] = np.floor(np.min(low, axis=0))
    return least


def _building(building: BuildingFaces, origin: NDArray[np.float64]) -> Part | None:
    """None where none of its polygons can be drawn."""
    builder = PartBuilder(building.id)
    builder.attributes |= dict(building.attributes)
    builder.attributes.pop(LEFT_OUT, None)
    left = 0
    told = building.attributes.get("provenance")
    known_by = Provenance(told) if told in set(Provenance) else Provenance.MEASURED
    materials: dict[Material, int] = {}
    features: dict[int | SemanticClass, int] = {}
    named: dict[str, int] = {}
    rows = building.surface or (-1,) * len(building.polygons)
    for rings, known, row in zip(building.polygons, building.classes, rows, strict=True):
        semantic = known or SemanticClass.OTHER
        said = building.surfaces[row] if row >= 0 else SurfaceTold(known)
        # A file that tells of no surface more than its class has one of each class.
        key = row if said.name or said.colour else semantic
        if key not in features:
            name = said.name or semantic.value
            count = named[name] = named.get(name, 0) + 1
            name = name if count == 1 else f"{name} {count}"
            features[key] = builder.feature(semantic, known_by, name)
        material = Material(semantic.value, said.colour or (1.0, 1.0, 1.0))
        if material not in materials:
            materials[material] = builder.material(material)
        kept = [piece for piece in _flat([ring - origin for ring in rings]) if _is_sound(piece)]
        left += not kept
        for piece in kept:
            builder.polygon(piece, features[key], materials[material])
    if left:
        builder.attributes[LEFT_OUT] = left
        builder.notes.append(f"{left} of {len(building.polygons)} polygons cannot be drawn")
    return builder.build() if builder.polygon_count else None


def _is_sound(rings: list[NDArray[np.float64]]) -> bool:
    """Whether it can be triangulated: whole millimetres make slivers cross themselves."""
    points, ends, whole = _columns(rings)
    points = points.astype(np.float32).astype(np.float64)
    return bool(_core.sound_polygons(points, ends, whole, PLANE_TOLERANCE_M)[0])


def _columns(
    rings: list[NDArray[np.float64]],
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]:
    """One polygon's corners, the first of each ring, and the first ring."""
    ends = np.concatenate([[0], np.cumsum([len(ring) for ring in rings])]).astype(np.int64)
    return np.concatenate(rings), ends, np.array([0, len(rings)], dtype=np.int64)


def _flat(rings: list[NDArray[np.float64]]) -> list[list[NDArray[np.float64]]]:
    """The polygon on its mean plane where whole millimetres warp it; of one that is warped more
    triangles between its corners as they are, cut where they do not overlap on that plane.
    """
    ring = rings[0]
    middle = ring.mean(axis=0)
    after = np.roll(ring, -1, axis=0)
    normal = np.cross(ring - middle, after - middle).sum(axis=0)
    length = float(np.linalg.norm(normal))
    if length == 0.0:
        return [rings]
    normal = normal / length
    off = max(float(np.abs((one - middle) @ normal).max()) for one in rings)
    if off <= 0.5 * PLANE_TOLERANCE_M:
        return [rings]
    level = [one - ((one - middle) @ normal)[:, None] * normal for one in rings]
    return [level] if off <= WARPED_M else _cut(rings, level)


def _cut(
    rings: list[NDArray[np.float64]], level: list[NDArray[np.float64]]
) -> list[list[NDArray[np.float64]]]:
    """Triangles of the corners, as those of the level polygon lie; none where it crosses itself."""
    points, ends, whole = _columns(level)
    if not _core.sound_polygons(points, ends, whole, PLANE_TOLERANCE_M)[0]:
        return []
    indices, _, _, _ = _core.triangulate_polygons(points, ends, whole, PLANE_TOLERANCE_M)
    return [[triangle] for triangle in np.concatenate(rings)[indices]]


def _class_of(name: str) -> SemanticClass:
    return _CLASSES.get(name.split(".")[0].lower(), SemanticClass.OTHER)


def _part(read: ReadMesh, part_id: str) -> Part:
    """Polygons as a file has them; y up becomes z up."""
    points = read.points[read.corners]
    count = len(read.offsets) - 1
    names = [name or f"material {row + 1}" for row, (name, _) in enumerate(read.materials)]
    rows = _unique([(_class_of(name), Provenance.MEASURED, name) for name in names])
    return Part(
        id=part_id,
        positions_m=np.stack([points[:, 0], -points[:, 2], points[:, 1]], axis=1).astype(
            np.float32
        ),
        uv=np.zeros((len(points), 2), dtype=np.float32),
        ring_offsets=read.offsets.astype(np.int64),
        polygon_offsets=np.arange(count + 1, dtype=np.int64),
        polygon_feature=read.face_material.astype(np.int32),
        polygon_material=read.face_material.astype(np.int32),
        features=feature_table(part_id, rows),
        materials=tuple(
            Material(name, colour or (1.0, 1.0, 1.0))
            for name, (_, colour) in zip(names, read.materials, strict=True)
        ),
    )


def _unique(
    rows: Sequence[tuple[SemanticClass, Provenance, str]],
) -> list[tuple[SemanticClass, Provenance, str]]:
    seen: dict[str, int] = {}
    made = []
    for semantic, provenance, name in rows:
        count = seen[name] = seen.get(name, 0) + 1
        made.append((semantic, provenance, name if count == 1 else f"{name} ({count})"))
    return made
