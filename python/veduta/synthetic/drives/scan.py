"""A truck with a vertical 2D scanner along the street, with the figures of Frueh et al. 2005."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.drives import rays
from veduta.synthetic.drives.street import Kind, Street

_WAVE_M = 60.0
"""Length of the waves in which the truck strays."""


@dataclass(frozen=True)
class TruckOptions:
    """The scanner: 180 degrees at one, 80 m, sigma 3.5 cm, 3.6 m over the road (section 2).

    spacing_m: of the scans. sway_m, sway_rad: how far the truck strays from a straight line; its
    poses are known. through: share of rays that go through glass; of the others nothing comes back.
    dropped: share of scans that are lost. level: whether a second scanner looks level to the left
    half (section 2).
    """

    height_m: float = 3.6
    beam_step_deg: float = 1.0
    farthest_m: float = 80.0
    sigma_m: float = 0.035
    spacing_m: float = 0.2
    speed_m_s: float = 8.0
    sway_m: float = 0.15
    sway_rad: float = 0.01
    through: float = 0.85
    dropped: float = 0.0
    level: bool = False


@dataclass(frozen=True, eq=False)
class DriveScans:
    """world_from_vehicle: (s, 3, 4). ranges: (s, b) m, 0 where nothing came back.

    Beam i lies in the plane across the vehicle, at `angles_rad[i]` over level, to the left.
    kind: (s, b) uint8 `Kind`. facade_m: (s, b) range of the wall or ground without the objects
    before it, and without glass; inf where there is none.
    level_ranges: (s, b) m of the horizontal scanner, from ahead over left to behind; None: none.
    """

    times_s: NDArray[np.float64]
    world_from_vehicle: NDArray[np.float64]
    angles_rad: NDArray[np.float64]
    ranges: NDArray[np.float32]
    kind: NDArray[np.uint8]
    facade_m: NDArray[np.float64]
    options: TruckOptions
    level_ranges: NDArray[np.float32] | None = None


def scan_street(
    street: Street,
    options: TruckOptions,
    seed: int,
    part_m: tuple[float, float] | None = None,
) -> DriveScans:
    """All scans of a drive along a street, or those of a part of it."""
    random = np.random.default_rng(seed)
    low, high = part_m or (0.0, street.length_m)
    y = np.arange(low, high, options.spacing_m)
    y = y[random.uniform(size=len(y)) >= options.dropped]
    poses = poses_at(y, options)
    angles = np.deg2rad(np.arange(-90.0, 90.0 + 1e-9, options.beam_step_deg))
    ranges = np.zeros((len(y), len(angles)), dtype=np.float32)
    kind = np.zeros(ranges.shape, dtype=np.uint8)
    facade = np.full(ranges.shape, np.inf)
    for first in range(0, len(y), 50):
        rows = slice(first, first + 50)
        near = street.between(float(y[rows][0]) - 3.0, float(y[rows][-1]) + 3.0)
        beams = _upright(poses[rows], angles)
        ranges[rows], kind[rows], facade[rows] = _cast(near, poses[rows], beams, options, random)
    times = y / options.speed_m_s
    level = _scan_level(street, poses, options, random) if options.level else None
    return DriveScans(times, poses, angles, ranges, kind, facade, options, level)


def poses_at(y: NDArray[np.float64], options: TruckOptions) -> NDArray[np.float64]:
    """(s, 3, 4) world_from_vehicle of the truck at (s,) places along the street (m)."""
    wave = 2 * np.pi * y / _WAVE_M
    yaw = options.sway_rad * np.sin(wave)
    poses = np.zeros((len(y), 3, 4))
    # x of the vehicle is forward (y of the world), y to its left (-x of the world).
    poses[:, 0, 0], poses[:, 1, 0] = -np.sin(yaw), np.cos(yaw)
    poses[:, 0, 1], poses[:, 1, 1] = -np.cos(yaw), -np.sin(yaw)
    poses[:, 2, 2] = 1.0
    poses[:, 0, 3], poses[:, 1, 3] = options.sway_m * np.cos(wave), y
    return poses


def _upright(poses: NDArray[np.float64], angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """(s, b, 3) unit directions in the plane across the vehicle, to its left."""
    level = poses[:, None, :, 1] * np.cos(angles)[None, :, None]
    return np.asarray(level + np.array([0.0, 0.0, 1.0]) * np.sin(angles)[None, :, None])


def _scan_level(
    street: Street,
    poses: NDArray[np.float64],
    options: TruckOptions,
    random: np.random.Generator,
) -> NDArray[np.float32]:
    """(s, 181) ranges of a scanner that looks level, from ahead over left to behind."""
    angles = np.deg2rad(np.arange(0.0, 180.0 + 1e-9, options.beam_step_deg))
    found = np.zeros((len(poses), len(angles)), dtype=np.float32)
    for first in range(0, len(poses), 50):
        rows = slice(first, first + 50)
        place = poses[rows, 1, 3]
        far = options.farthest_m
        near = street.between(float(place.min()) - far, float(place.max()) + far)
        beams = poses[rows, None, :, 0] * np.cos(angles)[None, :, None]
        beams = beams + poses[rows, None, :, 1] * np.sin(angles)[None, :, None]
        found[rows] = _cast(near, poses[rows], beams, options, random)[0]
    return found


def _cast(
    street: Street,
    poses: NDArray[np.float64],
    beams: NDArray[np.float64],
    options: TruckOptions,
    random: np.random.Generator,
) -> tuple[NDArray[np.float32], NDArray[np.uint8], NDArray[np.float64]]:
    """Ranges, kinds and ranges of the facade (s, b) along beams (s, b, 3)."""
    shape = beams.shape[:2]
    origin = poses[:, None, :, 3] + np.array([0.0, 0.0, options.height_m])
    origins = np.broadcast_to(origin, (*shape, 3)).reshape(-1, 3)
    directions = beams.reshape(-1, 3)
    ground = rays.to_ground(origins, directions)
    wall = rays.to_boxes(origins, directions, street.walls)
    things = np.minimum(
        rays.to_boxes(origins, directions, street.objects),
        np.minimum(
            rays.to_cylinders(origins, directions, street.cylinders),
            rays.to_balls(origins, directions, street.balls),
        ),
    )
    glazed = np.isfinite(wall)
    glazed &= rays.to_boxes(origins, directions, street.panes) <= wall + 0.05
    room = rays.to_boxes(origins, directions, street.rooms)
    facade = np.minimum(ground, wall)
    passed = glazed & (random.uniform(size=len(origins)) < options.through)
    behind = np.where(passed, np.minimum(room, ground), np.inf)
    solid = np.where(glazed & (wall < ground), behind, wall)
    distance = np.minimum(np.minimum(np.where(glazed & passed, np.inf, ground), solid), things)
    kind = np.full(len(origins), Kind.GROUND, dtype=np.uint8)
    kind[wall < ground] = Kind.WALL
    kind[glazed & (wall < ground)] = Kind.BEHIND_GLASS
    kind[things <= distance] = Kind.OBJECT
    distance = distance + random.normal(0.0, options.sigma_m, len(distance))
    lost = ~(distance < options.farthest_m)
    kind[lost] = Kind.NOTHING
    ranges = np.where(lost, 0.0, distance).astype(np.float32)
    return ranges.reshape(shape), kind.reshape(shape), facade.reshape(shape)
