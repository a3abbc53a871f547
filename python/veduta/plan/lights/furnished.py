"""Lamps that go with furniture: those that stand in the document, and one beside a seat."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from shapely.geometry import Point
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Furniture, Light

FLOOR_LUMEN, TABLE_LUMEN = 800.0, 450.0
FLOOR_LAMP_M = 1.55
"""From the floor to where a floor lamp shines from."""
FOOT_M = 0.16
"""Radius of its foot."""
_SEATS = ("armchair", "sofa", "couch")
_BESIDE_M = 0.08
_SHADE = 0.85
"""A lamp shines from this share of its height."""
_NEAR_M = 2.0
_WALL_M = 0.04


def light_id(item: Furniture) -> str:
    """The id of the light of a lamp that is furniture."""
    return f"{item.id}-light"


def furniture_lamps(room: str, things: Sequence[Furniture]) -> list[Light]:
    """The lamps among the things of a room: they stand on the floor or on other things."""
    lamps = []
    for item in things:
        if "lamp" not in item.object or "ceiling" in item.object:
            continue
        is_table = item.on is not None or item.above_m > 0.2
        lamps.append(
            Light(
                id=light_id(item),
                kind="table" if is_table else "floor",
                room=room,
                at_m=item.at_m,
                above_m=round(item.above_m + _SHADE * item.size_m[2], 3),
                lumen=TABLE_LUMEN if is_table else FLOOR_LUMEN,
            )
        )
    return lamps


def seat_lamp(
    room: str, name: str, things: Sequence[Furniture], free: BaseGeometry, lamps: Sequence[Light]
) -> Light | None:
    """A floor lamp beside the first seat that has none near it, where there is room for it.

    free: what of the floor is neither taken nor walked on by a door's leaf.
    """
    for seat in things:
        if not any(word in seat.object for word in _SEATS):
            continue
        if any(math.dist(seat.at_m, lamp.at_m) < _NEAR_M for lamp in lamps):
            return None
        for at in _beside(seat):
            foot = Point(at).buffer(FOOT_M)
            if free.covers(foot.buffer(_WALL_M)):
                place = (round(float(at[0]), 3), round(float(at[1]), 3))
                return Light(
                    id=name, kind="floor", room=room, at_m=place,
                    above_m=FLOOR_LAMP_M, lumen=FLOOR_LUMEN,
                )  # fmt: skip
    return None


def _beside(seat: Furniture) -> list[np.ndarray]:
    """Places at both ends of a seat, by its back."""
    width, depth, _ = seat.size_m
    cos, sin = math.cos(seat.turn_rad), math.sin(seat.turn_rad)
    turn = np.array([[cos, -sin], [sin, cos]])
    out = width / 2.0 + FOOT_M + _BESIDE_M
    back = depth / 2.0 - FOOT_M - _BESIDE_M
    return [
        np.array(seat.at_m) + turn @ np.array([side * out, along])
        for along in (back, 0.0)
        for side in (1.0, -1.0)
    ]
