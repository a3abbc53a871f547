"""A simulated street as the structure that `veduta.photos` works on."""

from __future__ import annotations

import numpy as np
import pycolmap

from veduta.photos.structure import Structure
from veduta.synthetic.camera import Camera
from veduta.synthetic.streets.house import Street
from veduta.synthetic.streets.plan import plan_street
from veduta.synthetic.streets.simulated import SimulatedStructure, Simulation, simulate
from veduta.synthetic.streets.walk import walk


def simulated_street(
    seed: int, simulation: Simulation | None = None, photos: int = 40
) -> tuple[Street, SimulatedStructure, Structure]:
    """A street, what photos of it would give with its truth, and that as columns of the verb."""
    street = plan_street(seed)
    simulated = simulate(street, walk(street, photos), seed, simulation)
    return street, simulated, structure_of_simulated(simulated)


def structure_of_simulated(simulated: SimulatedStructure) -> Structure:
    """The columns, with the true cameras; photos are `0001.jpg` and on, image ids 1 and on."""
    cameras: dict[int, pycolmap.Camera] = {}
    camera_of: dict[int, int] = {}
    known: dict[tuple[object, ...], int] = {}
    for row, camera in enumerate(simulated.cameras):
        key = (camera.width_px, camera.height_px, camera.focal_px, camera.distortion)
        number = known.setdefault(key, len(known) + 1)
        camera_of[row + 1] = number
        if number not in cameras:
            cameras[number] = engine_camera(camera, number)
    return Structure(
        cameras=cameras,
        camera_of=camera_of,
        image_ids=tuple(range(1, len(simulated.cameras) + 1)),
        names=tuple(photo_name(row) for row in range(len(simulated.cameras))),
        cam_from_world=simulated.cam_from_model,
        keypoints_px=simulated.keypoints_px,
        points=simulated.points,
        colours=simulated.colours,
        image_of=simulated.image_of,
        keypoint_of=simulated.keypoint_of,
        point_of=simulated.point_of,
    )


def photo_name(row: int) -> str:
    """Of the photo of a walk, by its row."""
    return f"{row + 1:04d}.jpg"


def engine_camera(camera: Camera, number: int = 1) -> pycolmap.Camera:
    """The engine's camera of the same lens."""
    lens = camera.distortion
    x, y = camera.centre_px
    across, down = (float(value) for value in camera.focals_px)
    if lens.is_none:
        model, params = "PINHOLE", [across, down, x, y]
    else:
        model, params = "OPENCV", [across, down, x, y, lens.k1, lens.k2, lens.p1, lens.p2]
    return pycolmap.Camera(
        camera_id=number,
        model=model,
        width=camera.width_px,
        height=camera.height_px,
        params=np.array(params),
    )
