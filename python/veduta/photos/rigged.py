"""Photos of rigs in the engine's model: those of one frame share a pose, whatever is adjusted.

How the cameras are fixed to each other is read off the poses themselves: all frames of a structure
that came from the engine say the same. So no step that turns, scales or thins a structure has to
know of rigs.
"""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pycolmap
from numpy.typing import NDArray

Floats = NDArray[np.float64]

NO_LENGTH = 1e-9
"""Poses of one place, worked out from matrices, are not quite at 0."""


@dataclass(frozen=True)
class RigFound:
    """Cameras that frames tie together: (3, 4) cam_from_rig by camera id; the first is the rig's.

    frames: image ids of each frame by its number, those of one camera alone included.
    """

    cam_from_rig: Mapping[int, Floats]
    frames: Mapping[int, tuple[int, ...]]


def rigs_among(
    poses: Mapping[int, Floats],
    camera_of: Mapping[int, int],
    frame_of: Mapping[int, int],
    first: Container[int] = (),
) -> list[RigFound]:
    """The rigs of photos, by the least camera id. poses: (3, 4) cam_from_world by image id.

    Cameras that no frame ties to another are of no rig, and their photos free. first: cameras of
    which one is the rig's, where it has any.
    """
    frames: dict[int, dict[int, int]] = {}
    for image in sorted(frame_of.keys() & poses.keys()):
        frames.setdefault(frame_of[image], {})[camera_of[image]] = image
    waiting = sorted({camera for images in frames.values() for camera in images})
    found = []
    while waiting:
        known = _tied_to(waiting[0], list(frames.values()), poses)
        waiting = [camera for camera in waiting if camera not in known]
        own = {
            number: tuple(sorted(image for camera, image in images.items() if camera in known))
            for number, images in frames.items()
            if images.keys() & known.keys()
        }
        if len(known) > 1:
            order = sorted(known, key=lambda camera: (camera not in first, camera))
            base = known[order[0]]
            found.append(RigFound({one: between(base, known[one]) for one in order}, own))
    return found


def _tied_to(
    first: int, frames: Sequence[Mapping[int, int]], poses: Mapping[int, Floats]
) -> dict[int, Floats]:
    """(3, 4) cam_from_rig of all cameras that frames tie to the first, which is the rig's.

    frames: the image id by camera id, of each.
    """
    known = {first: np.eye(3, 4)}
    count = 0
    while count < len(known):
        count = len(known)
        for images in frames:
            for camera in images:
                base = next((other for other in images if other in known), None)
                if base is not None and camera not in known:
                    tie = between(poses[images[base]], poses[images[camera]])
                    known[camera] = after(tie, known[base])
    return known


def rig_of(number: int, cam_from_rig: Mapping[int, Floats]) -> pycolmap.Rig:
    """The engine's rig of cameras by their ids; the first of them is its reference."""
    rig = pycolmap.Rig(rig_id=number)
    order = list(cam_from_rig)
    for camera in order:
        sensor = pycolmap.sensor_t(type=pycolmap.SensorType.CAMERA, id=camera)
        if camera == order[0]:
            rig.add_ref_sensor(sensor)
            continue
        pose = between(cam_from_rig[order[0]], cam_from_rig[camera])
        rig.add_sensor(sensor, pycolmap.Rigid3d(pose))
    return rig


def add_rig(
    model: pycolmap.Reconstruction,
    rig: RigFound,
    number: int,
    images: Mapping[int, pycolmap.Image],
    poses: Mapping[int, Floats],
) -> None:
    """A rig and its photos into a model that has its cameras. number: of the rig."""
    model.add_rig(rig_of(number, rig.cam_from_rig))
    for frame_id, members in sorted(rig.frames.items()):
        frame = pycolmap.Frame(frame_id=frame_id, rig_id=number)
        for image_id in members:
            frame.add_data_id(images[image_id].data_id)
        first = members[0]
        camera_from_rig = rig.cam_from_rig[images[first].camera_id]
        inverse = between(camera_from_rig, np.eye(3, 4))
        frame.rig_from_world = pycolmap.Rigid3d(after(inverse, poses[first]))
        model.add_frame(frame)
        for image_id in members:
            images[image_id].frame_id = frame_id
            model.add_image(images[image_id])
        model.register_frame(frame_id)


def fixed_to_each_other(
    model: pycolmap.Reconstruction, bodies: Mapping[int, str]
) -> list[pycolmap.sensor_t]:
    """The sensors whose places on their rig are known: those of the body of its reference.

    bodies: of cameras by their ids.
    """
    return [
        sensor
        for rig in model.rigs.values()
        if rig.num_sensors() > 1 and rig.ref_sensor_id.id in bodies
        for sensor in rig.non_ref_sensors
        if bodies.get(sensor.id) == bodies[rig.ref_sensor_id.id]
    ]


def has_length(model: pycolmap.Reconstruction) -> bool:
    """Whether some cameras of a rig stand apart from each other: panoramas alone do not."""
    return any(
        pose is not None and np.linalg.norm(pose.translation) > NO_LENGTH
        for rig in model.rigs.values()
        for pose in rig.non_ref_sensors.values()
    )


def frames_in(model: pycolmap.Reconstruction) -> dict[int, int]:
    """The frame of each photo of a model whose camera is one of several of a rig."""
    several = {number for number, rig in model.rigs.items() if rig.num_sensors() > 1}
    return {
        int(data.id): int(number)
        for number, frame in model.frames.items()
        if frame.rig_id in several
        for data in frame.data_ids
    }


def between(first: Floats, second: Floats) -> Floats:
    """(3, 4) second_from_first of two `from_world`."""
    rotation = second[:, :3] @ first[:, :3].T
    return np.column_stack([rotation, second[:, 3] - rotation @ first[:, 3]])


def after(outer: Floats, inner: Floats) -> Floats:
    """(3, 4) outer of inner."""
    return np.column_stack([outer[:, :3] @ inner[:, :3], outer[:, :3] @ inner[:, 3] + outer[:, 3]])


def mean_pose(each: Floats) -> Floats:
    """(3, 4) in the middle of (n, 3, 4) poses of one camera: the mean of their turns and places."""
    left, _, right = np.linalg.svd(each[:, :, :3].sum(axis=0))
    turn = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
    centre = -np.einsum("nji,nj->ni", each[:, :, :3], each[:, :, 3]).mean(axis=0)
    return np.column_stack([turn, -turn @ centre])
