"""Which way is up: cameras that go round an object lie on a ring, whose axis is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import CameraSet

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class UprightRule:
    """flat: the cameras' shift across their plane, of that along it, up to which they lie on a ring.
    least_cameras: fewer have no ring.
    """

    flat: float = 0.2
    least_cameras: int = 4


def find_up(cameras: CameraSet, rule: UprightRule | None = None) -> Floats | None:
    """(3,) the unit vector that points up in the cameras' frame; None where nothing tells.

    What the source says counts first; then the axis of the cameras' ring, on the side to which the
    photos' upper edges point; then those edges alone.
    """
    rule = rule or UprightRule()
    if cameras.up is not None:
        return np.array(cameras.up)
    edges = -np.array([camera.cam_from_world[1, :3] for camera in cameras.cameras])
    mean = edges.mean(axis=0)
    centres = cameras.centres
    if len(centres) >= rule.least_cameras:
        _, spread, axes = np.linalg.svd(centres - centres.mean(axis=0), full_matrices=False)
        if spread[2] < rule.flat * spread[1]:
            axis = axes[2]
            return np.asarray(axis if axis @ mean >= 0.0 else -axis)
    length = float(np.linalg.norm(mean))
    return None if length < 0.3 else mean / length


def turn_upright(cameras: CameraSet) -> CameraSet:
    """The cameras in a world whose z points up; as they are where nothing tells."""
    up = find_up(cameras)
    if up is None:
        return cameras
    # The first axis stays as near to the old one as it can.
    first = np.eye(3)[int(np.argmin(np.abs(up)))]
    first = first - (first @ up) * up
    first /= np.linalg.norm(first)
    turn = np.eye(4)
    turn[:3, :3] = np.array([first, np.cross(up, first), up])
    return cameras.moved(turn)
