"""The motion graph: states within a threshold of each other, and walks that do not repeat.

The paper gives no threshold. Here it is the smallest at which the graph is one component, so that
every state can be reached and no edge is longer than it must be: the longest edge of the least
spanning tree, which is where the last two components of a growing threshold meet.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra, minimum_spanning_tree
from scipy.spatial.distance import pdist, squareform

from veduta.fauna.motion.angles import Complexes, Floats, angles_of


@dataclass(frozen=True, eq=False)
class MotionGraph:
    """states: (k, 8) complex. distance: (k, k) between them. threshold: of an edge's length."""

    states: Complexes
    distance: Floats
    threshold: float

    @property
    def edges(self) -> NDArray[np.bool_]:
        """(k, k) which states are joined."""
        joined = self.distance <= self.threshold
        np.fill_diagonal(joined, False)
        return joined


def motion_graph(states: Complexes) -> MotionGraph:
    """Join the states (k, 8) by Euclidean distance of coefficients 1 to 7; two states at least."""
    columns = states[:, 1:]
    distance = squareform(pdist(np.concatenate([columns.real, columns.imag], axis=1)))
    # A distance of zero is no edge to the library: equal states get the least that there is.
    lengths = np.maximum(distance, np.finfo(np.float64).tiny)
    np.fill_diagonal(lengths, 0.0)
    tree = minimum_spanning_tree(csr_array(lengths))
    threshold = float(tree.data.max()) * (1.0 + 1e-12)
    return MotionGraph(states, distance, threshold)


def walk(graph: MotionGraph, start: int, steps: int) -> list[int]:
    """The states of a walk by W(q) = deg(q) / 2^v(q): often met ones are left for others.

    v(q) counts how often q was chosen. Of equal ones the first is taken; the logarithm is compared,
    since the power underflows on long walks.
    """
    edges = graph.edges
    degree = np.log2(np.maximum(edges.sum(axis=1), 1).astype(np.float64))
    visits = np.zeros(len(edges))
    found = [start]
    visits[start] = 1.0
    neighbours = [np.flatnonzero(row) for row in edges]
    for _ in range(steps):
        around = neighbours[found[-1]]
        chosen = int(around[np.argmax(degree[around] - visits[around])])
        visits[chosen] += 1.0
        found.append(chosen)
    return found


def closed_walk(graph: MotionGraph, start: int, steps: int) -> list[int]:
    """A walk that comes back to its start by the shortest way, so that it can be played anew."""
    found = walk(graph, start, steps)
    lengths = csr_array(np.where(graph.edges, np.maximum(graph.distance, 1e-12), 0.0))
    _, before = dijkstra(lengths, indices=np.array([start]), return_predecessors=True)
    while found[-1] != start:
        found.append(int(before[0, found[-1]]))
    return found


def interpolated(
    states: Complexes, visited: list[int], most_step: Floats, seed: int = 0
) -> Complexes:
    """(t, 8) the states frame by frame: coefficients on straight lines between those visited.

    Each stretch takes as many frames as it needs that no angle of the axis changes in a frame by
    more than `most_step`, (n,) rad: joints never move faster than in the footage. Up to half as
    many are added by the seed: the same states, met again, are no repetition.
    """
    nodes = states[visited]
    turns = np.abs(np.diff(angles_of(nodes, len(most_step)), axis=0))
    leisure = 1.0 + 0.5 * np.random.default_rng(seed).random(len(turns))
    frames = np.ceil(leisure * (turns / most_step).max(axis=1)).astype(int)
    pieces = [
        nodes[row] + (np.arange(count) / count)[:, None] * (nodes[row + 1] - nodes[row])
        for row, count in enumerate(np.maximum(frames, 1))
    ]
    return np.concatenate([*pieces, nodes[-1:]])
