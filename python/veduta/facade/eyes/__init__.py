"""The learned eyes: a network that gives each pixel of a front a class, and each element a box."""

from veduta.facade.eyes.elements import ElementParameters, SeenElement, seen_elements
from veduta.facade.eyes.look import Seen, look

__all__ = ["ElementParameters", "Seen", "SeenElement", "look", "seen_elements"]
