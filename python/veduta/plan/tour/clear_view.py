"""Where one looks on a tour so that no wall is right before one's eyes.

The wished directions are kept as far as they see far enough; elsewhere the nearest direction that
does is taken, without jumps: the cheapest course through all directions at all times, by dynamic
programming (Viterbi 1967).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.house.furniture import footprint
from veduta.plan.house.space import Space, pieces_of
from veduta.plan.tour.free import Ground
from veduta.plan.tour.leaves import DoorLeaf


@dataclass(frozen=True)
class ViewRule:
    """How far one sees, and how much a direction away from the wished one costs.

    near_m: a wall nearer than this is one before one's eyes; 1 m is asked for, the rest is for the
    calm of the head. blocked: cost of each metre that is missing to that, a second, beside the
    square of the angle (rad) to the wish. turning: cost of the square of a turn between two
    samples. step_rad, reach: directions, and by how many of them one turns in a sample: who turns
    faster than the view may is slowed down, with a wall before the eyes; who turns slower does not
    look around in narrow rooms. cell_m: of the map of walls. margin_m: by which it goes beyond
    them; who is farther away sees far. Chosen on ten drawn houses (seeds 31000 to 31009), so that
    as many rooms are looked around in.
    """

    near_m: float = 1.2
    blocked: float = 100.0
    turning: float = 0.5
    step_rad: float = np.pi / 36.0
    reach: int = 2
    cell_m: float = 0.05
    margin_m: float = 2.0


VIEW = ViewRule()
SEEN_M = 1.6
"""What reaches over this above the floor is before one's eyes: they are a little higher."""


@dataclass(frozen=True)
class Sight:
    """What of a storey one cannot see through, as a map (h, w). origin_m: its corner."""

    elevation_m: float
    solid: NDArray[np.bool_]
    origin_m: NDArray[np.float64]

    def depths(
        self, feet_m: NDArray[np.float64], angles: NDArray[np.float64], rule: ViewRule
    ) -> NDArray[np.float64]:
        """(n, k) how far one sees from places (n, 2) in directions (k,), at most `near_m`."""
        ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        far = np.full((len(feet_m), len(angles)), rule.near_m)
        height, width = self.solid.shape
        for away in np.arange(rule.near_m, 0.0, -rule.cell_m):
            at = (feet_m[:, None] + away * ways[None] - self.origin_m) / rule.cell_m
            column, row = at[..., 0].astype(np.int64), at[..., 1].astype(np.int64)
            known = (column >= 0) & (row >= 0) & (column < width) & (row < height)
            hit = known & self.solid[row.clip(0, height - 1), column.clip(0, width - 1)]
            far[hit] = away
        return far


def sights_of(
    grounds: Sequence[Ground], leaves: Sequence[DoorLeaf] = (), rule: ViewRule = VIEW
) -> list[Sight]:
    """The maps of all storeys: what is before one's eyes, and near walls that one looks past."""
    return [
        _sight(before_eyes(ground.space, leaves), ground.elevation_m, rule) for ground in grounds
    ]


def before_eyes(space: Space, leaves: Sequence[DoorLeaf] = ()) -> BaseGeometry:
    """What one cannot see through at the height of the eyes: walls, leaves, tall furniture.

    Doors, gaps and windows are seen through; leaves are those of open doors as they stand.
    """
    storey = space.storey
    eyes = storey.elevation_m + SEEN_M
    tall = [
        footprint(item)
        for item in storey.furniture or ()
        if item.above_m < SEEN_M < item.above_m + item.size_m[2]
    ]
    stood = [leaf.footprint for leaf in leaves if leaf.low_m < eyes < leaf.high_m]
    walls = space.walls.difference(unary_union([hole.outline for hole in space.holes]))
    return unary_union([walls, *tall, *stood])


def cleared(
    feet_m: NDArray[np.float64],
    yaw: NDArray[np.float64],
    sights: Sequence[Sight],
    rule: ViewRule = VIEW,
) -> NDArray[np.float64]:
    """(n,) yaws near the wished ones from which one sees farther than `near_m`, where there are."""
    if not sights or len(yaw) < 2:
        return yaw
    count = round(2.0 * np.pi / rule.step_rad)
    angles = np.asarray(rule.step_rad * np.arange(count), dtype=np.float64)
    elevations = np.array([one.elevation_m for one in sights])
    storey = np.abs(feet_m[:, 2, None] - elevations[None]).argmin(axis=1)
    depth = np.full((len(yaw), count), rule.near_m)
    for number, sight in enumerate(sights):
        here = storey == number
        depth[here] = sight.depths(feet_m[here, :2], angles, rule)
    off = np.angle(np.exp(1j * (angles[None] - yaw[:, None])))
    cost = off**2 + rule.blocked * (rule.near_m - depth)
    wished = np.round(yaw / rule.step_rad).astype(np.int64) % count
    if (depth[np.arange(len(yaw)), wished] >= rule.near_m).all():
        return yaw
    course = _cheapest(cost, rule)
    chosen = np.unwrap(angles[course])
    # What needed no change keeps its own direction, to parts of a step.
    turns = np.round((yaw - chosen) / (2.0 * np.pi)) * 2.0 * np.pi
    near = np.abs(yaw - turns - chosen) <= rule.step_rad
    found: NDArray[np.float64] = np.where(near, yaw - turns, chosen)
    return found


def _cheapest(cost: NDArray[np.float64], rule: ViewRule) -> NDArray[np.int64]:
    """(n,) the states of the cheapest course through costs (n, k), whose states are a ring."""
    shifts = np.arange(-rule.reach, rule.reach + 1)
    turning = rule.turning * (rule.step_rad * shifts) ** 2
    total = cost[0]
    came = np.zeros(cost.shape, dtype=np.int64)
    for time in range(1, len(cost)):
        options = np.stack([np.roll(total, shift) for shift in shifts]) + turning[:, None]
        best = options.argmin(axis=0)
        came[time] = (np.arange(cost.shape[1]) - shifts[best]) % cost.shape[1]
        total = options[best, np.arange(cost.shape[1])] + cost[time]
    course = np.zeros(len(cost), dtype=np.int64)
    course[-1] = int(total.argmin())
    for time in range(len(cost) - 1, 0, -1):
        course[time - 1] = came[time, course[time]]
    return course


def _sight(solid: BaseGeometry, elevation_m: float, rule: ViewRule) -> Sight:
    left, bottom, right, top = solid.bounds if not solid.is_empty else (0.0, 0.0, 1.0, 1.0)
    origin = np.array([left, bottom]) - rule.margin_m
    size = np.ceil((np.array([right, top]) + rule.margin_m - origin) / rule.cell_m).astype(int)
    mask = np.zeros((int(size[1]) + 1, int(size[0]) + 1), dtype=np.uint8)
    for piece in pieces_of(solid):
        rings = [
            np.round((np.array(ring.coords) - origin) / rule.cell_m).astype(np.int32)
            for ring in (piece.exterior, *piece.interiors)
        ]
        cv2.fillPoly(mask, rings, 1)
    return Sight(elevation_m, mask.astype(np.bool_), origin)
