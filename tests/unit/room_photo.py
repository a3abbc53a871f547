"""A photo of a room of known colours, sizes and camera, by rays that meet the planes of a box.

World: x to the right, y away from the camera, z up (m). Nothing of `veduta.plan.photos` is used.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Rgb = tuple[int, int, int]


@dataclass(frozen=True)
class Tiled:
    """Tiles of a size (m, with the joint) and colours; bond: the shift of every other row."""

    size_m: tuple[float, float]
    joint_m: float = 0.005
    tile: Rgb = (205, 198, 184)
    joint: Rgb = (120, 116, 110)
    spread: float = 6.0
    bond: float = 0.0


@dataclass(frozen=True)
class RoomScene:
    """A room of 4 x 5 x 2.6 m, the camera 0.4 m from its front wall at 1.5 m height."""

    wall: Rgb = (206, 188, 150)
    ceiling: Rgb = (244, 243, 240)
    floor: Rgb = (140, 100, 70)
    floor_tiles: Tiled | None = None
    wall_tiles: Tiled | None = None
    room_m: tuple[float, float, float] = (4.0, 5.0, 2.6)
    eye_m: tuple[float, float, float] = (2.2, 0.4, 1.5)
    pitch_rad: float = 0.25
    yaw_rad: float = 0.2
    focal: float = 0.75
    noise: float = 2.0
    boxes_m: tuple[tuple[float, float, float, float, float, float, Rgb], ...] = field(
        default=((0.5, 3.9, 0.0, 1.6, 5.0, 0.9, (90, 60, 45)),)
    )
    seed: int = 1


def room_photo(scene: RoomScene, width: int = 960, height: int = 720) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB; a pixel is the mean of four rays."""
    fine = _traced(scene, 2 * width, 2 * height)
    mean = fine.reshape(height, 2, width, 2, 3).mean(axis=(1, 3))
    seen = mean + np.random.default_rng(scene.seed).normal(0.0, scene.noise, mean.shape)
    photo: NDArray[np.uint8] = seen.round().clip(0, 255).astype(np.uint8)
    return photo


def _traced(scene: RoomScene, width: int, height: int) -> NDArray[np.float64]:
    eye, rays = camera_rays(scene, width, height)
    colour = np.zeros((height, width, 3))
    nearest = np.full((height, width), np.inf)
    size = np.array(scene.room_m)
    for axis in range(3):
        for at in (0.0, size[axis]):
            if (axis, at) == (1, 0.0):
                continue  # behind the camera
            _paint(scene, eye, rays, axis, at, colour, nearest)
    for x0, y0, z0, x1, y1, z1, rgb in scene.boxes_m:
        _box(eye, rays, np.array([x0, y0, z0]), np.array([x1, y1, z1]), rgb, colour, nearest)
    falloff = 1.02 - 0.012 * np.minimum(nearest, 6.0)  # dimmer further away
    dimmed: NDArray[np.float64] = colour * falloff[..., None]
    return dimmed


def camera_rays(
    scene: RoomScene, width: int, height: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The eye and (h, w, 3) directions of pixel centres; focal length in widths."""
    x = (np.arange(width) + 0.5 - width / 2) / (scene.focal * width)
    y = (np.arange(height) + 0.5 - height / 2) / (scene.focal * width)
    cam = np.stack(np.broadcast_arrays(x[None, :], np.ones(1), -y[:, None]), axis=-1)
    return np.array(scene.eye_m), cam @ world_from_cam(scene).T


def world_from_cam(scene: RoomScene) -> NDArray[np.float64]:
    """Axes right, ahead, up of the camera in the world, as columns."""
    c, s = np.cos(scene.pitch_rad), np.sin(scene.pitch_rad)
    tilt = np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    c, s = np.cos(scene.yaw_rad), np.sin(scene.yaw_rad)
    turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    axes: NDArray[np.float64] = turn @ tilt
    return axes


def pixel_of(
    scene: RoomScene, point_m: NDArray[np.float64], width: int, height: int
) -> NDArray[np.float64]:
    """(2,) where a point of the room is seen."""
    right, ahead, up = world_from_cam(scene).T @ (point_m - np.array(scene.eye_m))
    f = scene.focal * width
    return np.array([width / 2 + f * right / ahead, height / 2 - f * up / ahead])


def _paint(
    scene: RoomScene,
    eye: NDArray[np.float64],
    rays: NDArray[np.float64],
    axis: int,
    at: float,
    colour: NDArray[np.float64],
    nearest: NDArray[np.float64],
) -> None:
    with np.errstate(divide="ignore", invalid="ignore"):
        far = (at - eye[axis]) / rays[..., axis]
    point = eye + far[..., None] * rays
    inside = (point >= -1e-9) & (point <= np.array(scene.room_m) + 1e-9)
    inside[..., axis] = True
    hit = (far > 1e-6) & inside.all(axis=-1) & (far < nearest)
    along = point[..., [k for k in range(3) if k != axis]][hit]
    if axis == 2:
        plain, tiles = (scene.floor, scene.floor_tiles) if at == 0.0 else (scene.ceiling, None)
    else:
        plain, tiles = scene.wall, scene.wall_tiles
    colour[hit] = plain if tiles is None else _tiled(tiles, along)
    nearest[hit] = far[hit]


def _tiled(tiles: Tiled, along_m: NDArray[np.float64]) -> NDArray[np.float64]:
    row = np.floor(along_m[:, 1] / tiles.size_m[1])
    across = along_m[:, 0] / tiles.size_m[0] - tiles.bond * (row % 2)
    column = np.floor(across)
    u = (across - column) * tiles.size_m[0]
    v = along_m[:, 1] - row * tiles.size_m[1]
    half = tiles.joint_m / 2
    joint = (u < half) | (u > tiles.size_m[0] - half) | (v < half) | (v > tiles.size_m[1] - half)
    shade = np.sin(12.9898 * column + 78.233 * row) * 43758.5453
    own = tiles.spread * (2.0 * (shade - np.floor(shade)) - 1.0)
    found: NDArray[np.float64] = np.where(
        joint[:, None], np.array(tiles.joint), np.array(tiles.tile) + own[:, None]
    )
    return found


def _box(
    eye: NDArray[np.float64],
    rays: NDArray[np.float64],
    low: NDArray[np.float64],
    high: NDArray[np.float64],
    rgb: Rgb,
    colour: NDArray[np.float64],
    nearest: NDArray[np.float64],
) -> None:
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.stack([(low - eye) / rays, (high - eye) / rays])
    enter, leave = ends.min(axis=0).max(axis=-1), ends.max(axis=0).min(axis=-1)
    hit = (enter < leave) & (enter > 0) & (enter < nearest)
    side = ends.min(axis=0).argmax(axis=-1)[hit]
    colour[hit] = np.array(rgb) * np.array([0.8, 0.9, 1.0])[side][:, None]
    nearest[hit] = enter[hit]
