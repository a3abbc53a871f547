"""What a beam that is not infinitely thin measures: several rays, mixed as a detector mixes them.

A scanner's beam widens (15 mrad in Frueh et al. 2005, section 4.1). Echoes that come back within
one pulse of each other melt into one; of echoes that are farther apart the strongest is taken. Thus
points float between an edge and what is behind it, and thin things are seen in part only.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Kinds = NDArray[np.uint8]
PULSE_M = 0.6
"""Half the length of a pulse of 4 ns: echoes that are nearer to each other melt into one."""
RAYS = 7
_RING = 0.75
"""How far out the six outer rays are: each of the seven stands for about a seventh of the area."""
_FEWEST = 0.2
"""Less of a beam than this does not answer: a twig before the sky."""


def spread(directions: Floats, divergence_rad: float) -> Floats:
    """(n, 7, 3) unit rays about (n, 3) unit directions; the first is the middle one."""
    up = np.where(np.abs(directions[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
    side = np.cross(directions, up)
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    over = np.cross(side, directions)
    angle = np.arange(RAYS - 1) * 2 * np.pi / (RAYS - 1)
    out = _RING * divergence_rad / 2
    ring = (
        np.cos(angle)[None, :, None] * side[:, None] + np.sin(angle)[None, :, None] * over[:, None]
    )
    rays = np.concatenate([directions[:, None], directions[:, None] + out * ring], axis=1)
    return np.asarray(rays / np.linalg.norm(rays, axis=2, keepdims=True))


def mixed(distances: Floats, kinds: Kinds) -> tuple[Floats, Kinds]:
    """(n,) what is measured, inf where nothing is, and what most of it is, of (n, k) rays."""
    answered = np.isfinite(distances)
    energy = np.where(answered, 1.0 / np.maximum(distances, 0.1) ** 2, 0.0)
    nearest = np.where(answered, distances, 0.0)
    best = np.zeros(len(distances))
    group = np.zeros(distances.shape, dtype=bool)
    for first in np.argsort(distances, axis=1).T:
        begin = np.take_along_axis(distances, first[:, None], axis=1)
        with np.errstate(invalid="ignore"):
            own = answered & (distances >= begin) & (distances <= begin + PULSE_M)
        total = (energy * own).sum(axis=1)
        better = total > best * (1.0 + 1e-9)
        best, group[better] = np.where(better, total, best), own[better]
    share = group.mean(axis=1)
    known = share >= _FEWEST
    total = np.where(known, (energy * group).sum(axis=1), 1.0)
    measured = np.where(known, (energy * group * nearest).sum(axis=1) / total, np.inf)
    return measured, _most(kinds, energy * group, known)


def _most(kinds: Kinds, energy: Floats, known: NDArray[np.bool_]) -> Kinds:
    """(n,) the kind with most of the energy, 0 where nothing answers."""
    count = int(kinds.max(initial=0)) + 1
    sums = np.stack([(energy * (kinds == kind)).sum(axis=1) for kind in range(count)], axis=1)
    return np.where(known, sums.argmax(axis=1), 0).astype(np.uint8)
