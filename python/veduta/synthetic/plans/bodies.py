"""What walls cover on the page, with and without their openings."""

from __future__ import annotations

from shapely import unary_union
from shapely.geometry import LineString, Point
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans import curves
from veduta.synthetic.plans.house import Opening, Storey, Wall

THROUGH_M = 0.02


def opening_area(wall: Wall, opening: Opening, extra_m: float = THROUGH_M) -> BaseGeometry:
    """What an opening takes out of its wall; `extra_m` thicker than it, so that no skin stays."""
    end = opening.along_m + opening.width_m
    return curves.band(wall, opening.along_m, end, wall.thickness_m + 2 * extra_m)


def whole_walls(walls: tuple[Wall, ...]) -> BaseGeometry:
    """The union of the walls, as if there were no openings.

    Ends are square, so that corners close; where walls of one thickness meet at another angle,
    the corner is mitred.
    """
    bands: list[BaseGeometry] = []
    ends: dict[tuple[float, float], list[tuple[Wall, LineString]]] = {}
    for wall in walls:
        centre = LineString(curves.line(wall))
        bands.append(centre.buffer(wall.thickness_m / 2, cap_style="flat", join_style="mitre"))
        points = list(centre.coords)
        # Keyed by the junctions as given: an arc's own ends differ in their last digits.
        for point, inner in ((wall.start_m, points[1]), (wall.end_m, points[-2])):
            ends.setdefault(point, []).append((wall, LineString([inner, point])))
    for point, meeting in ends.items():
        bands += _corners(point, meeting)
    return unary_union(bands)


def _corners(
    point: tuple[float, float], meeting: list[tuple[Wall, LineString]]
) -> list[BaseGeometry]:
    """What closes a junction: the mitres of each pair of walls of one thickness."""
    if len(meeting) == 1:
        return []
    thick = max(wall.thickness_m for wall, _ in meeting)
    thickest = [item for item in meeting if item[0].thickness_m >= thick - 1e-9]
    if len(thickest) == 1:
        return [Point(point).buffer(thick / 2)]
    pieces: list[BaseGeometry] = []
    for index, (_, first) in enumerate(thickest):
        for _, second in thickest[index + 1 :]:
            path = LineString([first.coords[0], point, second.coords[0]])
            near = path.intersection(Point(point).buffer(thick))
            if isinstance(near, LineString):
                joined = near.buffer(thick / 2, cap_style="flat", join_style="mitre")
                pieces.append(joined)
    return pieces


def solid_walls(storey: Storey) -> BaseGeometry:
    """The walls' material: all that they cover, less the openings."""
    whole = whole_walls(storey.walls)
    if not storey.openings:
        return whole
    walls = {wall.id: wall for wall in storey.walls}
    holes = [opening_area(walls[opening.wall], opening) for opening in storey.openings]
    return whole.difference(unary_union(holes))
