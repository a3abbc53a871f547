"""A room as furnishing sees it: its floor, its walls, and what must stay free.

Plan frame, metres; heights are from the room's floor.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import affinity
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

from veduta.plan.document import Room, Stairs
from veduta.plan.house.hole import ENDS, End, Hole
from veduta.plan.house.sliding import SLIDING
from veduta.plan.house.space import Space, pieces_of

APPROACH_M = 0.65
"""What stays free before a door."""
LEAF_M = 0.06
"""How thick a leaf stands in the way, no less than a cell of the grid on which one walks."""
WINDOW_M = 0.35
"""How near things that are higher than its sill come to a window."""
STEP_M = 0.8
"""What stays free at the foot and the head of stairs."""
LEAST_WALL_M = 0.25
LEAST_FLOOR_M2 = 0.2
_STRAIGHT_M = 0.015
_BEHIND_M = 0.03
Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Stretch:
    """A straight piece of wall, the room on the left of who goes along it.

    start, along, inward: (2,), the latter two unit vectors. door_m: from its middle to the nearest
    door's. inner_start, inner_end: whether it ends in a corner of the room.
    """

    start: Vector
    along: Vector
    length: float
    door_m: float
    inner_start: bool
    inner_end: bool

    @property
    def inward(self) -> Vector:
        """Into the room."""
        return np.array([-self.along[1], self.along[0]])

    def at(self, along_m: float, into_m: float = 0.0) -> Vector:
        """A point along it and into the room."""
        point: Vector = self.start + along_m * self.along + into_m * self.inward
        return point

    @property
    def turn(self) -> float:
        """Of things whose back stands against it (rad, as `Furniture.turn_rad`)."""
        return float(np.arctan2(self.inward[0], -self.inward[1]))


@dataclass(frozen=True)
class Window:
    """What lies before a window, and how high its sill is."""

    hole: Hole
    zone: Polygon
    low_m: float
    inward: Vector


@dataclass(frozen=True)
class RoomSpace:
    """A room with all that limits what stands in it.

    region: the floor as it is; `floor` has straight walls made plain. doors: (n, 2) points before
    its doors. blocked: what doors, their leaves and stairs need. leaves: where those stand that
    open into the room: furniture that one would only reach through them is out of reach.
    """

    room: Room
    region: Polygon
    floor: Polygon
    stretches: tuple[Stretch, ...]
    doors: NDArray[np.float64]
    blocked: BaseGeometry
    windows: tuple[Window, ...]
    height_m: float
    leaves: BaseGeometry

    @cached_property
    def inside(self) -> Polygon:
        """The floor with a tolerance, prepared."""
        grown = self.region.buffer(1e-3, join_style="mitre")
        shapely.prepare(grown)
        return grown

    @cached_property
    def door_way(self) -> Vector:
        """The first door, or the room's middle."""
        return self.doors[0] if len(self.doors) else np.array(self.floor.centroid.coords[0])


def room_spaces(
    space: Space, height_m: float, stairs_below: Sequence[Stairs] = ()
) -> list[RoomSpace]:
    """The rooms of a storey that have a floor; stairs_below come up through it."""
    stairs = [_flight(one, comes_up=False) for one in space.storey.stairs]
    stairs += [_flight(one, comes_up=True) for one in stairs_below]
    found = []
    for room, region in space.floors:
        if room is None or room.open_below:
            continue
        # Narrow necks beside chimneys and in window niches are no floor to stand on.
        whole = max(pieces_of(region), key=lambda piece: piece.area)
        floor = _simple(whole)
        if floor.is_valid and floor.area > LEAST_FLOOR_M2:
            found.append(_room_space(room, (whole, floor), space, height_m, stairs))
    return found


def _simple(floor: Polygon) -> Polygon:
    """Counter-clockwise, without corners on straight walls."""
    plain = floor.simplify(_STRAIGHT_M)
    return orient(plain if isinstance(plain, Polygon) else floor)


def _room_space(
    room: Room,
    floors: tuple[Polygon, Polygon],
    space: Space,
    height_m: float,
    stairs: list[BaseGeometry],
) -> RoomSpace:
    floor = floors[1]
    ways = [(hole, sign) for hole in space.holes for sign in _sides(hole, room)]
    doors = [way for way in ways if way[0].opening.kind != "window"]
    points = np.array([_before(hole, sign) for hole, sign in doors]).reshape(-1, 2)
    middles = np.array([hole.middle for hole, _ in doors]).reshape(-1, 2)
    zones = [zone for hole, sign in doors for zone in _door_zones(hole, sign)]
    windows = tuple(
        Window(hole, _front_of(hole, sign, WINDOW_M, 0.0), hole.low_m, sign * hole.leftward)
        for hole, sign in ways
        if hole.opening.kind == "window"
    )
    # A car fills a garage: nobody walks around the leaf of its inner door then.
    swung = doors if room.use != "garage" else []
    leaves = unary_union([leaf for hole, sign in swung for leaf in _leaves(hole, sign)])
    blocked = unary_union([*zones, *stairs]).intersection(floor.buffer(0.05))
    shapely.prepare(blocked)
    walls = space.walls.buffer(1e-3)
    shapely.prepare(walls)
    stretches = [
        one
        for ring in (floor.exterior, *floor.interiors)
        for one in _stretches(np.array(ring.coords)[:-1], walls, middles)
    ]
    return RoomSpace(room, *floors, tuple(stretches), points, blocked, windows, height_m, leaves)


def _sides(hole: Hole, room: Room) -> list[float]:
    """+1 where the room is on the left of an opening, -1 on its right."""
    return [
        sign
        for sign, beside in ((1.0, hole.left), (-1.0, hole.right))
        if beside is not None and beside.id == room.id
    ]


def _before(hole: Hole, sign: float) -> Vector:
    """Where one stands before a door."""
    return hole.middle + sign * (hole.line.half_m + 0.32) * hole.leftward


def _front_of(hole: Hole, sign: float, deep_m: float, beside_m: float) -> Polygon:
    """The rectangle before an opening, from the middle of its wall on."""
    inward = sign * hole.leftward
    first = hole.start - beside_m * hole.along
    last = hole.start + (hole.width_m + beside_m) * hole.along
    out = (hole.line.half_m + deep_m) * inward
    return Polygon([first, last, last + out, first + out])


def _door_zones(hole: Hole, sign: float) -> list[Polygon]:
    """What a door needs on one side: an approach, the sweep of its leaves."""
    opening = hole.opening
    garage = hole.type == "garage"
    zones = [_front_of(hole, sign, APPROACH_M, 0.03)]
    if opening.kind == "gap" or hole.type == "plain" or garage:
        return zones
    if hole.type in SLIDING:
        # The leaf runs along the wall.
        return [*zones, _front_of(hole, sign, 0.1, hole.width_m)]
    if not _opens_to(hole, sign):
        return zones
    radius = (hole.width_m / 2.0 if _has_two(hole) else hole.width_m) + 0.03
    return zones + [hole.sweep(end, sign, radius) for end in _hung_at(hole)]


def _opens_to(hole: Hole, sign: float) -> bool:
    """Whether a leaf comes into the room on this side."""
    return hole.swing == "both" or (-1.0 if hole.swing == "right" else 1.0) == sign


def _has_two(hole: Hole) -> bool:
    """Whether half of a door hangs at either end."""
    return hole.hinge == "both" or hole.type in {"double", "french", "folding"}


def _hung_at(hole: Hole) -> list[End]:
    return [end for end in ENDS if _has_two(hole) or end == hole.hinge]


def _leaves(hole: Hole, sign: float) -> list[Polygon]:
    """Where the leaves of a door stand when they are open to this side; none of what slides."""
    still = hole.opening.kind == "gap" or hole.type in {"plain", "garage", "folding", *SLIDING}
    if still or not _opens_to(hole, sign):
        return []
    size = hole.width_m / 2.0 if _has_two(hole) else hole.width_m
    found = []
    for end in _hung_at(hole):
        at_start = end == "start"
        hinge = hole.start + (0.0 if at_start else hole.width_m) * hole.along
        hinge = hinge + sign * hole.line.half_m * hole.leftward
        tip = hinge + sign * size * hole.leftward
        thick = (1.0 if at_start else -1.0) * LEAF_M * hole.along
        found.append(Polygon([hinge, tip, tip + thick, hinge + thick]))
    return found


def _flight(stairs: Stairs, *, comes_up: bool) -> BaseGeometry:
    """A flight with the step before its foot, or, on the storey above, behind its head."""
    shape = Polygon(stairs.outline_m).buffer(0.02, join_style="mitre")
    if stairs.path_m:
        return unary_union([shape, _stand(np.array(stairs.path_m), comes_up=comes_up)])
    way = np.array(stairs.up) * (1.0 if comes_up else -1.0)
    moved = affinity.translate(shape, *(STEP_M * way))
    return unary_union([shape, moved]).convex_hull if np.any(way) else shape.buffer(0.4)


def _stand(path: NDArray[np.float64], *, comes_up: bool) -> BaseGeometry:
    """Where one steps on or off stairs that turn."""
    end, before = path[[-1, -2] if comes_up else [0, 1]]
    out = (end - before) / np.hypot(*(end - before))
    return LineString([end, end + STEP_M * out]).buffer(STEP_M / 2.0, cap_style="flat")


def _stretches(
    ring: NDArray[np.float64], walls: BaseGeometry, doors: NDArray[np.float64]
) -> list[Stretch]:
    """The straight edges of a ring along which there is a wall; the room is on their left."""
    edges = np.roll(ring, -1, axis=0) - ring
    lengths = np.linalg.norm(edges, axis=1)
    found = []
    for k, (start, edge, length) in enumerate(zip(ring, edges, lengths, strict=True)):
        if length < LEAST_WALL_M:
            continue
        along = edge / length
        behind = np.array([along[1], -along[0]]) * _BEHIND_M
        line = LineString([start + behind, start + edge + behind]).intersection(walls)
        after, before = edges[(k + 1) % len(ring)], edges[k - 1]
        for piece in getattr(line, "geoms", [line]):
            if piece.length < LEAST_WALL_M:
                continue
            first, last = sorted(float((np.array(p) - start) @ along) for p in piece.coords[::1])
            first, last = max(first, 0.0), min(last, float(length))
            middle = start + (first + last) / 2.0 * along
            far = float(np.linalg.norm(doors - middle, axis=1).min()) if len(doors) else 0.0
            found.append(
                Stretch(
                    start + first * along, along, last - first, far,
                    first < 1e-3 and _turns_left(before, edge),
                    last > length - 1e-3 and _turns_left(edge, after),
                )
            )  # fmt: skip
    return found


def _turns_left(first: Vector, second: Vector) -> bool:
    return bool(first[0] * second[1] - first[1] * second[0] > 0.0)
