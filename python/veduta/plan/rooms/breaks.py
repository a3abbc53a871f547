"""Where walls may be broken: from ends and corners of walls on to the next wall in their line.

`openings.gaps` looks ahead of walls that end freely. A wall that ends at a corner can go on, too,
behind a door beside that corner; so can a stub that is too short to be followed as a wall.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.gaps import Gap, parted
from veduta.plan.rooms.rays import Hit, Ray, Walls
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import Graph, with_facets
from veduta.plan.walls.join import UPRIGHT_RAD

GOES_ON_RAD = np.radians(30.0)
"""A wall goes on at a junction where another leaves it in this direction, or nearly."""

SQUARE_RAD = np.radians(15.0)
"""Walls in line or square to each other are off by less."""

SLANTED_FARTHEST = 12.0
"""Breaks between two ends of walls that do not lie in one line are so many (thin) wall thicknesses
wide at most ..."""

SLANTED_FARTHEST_OWN = 7.0
"""... or over so many of their own thicknesses, where these are thick."""

THICK = 1.5
"""Those are thicker than thin walls by this factor."""

STUB = (0.5, 2.5)
"""Stubs on the faces of walls are so broad, in (thin) wall thicknesses."""

STUB_WALL = 1.2
"""Or as broad as the thickest wall, and a little more."""


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


class Parting:
    """What of a way is not solid; looked at once, as most breaks are found in each round."""

    def __init__(self, solid: NDArray[np.bool_]) -> None:
        self.solid = solid
        self._known: dict[tuple[bytes, bytes, float], tuple[Gap, ...]] = {}

    def __call__(self, gap: Gap) -> tuple[Gap, ...]:
        """The gap, piece by piece."""
        place = (gap.start.tobytes(), gap.end.tobytes(), gap.thickness_px)
        if place not in self._known:
            self._known[place] = parted(gap, self.solid)
        return self._known[place]


def find_breaks(
    graph: Graph, axes: Sequence[Axis], parting: Parting, thin_px: float
) -> list[Break]:
    """All places where a wall of the graph may go on; most of them are none."""
    graph = with_facets(graph, axes)
    walls = Walls(graph, axes)
    rays = [*_from_nodes(graph, walls), *_from_stubs(graph, walls, parting.solid, thin_px)]
    found = [_ahead(one, parting) for one in walls.ahead(rays, thin_px)]
    found += _between_ends(graph, walls, parting, thin_px)
    return list({one.key: one for one in found}.values())


def _ahead(hit: Hit, parting: Parting) -> Break:
    """The way to the nearest wall ahead of a ray."""
    ray = hit.ray
    stop = ray.origin + hit.face_px * ray.way
    gap = Gap(-1, True, -1, hit.to_side, ray.origin, stop, ray.thickness_px, stop)
    end = ray.origin + hit.reach_px * ray.way
    return Break(
        ray.origin,
        end,
        ray.thickness_px,
        parting(gap),
        in_line=not hit.to_side,
        facing=hit.facing,
    )


def _from_nodes(graph: Graph, walls: Walls) -> Iterator[Ray]:
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
                yield Ray(graph.nodes[node], -away, float(walls.thickness[index]), beside)


def _is_side_of_bay(way: NDArray[np.float64], leaving: Sequence[NDArray[np.float64]]) -> bool:
    """Whether a slanted wall ends where it meets others that are neither in line nor square to it.

    `way` and `leaving` (2,) lead away from where they meet.
    """
    if float(np.abs(way).max()) > np.cos(UPRIGHT_RAD):
        return False
    along = [abs(float(other @ way)) for other in leaving]
    return any(np.sin(SQUARE_RAD) < one < np.cos(SQUARE_RAD) for one in along)


def _from_stubs(
    graph: Graph, walls: Walls, solid: NDArray[np.bool_], thin_px: float
) -> Iterator[Ray]:
    """Solid stubs that stand out from the face of a wall where no wall leaves it."""
    if not len(walls.length):
        return
    # Steps of a pixel along all walls at once; each wall begins with one that is not dark.
    count = np.ceil(np.maximum(walls.length - 0.5, 0.0)).astype(int) + 1
    index = np.repeat(np.arange(len(count)), count)
    step = np.arange(len(index)) - (np.cumsum(count) - count)[index]
    normal = np.stack([-walls.way[:, 1], walls.way[:, 0]], axis=1)
    beside = walls.thickness / 2 + 0.7 * thin_px
    most_px = _broadest_stubs(walls, thin_px)
    found: list[tuple[int, int, Ray]] = []
    for side in (1, -1):
        points = walls.start[index] + (step - 0.5)[:, None] * walls.way[index]
        points += side * beside[index, None] * normal[index]
        dark = _on(solid, points) & (step > 0)
        change = np.diff(np.pad(dark.astype(np.int8), 1))
        lows, highs = np.flatnonzero(change == 1), np.flatnonzero(change == -1)
        wide = highs - lows
        fits = (wide >= STUB[0] * thin_px) & (wide <= most_px[index[lows]])
        for low, width in zip(lows[fits], wide[fits], strict=True):
            edge = int(index[low])
            foot = walls.start[edge] + (float(step[low]) - 1.0 + float(width) / 2) * walls.way[edge]
            ray = Ray(foot, side * normal[edge], float(width), frozenset((edge,)))
            found.append((edge, -side, ray))
    yield from (ray for *_, ray in sorted(found, key=lambda one: one[:2]))


def _broadest_stubs(walls: Walls, thin_px: float) -> NDArray[np.float64]:
    """(n,) how broad stubs on the faces of each wall are at most."""
    most_px = np.full(len(walls.length), STUB[1] * thin_px)
    broad_px = max(STUB[1] * thin_px, STUB_WALL * float(walls.thickness.max()))
    most_px[[walls.points_on(index) for index in range(len(most_px))]] = broad_px
    return most_px


def _between_ends(graph: Graph, walls: Walls, parting: Parting, thin_px: float) -> list[Break]:
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
                free = parting(gap)
                if len(free) == 1:
                    found.append(Break(gap.start, gap.end, thickness_px, free, slanted=True))
    return found


def _slanted_as(width_px: float, thin_px: float, own_px: float) -> list[float]:
    """As how thick a wall a slanted way is looked at: as a thin one, and as those at its ends."""
    found = [thin_px] if width_px <= SLANTED_FARTHEST * thin_px else []
    if own_px > THICK * thin_px and width_px <= SLANTED_FARTHEST_OWN * own_px:
        found.append(own_px)
    return found


def _thickest_at(graph: Graph, walls: Walls) -> dict[int, float]:
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
