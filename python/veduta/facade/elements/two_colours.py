"""Two Gaussians of colour by expectation maximisation, and the chance of one of them (6.5)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
ROUNDS = 30
"""Of expectation maximisation: the means move by less than a grey level after about ten."""
LEAST_VARIANCE = 4.0
"""Grey levels squared, so that a picture of few colours has covariances that can be inverted."""


@dataclass(frozen=True)
class TwoColours:
    """shares (2), means (2, 3), covariances (2, 3, 3) of the clusters, the darker one first."""

    shares: Float
    means: Float
    covariances: Float

    def chance(self, colours: Float, cluster: int) -> Float:
        """P(cluster | i) of (6.5) for (n, 3) colours."""
        logs = np.log(self.shares) + _log_densities(colours, self.means, self.covariances)
        other = logs[:, 1 - cluster] - logs[:, cluster]
        return np.asarray(1.0 / (1.0 + np.exp(np.clip(other, -60.0, 60.0))), np.float64)


def two_colours(colours: Float) -> TwoColours:
    """The clusters of (n, 3) colours, from the darker and the lighter half on."""
    bright = colours.sum(axis=1)
    is_dark = bright <= np.median(bright)
    weights = np.stack([is_dark, ~is_dark], axis=1).astype(np.float64) + 1e-3
    found = _fitted(colours, weights)
    for _ in range(ROUNDS):
        dark = found.chance(colours, 0)
        found = _fitted(colours, np.stack([dark, 1.0 - dark], axis=1) + 1e-9)
    order = np.argsort(found.means.sum(axis=1))
    return TwoColours(found.shares[order], found.means[order], found.covariances[order])


def _fitted(colours: Float, weights: Float) -> TwoColours:
    sums = weights.sum(axis=0)
    means = weights.T @ colours / sums[:, None]
    apart = colours[:, None] - means
    covariances = np.einsum("nk,nki,nkj->kij", weights, apart, apart, optimize=True)
    covariances = covariances / sums[:, None, None] + LEAST_VARIANCE * np.eye(colours.shape[1])
    return TwoColours(sums / sums.sum(), means, covariances)


def _log_densities(colours: Float, means: Float, covariances: Float) -> Float:
    """(n, 2), but for a constant."""
    apart = colours[:, None] - means
    inverse = np.linalg.inv(covariances)
    squared = np.einsum("nki,kij,nkj->nk", apart, inverse, apart, optimize=True)
    return np.asarray(-0.5 * (squared + np.linalg.slogdet(covariances)[1]), np.float64)
