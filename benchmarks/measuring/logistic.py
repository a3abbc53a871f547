"""A logistic model, fitted by Newton's method."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def likeliest(
    known: Floats, right: NDArray[np.number], weight: Floats, ridge: float, rounds: int
) -> Floats:
    """(k,) the weights of the columns of `known` (n, k), whose first is ones and costs nothing.

    right: (n,) one or zero. weight: (n,) how much each row counts. ridge: what squares of the
    weights cost.
    """
    at = np.zeros(known.shape[1])
    cost = ridge * np.diag([0.0, *[1.0] * (known.shape[1] - 1)])
    for _ in range(rounds):
        chance = 1.0 / (1.0 + np.exp(-known @ at))
        slope = known.T @ (weight * (right - chance)) - cost @ at
        bend = (known.T * (weight * chance * (1.0 - chance))) @ known + cost
        at += np.linalg.solve(bend + 1e-9 * np.eye(len(at)), slope)
    return at
