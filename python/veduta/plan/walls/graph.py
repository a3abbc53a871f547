"""The graph of walls: axes meet at junctions, and are parted there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from veduta.plan.document import JunctionType
from veduta.plan.walls.axes import Axis, OnAxis

MEET_RAD = np.radians(12)
REACH = 0.45
"""A wall ends at another one if so many of its thicknesses are missing, or less."""

HOUSE_SHARE = 0.5
"""The walls of a house hang together: the largest group is so much of all their length."""

ISLAND_SHARE = 0.08

STRAIGHT_RAD = np.radians(15)


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
    for first in range(len(axes)):
        for second in range(first + 1, len(axes)):
            meeting = _meeting(axes[first], axes[second])
            if meeting is not None:
                point, along_first, along_second = meeting
                stops[first].append((along_first, len(points)))
                stops[second].append((along_second, len(points)))
                points.append(point)
    for index, axis in enumerate(axes):
        _with_ends(axis, stops[index], points)
    nodes, alias = _clustered(points, axes, stops)
    edges: dict[tuple[int, int], Edge] = {}
    for index in range(len(axes)):
        ordered = sorted(stops[index])
        for (low, one), (high, other) in zip(ordered, ordered[1:], strict=False):
            ends = (alias[one], alias[other])
            key = (min(ends), max(ends))
            if ends[0] != ends[1] and key not in edges:
                line = axes[index].line
                first, second = ((nodes[end] - line.start) @ line.direction for end in ends)
                if first < second:  # of two points that became one, one has moved along the axis
                    low, high = float(first), float(second)
                edges[key] = Edge(ends[0], ends[1], index, low, high)
    kept = _without_islands(tuple(edges.values()))
    return Graph(nodes, kept, tuple(_type(node, nodes, kept) for node in range(len(nodes))))


def _without_islands(edges: tuple[Edge, ...]) -> tuple[Edge, ...]:
    """The edges without small groups that touch no other wall: solid furniture, arrows, bars.

    Where no group is a house, as on plans of load-bearing walls alone, all are kept.
    """
    if not edges:
        return edges
    ends = np.array([(edge.first, edge.second) for edge in edges])
    count = int(ends.max()) + 1
    graph = coo_matrix((np.ones(len(ends), np.int8), (ends[:, 0], ends[:, 1])), (count, count))
    label = connected_components(graph, directed=False)[1][ends[:, 0]]
    length = np.bincount(label, weights=[edge.high - edge.low for edge in edges])
    if length.max() < HOUSE_SHARE * length.sum():
        return edges
    return tuple(
        edge
        for edge, group in zip(edges, label, strict=True)
        if length[group] >= ISLAND_SHARE * length.sum()
    )


def openings_on(edge: Edge, axis: Axis) -> list[OnAxis]:
    """The openings of the axis whose middle lies on this edge."""
    return [one for one in axis.openings if edge.low <= (one.first + one.last) / 2 < edge.high]


def _meeting(first: Axis, second: Axis) -> tuple[NDArray[np.float64], float, float] | None:
    """Where two axes cross or touch: the point, and how far along each."""
    one, other = first.line, second.line
    cross = one.direction[0] * other.direction[1] - one.direction[1] * other.direction[0]
    if abs(cross) < np.sin(MEET_RAD):
        return _end_to_end(first, second)
    apart = other.start - one.start
    along = float((apart[0] * other.direction[1] - apart[1] * other.direction[0]) / cross)
    beyond = float((apart[0] * one.direction[1] - apart[1] * one.direction[0]) / cross)
    reach = (other.thickness_px / 2 + REACH * one.thickness_px) / abs(cross) + 2
    reach_other = (one.thickness_px / 2 + REACH * other.thickness_px) / abs(cross) + 2
    if not -reach <= along <= one.length_px + reach:
        return None
    if not -reach_other <= beyond <= other.length_px + reach_other:
        return None
    return one.start + along * one.direction, along, beyond


def _end_to_end(first: Axis, second: Axis) -> tuple[NDArray[np.float64], float, float] | None:
    """Walls of different thickness or slightly different direction that touch with their ends."""
    one, other = first.line, second.line
    thick = max(one.thickness_px, other.thickness_px)
    for mine, along in ((one.start, 0.0), (one.end, one.length_px)):
        for its, beyond in ((other.start, 0.0), (other.end, other.length_px)):
            away = its - mine
            outward = -one.direction if along == 0.0 else one.direction
            ahead = float(away @ outward)
            beside = abs(float(away[0] * outward[1] - away[1] * outward[0]))
            if -0.5 * thick <= ahead <= REACH * thick + 2 and beside <= 0.6 * thick:
                longer = mine if one.length_px >= other.length_px else its
                return np.asarray(longer, dtype=float), along, beyond
    return None


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


def _on_lines(node: NDArray[np.float64], axes: Sequence[Axis]) -> NDArray[np.float64]:
    """The node moved to where the two longest walls cross that meet there, so that none is bent.

    Its cluster may have their crossing and, a little beside it, the end of one of them.
    """
    ordered = sorted(axes, key=lambda one: -one.line.length_px)
    first = ordered[0].line
    for other in ordered[1:]:
        line = other.line
        cross = first.direction[0] * line.direction[1] - first.direction[1] * line.direction[0]
        if abs(cross) < np.sin(MEET_RAD):
            continue
        apart = line.start - first.start
        along = (apart[0] * line.direction[1] - apart[1] * line.direction[0]) / cross
        place = first.start + along * first.direction
        near = max(first.thickness_px, line.thickness_px)
        return place if float(np.hypot(*(place - node))) <= near else node
    return node


def _type(node: int, nodes: NDArray[np.float64], edges: Sequence[Edge]) -> JunctionType:
    away = []
    for edge in edges:
        if node in (edge.first, edge.second):
            run = nodes[edge.second if edge.first == node else edge.first] - nodes[node]
            away.append(run / max(float(np.hypot(*run)), 1e-9))
    if len(away) <= 1:
        return "end"
    if len(away) == 2:
        return "straight" if float(away[0] @ away[1]) < -np.cos(STRAIGHT_RAD) else "L"
    return "T" if len(away) == 3 else "X"
