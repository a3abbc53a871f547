"""Which way a leaf slides: along a wall, where it covers no other opening and runs into no wall."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.house.hole import ENDS, End, Hinge, Hole

SLIDING = frozenset({"sliding", "pocket"})
LEAF_M, OVER_M = 0.04, 0.016
"""Of a leaf before the wall: how thick it is, and how far from the wall's face."""
NO_WALL = 1.5
"""What speaks against a leaf that stands open beside no wall: it would hang in the air."""
BEFORE_DOOR, BEFORE_WINDOW = 2.0, 0.5
"""What speaks against a leaf that stands open before another opening, wholly: 1 is one that would
have to stand in a wall."""
OUTSIDE = 0.6
"""What speaks against a leaf that slides outdoors: it is within."""
TWO_LEAVES = 0.08
"""What speaks against two leaves where one would do."""


@dataclass(frozen=True)
class Around:
    """What leaves may be in the way of.

    holes: other openings. rooms: the floor of each, by its id. walls: all of the storey, openings
    not cut.
    """

    holes: Sequence[Hole]
    rooms: Mapping[str, Polygon]
    walls: BaseGeometry


def against_slide(hole: Hole, hinge: Hinge, side: float, around: Around) -> float:
    """What speaks against leaves that slide to an end, or half to each: "both".

    side: +1 where they run on the left of the wall, -1 on the right.
    """
    if hinge == "both":
        halves = [_against(hole, end, side, 0.5, around) for end in ENDS]
        return TWO_LEAVES + sum(halves) / 2.0
    return _against(hole, hinge, side, 1.0, around)


def _against(hole: Hole, end: End, side: float, share: float, around: Around) -> float:
    """The same of one leaf, as wide as a share of its door."""
    width = share * hole.width_m
    in_wall = (-hole.line.half_m, hole.line.half_m)
    beside = _beyond(hole, end, width, in_wall)
    found = NO_WALL * (1.0 - beside.intersection(around.walls).area / beside.area)
    is_pocket = hole.type == "pocket"
    face = hole.line.half_m + OVER_M
    leaf = beside if is_pocket else _beyond(hole, end, width, (side * face, side * (face + LEAF_M)))
    room = hole.left if side > 0.0 else hole.right
    if not is_pocket:
        inside = room is not None and not room.outdoors
        free = around.rooms[room.id] if room is not None and inside else None
        found += OUTSIDE if free is None else 1.0 - leaf.intersection(free).area / leaf.area
    for other in around.holes:
        slight = other.opening.kind == "window" and not is_pocket
        near = other.outline.buffer(0.0 if is_pocket else LEAF_M + OVER_M)
        weight = BEFORE_WINDOW if slight else BEFORE_DOOR
        found += weight * leaf.intersection(near).area / leaf.area
    return found


def _beyond(hole: Hole, end: End, width_m: float, across_m: tuple[float, float]) -> Polygon:
    """A rectangle beyond an end of the opening; across_m: to the left of the centre line."""
    beyond = -1.0 if end == "start" else 1.0
    near = hole.start + (0.0 if end == "start" else hole.width_m) * hole.along
    far = near + beyond * width_m * hole.along
    first, last = (bound * hole.leftward for bound in across_m)
    return Polygon([near + first, far + first, far + last, near + last])
