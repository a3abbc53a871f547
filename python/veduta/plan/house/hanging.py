"""How leaves hang that are not drawn: where a builder would hang them.

A door of unknown type that is too wide for one leaf slides before closets and to the outdoors, and
has two leaves elsewhere. A leaf opens into the room that is entered, not into the way that leads
there, nor into a closet that it would fill; and it stands open against the wall that is nearest to
its hinge, before no other opening. What slides does so where it is least in the way (`sliding`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from shapely.geometry import Point, Polygon
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import DoorType, Room, RoomUse
from veduta.plan.house.hole import ENDS, End, Hinge, Hole, Swing
from veduta.plan.house.sliding import SLIDING, Around, against_slide

Rooms = Sequence[tuple[Room, Polygon]]

WAYS: frozenset[RoomUse] = frozenset({"hall", "corridor", "stairs"})
"""What one passes through: leaves do not open into it."""
WIDEST_LEAF_M = 1.15
CLOSET_M2 = 2.5
"""A room that is no larger would be filled by a leaf."""
INTO_WAY, INTO_CLOSET, OUT_OF_DOORS, INTO_LARGER = 2.0, 3.0, 2.5, 0.5
"""What speaks against a side, in leaves that strike a wall: 1 is a leaf that cannot open."""
BEFORE_OPENING, BEFORE_M = 1.5, 0.3
"""What speaks against a leaf that stands open so near before another opening."""
FAR = 0.3
"""What speaks against a hinge that is the further from the walls beside it."""
_THICK_M = 0.05


def hung(holes: Sequence[Hole], rooms: Rooms, walls: BaseGeometry) -> tuple[Hole, ...]:
    """The openings with the hinge and the swing of each leaf: as drawn, else where it is best.

    walls: all of the storey, openings not cut.
    """
    around = Around(holes, {room.id: shape for room, shape in rooms}, walls)
    return tuple(_hung(hole, around) for hole in holes)


def _hung(hole: Hole, around: Around) -> Hole:
    opening, guess = hole.opening, _guess(hole)
    hole = replace(hole, guess=guess)
    swings: tuple[Swing, ...] = ("left", "right")
    if opening.hinge == "both" or guess == "double":
        hinges: tuple[Hinge, ...] = ("both",)
    elif opening.hinge == "none":
        hinges = (*ENDS, "both") if hole.type in SLIDING else ENDS
    else:
        hinges = (opening.hinge,)
    if opening.swing != "none" and not (hole.type in SLIDING and opening.swing == "both"):
        swings = (opening.swing,)
    ways = [(hinge, swing) for swing in swings for hinge in hinges]
    if opening.kind != "door" or len(ways) == 1:
        hinge, swing = ways[0]
    else:
        others = [one for one in around.holes if one.opening.id != opening.id]
        beside = replace(around, holes=others)
        hinge, swing = min(ways, key=lambda way: _against(hole, way[0], way[1], beside))
    return replace(hole, hinge=hinge, swing=swing)


def _guess(hole: Hole) -> DoorType | None:
    """What a wide door is that shows no leaf; None where it is drawn, or one leaf is enough."""
    opening = hole.opening
    is_told = opening.kind != "door" or opening.type != "unknown" or opening.hinge != "none"
    if is_told or hole.width_m <= WIDEST_LEAF_M:
        return None
    sides = (hole.left, hole.right)
    closet = any(room is not None and room.area_m2 <= CLOSET_M2 for room in sides)
    return "sliding" if hole.is_outer or closet else "double"


def _against(hole: Hole, hinge: Hinge, swing: Swing, around: Around) -> float:
    """What speaks against a way to hang it."""
    if hole.type in SLIDING and swing != "both":
        side = 1.0 if swing == "left" else -1.0
        return against_slide(hole, hinge, side, around)
    into, other = (hole.left, hole.right) if swing == "left" else (hole.right, hole.left)
    found = _against_side(into, other)
    if into is None or hinge == "both" or swing == "both":
        return found
    side = 1.0 if swing == "left" else -1.0
    room = around.rooms[into.id]
    swept = hole.sweep(hinge, side, hole.width_m)
    found += 1.0 - swept.intersection(room).area / swept.area
    open_leaf = _open_leaf(hole, hinge, side)
    if any(open_leaf.distance(one.outline) < BEFORE_M for one in around.holes):
        found += BEFORE_OPENING
    edge = Point(open_leaf.exterior.coords[1])
    return found + FAR * min(1.0, edge.distance(room.exterior) / hole.width_m)


def _against_side(into: Room | None, other: Room | None) -> float:
    if into is None or into.outdoors:
        return OUT_OF_DOORS
    if other is None or other.outdoors:
        return 0.0
    found = INTO_CLOSET if into.area_m2 <= CLOSET_M2 else 0.0
    found += INTO_WAY if into.use in WAYS else 0.0
    return found + (INTO_LARGER if into.area_m2 > other.area_m2 else 0.0)


def _open_leaf(hole: Hole, hinge: End, side: float) -> Polygon:
    """The leaf at a right angle to its wall, with a little on the side of its hinge."""
    at_start = hinge == "start"
    near = hole.start + (0.0 if at_start else hole.width_m) * hole.along
    near = near + side * hole.line.half_m * hole.leftward
    far = near + side * hole.width_m * hole.leftward
    behind = (-1.0 if at_start else 1.0) * _THICK_M * hole.along
    return Polygon([near, far, far + behind, near + behind])
