"""A city model whose walls and roofs the cloud is held against."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyproj
from numpy.typing import NDArray

from veduta import _core
from veduta.cameras import CameraSet
from veduta.dense.document import CityMesh
from veduta.formats.building_faces import BuildingFaces, CityFile, Rings
from veduta.formats.cityjson_read import read_cityjson
from veduta.geometry.crs import way_between
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

MOST_BEND_M = 0.5
"""A surface whose corners lie farther off a plane is left out, as `veduta photos` does."""
LOOKS_DOWN = 0.9
"""A house stands on a surface without a class whose normal's z is less than minus this."""
Vertices = NDArray[np.float64]


def read_city_mesh(path: Path, cameras: CameraSet) -> CityMesh:
    """The buildings of a CityJSON file but for the surfaces that they stand on, which no photo
    shows, about the cameras' origin and in their coordinate system.

    InputError where the cameras lie nowhere on the earth, and where the file has no building that
    can be used.
    """
    if cameras.crs is None:
        raise InputError(
            "--model",
            "needs cameras that lie in a coordinate system of the earth",
            "Lay the photos into the model with `veduta photos DIR --model`, and give that result.",
        )
    file = read_cityjson(path)
    way, notes = _way(path, file, cameras.crs)
    left = 0
    positions: list[Vertices] = []
    triangles: list[NDArray[np.uint32]] = []
    start = 0
    for building in file.buildings:
        polygons = [
            tuple(_moved(ring, way) - np.asarray(cameras.origin_m) for ring in rings)
            for rings in building.polygons
        ]
        found, faces, lost = _triangles(polygons, building)
        left += lost
        if len(faces):
            positions.append(found)
            triangles.append(faces + np.uint32(start))
            start += len(found)
    if not triangles:
        reason = f" ({file.left[0][0]}: {file.left[0][1]})" if file.left else ""
        raise InputError(path, f"has no building that can be used{reason}", "Give another model.")
    if left:
        notes.append(f"{left} surfaces of the model are no plane polygons: they are left out")
    if file.left:
        notes.append(f"{len(file.left)} buildings of the model are left out")
    return CityMesh(
        np.concatenate(positions), np.concatenate(triangles), len(triangles), tuple(notes)
    )


def _way(path: Path, file: CityFile, crs: str) -> tuple[pyproj.Transformer | None, list[str]]:
    """From the file's coordinate system to that of the cameras; None where they are one."""
    if file.epsg is None:
        return None, [f"{path.name} names no coordinate system: it is taken for that of the photos"]
    own = f"EPSG:{file.epsg}"
    try:
        found = way_between(own, crs)
    except pyproj.exceptions.ProjError as error:
        fault = f"is in {own}, which cannot be converted to the photos' {crs}"
        raise InputError(path, fault, "Convert it before.") from error
    if found is None:
        return None, []
    return found, [f"the model was converted from {own} to {crs}; its heights stay as they are"]


def _moved(ring: Vertices, way: pyproj.Transformer | None) -> Vertices:
    if way is None:
        return ring
    east, north = way.transform(ring[:, 0], ring[:, 1])
    return np.column_stack([east, north, ring[:, 2]])


def _triangles(
    polygons: list[Rings], building: BuildingFaces
) -> tuple[Vertices, NDArray[np.uint32], int]:
    """Those of a building that are seen, and how many of its surfaces are left out."""
    columns = _columns(polygons)
    sound = _core.sound_polygons(*columns, MOST_BEND_M)
    lost = int((~sound).sum())
    rows = np.flatnonzero(sound)
    if not len(rows):
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.uint32), lost
    points, rings, ends = _columns([polygons[row] for row in rows.tolist()])
    faces, polygon, normals, _ = _core.triangulate_polygons(points, rings, ends, MOST_BEND_M)
    if building.solid and _volume(points, faces) < 0.0:
        faces, normals = faces[:, ::-1], -normals
    stands = np.array(
        [
            building.classes[row] is SemanticClass.GROUND
            or (building.classes[row] is None and normal < -LOOKS_DOWN)
            for row, normal in zip(rows.tolist(), normals[:, 2].tolist(), strict=True)
        ]
    )
    return points, np.ascontiguousarray(faces[~stands[polygon]]), lost


def _columns(
    polygons: list[Rings],
) -> tuple[Vertices, NDArray[np.int64], NDArray[np.int64]]:
    rings = [ring for one in polygons for ring in one]
    sizes = np.cumsum([0, *(len(ring) for ring in rings)]).astype(np.int64)
    return np.concatenate(rings), sizes, np.cumsum([0, *map(len, polygons)]).astype(np.int64)


def _volume(points: Vertices, faces: NDArray[np.uint32]) -> float:
    """Six times the volume that faces counter-clockwise seen from outside close."""
    a, b, c = (points[faces[:, corner]] - points.mean(axis=0) for corner in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c)))
