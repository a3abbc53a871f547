"""Axis-parallel rectangles on the facade: clipping them clear of each other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Rectangle:
    """Metres in the facade frame: x right, z up; x0 < x1 and z0 < z1 where it is not empty."""

    x0: float
    z0: float
    x1: float
    z1: float

    @property
    def width(self) -> float:
        """Size along x (m); negative where the rectangle is inside out."""
        return self.x1 - self.x0

    @property
    def height(self) -> float:
        """Size along z (m); negative where the rectangle is inside out."""
        return self.z1 - self.z0

    @property
    def area(self) -> float:
        """Square metres; zero where the rectangle is inside out."""
        return max(self.width, 0.0) * max(self.height, 0.0)

    def grown(self, margin_m: float) -> Rectangle:
        """The same centre, `margin_m` further out on each side (inwards where negative)."""
        return Rectangle(
            self.x0 - margin_m, self.z0 - margin_m, self.x1 + margin_m, self.z1 + margin_m
        )

    def common(self, other: Rectangle) -> Rectangle:
        """The intersection; empty (zero area) where there is none."""
        return Rectangle(
            max(self.x0, other.x0),
            max(self.z0, other.z0),
            min(self.x1, other.x1),
            min(self.z1, other.z1),
        )

    def corners(self) -> list[tuple[float, float]]:
        """Counter-clockwise from the lower left, as (x, z)."""
        return [(self.x0, self.z0), (self.x1, self.z0), (self.x1, self.z1), (self.x0, self.z1)]


def carve(rectangle: Rectangle, obstacles: Iterable[Rectangle], gap_m: float) -> Rectangle:
    """The largest strip of `rectangle` that one cut after the other leaves beside the obstacles.

    Every obstacle keeps a distance of `gap_m`. The result may be empty.
    """
    left = rectangle
    for obstacle in obstacles:
        if (
            obstacle.x0 - gap_m >= left.x1
            or obstacle.x1 + gap_m <= left.x0
            or obstacle.z0 - gap_m >= left.z1
            or obstacle.z1 + gap_m <= left.z0
        ):
            continue
        wall = obstacle.grown(gap_m)
        strips = (
            Rectangle(left.x0, left.z0, min(wall.x0, left.x1), left.z1),
            Rectangle(max(wall.x1, left.x0), left.z0, left.x1, left.z1),
            Rectangle(left.x0, left.z0, left.x1, min(wall.z0, left.z1)),
            Rectangle(left.x0, max(wall.z1, left.z0), left.x1, left.z1),
        )
        left = max(strips, key=lambda strip: strip.area)
    return left
