"""A village from the air, painted face by face: photos that look down, with GPS in their EXIF.

It shares nothing with what is measured on it: faces are warped onto photos by their four corners,
the far ones first, with a pinhole of its own. Nothing is ray traced, and no camera of the project
is asked.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image
from PIL.TiffImagePlugin import IFDRational
from pyproj import Transformer

SIZE_PX = (960, 720)
FOCAL_PX = 800.0
ABOVE_M = 60.0
ORIGIN_M = (500_000.0, 5_400_000.0, 300.0)
"""In EPSG:32632."""
GROUND_M = 110.0
WIDE_M = 230.0
"""Of the ground that oblique photos show beyond the village."""
TEXEL_M = 0.06
PATCHES = 16
FINER = 3
"""Photos are painted so many times as fine and then averaged: what lies at a grazing angle would
else be noise that differs from photo to photo."""

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Face:
    """corners: (4, 3), as those of the texture run: upper left, upper right, lower right, left."""

    corners: Floats
    texture: NDArray[np.uint8]


@dataclass(frozen=True)
class Shot:
    """rotation: (3, 3) camera from world, x right, y down, z ahead. place: (3,) metres."""

    rotation: Floats
    place: Floats

    def seen(self, points: Floats) -> Floats:
        """(n, 2) pixels of (n, 3) points; NaN behind the camera."""
        own = (points - self.place) @ self.rotation.T
        depth = np.where(own[:, 2] > 0.5, own[:, 2], np.nan)[:, None]
        pixels: Floats = FOCAL_PX * own[:, :2] / depth + np.array(SIZE_PX) / 2.0
        return pixels


def village(seed: int, half: float = GROUND_M) -> list[list[Face]]:
    """The ground, then houses: faces of each in the order in which they are painted."""
    rng = np.random.default_rng(seed)
    things = [_ground(rng, half)]
    for x in np.arange(-54.0, 60.0, 18.0):
        for y in np.arange(-54.0, 60.0, 18.0):
            if rng.random() < 0.85:
                place = np.array([x, y]) + rng.uniform(-3.0, 3.0, 2)
                things.append(_house(rng, place))
    return things


def _ground(rng: np.random.Generator, half: float) -> list[Face]:
    """A square in patches: one that reaches behind a camera is not painted.

    Texels of a wider one are coarser.
    """
    texture = _noise(rng, 2.0 * GROUND_M, 2.0 * GROUND_M, (95, 120, 80))
    cuts = np.linspace(0.0, len(texture), PATCHES + 1).astype(int)
    places = half * (2.0 * cuts / len(texture) - 1.0)
    faces = []
    for row in range(PATCHES):
        for column in range(PATCHES):
            left, right = places[column], places[column + 1]
            top, bottom = -places[row], -places[row + 1]
            corners = [[left, top, 0], [right, top, 0], [right, bottom, 0], [left, bottom, 0.0]]
            part = texture[cuts[row] : cuts[row + 1], cuts[column] : cuts[column + 1]]
            faces.append(Face(np.array(corners), part))
    return faces


def _house(rng: np.random.Generator, place: Floats) -> list[Face]:
    """Four walls and a saddle roof, turned about its middle."""
    width, depth = rng.uniform(7.0, 10.0), rng.uniform(5.0, 8.0)
    eaves, rise = rng.uniform(3.0, 6.0), rng.uniform(1.5, 3.0)
    angle = rng.uniform(0.0, np.pi)
    c, s = np.cos(angle), np.sin(angle)

    def at(x: float, y: float, z: float) -> Floats:
        return np.array([place[0] + c * x - s * y, place[1] + s * x + c * y, z])

    w, d, top = width / 2.0, depth / 2.0, eaves + rise
    feet = [(-w, -d), (w, -d), (w, d), (-w, d)]
    faces = []
    tint = tuple(rng.uniform(140, 220, 3))
    for (x, y), (to_x, to_y) in zip(feet, feet[1:] + feet[:1], strict=True):
        corners = [at(x, y, eaves), at(to_x, to_y, eaves), at(to_x, to_y, 0), at(x, y, 0)]
        faces.append(Face(np.array(corners), _noise(rng, width, eaves, tint)))
    roof = tuple(rng.uniform((120, 50, 40), (180, 90, 70)))
    for side in (-1.0, 1.0):
        corners = [at(-w, 0, top), at(w, 0, top), at(w, side * d, eaves), at(-w, side * d, eaves)]
        faces.append(Face(np.array(corners), _noise(rng, width, depth, roof)))
    return faces


def _noise(
    rng: np.random.Generator, width_m: float, height_m: float, tint: tuple[float, ...]
) -> NDArray[np.uint8]:
    """Blotches of all sizes: something to recognise everywhere."""
    size = (max(8, int(width_m / TEXEL_M)), max(8, int(height_m / TEXEL_M)))
    total = np.zeros((size[1], size[0]), np.float32)
    for cell, strength in ((4, 14.0), (12, 20.0), (40, 18.0), (150, 12.0)):
        coarse = rng.standard_normal((-(-size[1] // cell) + 1, -(-size[0] // cell) + 1))
        total += strength * cv2.resize(
            coarse.astype(np.float32), size, interpolation=cv2.INTER_CUBIC
        )
    colours = total[:, :, None] + np.array(tint, np.float32)
    return np.clip(colours, 0, 255).astype(np.uint8)


def shots(seed: int, pitch_deg: float = -90.0) -> list[Shot]:
    """Lines there and back, 24 photos; the aircraft turns round at the end of each line."""
    rng = np.random.default_rng(seed + 1)
    found = []
    for line, x in enumerate(np.linspace(-33.0, 33.0, 4)):
        for y in np.linspace(-38.0, 38.0, 6):
            way = 1.0 if line % 2 == 0 else -1.0
            pitch = np.deg2rad(pitch_deg) + rng.normal(0.0, 0.01)
            ahead = np.array([0.0, way * np.cos(pitch), np.sin(pitch)])
            right = np.array([way, 0.0, 0.0])
            rotation = np.stack([right, np.cross(ahead, right), ahead])
            roll = rng.normal(0.0, 0.015)
            turn = np.array([[1, -roll, 0], [roll, 1, 0], [0, 0, 1.0]]) / np.hypot(1.0, roll)
            turn[2, 2] = 1.0
            place = np.array([x, y, ABOVE_M]) + rng.normal(0.0, (1.0, 1.0, 1.5))
            found.append(Shot(turn @ rotation, place))
    return found


def painted(things: list[list[Face]], shot: Shot) -> NDArray[np.uint8]:
    """The photo: the ground, then the houses from the farthest on."""
    fine = (FINER * SIZE_PX[0], FINER * SIZE_PX[1])
    pixels = np.zeros((fine[1], fine[0], 3), np.uint8)
    order = sorted(
        things[1:],
        key=lambda house: -float(np.linalg.norm(house[0].corners.mean(axis=0) - shot.place)),
    )
    for thing in [things[0], *order]:
        for face in sorted(thing, key=lambda one: float(one.corners[:, 2].mean())):
            _paint(pixels, face, shot)
    shrunk = cv2.resize(pixels, SIZE_PX, interpolation=cv2.INTER_AREA)
    return np.asarray(shrunk, dtype=np.uint8)


def _paint(pixels: NDArray[np.uint8], face: Face, shot: Shot) -> None:
    normal = np.cross(face.corners[1] - face.corners[0], face.corners[3] - face.corners[0])
    corners = FINER * shot.seen(face.corners)
    middle = face.corners.mean(axis=0)
    is_wall = abs(normal[2]) < 1e-6 * np.linalg.norm(normal)
    if not np.isfinite(corners).all() or (is_wall and normal @ (shot.place - middle) > 0.0):
        return
    limit = np.array(pixels.shape[1::-1])
    low = np.clip(np.floor(corners.min(axis=0)), 0, limit).astype(int)
    high = np.clip(np.ceil(corners.max(axis=0)) + 1, 0, limit).astype(int)
    if (high <= low).any():
        return
    height, width = face.texture.shape[:2]
    own = np.array([[0, 0], [width, 0], [width, height], [0, height]], np.float32)
    places = (corners - low).astype(np.float32)
    warp = cv2.getPerspectiveTransform(own, places)
    size = (int(high[0] - low[0]), int(high[1] - low[1]))
    shown = cv2.warpPerspective(
        face.texture, warp, size, flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    mask = np.zeros((size[1], size[0]), np.uint8)
    cv2.fillConvexPoly(mask, places.round().astype(np.int32), 255)
    pixels[low[1] : high[1], low[0] : high[0]][mask > 0] = shown[mask > 0]


def write_survey(folder: Path, seed: int, pitch_deg: float = -90.0, gps_m: float = 1.0) -> Floats:
    """The photos with GPS that is off by so much each way; (n, 3) true places, by name."""
    rng = np.random.default_rng(seed + 2)
    to_world = Transformer.from_crs("EPSG:32632", "EPSG:4326", always_xy=True)
    things = village(seed, GROUND_M if pitch_deg < -80.0 else WIDE_M)
    places = []
    for number, shot in enumerate(shots(seed, pitch_deg)):
        told = shot.place + rng.normal(0.0, gps_m, 3) + ORIGIN_M
        longitude, latitude = to_world.transform(told[0], told[1])
        exif = Image.Exif()
        exif[0x8825] = {
            1: "N",
            2: _degrees(latitude),
            3: "E",
            4: _degrees(longitude),
            5: b"\0",
            6: IFDRational(int(told[2] * 100), 100),
        }
        picture = Image.fromarray(painted(things, shot))
        picture.save(folder / f"v{number:02d}.jpg", quality=92, exif=exif)
        places.append(shot.place)
    return np.array(places)


def _degrees(value: float) -> tuple[IFDRational, IFDRational, IFDRational]:
    degrees = int(value)
    minutes = int((value - degrees) * 60)
    seconds = (value - degrees - minutes / 60) * 3600
    return (
        IFDRational(degrees, 1),
        IFDRational(minutes, 1),
        IFDRational(round(seconds * 100_000), 100_000),
    )
