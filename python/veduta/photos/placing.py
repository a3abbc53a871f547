"""The place of a component: its points, and its photos where they were taken."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.photos.pictures import Pinhole, picture_name
from veduta.photos.structure import Structure
from veduta.place.manifest import Bounds, Place, PlaceCamera, PlacePoints, Start, Vector

POINTS = "points.ply"
PICTURES = "pictures"
STRAY_SHARE = 0.02
"""Share of the points at each end of each axis that the bounds leave out: a few lie far off."""


def place_of(structure: Structure, cameras: Sequence[Pinhole]) -> Place:
    """The manifest of one component; its unit of length is not known."""
    low, high = np.quantile(structure.points, [STRAY_SHARE, 1.0 - STRAY_SHARE], axis=0)
    centres = structure.centres()
    low, high = np.minimum(low, centres.min(axis=0)), np.maximum(high, centres.max(axis=0))
    middle = structure.cam_from_world[len(centres) // 2]
    eye = centres[len(centres) // 2]
    return Place(
        parts=[],
        points=[
            PlacePoints(
                id="points",
                file=POINTS,
                count=len(structure.points),
                bounds=Bounds(min=_vector(low), max=_vector(high)),
            )
        ],
        cameras=[_camera(structure, row, camera) for row, camera in enumerate(cameras)],
        scale="unknown",
        start=Start(eye=_vector(eye), target=_vector(eye + middle[2, :3])),
    )


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
