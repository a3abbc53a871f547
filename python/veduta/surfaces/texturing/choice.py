"""A view for each triangle: one that shows it well, and few seams.

A Markov random field over the triangles with a label for each view (Lempitsky and Ivanov 2007,
Waechter et al. 2014), started from worths that are spread over neighbours, and improved by iterated
conditional modes of random halves of the triangles.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.texturing.options import TextureParameters
from veduta.surfaces.texturing.sight import NO_VIEW, Sights

Labels = NDArray[np.int32]
_OUT = np.float32(1e6)
_SHOWS_ELSE = np.float32(0.7)
"""What a view loses that shows something else than most."""


def choose(
    sights: Sights, beside: NDArray[np.int32], parameters: TextureParameters, seed: int = 0
) -> Labels:
    """(m,) the view of each triangle, -1 where none sees it. beside: (m, 3) its neighbours."""
    costs = _costs(sights, parameters)
    labels = _spread(sights.views, costs, beside, parameters)
    rng = np.random.default_rng(seed)
    labels = _improved(labels, sights.views, costs, beside, parameters.seam, parameters.rounds, rng)
    small = _small(labels, beside, parameters.smallest)
    few = max(4, parameters.rounds // 2)
    return _improved(labels, sights.views, costs, beside, 4.0 * parameters.seam, few, rng, small)


def _costs(sights: Sights, parameters: TextureParameters) -> NDArray[np.float32]:
    """(m, k): 0 for the largest sight, towards 1 for small ones; more for what passed by."""
    there = sights.views != NO_VIEW
    largest = np.maximum(sights.areas[:, :1], 1e-12)
    costs = 1.0 - np.sqrt(sights.areas / largest)
    colours = np.where(there[..., None], sights.colours, np.nan)
    many = there.sum(axis=1) >= parameters.fewest
    median = np.nanmedian(colours[many], axis=1, keepdims=True)
    off = np.abs(colours[many] - median).max(axis=2)
    costs[many] += np.where(off > parameters.differs, _SHOWS_ELSE, 0.0)
    return np.where(there, costs, _OUT).astype(np.float32)


def _spread(
    views: Labels,
    costs: NDArray[np.float32],
    beside: NDArray[np.int32],
    parameters: TextureParameters,
) -> Labels:
    """The view that is worth most to a triangle and those around it, of those that see it."""
    from scipy.sparse import csr_array  # here, as few calls need it

    rows, columns = np.nonzero(views != NO_VIEW)
    count = len(views)
    shape = (count, int(views.max(initial=0)) + 1)
    seen = views[rows, columns]
    worth: Any = csr_array((1.0 - costs[rows, columns].astype(np.float64), (rows, seen)), shape)
    pattern: Any = csr_array((np.ones(len(rows)), (rows, seen)), shape)
    left, side = np.nonzero(beside >= 0)
    own = np.arange(count)
    mean: Any = csr_array(
        (
            np.full(len(left) + count, 0.25),
            (np.concatenate([left, own]), np.concatenate([beside[left, side], own])),
        ),
        shape=(count, count),
    )
    for _ in range(parameters.smoothing):
        worth = csr_array((mean @ worth) * pattern)
    found = np.full(views.shape, -np.inf, dtype=np.float32)
    found[rows, columns] = np.asarray(worth[rows, seen]).ravel()
    best = np.argmax(found, axis=1)
    return np.asarray(views[np.arange(count), best], dtype=np.int32)


def _improved(
    labels: Labels,
    views: Labels,
    costs: NDArray[np.float32],
    beside: NDArray[np.int32],
    seam: float,
    rounds: int,
    rng: np.random.Generator,
    only: NDArray[np.intp] | None = None,
) -> Labels:
    """Each triangle takes the view that is cheapest beside its neighbours; half at a time."""
    labels = labels.copy()
    taken = np.flatnonzero(views[:, 0] != NO_VIEW) if only is None else only
    for _ in range(rounds):
        rows = taken[rng.random(len(taken)) < 0.5]
        around = beside[rows]
        theirs = np.where(around >= 0, labels[around], NO_VIEW)
        counts = (theirs != NO_VIEW)[:, None] & (theirs[:, None] != views[rows][..., None])
        totals = costs[rows] + seam * counts.sum(axis=2, dtype=np.float32)
        labels[rows] = views[rows, np.argmin(totals, axis=1)]
    return labels


def patches(labels: Labels, beside: NDArray[np.int32]) -> tuple[int, Labels]:
    """The number of connected pieces of one view, and (m,) the piece of each triangle."""
    from scipy.sparse import csr_array  # here, as few calls need it
    from scipy.sparse.csgraph import connected_components

    rows, side = np.nonzero(beside >= 0)
    other = beside[rows, side]
    same = labels[rows] == labels[other]
    graph = csr_array(
        (np.ones(int(same.sum()), np.int8), (rows[same], other[same])), shape=(len(labels),) * 2
    )
    count, found = connected_components(graph, directed=False)
    return int(count), np.asarray(found, dtype=np.int32)


def _small(labels: Labels, beside: NDArray[np.int32], smallest: int) -> NDArray[np.intp]:
    count, piece = patches(labels, beside)
    sizes = np.bincount(piece, minlength=count)
    return np.flatnonzero((sizes[piece] < smallest) & (labels != NO_VIEW))
