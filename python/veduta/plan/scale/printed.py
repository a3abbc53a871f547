"""Sizes and areas that are printed on a sheet, the rooms around them, and how these lie."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely.affinity
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import Text
from veduta.plan.scale.quantities import Quantity, read_quantities


@dataclass(frozen=True)
class Printed:
    """A text with sizes, where it stands, and the room around it, None where none is known."""

    text: Text
    quantities: list[Quantity]
    at: NDArray[np.float64]
    room: int | None

    @property
    def areas(self) -> list[float]:
        """Areas that it may state, m2."""
        return [one.values[0] for one in self.quantities if one.kind == "area"]

    @property
    def sizes(self) -> list[tuple[float, ...]]:
        """Both sides that it may state, m."""
        return [one.values for one in self.quantities if one.kind == "size"]


def printed_in(texts: Sequence[Text], rooms: Sequence[Polygon]) -> list[Printed]:
    """The texts that say a size or an area; ratios are of the whole sheet."""
    found = []
    for text in texts:
        quantities = [one for one in read_quantities(text.text) if one.kind != "ratio"]
        at = np.mean(text.box_px, axis=0)
        if quantities:
            inside = next((i for i, room in enumerate(rooms) if room.contains(Point(at))), None)
            found.append(Printed(text, quantities, at, inside))
    return found


def room_polygon(outline: NDArray[np.float64]) -> Polygon:
    """An outline (n, 2) as a polygon: the largest part where it crosses itself."""
    polygon = Polygon(outline)
    if polygon.is_valid:
        return polygon
    parts = shapely.get_parts(shapely.make_valid(polygon))
    areas = [part for part in parts if isinstance(part, Polygon)]
    return max(areas, key=lambda part: part.area, default=Polygon())


def laid_level(room: Polygon) -> tuple[float, Polygon]:
    """The direction of a room's walls, and the room turned back by it about the pixels' origin."""
    angle = _direction(room)
    return angle, shapely.affinity.rotate(room, -angle, origin=(0, 0), use_radians=True)


def _direction(room: Polygon) -> float:
    """Direction of the walls, modulo a right angle: that along which most of the outline runs."""
    steps = np.diff(np.asarray(room.exterior.coords), axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    angles = np.arctan2(steps[:, 1], steps[:, 0])
    # Four times the angle is the same for all four directions of a rectangle.
    mean = np.sum(lengths**2 * np.exp(4j * angles))
    return float(np.angle(mean) / 4.0)
