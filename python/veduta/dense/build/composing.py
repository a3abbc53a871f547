"""The place: the mesh, the cloud and the cameras with their photos."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera, CameraSet
from veduta.dense.build.cloud import DenseCloud
from veduta.dense.document import Views
from veduta.place.manifest import PlaceCamera, Start
from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, Place, Standing

MOST_SHOWN_POINTS = 1_500_000
"""Points of the cloud in the place; the files of the cloud have all of them."""
MESH, POINTS, DISTANCES = "surface", "points", "distances"


def compose(
    title: str,
    cameras: CameraSet,
    cloud: DenseCloud,
    mesh: tuple[Mesh, NDArray[np.float64]] | None,
    seed: int,
    tints: NDArray[np.uint8] | None = None,
) -> Place:
    """mesh: about its own origin, and where that lies (m). tints: (n, 3) the cloud's colours by its
    distances from a city model, where there is one.
    """
    place = Place(title=title, crs=cameras.crs, origin_m=cameras.origin_m)
    place.scale = "metres" if cameras.scale == "metres" else "unknown"
    if mesh is not None:
        transform = np.eye(4)
        transform[:3, 3] = mesh[1]
        place.add(mesh[0], Standing(name=title, transform=transform))
    points, colours = cloud.points_m, cloud.colours
    if len(points) > MOST_SHOWN_POINTS:
        draw = np.random.default_rng(seed)
        kept = np.sort(draw.choice(len(points), MOST_SHOWN_POINTS, replace=False))
        points, colours = points[kept], colours[kept]
        tints = None if tints is None else tints[kept]
    place.clouds.append(Cloud(POINTS, points, colours))
    if tints is not None:
        place.clouds.append(Cloud(DISTANCES, points, tints, layer="distances"))
    return place


def start_at(views: Views, order: list[int], depth_m: dict[int, float]) -> Start | None:
    """Behind the photo that stands in the middle of the others, looking where it looks.

    depth_m: the middle depth of each view.
    """
    known = [view for view in order if view in depth_m]
    if not known:
        return None
    eyes = np.stack([views.cameras[view].centre() for view in known])
    middle = int(np.linalg.norm(eyes - np.median(eyes, axis=0), axis=1).argmin())
    ahead = views.cameras[known[middle]].cam_from_world[2, :3]
    depth = depth_m[known[middle]]
    # Around an object one steps back to see all photos; in a street there is no room behind.
    room = float(np.median(np.linalg.norm(eyes - eyes[middle], axis=1)))
    back = min(0.35 * depth, 0.5 * room)
    eye, target = eyes[middle] - back * ahead, eyes[middle] + depth * ahead
    return Start(eye=_vector(eye), target=_vector(target))


def stand_up(place: Place, stand: NDArray[np.float64]) -> Place:
    """The place moved as a whole. stand: (4, 4), a turn and a shift."""
    turn, shift = stand[:3, :3], stand[:3, 3]
    for placed in place.parts.values():
        placed.standing = replace(placed.standing, transform=stand @ placed.standing.transform)
    place.clouds = [
        replace(one, points_m=one.points_m @ turn.T + shift) for one in place.clouds
    ]
    place.cameras = [_moved_camera(one, stand) for one in place.cameras]
    if place.start is not None:
        eye, target = (turn @ np.array(one) + shift for one in (place.start.eye, place.start.target))
        place.start = Start(eye=_vector(eye), target=_vector(target))
    return place


def _moved_camera(camera: PlaceCamera, stand: NDArray[np.float64]) -> PlaceCamera:
    matrix = stand @ np.array(camera.transform).reshape(4, 4).T
    return camera.model_copy(update={"transform": tuple(matrix.T.ravel().tolist())})


def _vector(point: NDArray[np.float64]) -> tuple[float, float, float]:
    return float(point[0]), float(point[1]), float(point[2])


def place_cameras(views: Views, pictures: dict[int, Path]) -> list[PlaceCamera]:
    """The cameras as the place has them. pictures: of each, relative to the place's folder."""
    return [_place_camera(views.cameras[view], file) for view, file in sorted(pictures.items())]


def _place_camera(camera: Camera, file: Path) -> PlaceCamera:
    world = np.eye(4)
    turn = camera.cam_from_world[:, :3]
    world[:3, :3] = turn.T
    world[:3, 3] = camera.centre()
    return PlaceCamera(
        id=file.stem,
        name=camera.name,
        picture=file.as_posix(),
        width_px=camera.width_px,
        height_px=camera.height_px,
        focal_px=(float(camera.focal_px[0]), float(camera.focal_px[1])),
        centre_px=(float(camera.centre_px[0]), float(camera.centre_px[1])),
        transform=tuple(world.T.ravel().tolist()),
    )
