"""Rays that carry walls on, and the nearest wall ahead of each."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.openings.gaps import BESIDE, PARALLEL_RAD, Lines
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.graph import Edge, Graph
from veduta.plan.walls.join import UPRIGHT_RAD

FARTHEST = 24.0
"""Breaks towards the side of a wall reach over so many (thin) wall thicknesses at most."""

IN_LINE_FARTHEST = 45.0
"""Those between two walls in one line reach farther: a bay window may lie before them."""

LONG = 4.0
"""Slanted pieces of wall have a direction if so many times as long as thick."""


@dataclass(frozen=True)
class Ray:
    """From `origin` (2,) on in the direction `way` (2,), for a wall of this thickness."""

    origin: NDArray[np.float64]
    way: NDArray[np.float64]
    thickness_px: float
    beside: frozenset[int]
    """Indices of the edges that it starts from."""


@dataclass(frozen=True)
class Hit:
    """How far it is to the face of the nearest wall ahead, and to its line or its end.

    `to_side`: that wall crosses the ray; else it lies in its line. `facing`: one in its line ends
    there, whatever crosses it.
    """

    ray: Ray
    face_px: float
    reach_px: float
    to_side: bool
    facing: bool


class Walls(Lines):
    """Edges of a graph as arrays."""

    def __init__(self, graph: Graph, axes: Sequence[Axis]) -> None:
        self.edges: tuple[Edge, ...] = graph.edges
        super().__init__(
            graph.nodes[[one.first for one in self.edges]],
            graph.nodes[[one.second for one in self.edges]],
            np.array([axes[one.axis].line.thickness_px for one in self.edges]),
        )
        self.added = np.array([axes[one.axis].closing for one in self.edges])

    def points_on(self, index: int) -> bool:
        """Whether an edge's direction says where the wall would go on.

        That of a stub that is not upright does not, nor that of what was closed itself.
        """
        upright = float(np.abs(self.way[index]).max()) > np.cos(UPRIGHT_RAD)
        long = float(self.length[index]) > LONG * float(self.thickness[index])
        return not self.added[index] and (upright or long)

    def ahead(self, rays: Sequence[Ray], thin_px: float) -> list[Hit]:
        """What is nearest ahead of each ray; nothing for those with nothing ahead of them."""
        if not rays:
            return []
        many = _Rays(
            np.stack([one.origin for one in rays])[:, None],
            np.stack([one.way for one in rays])[:, None],
            np.array([one.thickness_px for one in rays])[:, None],
        )
        # Walls whose corner is missing end before they would meet.
        slack = self.thickness / 2 + 0.5 * many.thickness + 3.0
        to_line, to_face, crosses = self.crossings(many.origin, many.way, slack)
        to_end, in_line = self._ends(many)
        reach = np.where(crosses, to_line, np.where(in_line, to_end, np.inf))
        face = np.where(crosses, to_face, reach)
        farthest = np.where(crosses, FARTHEST, IN_LINE_FARTHEST) * thin_px
        usable = (face > np.maximum(3.0, 0.5 * many.thickness)) & (face <= farthest)
        usable &= ~(crosses & (to_line < 0))
        for row, one in enumerate(rays):
            usable[row, list(one.beside)] = False
        hits = np.flatnonzero(usable.any(axis=1))
        nearest = np.argmin(np.where(usable, face, np.inf), axis=1)[hits]
        # A wall that ends at a corner has its end in the wall that crosses it there.
        at_it = np.abs(to_end[hits] - reach[hits, nearest][:, None]) <= slack[hits]
        measured = zip(
            hits.tolist(), face[hits, nearest].tolist(), reach[hits, nearest].tolist(),
            crosses[hits, nearest].tolist(), (in_line[hits] & at_it).any(axis=1).tolist(),
            strict=True,
        )  # fmt: skip
        return [Hit(rays[row], *rest) for row, *rest in measured]

    def _ends(self, rays: _Rays) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """(rays, edges) how far ahead walls begin, and which lie in the rays' lines."""
        cross = np.abs(rays.way[..., 0] * self.way[:, 1] - rays.way[..., 1] * self.way[:, 0])
        x, y = rays.way[..., 0], rays.way[..., 1]
        first, second = self.start - rays.origin, self.end - rays.origin
        to_first = first[..., 0] * x + first[..., 1] * y
        to_second = second[..., 0] * x + second[..., 1] * y
        begins = np.abs(to_first) <= np.abs(to_second)
        near = np.where(begins[..., None], first, second)
        beside = np.abs(x * near[..., 1] - y * near[..., 0])
        thick = np.maximum(self.thickness, rays.thickness)
        fits = (cross <= np.sin(PARALLEL_RAD)) & (beside <= np.maximum(3.0, BESIDE * thick))
        return np.where(begins, to_first, to_second), fits


@dataclass(frozen=True)
class _Rays:
    """Origins and ways (rays, 1, 2), thicknesses (rays, 1)."""

    origin: NDArray[np.float64]
    way: NDArray[np.float64]
    thickness: NDArray[np.float64]
