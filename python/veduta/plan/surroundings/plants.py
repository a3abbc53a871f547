"""Plants: where they grow, and what they look like. All of it is invented.

AV3D: what stands upright on a slope does not tip; its lowest part alone, such as the trunk, says
how high it stands, and no part of that is above the ground.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import LineString, Point
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.surroundings.terrain import Terrain

Kind = Literal["tree", "conifer", "shrub"]
SEED = 11
_TREES_EVERY_M, _SHRUBS_EVERY_M = 8.5, 1.9
_TREE_AWAY_M = 7.6
"""From the house to the middle of a tree: a way around the house stays free."""
_SHRUB_AWAY_M = 1.5
_KEPT_M = 2.2
"""Beside a path nothing grows that is wider than this."""
_SEGMENTS = 9
_TRUNK: dict[Kind, float] = {"tree": 0.16, "conifer": 0.14, "shrub": 0.12}


@dataclass(frozen=True)
class Plant:
    """A plant: the middle of its foot (frame of the place, m), its height and turn about itself."""

    kind: Kind
    at_m: tuple[float, float, float]
    height_m: float
    turn_rad: float

    @property
    def foot_m(self) -> float:
        """The radius of its lowest part."""
        return _TRUNK[self.kind] * self.height_m / (1.0 if self.kind == "shrub" else 6.0)


def plants_of(terrain: Terrain, windows: BaseGeometry) -> list[Plant]:
    """Trees along the ends of the plot, shrubs along the house; the same for the same plot.

    windows: before them nothing high grows.
    """
    rng = np.random.default_rng(SEED)
    ways = terrain.taken.difference(terrain.house.buffer(0.6)).buffer(_KEPT_M)
    outer = terrain.house.convex_hull.buffer(_TREE_AWAY_M, join_style="mitre").exterior
    found: list[Plant] = []
    for at in _along(outer, _TREES_EVERY_M, rng):
        if terrain.plot.contains(at) and not ways.intersects(at):
            kind: Kind = "conifer" if rng.random() < 0.3 else "tree"
            found.append(_standing(kind, at, rng.uniform(4.2, 6.5), terrain, rng))
    beds = unary_union(terrain.house.buffer(_SHRUB_AWAY_M, join_style="mitre"))
    rings = [piece.exterior for piece in getattr(beds, "geoms", [beds])]
    kept = unary_union([ways, windows])
    for ring in rings:
        for at in _along(ring, _SHRUBS_EVERY_M, rng):
            if rng.random() < 0.6 and not kept.intersects(at):
                found.append(_standing("shrub", at, rng.uniform(0.5, 0.85), terrain, rng))
    return found


def _along(ring: LineString, every_m: float, rng: np.random.Generator) -> list[Point]:
    """Points along a line, each a little off its place."""
    count = max(1, round(ring.length / every_m))
    stray = rng.uniform(-0.35, 0.35, count) * every_m
    return [
        ring.interpolate(float((number + 0.5) * ring.length / count + off) % ring.length)
        for number, off in enumerate(stray)
    ]


def _standing(
    kind: Kind, at: Point, height_m: float, terrain: Terrain, rng: np.random.Generator
) -> Plant:
    x, y, turn = at.x, at.y, float(rng.uniform(0.0, 2.0 * math.pi))
    foot = Plant(kind, (x, y, 0.0), height_m, turn).foot_m
    return Plant(kind, (x, y, resting_height(terrain, (x, y), foot)), height_m, turn)


def resting_height(terrain: Terrain, at_m: tuple[float, float], foot_m: float) -> float:
    """How high a round foot stands so that no part of it is above the ground."""
    angle = 2.0 * np.pi * np.arange(16) / 16
    rim = np.array(at_m) + foot_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return float(terrain.height(np.concatenate([rim, [at_m]])).min())


Faces = list[NDArray[np.float64]]


def body(plant: Plant) -> list[tuple[Literal["bark", "leaves", "needles", "bush"], Faces]]:
    """What a plant looks like, about the middle of its foot: faces of each of its parts, (n, 3)."""
    high = plant.height_m
    if plant.kind == "shrub":
        return [("bush", _lump(0.62 * high, (0.0, 0.0, 0.45 * high), 0.9, plant.turn_rad))]
    foot = plant.foot_m
    if plant.kind == "conifer":
        trunk = _cone(foot, 0.7 * foot, 0.0, 0.22 * high, plant.turn_rad)
        tiers = [
            _cone(0.25 * high * size, 0.04 * high * size, low * high, top * high, plant.turn_rad)
            for size, low, top in ((0.95, 0.13, 0.5), (0.75, 0.36, 0.74), (0.5, 0.62, 1.0))
        ]
        return [("bark", trunk), ("needles", [face for tier in tiers for face in tier])]
    trunk = _cone(foot, 0.6 * foot, 0.0, 0.5 * high, plant.turn_rad)
    crown: Faces = []
    for number, (size, out, up) in enumerate(
        ((0.25, 0.0, 0.74), (0.19, 0.15, 0.58), (0.18, 0.15, 0.63), (0.18, 0.16, 0.6))
    ):
        angle = plant.turn_rad + 2.1 * number
        middle = (out * high * math.cos(angle), out * high * math.sin(angle), up * high)
        crown += _lump(size * high, middle, 0.95, angle)
    return [("bark", trunk), ("leaves", crown)]


def _cone(low_r: float, high_r: float, low: float, high: float, turn: float) -> Faces:
    """A piece of a cone, closed, counter-clockwise seen from outside."""
    angle = turn + 2.0 * np.pi * np.arange(_SEGMENTS) / _SEGMENTS
    circle = np.stack([np.cos(angle), np.sin(angle), np.zeros(_SEGMENTS)], axis=1)
    below = low_r * circle + [0.0, 0.0, low]
    above = high_r * circle + [0.0, 0.0, high]
    sides = np.stack([below, np.roll(below, -1, 0), np.roll(above, -1, 0), above], axis=1)
    return [below[::-1], above, *sides]


def _lump(radius: float, middle: tuple[float, float, float], flat: float, turn: float) -> Faces:
    """A rounded lump: a ball of flat faces whose corners are a little in and out."""
    rings = np.linspace(-0.5 * np.pi, 0.5 * np.pi, 7)
    angle = turn + 2.0 * np.pi * np.arange(_SEGMENTS + 1) / _SEGMENTS
    bumps = 1.0 + 0.09 * np.sin(3.0 * angle[None] + 5.0 * rings[:, None]) * np.cos(rings)[:, None]
    size = radius * bumps
    x = size * np.cos(rings)[:, None] * np.cos(angle)
    y = size * np.cos(rings)[:, None] * np.sin(angle)
    z = flat * size * np.sin(rings)[:, None]
    points = np.stack([x, y, z], axis=2) + np.array(middle)
    faces: Faces = []
    for ring in range(len(rings) - 1):
        for k in range(_SEGMENTS):
            a, b = points[ring, k], points[ring, k + 1]
            c, d = points[ring + 1, k + 1], points[ring + 1, k]
            if ring > 0:
                faces.append(np.array([a, b, c]))
            if ring < len(rings) - 2:
                faces.append(np.array([a, c, d]))
    return faces
