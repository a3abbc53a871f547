"""Random numbers of a synthetic place: one stream per purpose.

A change in what one purpose draws moves no other.
"""

from __future__ import annotations

import zlib

import numpy as np


def stream(seed: int, purpose: str) -> np.random.Generator:
    """The generator for one purpose of one seed; the same pair always gives the same numbers."""
    return np.random.default_rng([seed, zlib.crc32(purpose.encode())])
