"""How a place stands whose cameras do not say where the ground is: z up, the lowest points at 0."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.cameras import CameraSet

CLEAR = 0.5
"""Length of the mean of what is up in the photos, below which they do not say it."""
LOWEST = 0.01
"""Share of the points that may lie below the ground: a few are wrong."""


def place_from_cameras(
    cameras: CameraSet, points_m: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(4, 4) from the cameras' frame to the place's; one where the set lies on the earth.

    Without a word of the source, up is the mean of the photos' up, as people hold cameras level. The
    turn takes axes to axes, so that the given coordinates are told by their order and sign.
    """
    made = np.eye(4)
    if cameras.crs is not None:
        return made
    if cameras.up is not None:
        up = np.array(cameras.up)
    else:
        up = -np.stack([one.cam_from_world[1, :3] for one in cameras.cameras]).mean(axis=0)
    axis = int(np.abs(up).argmax())
    if np.linalg.norm(up) >= CLEAR:
        made[:3, :3] = _axis_to_z(axis, float(np.sign(up[axis])))
    heights = points_m @ made[2, :3]
    made[2, 3] = -float(np.round(np.quantile(heights, LOWEST), 3))
    return made


def _axis_to_z(axis: int, sign: float) -> NDArray[np.float64]:
    """The turn that takes an axis to +z, and axes to axes."""
    if axis == 2:
        return np.diag([1.0, sign, sign])
    turn = np.zeros((3, 3))
    turn[2, axis] = sign
    turn[0, 1 - axis] = 1.0
    turn[1, 2] = 1.0
    if np.linalg.det(turn) < 0.0:
        turn[1, 2] = -1.0
    return turn


def told_axes(turn: NDArray[np.float64]) -> str:
    """Which axes of the cameras' frame x, y and z of the place are: "x, -y, -z"."""
    found = []
    for row in turn:
        axis = int(np.abs(row).argmax())
        found.append(f"{'-' if row[axis] < 0 else ''}{'xyz'[axis]}")
    return ", ".join(found)
