"""The wall around a plot: a ring of walls in which the house stands free is a fence.

Taken for the house's own, it would make the yard a room, put the roof over the plot and turn the
windows of the house into doors between rooms.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shapely import unary_union
from shapely.geometry import LineString

from veduta.plan.walls.pieces import Piece


@dataclass(frozen=True)
class PlotRule:
    """When walls are those of a plot. Lengths count in (thin) wall thicknesses unless said.

    joined: walls that come so near to each other hang together. along: a fence runs along the hull
    of all walls, so near to it. free: it leaves so much on all sides. house: the walls within are
    so many times as long as it. inside: and the house covers so much of the plot, as a share.
    closed: and stands along so much of its own hull, which a core within a house does not.
    things: walls that hang together but are less than this part of the largest such group, and lie
    outside of all others, are things on the plot; so are those that cover less within a ring.
    """

    joined: float = 0.4
    along: float = 3.0
    free: float = 3.0
    house: float = 0.5
    inside: tuple[float, float] = (0.1, 0.92)
    closed: float = 0.5
    things: float = 0.15


PLOT = PlotRule()


def fence_pieces(pieces: Sequence[Piece], thin_px: float, rule: PlotRule = PLOT) -> set[int]:
    """Indices of the pieces that stand around a plot with a house in it; none without one."""
    lines = [LineString([one.start, one.end]) for one in pieces]
    if len(lines) < 5:
        return set()
    border = unary_union(lines).convex_hull.boundary.buffer(rule.along * thin_px)
    groups = _groups(pieces, lines, rule.joined * thin_px)
    fence = {
        index
        for group in groups
        if all(border.contains(lines[other]) for other in group)
        for index in group
    }
    house = _house(groups, lines, fence, rule.free * thin_px, rule)
    if not fence or not house:
        return set()
    walls = unary_union([lines[index] for index in house])
    plot = unary_union([lines[index] for index in fence])
    hull, ring = walls.convex_hull, plot.convex_hull
    share = hull.area / max(ring.area, 1e-9)
    free = ring.boundary.distance(hull)
    inside = unary_union([line for index, line in enumerate(lines) if index not in fence])
    enough = inside.length >= rule.house * plot.length
    sized = rule.inside[0] <= share <= rule.inside[1]
    beside = walls.buffer(rule.along * thin_px).intersection(hull.boundary).length
    sized = sized and beside >= rule.closed * hull.boundary.length
    around = enough and sized and free >= rule.free * thin_px
    return fence if around else set()


def ring_pieces(pieces: Sequence[Piece], thin_px: float, rule: PlotRule = PLOT) -> set[int]:
    """Indices of the pieces of a ring, where there is hardly another in it; none without one.

    The house is then drawn in another way than the wall around its plot.
    """
    lines = [LineString([one.start, one.end]) for one in pieces]
    if not lines:
        return set()
    border = unary_union(lines).convex_hull.boundary
    near = border.buffer(rule.along * thin_px)
    ring = {index for index, line in enumerate(lines) if near.contains(line)}
    cover = [one.length_px * one.thickness_px for one in pieces]
    inside = sum(cover) - sum(cover[index] for index in ring)
    walls = unary_union([lines[index] for index in ring])
    whole = walls.buffer(rule.along * thin_px).intersection(border).length
    alone = inside <= rule.things * sum(cover)
    return ring if ring and alone and whole >= rule.closed * border.length else set()


def _house(
    groups: Sequence[set[int]],
    lines: Sequence[LineString],
    fence: set[int],
    near_px: float,
    rule: PlotRule,
) -> set[int]:
    """The pieces that hang together in large groups, and what lies among or near those.

    The sheet lies straight: what is between two openings at a corner of a house is within the
    upright box around its other walls. What else stands on the plot, a car or a shed, is no part
    of the house.
    """
    rest = [group - fence for group in groups if group - fence]
    whole = [unary_union([lines[index] for index in group]) for group in rest]
    least = rule.things * max((one.length for one in whole), default=0.0)
    chosen = {place for place, one in enumerate(whole) if one.length >= least}
    while True:
        around = unary_union([whole[place] for place in chosen]).envelope.buffer(near_px)
        more = {place for place, one in enumerate(whole) if around.intersects(one)}
        if more <= chosen:
            return {index for place in chosen for index in rest[place]}
        chosen |= more


def _groups(
    pieces: Sequence[Piece], lines: Sequence[LineString], slack_px: float
) -> list[set[int]]:
    """Pieces whose bodies hang together."""
    bodies = [
        line.buffer(one.thickness_px / 2.0 + slack_px, cap_style="square")
        for one, line in zip(pieces, lines, strict=True)
    ]
    whole = unary_union(bodies)
    parts = list(getattr(whole, "geoms", [whole]))
    groups = [
        {index for index, line in enumerate(lines) if part.intersects(line)} for part in parts
    ]
    return [group for group in groups if group]
