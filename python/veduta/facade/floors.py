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
from veduta.facade.evidence import Evidence, Float, blur, blur_line
from veduta.facade.extent import RowHistograms, Skyline
from veduta.run.errors import NotFoundError

# Heights in tenths of a metre for a mean storey of 3.0 m (section 3.2).
_HEIGHTS_DM = range(24, 43)
_MEAN_STOREY_DM = 30
MAX_FLOORS = 12
_SIMILARITY = 1.0
_HEIGHT_CHANGE = 0.3
_BOUNDARY = 0.15
_PARTING = 0.15
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


def split_floors(evidence: Evidence, skyline: Skyline, histograms: RowHistograms) -> Floors:
    """Solve the chain for each storey height and keep the least energy per facade height."""
    distance = row_distance(evidence, skyline)
    profile = _edge_profile(evidence, skyline)
    rows = evidence.height
    storeys = range(rows // 14, round(rows / 3.2), max(1, rows // 280))
    scales = [_scale(s, profile, histograms, skyline.level, rows) for s in storeys]
    solved = _core.floor_chain(distance, scales, _SIMILARITY, _HEIGHT_CHANGE, 1.0, MAX_FLOORS)
    candidates = [
        (found[0], storey, i)
        for storey, (i, counts) in zip(storeys, enumerate(solved), strict=True)
        for found in counts[1:]
        if found is not None
    ]
    if not candidates:
        raise NotFoundError(
            "a facade",
            "no chain of floors fits between the skyline and the ground",
            "Give a photo in which the whole facade is seen, or its --corners.",
        )
    energy, storey, index = min(candidates)
    best = next(f for f in solved[index] if f is not None and f[0] == energy)
    return Floors(best[1], float(storey), energy / rows, {}, len(scales[index][0]) * rows)


def row_distance(evidence: Evidence, skyline: Skyline) -> Float:
    """Mean squared difference of any two rows (h, h), 1 for two rows of the facade at random.

    Rows are compared by lightness against their surroundings and by their gradients, so that a
    shadow across a floor does not make it another floor (equation 6 on these channels).
    """
    rows = evidence.height
    building = (np.arange(rows)[:, None] >= skyline.rows[None]) & evidence.valid
    lightness = evidence.lab[:, :, 0]
    local = lightness - blur(lightness, rows / 40, rows / 40)
    local /= np.sqrt(blur(local * local, rows / 20, rows / 20)) + 4
    edges = [blur(np.minimum(np.abs(g), 25), 1.5, 1.0) for g in (evidence.gx, evidence.gy)]
    channels = []
    for channel, weight in zip([local, *edges], (1.0, 1.0, 0.5), strict=True):
        masked = channel * building
        spread = float(masked[skyline.level :].std()) + 1e-6
        channels.append(blur(masked, 1.0, 1.0) * (np.sqrt(weight) / spread))
    stacked = np.concatenate(channels, axis=1)
    squares = (stacked * stacked).sum(1)
    distance = squares[:, None] + squares[None] - 2 * stacked @ stacked.T
    body = distance[skyline.level :, skyline.level :]
    apart = np.abs(np.subtract.outer(np.arange(len(body)), np.arange(len(body)))) > rows / 25
    return np.asarray(distance / max(float(body[apart].mean()), 1e-6), np.float32)


def _edge_profile(evidence: Evidence, skyline: Skyline) -> Float:
    building = np.arange(evidence.height)[:, None] >= skyline.rows[None]
    return np.asarray((np.abs(evidence.gx) * building).mean(1), np.float32)


def _scale(
    storey: int, profile: Float, histograms: RowHistograms, ridge: int, rows: int
) -> tuple[list[int], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Heights and the three costs (h + 1,) of one storey height, in rows."""
    heights = sorted({round(dm * storey / _MEAN_STOREY_DM) for dm in _HEIGHTS_DM})
    boundary = np.zeros(rows + 1)
    around = np.maximum(blur_line(profile, storey / 2), 1e-3)
    boundary[:rows] = _BOUNDARY * storey * (blur_line(profile, storey / 25) / around - 1)
    parting = histograms.parting(max(4, storey // 2))
    parting = np.minimum(parting / (np.median(parting[ridge:]) + 1e-6), 4)
    at = np.arange(rows + 1)
    reward = -_PARTING * storey * parting
    roof, ground = at - ridge, rows - at
    roof_fits = (roof >= _ROOF[0] * storey) & (roof <= _ROOF[1] * storey)
    ground_fits = (ground >= _GROUND[0] * storey) & (ground <= _GROUND[1] * storey)
    eaves = np.where(roof_fits, reward, np.inf)
    return heights, eaves, boundary, np.where(ground_fits, reward, np.inf)
