"""Which control points are believed: one that contradicts the others is left out, and named.

With one point wrong, the fit to all is drawn to it, and the largest residual may be another's. So
each is left out in turn: the wrong one is that without which the others agree.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.world.absolute_orientation import absolute_orientation
from veduta.photos.world.georeference import Similarity

MOST_DEVIATIONS = 5.0
FEWEST_LEFT = 3
MOST_LEFT_OUT = 0.25
"""Share of the points that may be wrong: else nothing says which they are."""
CLEARLY = 2.0
"""Leaving out another must leave so many times the misfit: else nothing says which it is."""


@dataclass(frozen=True)
class Trusted:
    """similarity: by the points that are kept: (n,) bool. apart_m, expected_m: (n,) of all.

    doubtful: rows that contradict each other where nothing says which of them is wrong. suspect:
    the row without which least is left, where that is not clearly less than without another.
    """

    similarity: Similarity
    kept: NDArray[np.bool_]
    apart_m: NDArray[np.float64]
    expected_m: NDArray[np.float64]
    doubtful: tuple[int, ...] = ()
    suspect: int | None = None


def trusted(
    own: NDArray[np.float64],
    world: NDArray[np.float64],
    sd: NDArray[np.float64],
    survey_sd_m: float,
    most_left_out: float = MOST_LEFT_OUT,
) -> Trusted:
    """Of (n, 3) places in a structure and in the world; sd: (n,) of those in the structure.

    most_left_out: share of them; one at least, unless it is zero.
    """
    kept = np.ones(len(own), dtype=bool)
    most = max(1, int(most_left_out * len(own))) if most_left_out > 0.0 else 0
    now = _fit(own, world, sd, survey_sd_m, kept)
    while not _agrees(now) and int((~kept).sum()) < most and int(kept.sum()) > FEWEST_LEFT:
        rows = np.flatnonzero(kept)
        tried = [_fit(own, world, sd, survey_sd_m, _without(kept, row)) for row in rows.tolist()]
        cost = np.array([_misfit(one) for one in tried])
        order = np.argsort(cost)
        best, next_best = int(order[0]), int(order[1])
        if cost[next_best] < CLEARLY**2 * max(cost[best], _noise(tried[best])):
            doubtful = tuple(int(rows[row]) for row in order if _agrees(tried[int(row)]))
            suspect = int(rows[best])
            return replace(now, doubtful=doubtful, suspect=suspect)
        kept, now = tried[best].kept, tried[best]
    return now


def worst_of(found: Trusted) -> int:
    """The row of the kept point that lies furthest off, for what is expected."""
    ratio = np.where(found.kept, found.apart_m / found.expected_m, -1.0)
    return int(np.argmax(ratio))


def agrees(found: Trusted) -> bool:
    """Whether the points that are kept agree."""
    return _agrees(found)


def _fit(
    own: NDArray[np.float64],
    world: NDArray[np.float64],
    sd: NDArray[np.float64],
    survey_sd_m: float,
    kept: NDArray[np.bool_],
) -> Trusted:
    similarity = absolute_orientation(own[kept], world[kept])
    apart = np.linalg.norm(similarity.moved(own) - world, axis=1)
    expected = np.hypot(survey_sd_m, similarity.scale * sd)
    return Trusted(similarity, kept, apart, expected)


def _without(kept: NDArray[np.bool_], row: int) -> NDArray[np.bool_]:
    fewer = kept.copy()
    fewer[row] = False
    return fewer


def _agrees(found: Trusted) -> bool:
    ratio = (found.apart_m / found.expected_m)[found.kept]
    return bool((ratio <= MOST_DEVIATIONS).all())


def _misfit(found: Trusted) -> float:
    ratio = (found.apart_m / found.expected_m)[found.kept]
    return float((ratio**2).sum())


def _noise(found: Trusted) -> float:
    """What chance leaves of the kept points, at least."""
    return 0.1 * float(found.kept.sum())
