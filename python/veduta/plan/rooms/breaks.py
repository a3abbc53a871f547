"""Where walls may be broken: from ends and corners of walls on to the next wall in their line.

`openings.gaps` looks ahead of walls that end freely. A wall that ends at a corner can go on, too,
behind a door beside that corner; so can a stub that is too short to be followed as a wall.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.gaps import BESIDE, CROSSING_RAD, PARALLEL_RAD, Gap, parted
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import Edge, Graph, with_facets
from veduta.plan.walls.join import UPRIGHT_RAD

GOES_ON_RAD = np.radians(30.0)
"""A wall goes on at a junction where another leaves it in this direction, or nearly."""

SQUARE_RAD = np.radians(15.0)
"""Walls in line or square to each other are off by less."""

FARTHEST = 24.0
"""Breaks towards the side of a wall reach over so many (thin) wall thicknesses at most."""

IN_LINE_FARTHEST = 45.0
"""Those between two walls in one line reach farther: a bay window may lie before them."""

SLANTED_FARTHEST = 12.0
"""Nor between two ends of walls that do not lie in one line ..."""

SLANTED_FARTHEST_OWN = 7.0
"""... or over so many of their own thicknesses, where these are thick."""

THICK = 1.5
"""Those are thicker than thin walls by this factor."""

STUB = (0.5, 2.5)
"""Stubs on the faces of walls are so broad, in (thin) wall thicknesses."""

STUB_WALL = 1.2
"""Or as broad as the thickest wall, and a little more."""

LONG = 4.0
"""Slanted pieces of wall have a direction if so many times as long as thick."""


@dataclass(frozen=True)
class Break:
    """A wall that may go on from `start` to `end`, (2,) pixels on its centre line.

    `gaps` are what of it is not solid. `slanted`: it joins two ends that do not lie in one line, so
    that only what is drawn there can speak for it. `in_line`: walls in one line lie at both ends.
    `facing`: so they do, whatever walls meet them at these ends.
    """

    start: NDArray[np.float64]
    end: NDArray[np.float64]
    thickness_px: float
    gaps: tuple[Gap, ...]
    slanted: bool = False
    in_line: bool = False
    facing: bool = False

    @property
    def width_px(self) -> float:
        """Of the widest part that is not solid; 0 where all is."""
        return max((one.width_px for one in self.gaps), default=0.0)

    @property
    def key(self) -> tuple[int, ...]:
        """The same break has the same key in the next round."""
        places = tuple(int(value) // 4 for value in (*self.start, *self.end))
        return (*places, round(self.thickness_px))


@dataclass(frozen=True)
class _Ray:
    origin: NDArray[np.float64]
    way: NDArray[np.float64]
    thickness_px: float
    beside: frozenset[int]
    """Indices of the edges that it starts from."""


def find_breaks(
    graph: Graph, axes: Sequence[Axis], solid: NDArray[np.bool_], thin_px: float
) -> list[Break]:
    """All places where a wall of the graph may go on; most of them are none."""
    graph = with_facets(graph, axes)
    walls = _Walls(graph, axes)
    rays = [*_from_nodes(graph, walls), *_from_stubs(graph, walls, solid, thin_px)]
    found = [one for ray in rays if (one := walls.ahead(ray, thin_px, solid))]
    found += _between_ends(graph, walls, solid, thin_px)
    return list({one.key: one for one in found}.values())


class _Walls:
    """Edges as arrays: starts and ways (n, 2), lengths and thicknesses (n,)."""

    def __init__(self, graph: Graph, axes: Sequence[Axis]) -> None:
        self.edges: tuple[Edge, ...] = graph.edges
        self.start = graph.nodes[[one.first for one in self.edges]]
        self.end = graph.nodes[[one.second for one in self.edges]]
        run = self.end - self.start
        self.length = np.hypot(run[:, 0], run[:, 1])
        self.way = run / np.maximum(self.length, 1e-9)[:, None]
        self.thickness = np.array([axes[one.axis].line.thickness_px for one in self.edges])
        self.added = np.array([axes[one.axis].closing for one in self.edges])

    def points_on(self, index: int) -> bool:
        """Whether an edge's direction says where the wall would go on.

        That of a stub that is not upright does not, nor that of what was closed itself.
        """
        upright = float(np.abs(self.way[index]).max()) > np.cos(UPRIGHT_RAD)
        long = float(self.length[index]) > LONG * float(self.thickness[index])
        return not self.added[index] and (upright or long)

    def ahead(self, ray: _Ray, thin_px: float, solid: NDArray[np.bool_]) -> Break | None:
        """The way to the nearest wall ahead of a ray."""
        apart = self.start - ray.origin
        cross = ray.way[0] * self.way[:, 1] - ray.way[1] * self.way[:, 0]
        safe = np.where(np.abs(cross) > 1e-6, cross, 1.0)
        to_line = (apart[:, 0] * self.way[:, 1] - apart[:, 1] * self.way[:, 0]) / safe
        along = (apart[:, 0] * ray.way[1] - apart[:, 1] * ray.way[0]) / safe
        half = self.thickness / 2
        # Walls whose corner is missing end before they would meet.
        slack = half + 0.5 * ray.thickness_px + 3.0
        crossing = (np.abs(cross) >= np.sin(CROSSING_RAD)) & (along >= -slack)
        crossing &= along <= self.length + slack
        to_end, in_line = self._to_ends(ray)
        reach = np.where(crossing, to_line, np.where(in_line, to_end, np.inf))
        face = reach - np.where(crossing, half / np.abs(safe), 0.0)
        farthest = np.where(crossing, FARTHEST, IN_LINE_FARTHEST) * thin_px
        usable = (face > max(3.0, 0.5 * ray.thickness_px)) & (face <= farthest)
        usable &= ~(crossing & (to_line < 0))
        usable[list(ray.beside)] = False
        if not usable.any():
            return None
        nearest = int(np.argmin(np.where(usable, face, np.inf)))
        to_side = bool(crossing[nearest])
        stop = ray.origin + float(face[nearest]) * ray.way
        end = ray.origin + float(reach[nearest]) * ray.way
        gap = Gap(-1, True, -1, to_side, ray.origin, stop, ray.thickness_px, stop)
        # A wall that ends at a corner has its end in the wall that crosses it there.
        corner = in_line & (np.abs(to_end - reach[nearest]) <= slack)
        return Break(
            ray.origin,
            end,
            ray.thickness_px,
            parted(gap, solid),
            in_line=not to_side,
            facing=bool(corner.any()),
        )

    def _to_ends(self, ray: _Ray) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """How far ahead walls in the ray's line begin, and which are in its line."""
        cross = np.abs(ray.way[0] * self.way[:, 1] - ray.way[1] * self.way[:, 0])
        ends = np.stack([self.start, self.end]) - ray.origin
        along = ends @ ray.way
        which = np.argmin(np.abs(along), axis=0)
        column = np.arange(len(which))
        near = ends[which, column]
        beside = np.abs(ray.way[0] * near[:, 1] - ray.way[1] * near[:, 0])
        thick = np.maximum(self.thickness, ray.thickness_px)
        fits = (cross <= np.sin(PARALLEL_RAD)) & (beside <= np.maximum(3.0, BESIDE * thick))
        return along[which, column], fits


def _from_nodes(graph: Graph, walls: _Walls) -> Iterator[_Ray]:
    """Walls that end at a node, carried on."""
    at: dict[int, list[tuple[int, NDArray[np.float64]]]] = {}
    for index, edge in enumerate(graph.edges):
        at.setdefault(edge.first, []).append((index, walls.way[index]))
        at.setdefault(edge.second, []).append((index, -walls.way[index]))
    for node, leaving in at.items():
        beside = frozenset(index for index, _ in leaving)
        for index, away in leaving:
            if not walls.points_on(index) or _is_side_of_bay(away, [way for _, way in leaving]):
                continue
            if not any(float(other @ -away) > np.cos(GOES_ON_RAD) for _, other in leaving):
                yield _Ray(graph.nodes[node], -away, float(walls.thickness[index]), beside)


def _is_side_of_bay(way: NDArray[np.float64], leaving: Sequence[NDArray[np.float64]]) -> bool:
    """Whether a slanted wall ends where it meets others that are neither in line nor square to it.

    `way` and `leaving` (2,) lead away from where they meet.
    """
    if float(np.abs(way).max()) > np.cos(UPRIGHT_RAD):
        return False
    along = [abs(float(other @ way)) for other in leaving]
    return any(np.sin(SQUARE_RAD) < one < np.cos(SQUARE_RAD) for one in along)


def _from_stubs(
    graph: Graph, walls: _Walls, solid: NDArray[np.bool_], thin_px: float
) -> Iterator[_Ray]:
    """Solid stubs that stand out from the face of a wall where no wall leaves it."""
    thickest_px = float(walls.thickness.max(initial=0.0))
    for index in range(len(graph.edges)):
        way, thick = walls.way[index], float(walls.thickness[index])
        normal = np.array([-way[1], way[0]])
        most_px = STUB[1] * thin_px
        if walls.points_on(index):
            most_px = max(most_px, STUB_WALL * thickest_px)
        steps = np.arange(0.5, walls.length[index], 1.0)
        for side in (1, -1):
            points = walls.start[index] + steps[:, None] * way
            points = points + side * (thick / 2 + 0.7 * thin_px) * normal
            dark = np.diff(np.pad(_on(solid, points).astype(np.int8), 1))
            pairs = zip(np.flatnonzero(dark == 1), np.flatnonzero(dark == -1), strict=True)
            for low, high in pairs:
                if not STUB[0] * thin_px <= high - low <= most_px:
                    continue
                foot = walls.start[index] + float(low + high) / 2 * way
                yield _Ray(foot, side * normal, float(high - low), frozenset((index,)))


def _between_ends(
    graph: Graph, walls: _Walls, solid: NDArray[np.bool_], thin_px: float
) -> list[Break]:
    """Slanted ways between ends and corners of walls that are a door's width apart."""
    loose = [index for index, kind in enumerate(graph.types) if kind in ("end", "L")]
    thick = _thickest_at(graph, walls)
    loose = [index for index in loose if index in thick]
    linked = {(edge.first, edge.second) for edge in graph.edges}
    found = []
    for place, first in enumerate(loose):
        for second in loose[place + 1 :]:
            run = graph.nodes[second] - graph.nodes[first]
            width = float(np.hypot(*run))
            straight = float(np.abs(run).min()) < 0.15 * width
            joined = {(first, second), (second, first)} & linked
            if width <= 3 * thin_px or straight or joined:
                continue
            ends = graph.nodes[first], graph.nodes[second]
            own_px = min(thick[first], thick[second])
            for thickness_px in _slanted_as(width, thin_px, own_px):
                gap = Gap(-1, True, -1, False, *ends, thickness_px, ends[1])
                free = parted(gap, solid)
                if len(free) == 1:
                    found.append(Break(gap.start, gap.end, thickness_px, free, slanted=True))
    return found


def _slanted_as(width_px: float, thin_px: float, own_px: float) -> list[float]:
    """As how thick a wall a slanted way is looked at: as a thin one, and as those at its ends."""
    found = [thin_px] if width_px <= SLANTED_FARTHEST * thin_px else []
    if own_px > THICK * thin_px and width_px <= SLANTED_FARTHEST_OWN * own_px:
        found.append(own_px)
    return found


def _thickest_at(graph: Graph, walls: _Walls) -> dict[int, float]:
    """How thick the thickest wall at each node is; nodes without walls are left out."""
    thick: dict[int, float] = {}
    for edge, own in zip(graph.edges, walls.thickness, strict=True):
        for node in (edge.first, edge.second):
            thick[node] = max(thick.get(node, 0.0), float(own))
    return thick


def _on(mask: NDArray[np.bool_], points: NDArray[np.float64]) -> NDArray[np.bool_]:
    index = np.floor(points).astype(int)
    x = np.clip(index[:, 0], 0, mask.shape[1] - 1)
    y = np.clip(index[:, 1], 0, mask.shape[0] - 1)
    return np.asarray(mask[y, x], dtype=np.bool_)
