"""How the plane of a lattice lies before the camera, a floor or a wall, and its tiles' size.

A photo alone has no scale. The size of a tile is the typical one that fits its shape best, and
that puts the camera about as high over a floor, or as far from a wall, as one stands. It is
invented, and what is made of it is marked so.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.geometry.homography import Matrix, translation
from veduta.geometry.vanishing import focal_from_orthogonal

Seen = Literal["floor", "wall", "ceiling"]
Size = tuple[float, float]

USUAL_FOCAL = 0.75
"""Of a camera that does not say it, in longer sides of the photo: 27 mm for a frame of 36 mm."""
_FOCALS = (0.45, 1.8)
"""Those that a lattice may give; of a plane seen nearly head-on it is no more than noise."""
HEAD_ON = math.cos(math.radians(30.0))
_FLOOR, _CEILING = math.sin(math.radians(30.0)), -math.sin(math.radians(40.0))
"""How far down the way to a plane leads at least (the sine, as the camera is held), or up.

One looks down at a floor by up to 60 degrees; who looks up at a wall does so by less than 30.
"""
EYE_M = 1.5
"""How high a camera is held."""
_DOUBT = {"floor": 0.15, "wall": 0.4}
"""How far the camera is from the plane is known so exactly (a logarithm)."""
WALL_AWAY = 0.75
"""How far one stands from the wall that one photographs, in widths of the room."""
_SHAPE = 0.06
"""How exactly the ratio of the sides is known (a logarithm)."""
TYPICAL_M: dict[Literal["floor", "wall"], tuple[Size, ...]] = {
    "floor": (
        (0.10, 0.10), (0.20, 0.20), (0.30, 0.30), (0.33, 0.33), (0.45, 0.45), (0.60, 0.60),
        (0.80, 0.80), (0.60, 0.30), (0.20, 0.10), (0.80, 0.40), (0.90, 0.15), (1.20, 0.20),
        (0.45, 0.30),
    ),
    "wall": (
        (0.10, 0.10), (0.15, 0.15), (0.20, 0.20), (0.30, 0.30), (0.15, 0.075), (0.20, 0.10),
        (0.25, 0.20), (0.30, 0.20), (0.40, 0.25), (0.50, 0.20), (0.60, 0.30), (0.60, 0.20),
    ),
}  # fmt: skip
"""Sizes in which tiles are sold (m), longer side first."""


@dataclass(frozen=True)
class Plane:
    """surface: what it is. head_on: whether that cannot be told, since the camera faces it.

    shape: width of a tile by its height. distance: of the camera, in widths of a tile.
    """

    surface: Seen
    head_on: bool
    shape: float
    distance: float


def plane_of(photo_from_tiles: Matrix, size_px: tuple[int, int], focal_px: float | None) -> Plane:
    """The plane of a lattice. size_px: of the photo, width and height; upright."""
    centred = translation(-size_px[0] / 2.0, -size_px[1] / 2.0) @ photo_from_tiles
    focal = focal_px or _focal_of(centred, max(size_px))
    right, down, origin = (centred / np.array([[focal], [focal], [1.0]])).T
    normal = np.cross(right, down)
    normal = normal / np.linalg.norm(normal)
    depth = float(normal @ origin)
    away = normal * np.sign(depth)  # from the camera to the plane
    head_on = bool(abs(away[2]) > HEAD_ON)
    surface: Seen = "wall"
    if away[1] > _FLOOR or away[1] < _CEILING:
        surface = "floor" if away[1] > 0 else "ceiling"
    width, height = float(np.linalg.norm(right)), float(np.linalg.norm(down))
    return Plane(surface, head_on, width / height, abs(depth) / width)


def likely_size(plane: Plane, room_m: float) -> Size:
    """Width and height of a tile (m): the likeliest of the typical sizes, either way round.

    room_m: how wide the room is about.
    """
    kind: Literal["floor", "wall"] = "floor" if plane.surface == "floor" else "wall"
    away_m = EYE_M if kind == "floor" else WALL_AWAY * room_m
    both = [turned for size in TYPICAL_M[kind] for turned in (size, size[::-1])]

    def unlikely(size: Size) -> float:
        shape = math.log(size[0] / size[1] / plane.shape) / _SHAPE
        away = math.log(size[0] * plane.distance / away_m) / _DOUBT[kind]
        return shape**2 + away**2

    return min(both, key=unlikely)


def _focal_of(centred: NDArray[np.float64], side_px: int) -> float:
    """By the right angle of the tiles' sides, where their vanishing points tell; else the usual."""
    found = focal_from_orthogonal(centred[:, 0], centred[:, 1], (0.0, 0.0))
    focal = (found or 0.0) / side_px
    low, high = _FOCALS
    return side_px * (focal if low <= focal <= high else USUAL_FOCAL)
