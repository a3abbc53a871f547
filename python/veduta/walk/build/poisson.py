"""The Poisson equation (6): destinations that keep a surface's shape and close onto what is known."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import spsolve


def extend_destinations(
    points: NDArray[np.float64], destinations: NDArray[np.float64], known: NDArray[np.bool_],
    right: NDArray[np.float64], down: NDArray[np.float64],
) -> NDArray[np.float64]:  # fmt: skip
    """Equation (6): (rows, columns, c) destinations everywhere, from those that are known.

    points: (rows, columns, c) where the nodes of the grid are. right, down: (rows, columns) how
    firmly a node hangs on the one on its right, below it (1; less across a break in depth). The
    gradient of what is found is that of the points: so the correction is harmonic. What hangs on
    nothing that is known stays where it is.
    """
    shape = known.shape
    unknown = ~known
    if not unknown.any() or not known.any():
        return np.where(known[..., None], destinations, points)
    number = np.arange(known.size).reshape(shape)
    pairs = [
        (number[:, :-1].ravel(), number[:, 1:].ravel(), right[:, :-1].ravel()),
        (number[:-1].ravel(), number[1:].ravel(), down[:-1].ravel()),
    ]
    one, other, weight = (np.concatenate(column) for column in zip(*pairs, strict=True))
    size = known.size
    links = sparse.coo_matrix((weight, (one, other)), shape=(size, size)).tocsr()
    links = links + links.T
    laplacian = sparse.diags(np.asarray(links.sum(axis=1)).ravel()) - links
    fixed, free = np.flatnonzero(known), np.flatnonzero(unknown)
    correction = np.where(known[..., None], destinations - points, 0.0).reshape(size, -1)
    inner = laplacian[free][:, free] + sparse.identity(len(free)) * 1e-9
    towards = -laplacian[free][:, fixed] @ correction[fixed]
    correction[free] = spsolve(inner.tocsc(), towards).reshape(len(free), -1)
    return points + correction.reshape(points.shape)
