"""How unlike rows or columns of the facade are: any two, and those a given way apart."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

Real = TypeVar("Real", bound=np.floating)


def of_pairs(vectors: NDArray[Real]) -> NDArray[Real]:
    """(n, n) squared distances of any two of the (n, d) vectors."""
    squares = (vectors * vectors).sum(1)
    return np.asarray(squares[:, None] + squares[None] - 2 * vectors @ vectors.T)


def at_offsets(distance: NDArray[np.floating], reach: int) -> NDArray[np.float64]:
    """(reach,) means of an (n, n) distance over all pairs that are 0, 1, ... reach - 1 apart."""
    return np.array([float(np.diagonal(distance, k).mean()) for k in range(reach)])
