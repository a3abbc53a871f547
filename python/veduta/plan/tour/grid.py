"""Ways over the free space of all storeys: A* on a grid of squares (FPPC of AV3D).

Each square that can be crossed is a node, with edges to its eight neighbours; a diagonal is one
only where both squares beside it are free, so that no corner is cut. Flights of stairs join the
grids of two storeys. Near walls a metre costs more, so that the ways keep to the middle of doors
and rooms. rustworkx searches (A*, Hart et al. 1968); scipy has the costs between all stops.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import rustworkx
import shapely
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from veduta.plan.tour.climbs import Climb
from veduta.plan.tour.free import Ground

CELL_M = 0.06
"""Side of a square: doors leave a strip that is little wider for the visitor's middle."""
MOST_CELLS = 400_000
"""In a storey; larger ones have larger squares."""
MOST_IN_ALL = 2_000_000
"""In all storeys together."""
MOST_COSTS = 16_000_000
"""Costs from squares to stops that are kept for A*, 8 bytes each."""
SHY_M = 0.5
"""Nearer to what stands in the way than this a metre costs more ..."""
SHY_COST = 3.0
"""... up to so many times as much in addition."""


@dataclass(frozen=True)
class Cells:
    """The free squares of a storey.

    places_m: (n, 2) their middles. clear_m: (n,) to the nearest square that is not free.
    piece: (n,) the number of the connected piece that a square lies in.
    edges: (m, 2) neighbours. lengths_m: (m,) from middle to middle.
    """

    side_m: float
    places_m: NDArray[np.float64]
    clear_m: NDArray[np.float64]
    piece: NDArray[np.int64]
    edges: NDArray[np.int64]
    lengths_m: NDArray[np.float64]


def cells_of(ground: Ground, storeys: int = 1) -> Cells:
    """The free squares of a storey of so many."""
    left, bottom, right, top = ground.free.bounds if not ground.free.is_empty else (0, 0, 0, 0)
    most = min(MOST_CELLS, MOST_IN_ALL // storeys)
    side = max(CELL_M, math.sqrt((right - left) * (top - bottom) / most))
    columns = np.arange(left + side / 2.0, right, side)
    rows = np.arange(bottom + side / 2.0, top, side)
    x, y = np.meshgrid(columns, rows)
    is_free = shapely.contains_xy(ground.free, x, y).reshape(len(rows), len(columns))
    clear = distance_transform_edt(np.pad(is_free, 1))[1:-1, 1:-1] * side
    pieces, _ = label(is_free)
    number = np.full(is_free.shape, -1, dtype=np.int64)
    number[is_free] = np.arange(int(is_free.sum()))
    edges, lengths = _neighbours(number, is_free, side)
    places = np.stack([x[is_free], y[is_free]], axis=1)
    return Cells(side, places, clear[is_free], pieces[is_free].astype(np.int64), edges, lengths)


def _neighbours(
    number: NDArray[np.int64], is_free: NDArray[np.bool_], side: float
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Pairs of free squares that touch."""
    pairs, lengths = [], []
    here, east = number[:, :-1], number[:, 1:]
    below, above = number[:-1], number[1:]
    corner = is_free[:-1, :-1] & is_free[1:, :-1] & is_free[:-1, 1:] & is_free[1:, 1:]
    for first, second, length in (
        (here, east, side),
        (below, above, side),
        (np.where(corner, number[:-1, :-1], -1), number[1:, 1:], math.sqrt(2.0) * side),
        (np.where(corner, number[:-1, 1:], -1), number[1:, :-1], math.sqrt(2.0) * side),
    ):
        both = (first >= 0) & (second >= 0)
        pairs.append(np.stack([first[both], second[both]], axis=1))
        lengths.append(np.full(int(both.sum()), length))
    return np.concatenate(pairs), np.concatenate(lengths)


class Grid:
    """The squares of all storeys as one graph; a node's number counts through the storeys."""

    def __init__(self, storeys: Sequence[Cells], climbs: Sequence[Climb] = ()) -> None:
        self.storeys = tuple(storeys)
        self.first = np.cumsum([0, *(len(cells.places_m) for cells in storeys)])
        self.places_m = np.concatenate([cells.places_m for cells in storeys])
        self.clear_m = np.concatenate([cells.clear_m for cells in storeys])
        self.storey = np.repeat(np.arange(len(storeys)), np.diff(self.first))
        self._piece = self._pieces()
        self._edges: list[tuple[NDArray[np.int64], NDArray[np.float64]]] = []
        self._add_edges()
        self._rest: dict[int, NDArray[np.float64]] = {}
        self._climbs: dict[tuple[int, int], Climb] = {}
        for climb in climbs:
            self._add_climb(climb)

    def _pieces(self) -> NDArray[np.int64]:
        """Numbers of connected pieces that differ between storeys."""
        counts = [int(cells.piece.max(initial=0)) + 1 for cells in self.storeys]
        shifts = np.cumsum([0, *counts[:-1]])
        return np.concatenate(
            [cells.piece + shift for cells, shift in zip(self.storeys, shifts, strict=True)]
        )

    def _add_edges(self) -> None:
        shy = SHY_COST * np.maximum(0.0, 1.0 - self.clear_m / SHY_M) ** 2
        for cells, first in zip(self.storeys, self.first, strict=False):
            ends = cells.edges + first
            mean = (shy[ends[:, 0]] + shy[ends[:, 1]]) / 2.0
            self._edges.append((ends, cells.lengths_m * (1.0 + mean)))

    def _add_climb(self, climb: Climb) -> None:
        foot = self.nearest(climb.lower, climb.foot_m)
        head = self.nearest(climb.lower + 1, climb.head_m)
        if foot is None or head is None:
            return
        self._edges.append((np.array([[foot, head]]), np.array([climb.length_m])))
        self._climbs[foot, head] = climb
        joined, kept = self._piece[head], self._piece[foot]
        self._piece[self._piece == joined] = kept

    @cached_property
    def _graph(self) -> rustworkx.PyGraph:
        """Made when a way is looked for: of two grids of a house one is only asked for costs."""
        graph = rustworkx.PyGraph(multigraph=False)
        graph.add_nodes_from(range(len(self.places_m)))
        for ends, costs in self._edges:
            first, second = ends.T.tolist()
            graph.extend_from_weighted_edge_list([*zip(first, second, costs.tolist(), strict=True)])
        return graph

    def climb(self, start: int, end: int) -> NDArray[np.float64]:
        """(n, 3) the feet on the stairs from one square to another, above the lower floor."""
        if (start, end) in self._climbs:
            return self._climbs[start, end].line_m
        return self._climbs[end, start].line_m[::-1]

    def nearest(
        self, storey: int, at_m: Sequence[float] | NDArray[np.float64], within_m: float = 0.15
    ) -> int | None:
        """The free square at a place; None where there is none near it."""
        chosen = np.arange(self.first[storey], self.first[storey + 1])
        if len(chosen) == 0:
            return None
        away = np.linalg.norm(self.places_m[chosen] - np.asarray(at_m), axis=1)
        best = int(away.argmin())
        return int(chosen[best]) if away[best] <= within_m else None

    def pieces_of(self, squares: NDArray[np.int64]) -> dict[int, int]:
        """The connected pieces that squares lie in, and one of the squares in each."""
        pieces, rows = np.unique(self._piece[squares], return_index=True)
        return dict(zip(pieces.tolist(), squares[rows].tolist(), strict=True))

    def reachable(self, node: int) -> NDArray[np.bool_]:
        """(n,) the squares to which there is a way."""
        reached: NDArray[np.bool_] = self._piece == self._piece[node]
        return reached

    def way(self, start: int, goal: int) -> list[int]:
        """The cheapest way, both ends with it, by A*.

        What is left of a way is known after `costs` of the goal, and else at least the beeline.
        """
        known = self._rest.get(goal)
        left = (self._beeline(goal).tolist() if known is None else known).__getitem__
        return list(
            rustworkx.graph_astar_shortest_path(
                self._graph, start, lambda node: node == goal, float, left
            )
        )

    def _beeline(self, goal: int) -> NDArray[np.float64]:
        """(n,) a lower bound of the cost to the goal from each square: 0 on other storeys."""
        away = np.linalg.norm(self.places_m - self.places_m[goal], axis=1)
        away[self.storey != self.storey[goal]] = 0.0
        return np.asarray(away, dtype=np.float64)

    def costs(self, nodes: Sequence[int]) -> NDArray[np.float64]:
        """(k, k) what the cheapest ways between some squares cost; infinite where there is none.

        What is left to each of them from any square is kept for `way`, unless it is too much.
        """
        ends = np.concatenate([edge for edge, _ in self._edges])
        costs = np.concatenate([cost for _, cost in self._edges])
        count = len(self.places_m)
        matrix = coo_array((costs, (ends[:, 0], ends[:, 1])), shape=(count, count)).tocsr()
        found: NDArray[np.float64] = dijkstra(matrix, directed=False, indices=list(nodes))
        if found.size <= MOST_COSTS:
            self._rest = dict(zip(nodes, found, strict=True))
        return found[:, list(nodes)]
