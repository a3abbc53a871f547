"""Lamps of a part: points that shine."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.place.material import Colour
from veduta.place.mover import Vector

WARM_WHITE: Colour = (1.0, 0.88, 0.72)
"""sRGB of an electric bulb to an eye that has half adapted to it; chosen."""


@dataclass(frozen=True)
class Lamp:
    """A lamp that shines alike in all directions.

    at_m: in the part's frame. lumen: all its light. room: the room that it lights, a name that is
    the same for all lamps of it; empty if it is of none. range_m: how far its light matters.
    """

    name: str
    kind: str
    at_m: Vector
    lumen: float
    room: str = ""
    colour: Colour = WARM_WHITE
    range_m: float = 0.0
