"""The carved object as a part of a place, standing on the ground, with the cameras around it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera, CameraSet
from veduta.carve.views import View
from veduta.place.features import feature_table
from veduta.place.manifest import PlaceCamera
from veduta.place.material import Material
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing
from veduta.place.semantics import Provenance, SemanticClass

Floats = NDArray[np.float64]
HULL, CARVED = 0, 1
PHOTOS = "photos"


@dataclass(frozen=True, eq=False)
class Shape:
    """positions: (v, 3) m. triangles: (m, 3). colours: (v, 3) uint8. carved: (m,) by their colours."""

    positions: Floats
    triangles: NDArray[np.uint32]
    colours: NDArray[np.uint8]
    carved: NDArray[np.bool_]


def object_mesh(name: str, shape: Shape, shift: Floats) -> Mesh:
    """Two features: what the silhouettes bound (inferred: a concavity may lie behind it), and what
    the colours carved (measured). shift: the part's origin in the cameras' frame.
    """
    rows = [
        (SemanticClass.OTHER, Provenance.INFERRED, "hull"),
        (SemanticClass.OTHER, Provenance.MEASURED, "carved by colour"),
    ]
    return Mesh(
        id=name,
        positions_m=(shape.positions - shift).astype(np.float32),
        triangles=shape.triangles,
        features=feature_table(name, rows),
        materials=(Material("photos"),),
        triangle_feature=np.where(shape.carved, CARVED, HULL).astype(np.int32),
        triangle_material=np.zeros(len(shape.triangles), dtype=np.int32),
        colours=shape.colours,
    )


def base_of(positions: Floats) -> Floats:
    """(3,) the middle of the lower side of the box around the object."""
    low, high = positions.min(axis=0), positions.max(axis=0)
    return np.array([(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0, low[2]])


def place_of(mesh: Mesh, views: Sequence[View], cameras: CameraSet, shift: Floats) -> Place:
    """The object with its base at the origin, or where the cameras' own frame has it (`shift` 0)."""
    moved = np.eye(4)
    moved[:3, 3] = -shift
    place = Place(title=mesh.id, scale=cameras.scale, crs=cameras.crs, origin_m=cameras.origin_m)
    place.add(mesh, Standing(name=mesh.id))
    place.cameras = [
        _camera(number, view.camera.moved(moved)) for number, view in enumerate(views)
    ]
    return place


def photo_name(number: int) -> str:
    """The file of a view's photo in the place's folder."""
    return f"{PHOTOS}/{number:04d}.jpg"


def _camera(number: int, camera: Camera) -> PlaceCamera:
    matrix = np.eye(4)
    matrix[:3, :3] = camera.cam_from_world[:, :3].T
    matrix[:3, 3] = camera.centre()
    return PlaceCamera(
        id=f"view-{number}",
        name=camera.name,
        picture=photo_name(number),
        width_px=camera.width_px,
        height_px=camera.height_px,
        focal_px=camera.focal_px,
        centre_px=camera.centre_px,
        transform=tuple(matrix.T.ravel().tolist()),
    )
