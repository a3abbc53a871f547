"""An element that the network saw: a box with a kind and a score."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SeenElement:
    """An upright box in pixels of the picture that was looked at, and how sure it is (0..1)."""

    kind: str
    x0: float
    y0: float
    x1: float
    y1: float
    score: float

    @property
    def width(self) -> float:
        """Pixels."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Pixels."""
        return self.y1 - self.y0
