"""Where photos are taken: two passes along a street, each looking across and ahead."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.camera import FILM_DIAGONAL_MM, Camera, look_at
from veduta.synthetic.lens import NO_DISTORTION, Distortion
from veduta.synthetic.seeds import stream
from veduta.synthetic.streets.house import Street

EYE_M = 1.65
CAR_M = 2.6
"""Of a camera on the roof of a car."""
LANE_M = 0.27
"""Distance of a lane from the middle, as a share of the street's width."""
ACROSS_DEG, AHEAD_DEG = 55.0, 30.0
"""Headings from ahead, in turn."""
ENDING = 5
"""Photos that turn from one side to the other at the end of the street."""


def walk(
    street: Street,
    photos: int = 40,
    size_px: tuple[int, int] = (1000, 750),
    focal_mm35: float = 25.0,
    distortions: tuple[Distortion, ...] = (NO_DISTORTION,),
    focal_steps: tuple[float, ...] = (1.0,),
    seed: int = 0,
) -> tuple[Camera, ...]:
    """The cameras in the order of their photos.

    Along a street one walks on the right looking at the houses on the left, turns at the end, and
    walks back on the left looking at those on the right. Round a block both walks go the same way,
    the first looking at the block. distortions, focal_steps: of the cameras that take turns, and
    what their focal lengths are multiplied with.
    """
    rng = stream(street.seed * 977 + seed, "walk")
    stands = _round(street, photos) if street.is_round else _there_and_back(street, photos)
    stands = stands + rng.normal(0.0, (0.25, 0.02, np.deg2rad(4.0)), stands.shape)
    focal_px = focal_mm35 * float(np.hypot(*size_px)) / FILM_DIAGONAL_MM
    cameras = []
    for number, (along, aside, heading) in enumerate(stands.tolist()):
        eye, ahead = _stand(street, along, aside, heading)
        pitch = float(np.deg2rad(rng.uniform(6.0, 17.0)))
        roll = float(np.deg2rad(rng.normal(0.0, 1.2)))
        step = focal_steps[number % len(focal_steps)]
        lens = distortions[number % len(distortions)]
        cameras.append(_camera(eye, ahead, pitch, roll, size_px, focal_px * step, lens))
    return tuple(cameras)


def walk_part(
    street: Street,
    photos: int = 14,
    share: tuple[float, float] = (0.35, 0.5),
    size_px: tuple[int, int] = (900, 900),
    focal_mm35: float = 33.0,
) -> tuple[Camera, ...]:
    """Cameras of a car on a part of a street, which show only parts of what stands along it.

    In turn ahead, to the left and back, level: rows of houses go on beyond what is seen, and their
    eaves are above it. share: of the street's length, from where to where.
    """
    rng = stream(street.seed * 977, "walk along a part")
    focal_px = focal_mm35 * float(np.hypot(*size_px)) / FILM_DIAGONAL_MM
    alongs = np.repeat(np.linspace(*share, -(-photos // 3)) * street.length_m, 3)[:photos]
    cameras = []
    for number, along in enumerate(alongs.tolist()):
        heading = (0.0, 0.5 * np.pi, np.pi)[number % 3] + float(rng.normal(0.0, 0.02))
        eye, ahead = _stand(street, along, float(rng.normal(0.0, 0.004)), heading)
        high = (eye[0], eye[1], CAR_M)
        cameras.append(_camera(high, ahead, 0.05, 0.0, size_px, focal_px))
    return tuple(cameras)


def walk_round(
    radius_m: float, photos: int = 32, size_px: tuple[int, int] = (1000, 750), seed: int = 0
) -> tuple[Camera, ...]:
    """Pinholes on a ring about the origin, evenly spread, that look at its middle."""
    rng = stream(seed, "walk round")
    focal_px = 25.0 * float(np.hypot(*size_px)) / FILM_DIAGONAL_MM
    cameras = []
    for turn in np.linspace(0.0, 2 * np.pi, photos, endpoint=False).tolist():
        away = radius_m + float(rng.normal(0.0, 0.4))
        eye = (away * np.cos(turn), away * np.sin(turn), EYE_M + float(rng.normal(0.0, 0.05)))
        ahead = turn + np.pi + float(np.deg2rad(rng.normal(0.0, 2.0)))
        pitch, roll = np.deg2rad(rng.uniform(5.0, 9.0)), np.deg2rad(rng.normal(0.0, 1.0))
        cameras.append(_camera(eye, ahead, float(pitch), float(roll), size_px, focal_px))
    return tuple(cameras)


def _camera(
    eye: tuple[float, float, float],
    ahead: float,
    pitch: float,
    roll: float,
    size_px: tuple[int, int],
    focal_px: float,
    lens: Distortion = NO_DISTORTION,
) -> Camera:
    """A camera that looks along a heading and upwards by a pitch (rad)."""
    target = (eye[0] + np.cos(ahead), eye[1] + np.sin(ahead), eye[2] + np.tan(pitch))
    return replace(look_at(eye, target, size_px, focal_px, roll), distortion=lens)


def _there_and_back(street: Street, photos: int) -> NDArray[np.float64]:
    """(n, 3) distance along, share of the width to the left, heading from ahead (rad)."""
    ending = min(ENDING, photos // 4)
    each = (photos - ending) // 2
    last = street.length_m - 3.0
    turning = np.linspace(1.0, -1.0, ending + 2)[1:-1]
    turn = [np.full(ending, last + 1.0), -LANE_M * turning, np.deg2rad(AHEAD_DEG) * turning]
    out = _pass(np.linspace(0.5, last, each), 1.0)
    back = _pass(np.linspace(last, 0.5, photos - ending - each), -1.0)
    return np.concatenate([out, np.stack(turn, axis=1), back])


def _round(street: Street, photos: int) -> NDArray[np.float64]:
    """As `_there_and_back`, twice round."""
    each = (photos + 1) // 2
    along = np.linspace(0.0, street.length_m, each, endpoint=False)
    return np.concatenate([_pass(along, 1.0), _pass(along[: photos - each], -1.0)])


def _pass(along: NDArray[np.float64], side: float) -> NDArray[np.float64]:
    """Photos that look to the left (side 1) or right (-1): in turn more across and more ahead."""
    headings = np.where(np.arange(len(along)) % 2 == 0, ACROSS_DEG, AHEAD_DEG)
    aside = np.full(len(along), -side * LANE_M)
    return np.stack([along, aside, side * np.deg2rad(headings)], axis=1)


def _stand(
    street: Street, along: float, aside: float, heading: float
) -> tuple[tuple[float, float, float], float]:
    middle, way = street.at(along)
    left = np.array([-np.sin(way), np.cos(way)])
    x, y = middle + aside * street.width_m * left
    return (float(x), float(y), EYE_M), way + heading
