"""The learned eyes: a network that gives each pixel of a front a class, and each element a box."""

from veduta.facade.eyes.believed import BeliefParameters, believed
from veduta.facade.eyes.element import SeenElement
from veduta.facade.eyes.elements import ElementParameters, seen_elements
from veduta.facade.eyes.look import Seen, look, look_soon

__all__ = [
    "BeliefParameters",
    "ElementParameters",
    "Seen",
    "SeenElement",
    "believed",
    "look",
    "look_soon",
    "seen_elements",
]
