"""A camera that took a picture, and a set of them: what every reader gives and every verb takes.

Camera frame: x right, y down, z forward. Pixels: the middle of the upper left one is (0.5, 0.5).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Literal

import cv2
import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Scale = Literal["metres", "unknown"]
LENS_NUMBERS = (0, 4, 5, 8)
"""Numbers of a distortion: none, k1 k2 p1 p2, with k3, with k4 k5 k6 (OpenCV's rational model)."""


@dataclass(frozen=True, eq=False)
class Camera:
    """A camera with its lens, and the picture that it took, if that is there.

    focal_px, centre_px: along x and y. cam_from_world: (3, 4). distortion: as `LENS_NUMBERS`.
    skew_px: the matrix's second number, which no real camera has and some calibrations do.
    picture: upright, of this size.
    """

    name: str
    width_px: int
    height_px: int
    focal_px: tuple[float, float]
    centre_px: tuple[float, float]
    cam_from_world: Floats
    distortion: tuple[float, ...] = ()
    picture: Path | None = None
    skew_px: float = 0.0

    def __post_init__(self) -> None:
        if self.cam_from_world.shape != (3, 4) or not np.isfinite(self.cam_from_world).all():
            raise ValueError(f"camera {self.name!r}: its pose is no (3, 4) matrix of numbers")
        if len(self.distortion) not in LENS_NUMBERS:
            raise ValueError(f"camera {self.name!r}: {len(self.distortion)} numbers for its lens")

    @property
    def distorted(self) -> bool:
        """Whether straight lines are bent or sheared in its picture."""
        return any(self.distortion) or self.skew_px != 0.0

    def matrix(self) -> Floats:
        """K (3, 3): px from the camera frame."""
        return np.array(
            [
                [self.focal_px[0], self.skew_px, self.centre_px[0]],
                [0.0, self.focal_px[1], self.centre_px[1]],
                [0.0, 0.0, 1.0],
            ]
        )

    def projection(self) -> Floats:
        """P (3, 4): K times the pose; px of a lens without distortion."""
        return self.matrix() @ self.cam_from_world

    def centre(self) -> Floats:
        """(3,) where it stands in the world."""
        turn, shift = self.cam_from_world[:, :3], self.cam_from_world[:, 3]
        return np.asarray(-turn.T @ shift)

    def project(self, points: ArrayLike) -> tuple[Floats, Floats]:
        """Where (n, 3) points of the world are in the picture: (n, 2) px, and (n,) depth.

        The depth is along the axis, in the world's unit: where it is not positive, the place says
        nothing.
        """
        world = np.asarray(points, dtype=np.float64).reshape(-1, 3)
        local = world @ self.cam_from_world[:, :3].T + self.cam_from_world[:, 3]
        depth = local[:, 2]
        plane = local[:, :2] / np.where(depth == 0.0, np.finfo(np.float64).tiny, depth)[:, None]
        return self.pixels_of(plane), depth

    def pixels_of(self, plane: Floats) -> Floats:
        """(n, 2) px of (n, 2) places in the plane one unit before an ideal camera."""
        if any(self.distortion) and len(plane):
            ahead = np.column_stack([plane, np.ones(len(plane))])
            none = np.zeros(3)
            lens = np.asarray(self.distortion)
            bent, _ = cv2.projectPoints(ahead, none, none, np.eye(3), lens)
            plane = np.asarray(bent, dtype=np.float64).reshape(-1, 2)
        skewed = np.stack(
            [
                plane[:, 0] * self.focal_px[0] + plane[:, 1] * self.skew_px,
                plane[:, 1] * self.focal_px[1],
            ],
            axis=1,
        )
        return np.asarray(skewed + np.array(self.centre_px))

    def plane_of(self, pixels: ArrayLike) -> Floats:
        """(n, 2) places in the plane one unit before the camera, of (n, 2) px."""
        moved = np.asarray(pixels, dtype=np.float64).reshape(-1, 2) - np.array(self.centre_px)
        y = moved[:, 1] / self.focal_px[1]
        plane = np.stack([(moved[:, 0] - self.skew_px * y) / self.focal_px[0], y], axis=1)
        if not any(self.distortion) or not len(plane):
            return plane
        rounds = (cv2.TERM_CRITERIA_COUNT | cv2.TERM_CRITERIA_EPS, 60, 1e-12)
        lens = np.asarray(self.distortion)
        flat = cv2.undistortPoints(plane[:, None], np.eye(3), lens, criteria=rounds)
        return np.asarray(flat, dtype=np.float64).reshape(-1, 2)

    def rays(self, pixels: ArrayLike) -> tuple[Floats, Floats]:
        """(3,) where the rays through (n, 2) px start, and (n, 3) their directions, unit, world."""
        plane = self.plane_of(pixels)
        ahead = np.column_stack([plane, np.ones(len(plane))]) @ self.cam_from_world[:, :3]
        return self.centre(), ahead / np.linalg.norm(ahead, axis=1, keepdims=True)

    def scaled(self, factor: float) -> Camera:
        """The camera of its picture at so many times the size, rounded to whole pixels."""
        size = (max(1, round(self.width_px * factor)), max(1, round(self.height_px * factor)))
        return self.sized(*size)

    def sized(self, width_px: int, height_px: int) -> Camera:
        """The camera of its picture at another size."""
        across, down = width_px / self.width_px, height_px / self.height_px
        return replace(
            self,
            width_px=width_px,
            height_px=height_px,
            focal_px=(self.focal_px[0] * across, self.focal_px[1] * down),
            centre_px=(self.centre_px[0] * across, self.centre_px[1] * down),
            skew_px=self.skew_px * across,
        )

    def moved(self, world_from_old: Floats) -> Camera:
        """The camera in a world that is turned, moved and scaled: (4, 4) similarity."""
        scale = float(np.cbrt(np.linalg.det(world_from_old[:3, :3])))
        turn = self.cam_from_world[:, :3] @ (world_from_old[:3, :3] / scale).T
        centre = world_from_old[:3, :3] @ self.centre() + world_from_old[:3, 3]
        return replace(self, cam_from_world=np.column_stack([turn, -turn @ centre]))


@dataclass(frozen=True, eq=False)
class CameraSet:
    """Cameras of one place, and what their source knows of it.

    points: (n, 3) in the same frame. colours: (n, 3) uint8 sRGB. visible: for each camera, the
    rows of the points that it sees. crs, origin_m: where metres about that origin lie in the
    world. up: (3,) the unit vector that points up, where the source says so. masks: by a camera's
    name, a picture that is black where nothing counts. notes: what a person should know.
    """

    cameras: tuple[Camera, ...]
    points: Floats | None = None
    colours: NDArray[np.uint8] | None = None
    visible: tuple[NDArray[np.intp], ...] | None = None
    scale: Scale = "unknown"
    crs: str | None = None
    origin_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    source: str = ""
    up: tuple[float, float, float] | None = None
    masks: Mapping[str, Path] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.cameras)

    @cached_property
    def centres(self) -> Floats:
        """(c, 3) where the cameras stand."""
        return np.array([camera.centre() for camera in self.cameras]).reshape(-1, 3)

    def moved(self, world_from_old: Floats) -> CameraSet:
        """The set in a world that is turned, moved and scaled: (4, 4) similarity."""
        turn, shift = world_from_old[:3, :3], world_from_old[:3, 3]
        up = self.up
        if up is not None:
            x, y, z = turn @ np.array(up) / np.cbrt(np.linalg.det(turn))
            up = (float(x), float(y), float(z))
        return replace(
            self,
            cameras=tuple(camera.moved(world_from_old) for camera in self.cameras),
            points=None if self.points is None else self.points @ turn.T + shift,
            up=up,
        )
