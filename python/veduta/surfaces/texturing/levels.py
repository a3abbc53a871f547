"""Brightness and colour levelled between views, so that seams do not show.

A correction for each vertex of each chart: equal colours where charts meet, and as even as can be
within one (Lempitsky and Ivanov 2007, section 5). Least squares, solved by conjugate gradients.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.texturing.options import TextureParameters

Floats = NDArray[np.float64]
_MOST_STEPS = 300
_TOLERANCE = 1e-3


@dataclass(frozen=True, eq=False)
class Nodes:
    """Vertices of charts. vertex: (n,) in the mesh. triangles: (t, 3) nodes of each seen one."""

    vertex: NDArray[np.int64]
    triangles: NDArray[np.int64]


def nodes_of(triangles: NDArray[np.int64], chart_of: NDArray[np.int32]) -> Nodes:
    """A node for each chart in which a vertex is; of the triangles that have a chart."""
    seen = chart_of >= 0
    corners = triangles[seen].ravel()
    most = int(triangles.max(initial=0)) + 1
    keys = np.repeat(chart_of[seen].astype(np.int64), 3) * most + corners
    unique, node = np.unique(keys, return_inverse=True)
    return Nodes(unique % most, node.reshape(-1, 3))


def corrections(nodes: Nodes, colours: Floats, parameters: TextureParameters) -> Floats:
    """(n, 3) to add to the colours of each node. colours: (n, 3) of the node in its own photo."""
    from scipy.sparse import csr_array, diags_array  # here, as few calls need it
    from scipy.sparse.linalg import cg

    count = len(nodes.vertex)
    if count == 0:
        return np.zeros((0, 3))
    order = np.argsort(nodes.vertex, kind="stable")
    met = nodes.vertex[order][1:] == nodes.vertex[order][:-1]
    one, other = order[:-1][met], order[1:][met]
    edges = np.concatenate([nodes.triangles[:, [0, 1]], nodes.triangles[:, [1, 2]]])
    starts, ends = edges[:, 0], edges[:, 1]
    rows = np.concatenate([one, starts])
    columns = np.concatenate([other, ends])
    weights = np.concatenate([np.ones(len(one)), np.full(len(starts), parameters.level_smooth)])
    apart = csr_array((weights, (rows, columns)), shape=(count, count))
    apart = csr_array(apart + apart.T)
    degree = np.asarray(apart.sum(axis=1)).ravel() + parameters.level_keep
    system = csr_array(diags_array(degree) - apart)
    difference = colours[other] - colours[one]
    inverse = diags_array(1.0 / degree)
    found = np.empty((count, 3))
    for channel in range(3):
        right = np.bincount(one, difference[:, channel], minlength=count)
        right -= np.bincount(other, difference[:, channel], minlength=count)
        found[:, channel], _ = cg(system, right, rtol=_TOLERANCE, maxiter=_MOST_STEPS, M=inverse)
    return np.clip(found, -parameters.level_most, parameters.level_most)
