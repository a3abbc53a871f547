"""A camera: x right, y down, z forward; the upper left pixel's centre is (0.5, 0.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.lens import NO_DISTORTION, Distortion

Points = NDArray[np.float64]
FILM_DIAGONAL_MM = 43.2666153


@dataclass(frozen=True)
class Camera:
    """Size and focal length in pixels; `cam_from_world` is 4x4 and rigid.

    distortion: of the lens; without it a pinhole with square pixels.
    """

    width_px: int
    height_px: int
    focal_px: float
    centre_px: tuple[float, float]
    cam_from_world: NDArray[np.float64]
    distortion: Distortion = NO_DISTORTION

    @property
    def focals_px(self) -> NDArray[np.float64]:
        """(2,) across and down."""
        return np.array([self.focal_px, self.focal_px * self.distortion.aspect])

    @property
    def intrinsics(self) -> NDArray[np.float64]:
        """K (3, 3): pixels from camera coordinates, but for what the lens bends."""
        (x, y), (across, down) = self.centre_px, self.focals_px
        return np.array([[across, 0, x], [0, down, y], [0, 0, 1]])

    @property
    def position_m(self) -> NDArray[np.float64]:
        """The centre of projection in the world (3,)."""
        rotation = self.cam_from_world[:3, :3]
        return -rotation.T @ self.cam_from_world[:3, 3]

    @property
    def focal_mm35(self) -> float:
        """35 mm equivalent focal length, by the diagonal (as EXIF has it)."""
        return self.focal_px * FILM_DIAGONAL_MM / float(np.hypot(self.width_px, self.height_px))

    def project(self, points_m: Points) -> tuple[Points, NDArray[np.float64]]:
        """World points (n, 3) to pixels (n, 2) and depths (n,); behind the camera is NaN pixels."""
        local = points_m @ self.cam_from_world[:3, :3].T + self.cam_from_world[:3, 3]
        depth = local[:, 2]
        safe = np.where(depth > 1e-9, depth, np.nan)[:, None]
        bent = self.distortion.bent(local[:, :2] / safe)
        return self.focals_px * bent + np.asarray(self.centre_px), depth

    def rays(self, pixels: Points) -> NDArray[np.float64]:
        """World directions (n, 3) through pixels (n, 2); their depth along z forward is 1."""
        local = np.empty((len(pixels), 3))
        bent = (pixels - np.asarray(self.centre_px)) / self.focals_px
        local[:, :2] = self.distortion.straight(bent)
        local[:, 2] = 1.0
        return np.asarray(local @ self.cam_from_world[:3, :3], np.float64)

    def image_from_plane(self, origin_m: Points, u_m: Points, v_m: Points) -> NDArray[np.float64]:
        """The homography (3, 3) from plane coordinates (a, b), the point origin + a u + b v."""
        columns = np.stack([u_m, v_m, origin_m], axis=1)
        moved = self.cam_from_world[:3, :3] @ columns
        moved[:, 2] += self.cam_from_world[:3, 3]
        homography = self.intrinsics @ moved
        return np.asarray(homography / homography[2, 2], np.float64)


def look_at(
    eye_m: tuple[float, float, float],
    target_m: tuple[float, float, float],
    size_px: tuple[int, int],
    focal_px: float,
    roll_rad: float = 0.0,
) -> Camera:
    """A camera at `eye_m` whose axis passes through `target_m`; z of the world is up.

    A positive roll turns the camera clockwise, so that the picture turns counter-clockwise.
    """
    eye, target = np.asarray(eye_m, np.float64), np.asarray(target_m, np.float64)
    forward = target - eye
    forward /= np.linalg.norm(forward)
    middle_px = (size_px[0] / 2, size_px[1] / 2)
    return Camera(size_px[0], size_px[1], focal_px, middle_px, pose_along(eye, forward, roll_rad))


def pose_along(
    eye: NDArray[np.float64], forward: NDArray[np.float64], roll_rad: float = 0.0
) -> NDArray[np.float64]:
    """(4, 4) of what is at `eye` (3,) and whose z is the unit vector `forward`, as of `look_at`."""
    right = np.cross(forward, [0.0, 0.0, 1.0])
    if np.linalg.norm(right) < 1e-9:
        right = np.array([1.0, 0.0, 0.0])
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    c, s = np.cos(roll_rad), np.sin(roll_rad)
    rotation = np.stack([c * right + s * down, -s * right + c * down, forward])
    found = np.eye(4)
    found[:3, :3] = rotation
    found[:3, 3] = -rotation @ eye
    return found
