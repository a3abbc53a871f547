"""A flight of stairs in the room that is kept for it."""

from __future__ import annotations

from shapely.geometry import Polygon

from veduta.synthetic.plans.house import Stairs

TREAD_M = 0.27
LANDING_M = 0.35


def flight(area: Polygon) -> Stairs:
    """A straight flight along the longer side of an upright room, a landing at its foot."""
    x0, y0, x1, y1 = area.bounds
    if x1 - x0 >= y1 - y0:
        treads = int((x1 - x0 - LANDING_M) / TREAD_M)
        start = x1 - treads * TREAD_M
        outline = ((start, y0), (x1, y0), (x1, y1), (start, y1))
        return Stairs(outline, treads, (1.0, 0.0))
    treads = int((y1 - y0 - LANDING_M) / TREAD_M)
    start = y1 - treads * TREAD_M
    return Stairs(((x0, start), (x1, start), (x1, y1), (x0, y1)), treads, (0.0, 1.0))
