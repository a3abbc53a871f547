"""Where a piece of a house stands: an origin and three axes, and prisms in them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from veduta.place.builder import PartBuilder
from veduta.plan.house.looks import Looks
from veduta.plan.house.space import pieces_of

Face = Literal["low", "high", "side"]


@dataclass(frozen=True)
class Frame:
    """Right-handed axes in the part's frame. origin_m: (3,). axes: (3, 3), a row each."""

    origin_m: NDArray[np.float64]
    axes: NDArray[np.float64]

    def place(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 3) points of the frame in the part's frame."""
        moved: NDArray[np.float64] = points @ self.axes + self.origin_m
        return moved


def level(elevation_m: float) -> Frame:
    """The part's own axes at a height."""
    return Frame(np.array([0.0, 0.0, elevation_m]), np.eye(3))


def upright(start: NDArray[np.float64], along: NDArray[np.float64], elevation_m: float) -> Frame:
    """First axis along a wall, second up, third to its right: pictures of the wall lie flat in it.

    start, along: (2,), the way a unit vector.
    """
    axes = np.array([[along[0], along[1], 0.0], [0.0, 0.0, 1.0], [along[1], -along[0], 0.0]])
    return Frame(np.array([start[0], start[1], elevation_m]), axes)


@dataclass(frozen=True)
class Surface:
    """A feature of the part and what it looks like."""

    feature: int
    look: str


class Sculptor:
    """Adds prisms to a part."""

    def __init__(self, builder: PartBuilder, looks: Looks) -> None:
        self.builder = builder
        self.looks = looks

    def prism(
        self,
        region: BaseGeometry,
        low_m: float,
        high_m: float,
        frame: Frame,
        surface: Surface,
        **other: Surface,
    ) -> None:
        """A region of the frame's first two axes, drawn out along the third.

        other: surfaces of the faces `low`, `high` and `side` that are not as the rest.
        """
        if high_m <= low_m:
            raise ValueError(f"a prism from {low_m} to {high_m} m has no height")
        low, high, side = (other.get(face, surface) for face in ("low", "high", "side"))
        for piece in pieces_of(region):
            shape = orient(piece)
            rings = [np.array(ring.coords)[:-1] for ring in (shape.exterior, *shape.interiors)]
            self.face([_lifted(ring, high_m) for ring in rings], frame, high)
            self.face([_lifted(ring[::-1], low_m) for ring in rings], frame, low)
            for ring in rings:
                self._walls(ring, low_m, high_m, frame, side)

    def slab(
        self,
        first: tuple[float, float],
        second: tuple[float, float],
        third: tuple[float, float],
        frame: Frame,
        surface: Surface,
    ) -> None:
        """A box, by its ends along the frame's axes."""
        self.prism(box(first[0], second[0], first[1], second[1]), *third, frame, surface)

    def face(self, rings: list[NDArray[np.float64]], frame: Frame, surface: Surface) -> None:
        """A flat polygon of (n, 3) rings, counter-clockwise seen from outside, holes clockwise."""
        placed = [frame.place(ring) for ring in rings]
        material, uv = self.looks.of(surface.look, placed[0])
        self.builder.polygon(placed, surface.feature, material, uv)

    def _walls(
        self,
        ring: NDArray[np.float64],
        low_m: float,
        high_m: float,
        frame: Frame,
        surface: Surface,
    ) -> None:
        for here, there in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            ends = np.stack([here, there])
            face = np.concatenate([_lifted(ends, low_m), _lifted(ends[::-1], high_m)])
            self.face([face], frame, surface)


def ring_of(outer: Polygon, holes: list[Polygon]) -> Polygon:
    """A polygon with holes."""
    return Polygon(outer.exterior, [hole.exterior for hole in holes])


def _lifted(ring: NDArray[np.float64], height_m: float) -> NDArray[np.float64]:
    return np.concatenate([ring, np.full((len(ring), 1), height_m)], axis=1)
