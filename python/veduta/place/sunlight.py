"""The sun as a light of a part: rays that are all parallel."""

from __future__ import annotations

from dataclasses import dataclass

from veduta.place.material import Colour
from veduta.place.mover import Vector


@dataclass(frozen=True)
class Sunlight:
    """Light from far away.

    toward: unit vector to the sun, in the part's frame. colour: sRGB. strength: 1 is a clear day's
    sun high in the sky, as an eye or a camera that has adapted to it sees it; 0 or more.
    """

    toward: Vector
    colour: Colour
    strength: float
