"""Which way a leaf slides: where it covers no other opening and runs into no wall."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from shapely.geometry import Polygon

from veduta.plan.house.hole import ENDS, End, Hinge, Hole

SLIDING = frozenset({"sliding", "pocket"})
LEAF_M, OVER_M = 0.04, 0.016
"""Of a leaf before the wall: how thick it is, and how far from the wall's face."""
BEFORE_DOOR, BEFORE_WINDOW = 2.0, 0.5
"""What speaks against a leaf that stands open before another opening, wholly: 1 is one that would
have to stand in a wall."""
OUTSIDE = 0.6
"""What speaks against a leaf that slides outdoors: it is within."""
TWO_LEAVES = 0.08
"""What speaks against two leaves where one would do."""


def against_slide(
    hole: Hole, hinge: Hinge, side: float, others: Sequence[Hole], shapes: Mapping[str, Polygon]
) -> float:
    """What speaks against leaves that slide to an end, or half to each: "both".

    side: +1 where they run on the left of the wall, -1 on the right. shapes: the floor of each
    room, by its id.
    """
    if hinge == "both":
        halves = [_against(hole, end, side, 0.5, others, shapes) for end in ENDS]
        return TWO_LEAVES + sum(halves) / 2.0
    return _against(hole, hinge, side, 1.0, others, shapes)


def _against(
    hole: Hole,
    end: End,
    side: float,
    share: float,
    others: Sequence[Hole],
    shapes: Mapping[str, Polygon],
) -> float:
    """The same of one leaf, as wide as a share of its door."""
    width = share * hole.width_m
    leaf = _open_leaf(hole, end, side, width)
    room = hole.left if side > 0.0 else hole.right
    if hole.type == "pocket":
        length = hole.start_m if end == "start" else hole.line.line.length - hole.end_m
        found = max(0.0, 1.0 - length / width)
    elif room is None or room.outdoors:
        found = OUTSIDE
    else:
        found = 1.0 - leaf.intersection(shapes[room.id]).area / leaf.area
    for other in others:
        weight = BEFORE_WINDOW if other.opening.kind == "window" else BEFORE_DOOR
        near = other.outline.buffer(LEAF_M + OVER_M)
        found += weight * leaf.intersection(near).area / leaf.area
    return found


def _open_leaf(hole: Hole, end: End, side: float, width_m: float) -> Polygon:
    """Beyond the opening: before the wall's face, or in the wall if it is a pocket door."""
    beyond = -1.0 if end == "start" else 1.0
    near = hole.start + (0.0 if end == "start" else hole.width_m) * hole.along
    far = near + beyond * width_m * hole.along
    if hole.type == "pocket":
        bounds = (-LEAF_M / 2.0, LEAF_M / 2.0)
    else:
        face = hole.line.half_m + OVER_M
        bounds = (side * face, side * (face + LEAF_M))
    first, last = (bound * hole.leftward for bound in bounds)
    return Polygon([near + first, far + first, far + last, near + last])
