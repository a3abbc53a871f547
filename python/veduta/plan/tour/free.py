"""Where a visitor can walk in a storey: floors less walls, open leaves, stairs and furniture.

Plan frame (m). Configuration space of a disc: what is in the way is grown by the visitor's radius,
so that where its middle may be is one region (Lozano-Perez, 1983).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import shapely
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.plan.document import Furniture
from veduta.plan.house.doors import FRAME_M
from veduta.plan.house.flights import AnyFlight
from veduta.plan.house.furniture import footprint
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space
from veduta.plan.tour.leaves import DoorLeaf

BODY_M = 0.2
"""Radius of the visitor."""
SLIM_M = 0.14
"""Of one who turns sideways, where that leads to more rooms: between two leaves that stand open."""
HEAD_M = 1.8
"""What lies higher above the floor is walked under."""
FOOT_M = 0.05
"""What is lower than this is walked over: carpets, thresholds."""
GRAZE_M = 0.03
"""So much nearer than it may a straight piece between two points come to a convex corner."""
_THROUGH_M = 1e-3
"""How far a passage reaches beyond both faces of its wall."""


@dataclass(frozen=True)
class Ground:
    """A storey as a visitor meets it.

    solid: what stands in the way. floor: what there is to walk on. body_m: the visitor's radius.
    """

    space: Space
    solid: BaseGeometry
    floor: BaseGeometry
    body_m: float = BODY_M

    @cached_property
    def free(self) -> BaseGeometry:
        """Where the middle of the visitor may be."""
        region = self.floor.difference(self.solid.buffer(self.body_m, quad_segs=4))
        shapely.prepare(region)
        return region

    @cached_property
    def grazed(self) -> BaseGeometry:
        """Where straight pieces of a way may be whose points are in what is free."""
        region = self.free.buffer(GRAZE_M)
        shapely.prepare(region)
        return region

    @property
    def elevation_m(self) -> float:
        """Of the floor, in the plan frame."""
        return self.space.storey.elevation_m


def ground_of(
    space: Space,
    leaves: Sequence[DoorLeaf],
    outdoors: BaseGeometry,
    flights: Sequence[AnyFlight],
    body_m: float = BODY_M,
) -> Ground:
    """The ground of a storey; outdoors is what of the surroundings one may walk on.

    flights: those that lead up from this storey. What comes up to it leaves a well in its floor.
    """
    storey = space.storey
    low, high = storey.elevation_m + FOOT_M, storey.elevation_m + HEAD_M
    passages = [_passage(hole) for hole in space.holes if _is_passable(hole)]
    solid = unary_union(
        [
            space.walls.difference(unary_union(passages)),
            *(leaf.footprint for leaf in leaves if leaf.low_m < high and leaf.high_m > low),
            *(flight.outline for flight in flights),
            space.well,
            *obstacles(storey.furniture or ()),
        ]
    )
    floor = unary_union([space.slab, outdoors])
    if outdoors.is_empty:
        # No one steps over the edge of a floor.
        floor = floor.buffer(-body_m)
    return Ground(space, solid, floor, body_m)


def obstacles(furniture: Iterable[Furniture]) -> list[Polygon]:
    """The footprints of what one would run into."""
    return [
        footprint(item)
        for item in furniture
        if item.above_m < HEAD_M and item.above_m + item.size_m[2] > FOOT_M
    ]


def _is_passable(hole: Hole) -> bool:
    """Whether one walks through it upright."""
    return hole.opening.kind != "window" and hole.low_m <= FOOT_M and hole.high_m >= HEAD_M


def _passage(hole: Hole) -> Polygon:
    """What an opening leaves free between its linings, through the whole wall."""
    inset = min(FRAME_M, (hole.end_m - hole.start_m) / 3.0)
    return hole.line.piece(hole.start_m + inset, hole.end_m - inset, hole.line.half_m + _THROUGH_M)
