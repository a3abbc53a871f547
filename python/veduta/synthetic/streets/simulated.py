"""What structure from motion would find in a street, without photos: from geometry and noise.

It takes a second where photos take minutes: for tests and statistics of what is made of the points.
The tracks and their noise are those of good photos; false matches are few.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera
from veduta.synthetic.scene import RayScene
from veduta.synthetic.seeds import stream
from veduta.synthetic.streets.cloud import NO_WALL, Cloud, street_cloud
from veduta.synthetic.streets.coarse import everything, ray_scene
from veduta.synthetic.streets.drift import draw_drift, information, turned
from veduta.synthetic.streets.house import Street
from veduta.synthetic.streets.walls import GRAZING, TrueWall, sees, true_walls

Floats = NDArray[np.float64]
Frame = Literal["world", "upright", "any"]
MOST_DOUBT_M = 0.6
"""Points whose place is less sure than this are left out, as an engine leaves out narrow angles."""
LOOSE_GRAZING = 0.06
POSE_NOISE_M, POSE_NOISE_RAD = 0.003, 1e-4
TILT_RAD = 0.004
"""Deviation of "upright" from upright."""


@dataclass(frozen=True)
class Simulation:
    """per_m2: points on walls. noise_px: of keypoints, each way. found: how often one is found.

    drift_m: of the warp that is left. false_share: of the points that are no points.
    frame: of the result: the world's; one with z (nearly) up; or any.
    """

    per_m2: float = 4.0
    noise_px: float = 0.5
    found: float = 0.7
    drift_m: float = 0.03
    false_share: float = 0.03
    frame: Frame = "any"


@dataclass(frozen=True)
class SimulatedStructure:
    """Columns as an engine gives them, and the truth.

    cameras: the true ones, in the world. walls: all edges of the street's houses.
    cam_from_model: (n, 3, 4). keypoints_px: (k, 2) of each photo. points: (p, 3) in the model's
    frame. colours: (p, 3) uint8. image_of, keypoint_of, point_of: (o,). wall_of: (p,) the row of
    the wall that a point is on, else -1. world_from_model: scale, rotation (3, 3) and shift (3,).
    """

    cameras: tuple[Camera, ...]
    walls: tuple[TrueWall, ...]
    cam_from_model: Floats
    keypoints_px: tuple[Floats, ...]
    points: Floats
    colours: NDArray[np.uint8]
    image_of: NDArray[np.int64]
    keypoint_of: NDArray[np.int64]
    point_of: NDArray[np.int64]
    wall_of: NDArray[np.int64]
    world_from_model: tuple[float, Floats, Floats]


def simulate(
    street: Street, cameras: Sequence[Camera], seed: int, simulation: Simulation | None = None
) -> SimulatedStructure:
    """The structure that the photos of these cameras would give; same seed, same bytes."""
    simulation = simulation or Simulation()
    rng = stream(seed, "simulated structure")
    scene = ray_scene(everything(street))
    walls = true_walls(street.houses, cameras, scene)
    cloud = street_cloud(street, walls, simulation.per_m2, rng)
    places, image_of, point_of, wall_of = _tracks(cloud, cameras, scene, simulation, rng)
    pixels = _pixels(cameras, places, image_of, point_of)
    noisy = pixels + simulation.noise_px * rng.standard_normal(pixels.shape)
    noise = _triangulation_noise(cameras, places, image_of, point_of, simulation, rng)
    found, cam_from_world = _warped(cameras, places, noise, simulation, rng)
    scale, turn, shift = _frame(simulation.frame, rng)
    points = (found - shift) @ turn / scale
    keypoints, keypoint_of = _keypoints(noisy, image_of, len(cameras))
    return SimulatedStructure(
        cameras=tuple(cameras),
        walls=walls,
        cam_from_model=_in_frame(cam_from_world, scale, turn, shift),
        keypoints_px=keypoints,
        points=points,
        colours=rng.integers(60, 220, (len(points), 3)).astype(np.uint8),
        image_of=image_of,
        keypoint_of=keypoint_of,
        point_of=point_of,
        wall_of=wall_of,
        world_from_model=(scale, turn, shift),
    )


def _tracks(
    cloud: Cloud,
    cameras: Sequence[Camera],
    scene: RayScene,
    simulation: Simulation,
    rng: np.random.Generator,
) -> tuple[Floats, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """The points with a track: places (p, 3), photo and point of each observation, wall (p,)."""
    # The ground is recognised at flat angles, too: nobody looks at it otherwise.
    grazing = np.where(cloud.wall == NO_WALL, LOOSE_GRAZING, GRAZING)
    seen = np.stack(
        [sees(camera, scene, cloud.places_m, cloud.normals, grazing) for camera in cameras]
    )
    seen &= rng.random(seen.shape) < simulation.found
    image_of, point_of = np.nonzero(seen)
    focal = np.array([camera.focal_px for camera in cameras])[image_of] / simulation.noise_px
    centres = np.array([camera.position_m for camera in cameras])[image_of]
    sure = information(cloud.points_m, centres, point_of, focal)
    # A point that no two lines of sight cross has no smallest eigenvalue to speak of.
    doubt = 1.0 / np.sqrt(np.maximum(np.linalg.eigvalsh(sure)[:, 0], 1e-12))
    kept = doubt < MOST_DOUBT_M
    number = np.cumsum(kept) - 1
    own = kept[point_of]
    places, wall_of = cloud.points_m[kept], cloud.wall[kept]
    false = _false_tracks(cameras, int(simulation.false_share * len(places)), len(places), rng)
    return (
        np.concatenate([places, false[0]]),
        np.concatenate([image_of[own], false[1]]).astype(np.int64),
        np.concatenate([number[point_of[own]], false[2]]).astype(np.int64),
        np.concatenate([wall_of, np.full(len(false[0]), NO_WALL)]),
    )


def _false_tracks(
    cameras: Sequence[Camera], count: int, first: int, rng: np.random.Generator
) -> tuple[Floats, NDArray[np.int64], NDArray[np.int64]]:
    """Points anywhere before a camera, that it and the next ones in the walk claim to see."""
    at = rng.integers(0, len(cameras), count)
    size = np.array([cameras[0].width_px, cameras[0].height_px])
    pixels = rng.uniform(0.0, 1.0, (count, 2)) * size
    depth = rng.uniform(4.0, 30.0, count)
    places = np.empty((count, 3))
    for row, camera in enumerate(cameras):
        own = at == row
        places[own] = camera.position_m + camera.rays(pixels[own]) * depth[own, None]
    images, points = [], []
    for step in (0, 1, 2):
        other = np.clip(at + step, 0, len(cameras) - 1)
        for row, camera in enumerate(cameras):
            own = np.flatnonzero((other == row) & ((step == 0) | (other != at)))
            seen, ahead = camera.project(places[own])
            inside = (ahead > 0.3) & ((seen > 0) & (seen < size)).all(axis=1)
            images.append(np.full(int(inside.sum()), row))
            points.append(first + own[inside])
    image_of, point_of = np.concatenate(images), np.concatenate(points)
    pair = np.unique(np.stack([image_of, point_of]), axis=1)
    return places, pair[0], pair[1]


def _pixels(
    cameras: Sequence[Camera],
    places: Floats,
    image_of: NDArray[np.int64],
    point_of: NDArray[np.int64],
) -> Floats:
    """(o, 2) where each observation's place truly comes to lie."""
    pixels = np.empty((len(image_of), 2))
    for row, camera in enumerate(cameras):
        own = image_of == row
        pixels[own] = camera.project(places[point_of[own]])[0]
    return pixels


def _triangulation_noise(
    cameras: Sequence[Camera],
    places: Floats,
    image_of: NDArray[np.int64],
    point_of: NDArray[np.int64],
    simulation: Simulation,
    rng: np.random.Generator,
) -> Floats:
    """(p, 3) the error of each point, drawn from what its lines of sight leave open."""
    focal = np.array([camera.focal_px for camera in cameras])[image_of]
    centres = np.array([camera.position_m for camera in cameras])[image_of]
    sure = information(places, centres, point_of, focal / max(simulation.noise_px, 1e-6))
    # False tracks may leave a direction open; their place is false anyhow.
    factor = np.linalg.cholesky(sure + np.eye(3) / MOST_DOUBT_M**2)
    drawn = rng.standard_normal((len(places), 3, 1))
    return np.asarray(np.linalg.solve(np.swapaxes(factor, 1, 2), drawn)[..., 0], np.float64)


def _warped(
    cameras: Sequence[Camera],
    places: Floats,
    noise: Floats,
    simulation: Simulation,
    rng: np.random.Generator,
) -> tuple[Floats, Floats]:
    """Points and (n, 3, 4) poses with the errors that the adjustment leaves, in the world."""
    centres = np.array([camera.position_m for camera in cameras])
    rotations = np.array([camera.cam_from_world[:3, :3] for camera in cameras])
    drift = draw_drift(centres, simulation.drift_m, rng)
    turn = drift.turn(centres) + POSE_NOISE_RAD * rng.standard_normal(centres.shape)
    moved = centres + drift.shift(centres) + POSE_NOISE_M * rng.standard_normal(centres.shape)
    rotations = rotations @ np.swapaxes(turned(turn), 1, 2)
    shifts = -np.einsum("nij,nj->ni", rotations, moved)
    points = places + drift.shift(places) + noise
    return points, np.concatenate([rotations, shifts[:, :, None]], axis=2)


def _frame(frame: Frame, rng: np.random.Generator) -> tuple[float, Floats, Floats]:
    """world_from_model: scale, rotation and shift."""
    if frame == "world":
        return 1.0, np.eye(3), np.zeros(3)
    scale = float(np.exp(rng.normal(0.0, 0.7)))
    shift = rng.uniform(-20.0, 20.0, 3)
    if frame == "any":
        left, _, right = np.linalg.svd(rng.standard_normal((3, 3)))
        turn = left @ right
        return scale, turn * np.sign(np.linalg.det(turn)), shift
    about = np.array([[0.0, 0.0, rng.uniform(-np.pi, np.pi)]])
    tilt = np.array([[*(TILT_RAD * rng.standard_normal(2)), 0.0]])
    return scale, (turned(tilt) @ turned(about))[0], shift


def _in_frame(cam_from_world: Floats, scale: float, turn: Floats, shift: Floats) -> Floats:
    rotations = cam_from_world[:, :, :3] @ turn
    moved = (cam_from_world[:, :, :3] @ shift + cam_from_world[:, :, 3]) / scale
    return np.concatenate([rotations, moved[:, :, None]], axis=2)


def _keypoints(
    pixels: Floats, image_of: NDArray[np.int64], photos: int
) -> tuple[tuple[Floats, ...], NDArray[np.int64]]:
    """The keypoints of each photo, and which of them each observation is."""
    keypoint_of = np.empty(len(image_of), np.int64)
    keypoints = []
    for row in range(photos):
        own = np.flatnonzero(image_of == row)
        keypoint_of[own] = np.arange(len(own))
        keypoints.append(pixels[own])
    return tuple(keypoints), keypoint_of
