"""A truck with a vertical 2D scanner along the street, with the figures of Frueh et al. 2005."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.drives.footprint import mixed, spread
from veduta.synthetic.drives.scenery import Scenery
from veduta.synthetic.drives.street import Kind
from veduta.synthetic.drives.way import Way

_WAVE_M = 60.0
"""Length of the waves in which the truck strays."""


@dataclass(frozen=True)
class TruckOptions:
    """The scanner: 180 degrees at one, 80 m, sigma 3.5 cm, 3.6 m over the road (section 2).

    spacing_m: of the scans. sway_m, sway_rad: how far the truck strays from a straight line; its
    poses are known. through: share of rays that go through glass; of the others nothing comes back.
    dropped: share of scans that are lost. level: whether a second scanner looks level to the left
    half (section 2). divergence_rad: how wide a beam opens; 0: thin rays, which cost less.
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
    divergence_rad: float = 0.0


PAPER = TruckOptions(divergence_rad=0.015)
"""With the beams of the paper's scanner, too (section 4.1)."""


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
    street: Scenery,
    options: TruckOptions,
    seed: int,
    part_m: tuple[float, float] | None = None,
) -> DriveScans:
    """All scans of a drive along a street, or those of a part of it."""
    random = np.random.default_rng(seed)
    low, high = part_m or (0.0, street.length_m)
    y = np.arange(low, high, options.spacing_m)
    y = y[random.uniform(size=len(y)) >= options.dropped]
    poses = poses_at(y, options, street.way)
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
    level = _scan_level(street, y, poses, options, random) if options.level else None
    return DriveScans(times, poses, angles, ranges, kind, facade, options, level)


def poses_at(
    along_m: NDArray[np.float64], options: TruckOptions, way: Way | None = None
) -> NDArray[np.float64]:
    """(s, 3, 4) world_from_vehicle of the truck at (s,) places along the street (m).

    x of the vehicle is forward, y to its left; without a way it goes along y of the world.
    """
    wave = 2 * np.pi * along_m / _WAVE_M
    yaw = options.sway_rad * np.sin(wave)
    frames = (way or Way()).frames(along_m)
    cosine, sine = np.cos(yaw)[:, None], np.sin(yaw)[:, None]
    poses = frames.copy()
    poses[:, :, 0] = cosine * frames[:, :, 0] + sine * frames[:, :, 1]
    poses[:, :, 1] = cosine * frames[:, :, 1] - sine * frames[:, :, 0]
    poses[:, :, 3] -= (options.sway_m * np.cos(wave))[:, None] * frames[:, :, 1]
    return poses


def _upright(poses: NDArray[np.float64], angles: NDArray[np.float64]) -> NDArray[np.float64]:
    """(s, b, 3) unit directions in the plane across the vehicle, to its left."""
    level = poses[:, None, :, 1] * np.cos(angles)[None, :, None]
    return np.asarray(level + np.array([0.0, 0.0, 1.0]) * np.sin(angles)[None, :, None])


def _scan_level(
    street: Scenery,
    along: NDArray[np.float64],
    poses: NDArray[np.float64],
    options: TruckOptions,
    random: np.random.Generator,
) -> NDArray[np.float32]:
    """(s, 181) ranges of a scanner that looks level, from ahead over left to behind."""
    angles = np.deg2rad(np.arange(0.0, 180.0 + 1e-9, options.beam_step_deg))
    found = np.zeros((len(poses), len(angles)), dtype=np.float32)
    for first in range(0, len(poses), 50):
        rows = slice(first, first + 50)
        far = options.farthest_m
        near = street.between(float(along[rows].min()) - far, float(along[rows].max()) + far)
        beams = poses[rows, None, :, 0] * np.cos(angles)[None, :, None]
        beams = beams + poses[rows, None, :, 1] * np.sin(angles)[None, :, None]
        found[rows] = _cast(near, poses[rows], beams, options, random)[0]
    return found


def _cast(
    scenery: Scenery,
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
    passes = random.uniform(size=len(origins)) < options.through
    if options.divergence_rad > 0.0:
        cone = spread(directions, options.divergence_rad)
        rays = cone.shape[1]
        found, kinds = scenery.meet(
            np.repeat(origins, rays, axis=0), cone.reshape(-1, 3), np.repeat(passes, rays)
        )
        distance, kind = mixed(found.reshape(-1, rays), kinds.reshape(-1, rays))
    else:
        distance, kind = scenery.meet(origins, directions, passes)
    distance = distance + random.normal(0.0, options.sigma_m, len(distance))
    lost = ~(distance < options.farthest_m)
    kind[lost] = Kind.NOTHING
    ranges = np.where(lost, 0.0, distance).astype(np.float32)
    facade, _ = scenery.facade(origins, directions)
    return ranges.reshape(shape), kind.reshape(shape), facade.reshape(shape)
