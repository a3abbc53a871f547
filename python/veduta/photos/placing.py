"""The place of a component: its points, and its photos where they were taken."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.photos.pictures import picture_name
from veduta.photos.straight import Pinhole
from veduta.photos.structure import Structure
from veduta.photos.texture.step import Textured
from veduta.photos.walls.part import add_walls
from veduta.photos.world.georeference import Georeference
from veduta.place.manifest import PlaceCamera, Start, Vector
from veduta.place.part import Part
from veduta.place.place import Cloud, Place

POINTS = "points"
CLOUD = "points.laz"
PICTURES = "pictures"


def place_of(
    structure: Structure,
    cameras: Sequence[Pinhole],
    walls: Part | None = None,
    world: Georeference | None = None,
    textured: Textured | None = None,
) -> Place:
    """The place of one component, with the city model's buildings and its walls as parts.

    The unit of length is known where the component lies in the world. The models of buildings are
    written already, as `textured` says.
    """
    low, high = structure.seen_box()
    centres = structure.centres()
    middle = structure.cam_from_world[len(centres) // 2]
    eye = centres[len(centres) // 2]
    seen = (_vector(low), _vector(high))
    place = Place(
        clouds=[Cloud(POINTS, structure.points, structure.colours, seen_m=seen)],
        cameras=[_camera(structure, row, camera) for row, camera in enumerate(cameras)],
        crs=None if world is None else world.crs,
        origin_m=(0.0, 0.0, 0.0) if world is None else world.origin_m,
        scale="unknown" if world is None else "metres",
        start=Start(eye=_vector(eye), target=_vector(eye + middle[2, :3])),
    )
    if textured is not None:
        for building in textured.parts:
            place.lay(building, textured.folder)
    if walls is not None:
        add_walls(place, walls)
    return place


def _camera(structure: Structure, row: int, pinhole: Pinhole) -> PlaceCamera:
    world_from_camera = np.eye(4)
    rotation = structure.cam_from_world[row, :, :3]
    world_from_camera[:3, :3] = rotation.T
    world_from_camera[:3, 3] = structure.centres()[row]
    image_id = structure.image_ids[row]
    return PlaceCamera(
        id=f"photo-{image_id:04d}",
        name=structure.names[row],
        picture=f"{PICTURES}/{picture_name(image_id)}",
        width_px=pinhole.width_px,
        height_px=pinhole.height_px,
        focal_px=pinhole.focal_px,
        centre_px=pinhole.centre_px,
        transform=tuple(world_from_camera.T.ravel().tolist()),
    )


def _vector(values: np.ndarray) -> Vector:
    x, y, z = (float(value) for value in values)
    return (x, y, z)
