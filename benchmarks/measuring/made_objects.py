"""Objects on a table whose surfaces are known, and photos of them.

A vase, a stone, a slatted crate and a painted stool. Rays are cast by Embree; light is one sun
with its shadows, and an even sky. Nothing is shared with what is measured.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from veduta.synthetic.camera import Camera, look_at

Floats = NDArray[np.float64]
Faces = NDArray[np.int64]
SUN = np.array([0.45, -0.7, 0.75]) / np.linalg.norm([0.45, -0.7, 0.75])
SAMPLES = ((0.25, 0.25), (0.75, 0.75), (0.25, 0.75), (0.75, 0.25))
TABLE_M = 0.02
"""What is lower is the table's."""


@dataclass(frozen=True)
class Skin:
    """How a surface looks. grains_m: sizes of its spots. contrast: share of its colour."""

    colour: tuple[float, float, float]
    grains_m: tuple[float, ...]
    contrast: float


SKINS = (
    Skin((0.42, 0.36, 0.30), (0.09, 0.03, 0.01, 0.004), 0.5),  # table
    Skin((0.62, 0.50, 0.36), (0.06, 0.02, 0.006), 0.35),  # vase
    Skin((0.45, 0.45, 0.43), (0.05, 0.015, 0.005), 0.6),  # stone
    Skin((0.55, 0.38, 0.22), (0.03, 0.008), 0.25),  # crate
    Skin((0.30, 0.34, 0.45), (0.02, 0.006), 0.10),  # stool: painted, nearly even
)


class ObjectScene:
    """Triangles with a skin each, under rays."""

    def __init__(self, seed: int) -> None:
        draw = np.random.default_rng(seed)
        parts = [
            _slab((-3.0, -3.0, -0.05), (3.0, 3.0, 0.0)),
            _moved(_vase(draw), (-0.75, 0.1, 0.0)),
            _moved(_stone(draw), (-0.1, -0.15, 0.0)),
            _moved(_crate(draw), (0.55, 0.25, 0.0)),
            _moved(_stool(draw), (1.1, -0.3, 0.0)),
        ]
        self.corners = np.concatenate([points[faces] for points, faces in parts])
        self.skin = np.concatenate(
            [np.full(len(faces), number) for number, (_, faces) in enumerate(parts)]
        )
        cross = np.cross(
            self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0]
        )
        self.normal = cross / np.linalg.norm(cross, axis=1)[:, None]
        self._grids = draw.uniform(-1.0, 1.0, (4, 32, 32, 32))
        self._scene = EmbreeScene()
        self._mesh = TriangleMesh(self._scene, self.corners.astype(np.float32))

    def depth_m(self, camera: Camera) -> NDArray[np.float64]:
        """(h, w) along the camera's z through the pixels' centres, NaN where nothing is."""
        _, _, away = self._cast(camera, (0.5, 0.5))
        return away.reshape(camera.height_px, camera.width_px)

    def photo(self, camera: Camera, seed: int) -> NDArray[np.uint8]:
        """(h, w, 3) sRGB with a little blur and noise."""
        light = np.mean([self._light(camera, offset) for offset in SAMPLES], axis=0)
        light = cv2.GaussianBlur(light.reshape(camera.height_px, camera.width_px, 3), (0, 0), 0.4)
        noise = np.random.default_rng(seed).standard_normal(light.shape)
        light = light + 0.008 * np.sqrt(light / 0.2 + 0.05) * noise
        return np.asarray(np.rint(255.0 * np.clip(light, 0.0, 1.0) ** (1 / 2.2)), dtype=np.uint8)

    def _cast(
        self, camera: Camera, offset: tuple[float, float]
    ) -> tuple[Floats, NDArray[np.intp], NDArray[np.float64]]:
        y, x = np.indices((camera.height_px, camera.width_px))
        rays = camera.rays(np.stack([x.ravel() + offset[0], y.ravel() + offset[1]], axis=1))
        found = self._scene.run(_from(camera.position_m, rays), rays.astype(np.float32), output=1)
        triangle = np.asarray(found["primID"], dtype=np.intp)
        return rays, triangle, np.where(triangle >= 0, found["tfar"], np.nan).astype(np.float64)

    def _light(self, camera: Camera, offset: tuple[float, float]) -> Floats:
        rays, triangle, away = self._cast(camera, offset)
        hit = triangle >= 0
        light = np.full((len(rays), 3), 0.75)
        places = camera.position_m + rays[hit] * away[hit][:, None]
        normal = self.normal[triangle[hit]]
        start = (places + 1e-4 * normal).astype(np.float32)
        sun = np.repeat(SUN[None].astype(np.float32), len(start), axis=0)
        lit = np.asarray(self._scene.run(start, sun)) < 0
        facing = np.clip(normal @ SUN, 0.0, 1.0) * lit
        shade = 0.8 * facing + 0.25 + 0.15 * normal[:, 2]
        light[hit] = self._colour(places, self.skin[triangle[hit]]) * shade[:, None]
        return light

    def _colour(self, places: Floats, skin: NDArray[np.intp]) -> Floats:
        """Spots in space: the same from all sides."""
        found = np.empty((len(places), 3))
        for number, look in enumerate(SKINS):
            own = skin == number
            value = np.zeros(int(own.sum()))
            for grid, grain in zip(self._grids, look.grains_m, strict=False):
                value += _noise(grid, places[own] / grain) / len(look.grains_m)
            found[own] = np.array(look.colour) * (1.0 + 2.0 * look.contrast * value)[:, None]
        return np.clip(found, 0.02, 1.0)


def cameras_around(
    count: int, size_px: tuple[int, int], focal_px: float, away_m: float
) -> list[Camera]:
    """On an arc before the objects, up and down in turn."""
    turns = np.radians(np.linspace(-38.0, 38.0, count))
    return [
        look_at(
            (
                0.2 + away_m * float(np.sin(turn)),
                -away_m * float(np.cos(turn)),
                0.7 + 0.3 * (n % 2),
            ),
            (0.2, 0.05, 0.3),
            size_px,
            focal_px,
        )
        for n, turn in enumerate(turns)
    ]


def _from(place: Floats, rays: Floats) -> NDArray[np.float32]:
    return np.repeat(place[None].astype(np.float32), len(rays), axis=0)


def _noise(grid: Floats, places: Floats) -> Floats:
    """Random values at whole places, and between them smooth; it repeats."""
    low = np.floor(places).astype(np.intp)
    share = places - low
    share = share * share * (3.0 - 2.0 * share)
    size = grid.shape[0]
    value = np.zeros(len(places))
    for corner in np.ndindex(2, 2, 2):
        weight = np.where(corner, share, 1.0 - share).prod(axis=1)
        at = (low + corner) % size
        value += weight * grid[at[:, 0], at[:, 1], at[:, 2]]
    return value


def _turned(radius: Floats, height: Floats) -> tuple[Floats, Faces]:
    """Rings of (r, s) radii at (r,) heights as a closed surface, outside outside."""
    rings, sides = radius.shape
    turn = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)
    flat = np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=2)
    points = np.concatenate([flat, np.repeat(height[:, None, None], sides, axis=1)], axis=2)
    number = np.arange(rings * sides).reshape(rings, sides)
    following = np.roll(number, -1, axis=1)
    a, b, c, d = number[:-1], following[:-1], following[1:], number[1:]
    cells = [np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)]
    ends = [np.array([0.0, 0.0, height[0]]), np.array([0.0, 0.0, height[-1]])]
    every = np.concatenate([points.reshape(-1, 3), ends])
    foot, head = rings * sides, rings * sides + 1
    caps = [
        np.stack([np.full(sides, foot), following[0], number[0]], axis=-1),
        np.stack([np.full(sides, head), number[-1], following[-1]], axis=-1),
    ]
    return every, np.concatenate([cell.reshape(-1, 3) for cell in [*cells, *caps]])


def _vase(draw: np.random.Generator) -> tuple[Floats, Faces]:
    """Fluted, with a belly and a neck."""
    share = np.linspace(0.0, 1.0, 160)
    belly = draw.uniform(0.15, 0.20)
    outline = (
        0.09 + belly * np.sin(np.pi * share**0.8) ** 2 + 0.05 * np.clip(share - 0.85, 0, 1) / 0.15
    )
    turn = np.linspace(0.0, 2.0 * np.pi, 320, endpoint=False)
    flutes = 0.012 * np.cos(int(draw.integers(14, 22)) * turn)
    window = np.clip(np.sin(np.pi * share), 0.0, 1.0) ** 0.5
    return _turned(outline[:, None] + window[:, None] * flutes, 0.75 * share)


def _stone(draw: np.random.Generator) -> tuple[Floats, Faces]:
    """A ball with dents, its foot in the table."""
    polar = np.linspace(np.pi, 0.0, 140)[1:-1, None]
    turn = np.linspace(0.0, 2.0 * np.pi, 280, endpoint=False)[None]
    ball = np.stack(
        [np.sin(polar) * np.cos(turn), np.sin(polar) * np.sin(turn), np.cos(polar) + 0 * turn],
        axis=-1,
    )
    grid = draw.uniform(-1.0, 1.0, (16, 16, 16))
    dents = sum(
        strength * _noise(grid, 3.0 + ball.reshape(-1, 3) * scale)
        for strength, scale in ((0.25, 1.5), (0.10, 4.0), (0.03, 12.0))
    )
    radius = 0.26 * (1.0 + np.reshape(dents, ball.shape[:2]))
    points, faces = _turned(radius * np.sin(polar), np.cos(polar).ravel() * 0.26)
    points[: radius.size, 2] = (radius * np.cos(polar)).ravel()
    return points + np.array([0.0, 0.0, 0.17]), faces


def _crate(draw: np.random.Generator) -> tuple[Floats, Faces]:
    """A box of slats before a second, smaller one."""
    side, tall = draw.uniform(0.38, 0.46), draw.uniform(0.42, 0.5)
    boxes = [((-0.46 * side, -0.46 * side, 0.0), (0.46 * side, 0.46 * side, 0.96 * tall))]
    slats = int(draw.integers(4, 7))
    for slat in range(slats):
        low = tall * slat / slats
        boxes.append(((-side / 2, -side / 2, low), (side / 2, side / 2, low + 0.72 * tall / slats)))
    return _turn(_boxes(boxes), draw.uniform(0.2, 0.6))


def _stool(draw: np.random.Generator) -> tuple[Floats, Faces]:
    """A seat on four thin legs with rungs."""
    half, tall = draw.uniform(0.16, 0.2), draw.uniform(0.42, 0.5)
    boxes = [((-half, -half, tall - 0.04), (half, half, tall))]
    for x in (-1.0, 1.0):
        for y in (-1.0, 1.0):
            low = (x * (half - 0.02) - 0.02, y * (half - 0.02) - 0.02, 0.0)
            boxes.append((low, (low[0] + 0.04, low[1] + 0.04, tall - 0.04)))
    for y in (-1.0, 1.0):
        at = y * (half - 0.02)
        boxes.append(((-half, at - 0.0125, 0.15), (half, at + 0.0125, 0.175)))
    return _turn(_boxes(boxes), draw.uniform(-0.5, 0.5))


def _boxes(boxes: Sequence[tuple[tuple[float, ...], tuple[float, ...]]]) -> tuple[Floats, Faces]:
    made = [_slab(low, high) for low, high in boxes]
    return (
        np.concatenate([points for points, _ in made]),
        np.concatenate([faces + 8 * number for number, (_, faces) in enumerate(made)]),
    )


def _slab(low: tuple[float, ...], high: tuple[float, ...]) -> tuple[Floats, Faces]:
    """An upright box."""
    ends = np.array([low, high])
    points = np.array([[ends[i, 0], ends[j, 1], ends[k, 2]] for i, j, k in np.ndindex(2, 2, 2)])
    squares = np.array(
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    )
    return points, np.concatenate([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]])


def _moved(part: tuple[Floats, Faces], by: tuple[float, float, float]) -> tuple[Floats, Faces]:
    return part[0] + np.array(by), part[1]


def _turn(part: tuple[Floats, Faces], angle: float) -> tuple[Floats, Faces]:
    cos, sin = np.cos(angle), np.sin(angle)
    return part[0] @ np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]]), part[1]
