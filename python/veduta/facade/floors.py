"""The vertical split: eaves, floors and the ground floor's top (paper section 3.2).

The energy of Koutsourakis et al. (equations 5 to 7) is a sum of positive terms, so taken literally
the fewest floors win. Two changes make it fair across storey counts and scales:

- a pair's similarity counts *relative to the mean dissimilarity of any two stretches of the
  facade*, weighted with the lower floor's height: alike floors earn, unlike ones pay, and the sum
  is an integral over the facade, whatever the number of floors that it is cut into;
- the boundary term is centred in the same way, on the local mean of the vertical-edge profile.

Without a known scale the storey is a further unknown: the chain is solved exactly for each storey
height (pixels) in a range, heights being 0.8 to 1.4 storeys, and the least energy of all wins.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.evidence import blur_line
from veduta.facade.rows import Rows
from veduta.run.errors import NotFoundError

# Heights in tenths of a metre for a mean storey of 3.0 m (section 3.2).
_HEIGHTS_DM = range(24, 43)
_MEAN_STOREY_DM = 30
MAX_FLOORS = 12
# Weights of equation 5 (alpha, beta), equation 7, and of the histograms' parting (equation 9).
_SIMILARITY = 1.0
_NEUTRAL = 0.85
_HEIGHT_CHANGE = 1.2
_BOUNDARY = 0.15
_MEAN_OFF = 0.1
_REACH = 0.8
_EAVES = 0.07
_GROUND_TOP = 0.02
# In storeys: the range of the roof (eaves to ridge) and of the ground floor.
_ROOF = (0.15, 1.7)
_GROUND = (0.85, 1.9)


@dataclass(frozen=True)
class Floors:
    """Row boundaries (analysis pixels) from the eaves down to the ground floor's top."""

    boundaries: list[int]
    storey_px: float
    energy: float
    terms: dict[str, float]
    labels: int

    @property
    def eaves(self) -> int:
        """Row of the eaves."""
        return self.boundaries[0]

    @property
    def mean_storey(self) -> float:
        """Mean height of a floor above the ground floor (analysis pixels)."""
        return (self.ground_top - self.eaves) / (len(self.boundaries) - 1)

    @property
    def ground_top(self) -> int:
        """Row of the ground floor's top."""
        return self.boundaries[-1]


def split_floors(rows: Rows) -> Floors:
    """Solve the chain for each storey height and keep the least energy of all."""
    storeys = range(rows.count // 14, round(rows.count / 3.2))
    scales = [_scale(s, rows) for s in storeys]
    solved = _core.floor_chain(rows.distance, scales, _SIMILARITY, _HEIGHT_CHANGE, MAX_FLOORS)
    candidates = [
        (found[0], index, count)
        for index, counts in enumerate(solved)
        for count, found in enumerate(counts[1:], start=2)
        if found is not None and _is_mean(storeys[index], found[1])
    ]
    if not candidates:
        raise NotFoundError(
            "a facade",
            "no chain of floors fits between the skyline and the ground",
            "Give a photo in which the whole facade is seen, or its --corners.",
        )
    energy, index, count = min(candidates)
    found = solved[index][count - 1]
    boundaries = [b * rows.step for b in found[1]] if found is not None else []
    labels = len(scales[index][0]) * rows.count
    return Floors(boundaries, float(storeys[index] * rows.step), energy / rows.count, {}, labels)


def _is_mean(storey: int, boundaries: list[int]) -> bool:
    """Whether the floors found at this scale have its storey as their mean."""
    mean = (boundaries[-1] - boundaries[0]) / (len(boundaries) - 1)
    return abs(mean / storey - 1) <= _MEAN_OFF


def _scale(
    storey: int, rows: Rows
) -> tuple[list[int], float, NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Heights, neutral dissimilarity and three costs (n + 1,) of a storey height, in grid rows."""
    heights = sorted({round(dm * storey / _MEAN_STOREY_DM) for dm in _HEIGHTS_DM})
    boundary = np.zeros(rows.count + 1)
    around = np.maximum(blur_line(rows.edges, storey / 2), 1e-3)
    boundary[:-1] = _BOUNDARY * (blur_line(rows.edges, storey / 25) / around - 1)
    parting = rows.parting(max(2, round(_REACH * storey)))
    parting = np.minimum(parting / (np.median(parting[rows.ridge :]) + 1e-6), 4)
    at = np.arange(rows.count + 1)
    roof, ground = at - rows.ridge, rows.count - at
    roof_fits = (roof >= _ROOF[0] * storey) & (roof <= _ROOF[1] * storey)
    ground_fits = (ground >= _GROUND[0] * storey) & (ground <= _GROUND[1] * storey)
    eaves = np.where(roof_fits, -_EAVES * rows.count * parting, np.inf)
    ground_top = np.where(ground_fits, -_GROUND_TOP * rows.count * parting, np.inf)
    return heights, _neutral(storey, rows), eaves, boundary, ground_top


def _neutral(storey: int, rows: Rows) -> float:
    """The dissimilarity of floors that are nothing alike: that of rows part of a storey apart."""
    offsets = range(max(1, int(0.4 * storey)), max(2, int(0.9 * storey)))
    body = rows.distance[rows.ridge :, rows.ridge :]
    return _NEUTRAL * max(float(np.diagonal(body, k).mean()) for k in offsets)
