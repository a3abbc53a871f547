"""The graph of walls: axes meet at junctions, and are parted there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import KDTree

from veduta.geometry.arcs import bulge_through
from veduta.plan.document import JunctionType
from veduta.plan.walls.axes import Axis, OnAxis
from veduta.plan.walls.meetings import crossing, meetings, pairs_in_reach
from veduta.plan.walls.pieces import FACET_RAD, Piece

HOUSE_SHARE = 0.5
"""The walls of a house hang together: the largest group is so much of all their length."""

ISLAND_SHARE = 0.08
"""Smaller groups, of all that length, are furniture, unless they are drawn as walls are."""

PIERS_SHARE = 0.15
"""Walls that stand free make up so much of the length, at least: less may be furniture."""

PIER = 3.0
"""And the longest of a group is so many times as long as thick."""

AS_THICK = 0.15
"""They are as thick as the house's walls, up to this part, or a pixel."""

STRAIGHT_RAD = np.radians(15)
BULGES = 20
"""Of so many parts of a half circle: walls between two nodes that bow alike are the same wall."""

SAME_PX = 0.5
"""Junctions that are nearer to each other are one."""

HALF_CIRCLE_RAD = np.radians(175.0)
"""A curved wall that turns more is parted in the middle: a bulge is of less than half a circle."""


@dataclass(frozen=True)
class Edge:
    """A piece of wall between nodes, its axis, and the stretch of the axis that it is."""

    first: int
    second: int
    axis: int
    low: float
    high: float


@dataclass(frozen=True)
class Graph:
    """Nodes (n, 2) and edges; types of the nodes by how many walls meet, and how."""

    nodes: NDArray[np.float64]
    edges: tuple[Edge, ...]
    types: tuple[JunctionType, ...]


def wall_graph(axes: Sequence[Axis]) -> Graph:
    """Let axes end at those that they reach, and part them where they meet."""
    stops: list[list[tuple[float, int]]] = [[] for _ in axes]
    points: list[NDArray[np.float64]] = []
    lines = [axis.line for axis in axes]
    for first, second in pairs_in_reach(lines):
        for point, along_first, along_second in meetings(lines[first], lines[second]):
            stops[first].append((along_first, len(points)))
            stops[second].append((along_second, len(points)))
            points.append(point)
    for index, axis in enumerate(axes):
        _with_ends(axis, stops[index], points)
        _with_middles(axis, stops[index], points)
    nodes, alias = _clustered(points, axes, stops)
    alias = _at_one_place(nodes, alias)
    edges: dict[tuple[int, int, int], Edge] = {}
    for index in range(len(axes)):
        ordered = sorted(stops[index])
        for (low, one), (high, other) in zip(ordered, ordered[1:], strict=False):
            ends = (alias[one], alias[other])
            # A curved wall and a straight one, or two curved ones, may part the same ends.
            bulge = axes[index].line.arc.bulge_of(low, high)
            side = 1.0 if ends[0] < ends[1] else -1.0
            key = (min(ends), max(ends), round(BULGES * side * bulge))
            if ends[0] != ends[1] and key not in edges:
                first, second = axes[index].line.arc.place(nodes[list(ends)])[0]
                if first < second:  # of two points that became one, one has moved along the axis
                    low, high = float(first), float(second)
                edges[key] = Edge(ends[0], ends[1], index, low, high)
    kept = _without_islands(tuple(edges.values()), axes)
    types = tuple(_type(node, nodes, kept, axes) for node in range(len(nodes)))
    return Graph(nodes, kept, types)


def _without_islands(edges: tuple[Edge, ...], axes: Sequence[Axis]) -> tuple[Edge, ...]:
    """The edges without small groups that touch no other wall: solid furniture, arrows, bars.

    Where no group is a house, as on plans of load-bearing walls alone, all are kept; where many
    stand free that are as thick as the house's walls, those are.
    """
    if not edges:
        return edges
    ends = np.array([(edge.first, edge.second) for edge in edges])
    count = int(ends.max()) + 1
    graph = coo_matrix((np.ones(len(ends), np.int8), (ends[:, 0], ends[:, 1])), (count, count))
    label = connected_components(graph, directed=False)[1][ends[:, 0]]
    own = np.array([edge.high - edge.low for edge in edges])
    length = np.bincount(label, weights=own)
    if length.max() < HOUSE_SHARE * length.sum():
        return edges
    keep = length >= ISLAND_SHARE * length.sum()
    thick = np.array([axes[edge.axis].line.thickness_px for edge in edges])
    piers = ~keep & _as_thick(label, own, thick)
    if length[piers].sum() >= PIERS_SHARE * length.sum():
        keep |= piers
    return tuple(edge for edge, group in zip(edges, label, strict=True) if keep[group])


def _as_thick(
    label: NDArray[np.int32], length: NDArray[np.float64], thick: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """(n,) which groups of edges are long and as thick as most walls of the largest group are."""
    total = np.bincount(label, weights=length)
    house = label == int(np.argmax(total))
    order = np.argsort(thick[house])
    along = np.cumsum(length[house][order])
    usual = float(thick[house][order][np.searchsorted(along, along[-1] / 2)])
    alike = np.abs(thick - usual) <= max(1.0, AS_THICK * usual)
    longest = np.zeros(len(total))
    np.maximum.at(longest, label[alike], length[alike])
    of_it = np.bincount(label, weights=length * alike)
    return np.asarray((longest >= PIER * usual) & (of_it >= HOUSE_SHARE * total), dtype=np.bool_)


def edge_line(edge: Edge, graph: Graph, axes: Sequence[Axis]) -> Piece:
    """The wall of an edge from node to node; a curved one goes through the middle of its arc."""
    start, end = graph.nodes[edge.first], graph.nodes[edge.second]
    line = axes[edge.axis].line
    bulge = 0.0
    if line.bulge:
        bulge = bulge_through(start, line.arc.at((edge.low + edge.high) / 2), end)
    return replace(line, start=start, end=end, bulge=bulge)


def with_facets(graph: Graph, axes: Sequence[Axis]) -> Graph:
    """The graph with each curved wall as a chain of straight ones, for what knows no others."""
    nodes, types, edges = [*graph.nodes], [*graph.types], list[Edge]()
    for edge in graph.edges:
        facets = edge_line(edge, graph, axes).facets(FACET_RAD)
        step = (edge.high - edge.low) / len(facets)
        first = edge.first
        for place, facet in enumerate(facets):
            last = edge.second
            if place < len(facets) - 1:
                last = len(nodes)
                nodes.append(facet.end)
                types.append("straight")
            low = edge.low + place * step
            edges.append(Edge(first, last, edge.axis, low, low + step))
            first = last
    return Graph(np.array(nodes).reshape(-1, 2), tuple(edges), tuple(types))


def openings_on(edge: Edge, axis: Axis) -> list[OnAxis]:
    """The openings of the axis whose middle lies on this edge."""
    return [one for one in axis.openings if edge.low <= (one.first + one.last) / 2 < edge.high]


def _with_ends(
    axis: Axis, stops: list[tuple[float, int]], points: list[NDArray[np.float64]]
) -> None:
    """Add the ends of the axis where no other wall is near."""
    near = 1.2 * axis.line.thickness_px
    length = axis.line.length_px
    at = [along for along, _ in stops]
    if not any(along < near for along in at):
        stops.append((0.0, len(points)))
        points.append(axis.line.start)
    if not any(along > length - near for along in at) or len(stops) < 2:
        stops.append((length, len(points)))
        points.append(axis.line.end)


def _with_middles(
    axis: Axis, stops: list[tuple[float, int]], points: list[NDArray[np.float64]]
) -> None:
    """Part an arc that is more than half a circle between two of its stops."""
    if not axis.line.bulge:
        return
    ordered = sorted(along for along, _ in stops)
    for low, high in zip(ordered, ordered[1:], strict=False):
        if (high - low) / axis.line.arc.radius_px > HALF_CIRCLE_RAD:
            stops.append(((low + high) / 2, len(points)))
            points.append(axis.line.arc.at((low + high) / 2))


def _clustered(
    points: list[NDArray[np.float64]],
    axes: Sequence[Axis],
    stops: Sequence[Sequence[tuple[float, int]]],
) -> tuple[NDArray[np.float64], list[int]]:
    """Meeting points on one axis that are nearer than half its thickness are one junction."""
    parent = list(range(len(points)))

    def root(index: int) -> int:
        while parent[index] != index:
            parent[index] = parent[parent[index]]
            index = parent[index]
        return index

    for axis, here in zip(axes, stops, strict=True):
        ordered = sorted(here)
        for (low, one), (high, other) in zip(ordered, ordered[1:], strict=False):
            if high - low < max(2.0, 0.5 * axis.line.thickness_px):
                parent[root(one)] = root(other)
    weight = np.zeros(len(points))
    for axis, here in zip(axes, stops, strict=True):
        for _, index in here:
            weight[index] += axis.line.length_px
    roots = sorted({root(index) for index in range(len(points))})
    number = {one: place for place, one in enumerate(roots)}
    alias = [number[root(index)] for index in range(len(points))]
    # The meeting of the longest walls stays in place: a mean would bend them.
    nodes, heaviest = np.zeros((len(roots), 2)), np.full(len(roots), -1.0)
    for index, point in enumerate(points):
        if weight[index] > heaviest[alias[index]]:
            heaviest[alias[index]] = weight[index]
            nodes[alias[index]] = point
    through: list[set[int]] = [set() for _ in roots]
    for axis_index, here in enumerate(stops):
        for _, index in here:
            through[alias[index]].add(axis_index)
    return np.array(
        [_on_lines(node, [axes[i] for i in at]) for node, at in zip(nodes, through, strict=True)]
    ).reshape(-1, 2), alias


def _at_one_place(nodes: NDArray[np.float64], alias: Sequence[int]) -> list[int]:
    """The numbers of points' junctions, where those that were moved to one place are one.

    Between them there would be a wall of no length.
    """
    if len(nodes) == 0:
        return list(alias)
    near = np.array(sorted(KDTree(nodes).query_pairs(SAME_PX)), np.int64).reshape(-1, 2)
    pairs = coo_matrix((np.ones(len(near)), (near[:, 0], near[:, 1])), (len(nodes), len(nodes)))
    group = connected_components(pairs, directed=False)[1]
    first = np.unique(group, return_index=True)[1]
    return [int(first[group[one]]) for one in alias]


def _on_lines(node: NDArray[np.float64], axes: Sequence[Axis]) -> NDArray[np.float64]:
    """The node moved to where the two longest walls cross that meet there, so that none is bent.

    Its cluster may have their crossing and, a little beside it, the end of one of them. Where one
    of all is an arc, the node stays: it was put there already.
    """
    ordered = sorted(axes, key=lambda one: -one.line.length_px)
    first = ordered[0].line
    if any(one.line.bulge for one in ordered):
        return node
    for other in ordered[1:]:
        line = other.line
        met = crossing(first, line)
        if met is None:
            continue
        near = max(first.thickness_px, line.thickness_px)
        return met.point if float(np.hypot(*(met.point - node))) <= near else node
    return node


def _type(
    node: int, nodes: NDArray[np.float64], edges: tuple[Edge, ...], axes: Sequence[Axis]
) -> JunctionType:
    away = []
    for edge in edges:
        if node in (edge.first, edge.second):
            line = edge_line(edge, Graph(nodes, edges, ()), axes)
            at_start = edge.first == node
            away.append(line.arc.way(0.0) if at_start else -line.arc.way(line.length_px))
    return junction_type(away)


def junction_type(away: Sequence[NDArray[np.float64]]) -> JunctionType:
    """What walls make that go away from one point in these directions (2,) of length 1."""
    if len(away) <= 1:
        return "end"
    if len(away) == 2:
        return "straight" if float(away[0] @ away[1]) < -np.cos(STRAIGHT_RAD) else "L"
    return "T" if len(away) == 3 else "X"
