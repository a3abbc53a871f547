"""A pinhole camera in front of a vertical plane, and what it does to directions.

Camera frame: x right, y down, z forward. Facade frame here: x right along the wall, y down the
wall, z into it (a camera that looks straight at the wall has the identity rotation). The
rotation is cam_from_facade = Rz(roll) Rx(pitch) Ry(yaw): the wall turns about its own vertical,
then the camera tilts, then it rolls. Square pixels.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.homography import Matrix, Points

Rotation = NDArray[np.float64]


@dataclass(frozen=True)
class FacadeView:
    """Where a camera looks at a wall: angles in radians, focal length and centre in pixels."""

    yaw: float
    pitch: float
    roll: float
    focal_px: float
    centre_x_px: float
    centre_y_px: float

    def rotation(self) -> Rotation:
        """cam_from_facade, 3x3."""
        return rotation_from_angles(self.yaw, self.pitch, self.roll)

    def camera(self) -> Matrix:
        """The camera matrix K, 3x3."""
        return camera_matrix(self.focal_px, self.centre_x_px, self.centre_y_px)


def camera_matrix(focal_px: float, centre_x_px: float, centre_y_px: float) -> Matrix:
    """K of a camera with square pixels."""
    return np.array([[focal_px, 0.0, centre_x_px], [0.0, focal_px, centre_y_px], [0.0, 0.0, 1.0]])


def rotation_from_angles(yaw: float, pitch: float, roll: float) -> Rotation:
    """cam_from_facade = Rz(roll) Rx(pitch) Ry(yaw), radians."""
    cy, sy = math.cos(yaw), math.sin(yaw)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cr, sr = math.cos(roll), math.sin(roll)
    about_y = np.array([[cy, 0.0, sy], [0.0, 1.0, 0.0], [-sy, 0.0, cy]])
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cp, -sp], [0.0, sp, cp]])
    about_z = np.array([[cr, -sr, 0.0], [sr, cr, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(about_z @ about_x @ about_y, dtype=np.float64)


def angles_from_rotation(cam_from_facade: Rotation) -> tuple[float, float, float]:
    """Yaw, pitch, roll of a rotation (pitch within a quarter turn)."""
    down = cam_from_facade[:, 1]
    pitch = math.asin(max(-1.0, min(1.0, float(down[2]))))
    roll = math.atan2(-float(down[0]), float(down[1]))
    right = rotation_from_angles(0.0, pitch, roll).T @ cam_from_facade[:, 0]
    return math.atan2(-float(right[2]), float(right[0])), pitch, roll


def rotation_from_vanishing_points(
    camera: Matrix, horizontal: NDArray[np.float64], vertical: NDArray[np.float64]
) -> Rotation | None:
    """cam_from_facade whose down axis is exactly that of `vertical`, its right axis nearest.

    Both are homogeneous pixel points. None when the two are the same direction. The axes point
    right and down as seen from the camera.
    """
    down = np.linalg.solve(camera, vertical)
    right = np.linalg.solve(camera, horizontal)
    down = down / np.linalg.norm(down) * (1.0 if down[1] >= 0 else -1.0)
    right = right - (right @ down) * down
    length = float(np.linalg.norm(right))
    if length < 1e-6 * float(np.linalg.norm(horizontal)) or length == 0.0:
        return None
    right = right / length * (1.0 if right[0] >= 0 else -1.0)
    return np.stack([right, down, np.cross(right, down)], axis=1)


def plane_from_image(view: FacadeView) -> Matrix:
    """Takes pixels to the wall's plane, in units of the camera's distance along the wall's normal.

    (x, y) = (R^T K^-1 p)_xy / (R^T K^-1 p)_z: x right, y down, the foot of the normal at (0, 0).
    """
    return np.asarray(view.rotation().T @ np.linalg.inv(view.camera()), dtype=np.float64)


def angles_to_vanishing_point(
    midpoints: Points, directions: Points, point: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n,) signed angles (radians, -pi/2..pi/2) from segments to a homogeneous vanishing point.

    `directions` are unit vectors; the sign of a direction does not matter.
    """
    towards_x = point[0] - midpoints[:, 0] * point[2]
    towards_y = point[1] - midpoints[:, 1] * point[2]
    cross = directions[:, 0] * towards_y - directions[:, 1] * towards_x
    dot = directions[:, 0] * towards_x + directions[:, 1] * towards_y
    return np.asarray(np.arctan2(np.where(dot < 0, -cross, cross), np.abs(dot)))


def focal_from_orthogonal(
    first: NDArray[np.float64], second: NDArray[np.float64], centre_px: tuple[float, float]
) -> float | None:
    """Focal length (px) under which two homogeneous vanishing points are orthogonal directions.

    f^2 = -(v1 - c) . (v2 - c) (Hartley and Zisserman, 8.26); None where that is not positive or
    a point is at infinity (then any focal length or none will do).
    """
    if abs(first[2]) < 1e-12 or abs(second[2]) < 1e-12:
        return None
    a = first[:2] / first[2] - np.asarray(centre_px)
    b = second[:2] / second[2] - np.asarray(centre_px)
    squared = -float(a @ b)
    return math.sqrt(squared) if squared > 0 else None


def axis_angles(directions: Points) -> NDArray[np.float64]:
    """(n,) absolute angles (radians, 0..pi/4) of directions to the nearer image axis."""
    x, y = np.abs(directions[:, 0]), np.abs(directions[:, 1])
    return np.asarray(np.arctan2(np.minimum(x, y), np.maximum(x, y)))
