"""The vertical split: eaves, floors and the ground floor's top (paper section 3.2).

The energy of Koutsourakis et al. (equations 5 to 7) is a sum of positive terms, so taken literally
the fewest floors win. Two changes make it fair across storey counts and scales:

- a pair's similarity counts *relative to the mean dissimilarity of any two stretches of the
  facade*, weighted with the lower floor's height: alike floors earn, unlike ones pay, and the sum
  is an integral over the facade, whatever the number of floors that it is cut into;
- the boundary term is centred in the same way, on the local mean of the vertical-edge profile.

Without a known scale the storey is a further unknown: the chain is solved exactly for each storey
height (pixels) in a range, heights being 0.8 to 1.4 storeys, and the least energy of all wins;
energies at storeys that are much lower than the facade's bays are wide (`bays`) count for less.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.dissimilarity import at_offsets
from veduta.facade.evidence import blur_line
from veduta.facade.rows import Rows
from veduta.run.errors import NotFoundError

# Heights in tenths of a metre for a mean storey of 3.0 m (section 3.2).
_HEIGHTS_DM = range(24, 43)
_MEAN_STOREY_DM = 30
MAX_FLOORS = 18
# Floors, and the part of the picture of one storey, up to which bays need not confirm them; bays in
# storeys that do, and the energy per row that so many floors have at most.
_USUAL_FLOORS, _USUAL_STOREY = 12, 1 / 14
_CONFIRMS = (0.65, 1.3)
_ALIKE = -0.3
# Grid rows below which a storey shows nothing to compare.
_LEAST_STOREY = 4
# Shares of the picture that one storey may take: at most, and where the bays say that it is so.
_LEAST, _MOST, _MOST_BY_BAYS = 1 / 22, 1 / 3.2, 1 / 1.9
# Storeys up to which bays are wide (in 82 facades from straight in front, 96 % are 0.27 to 1.2
# wide), and how much of the energy counts at twice that, and at the least.
_WIDE_BAY = 1.2
_NARROW_BAY = 0.3
_AT_TWICE, _AT_LEAST = 0.3, 0.1
# Weights of equation 5 (alpha, beta), equation 7, and of the histograms' parting (equation 9).
_SIMILARITY = 1.0
_NEUTRAL = 0.85
_HEIGHT_CHANGE = 1.2
_BOUNDARY = 0.15
_MEAN_OFF = 0.1
# Share of the best energy at which floors of twice the height win, and the least count for that;
# and that at which floors of half the height win, where bays are narrower than this many storeys.
_HALVED = 0.9
_MANY = 6
_DOUBLED = 0.85
_SLIM_BAY = 0.56
_REACH = 0.8
_EAVES = 0.07
_GROUND_TOP = 0.02
# In storeys: the range of the roof (eaves to ridge) and of the ground floor.
_ROOF = (0.15, 1.2)
_GROUND = (0.85, 1.9)


Costs = NDArray[np.float64]
# Heights, neutral dissimilarity, and the costs of eaves, boundaries and the ground floor's top.
Scale = tuple[list[int], float, Costs, Costs, Costs]


class _Candidate(NamedTuple):
    """The best chain of so many floors at a storey height (grid rows), by its energy."""

    energy: float
    scale: int
    floors: int
    storey: int

    def is_slim(self, bay: int | None) -> bool:
        """Whether bays are narrower than storeys of this height have them."""
        return bay is not None and bay < _SLIM_BAY * self.storey


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


def split_floors(rows: Rows, height_m: float | None = None) -> Floors:
    """Solve the chain for each storey height and keep the least energy of all.

    With a known `height_m` (ground to eaves) the mean floor must have 2.4 to 4.2 m. Raises
    NotFoundError where no chain fits.
    """
    storeys = _storeys(rows)
    body = rows.distance[rows.ridge :, rows.ridge :]
    unlike = at_offsets(body, len(body))
    partings = {half: rows.parting(half) for half in sorted({*map(_reach, storeys)})}
    scales = [_scale(s, rows, unlike, partings[_reach(s)]) for s in storeys]
    solved = _core.floor_chain(rows.distance, scales, _SIMILARITY, _HEIGHT_CHANGE, MAX_FLOORS)
    candidates = [
        _Candidate(found[0] * _trust(storeys[index], rows.bay), index, count, storeys[index])
        for index, counts in enumerate(solved)
        for count, found in enumerate(counts, start=1)
        if found is not None
        and _is_mean(storeys[index], found[1])
        and _is_usual(storeys[index], count, found[0], rows)
        and (height_m is None or _fits_height(found[1], rows.count, height_m))
    ]
    if not candidates:
        raise NotFoundError(
            "a facade",
            "no storeys of a usual height fit between the sky and the ground"
            + ("" if height_m is None else f" for a height of {height_m} m"),
            "Give a photo in which the whole facade is seen, or its --corners, "
            "and check --height-m where it is given.",
        )
    _, index, count, _ = _not_doubled(_not_halved(candidates, rows.bay), candidates, rows.bay)
    energy, boundaries = solved[index][count - 1] or (0.0, [])
    return Floors(
        [b * rows.step for b in boundaries],
        float(storeys[index] * rows.step),
        energy / rows.count,
        _terms(boundaries, rows, scales[index]),
        len(scales[index][0]) * rows.count,
    )


def _storeys(rows: Rows) -> list[int]:
    """The storey heights to try, in grid rows."""
    least, most = (round(rows.count * part) for part in (_LEAST, _MOST))
    least = max(_LEAST_STOREY, least)
    tall = range(max(least, most), round(rows.count * _MOST_BY_BAYS))
    by_bays = [s for s in tall if rows.bay is not None and rows.bay >= _NARROW_BAY * s]
    return [*range(least, most), *by_bays]


def _trust(storey: int, bay: int | None) -> float:
    """How much of a storey height's energy counts: less where bays are too wide for it."""
    if bay is None:
        return 1.0
    octaves = float(np.log2(max(1.0, bay / (_WIDE_BAY * storey))))
    return max(_AT_LEAST, 1 - (1 - _AT_TWICE) * octaves)


def _fits_height(boundaries: list[int], bottom: int, height_m: float) -> bool:
    """Whether the mean floor has 2.4 to 4.2 m where ground to eaves has `height_m`."""
    mean = (boundaries[-1] - boundaries[0]) / (len(boundaries) - 1)
    mean_dm = 10 * mean * height_m / (bottom - boundaries[0])
    return _HEIGHTS_DM.start <= mean_dm < _HEIGHTS_DM.stop


def _terms(boundaries: list[int], rows: Rows, scale: Scale) -> dict[str, float]:
    """What each term adds to the energy (per row), summed up anew from the boundaries."""
    _, neutral, eaves, boundary, ground = scale
    similarity = change = edges = 0.0
    for (top, middle), (_, bottom) in pairwise(pairwise(boundaries)):
        above, below = middle - top, bottom - middle
        shared = np.arange(min(above, below))
        unlike = float(rows.distance[top + shared, middle + shared].mean()) - neutral
        similarity += _SIMILARITY * unlike * below
        change += _HEIGHT_CHANGE * abs(above - below)
        edges += float(boundary[middle]) * (above + below) / 2
    sums = {
        "similarity": similarity,
        "height_change": change,
        "boundary": edges,
        "eaves": float(eaves[boundaries[0]]),
        "ground_top": float(ground[boundaries[-1]]),
    }
    return {name: total / rows.count for name, total in sums.items()}


def _is_usual(storey: int, count: int, energy: float, rows: Rows) -> bool:
    """Whether floors are as many as most facades have, or as bays and their likeness confirm."""
    if count <= _USUAL_FLOORS and storey >= int(rows.count * _USUAL_STOREY):
        return True
    least, most = _CONFIRMS
    confirmed = rows.bay is not None and least * storey <= rows.bay <= most * storey
    return confirmed and energy <= _ALIKE * rows.count


def _not_halved(candidates: list[_Candidate], bay: int | None) -> _Candidate:
    """The least energy; but where floors of about twice the height do nearly as well, those.

    Windows and spandrels that look alike repeat at half a storey as well as at a whole one. Few
    floors are taken as they are: there is too little of them to compare. Bays that are too narrow
    for the taller floors speak against them.
    """
    several = [c for c in candidates if c.floors > 1]
    best = min(candidates)
    # One floor has nothing to be like; it wins only where several are clearly worse.
    if best.floors == 1 and several and min(several).energy <= _HALVED * best.energy:
        best = min(several)
    taller = [c for c in candidates if 0.4 <= c.floors / best.floors <= 0.6 and not c.is_slim(bay)]
    if best.floors >= _MANY and taller and min(taller).energy <= _HALVED * best.energy:
        return min(taller)
    return best


def _not_doubled(best: _Candidate, candidates: list[_Candidate], bay: int | None) -> _Candidate:
    """The best; but where bays are too narrow for it and confirm half its height, that.

    Two storeys repeat where one does, and floors that come in pairs are more alike so.
    """
    if bay is None or not best.is_slim(bay):
        return best
    lower = [
        c
        for c in candidates
        if 1.7 <= c.floors / best.floors <= 2.6 and bay >= _CONFIRMS[0] * c.storey
    ]
    return min(lower) if lower and min(lower).energy <= _DOUBLED * best.energy else best


def _is_mean(storey: int, boundaries: list[int]) -> bool:
    """Whether the floors found at this scale have its storey as their mean."""
    mean = (boundaries[-1] - boundaries[0]) / (len(boundaries) - 1)
    return abs(mean / storey - 1) <= _MEAN_OFF


def _reach(storey: int) -> int:
    """How far above and below its ends a facade is compared (grid rows)."""
    return max(2, round(_REACH * storey))


def _scale(
    storey: int, rows: Rows, unlike: NDArray[np.float64], parting: NDArray[np.float64]
) -> Scale:
    """Heights, neutral dissimilarity and three costs (n + 1,) of a storey height, in grid rows.

    parting: (n + 1,) that of the rows within `_reach` above and below each border.
    """
    heights = sorted({round(dm * storey / _MEAN_STOREY_DM) for dm in _HEIGHTS_DM})
    boundary = np.zeros(rows.count + 1)
    around = np.maximum(blur_line(rows.edges, storey / 2), 1e-3)
    boundary[:-1] = _BOUNDARY * (blur_line(rows.edges, storey / 25) / around - 1)
    parting = np.minimum(parting / (np.median(parting[rows.ridge :]) + 1e-6), 4)
    at = np.arange(rows.count + 1)
    roof, ground = at - rows.ridge, rows.count - at
    roof_fits = (roof >= _ROOF[0] * storey) & (roof <= _ROOF[1] * storey)
    ground_fits = (ground >= _GROUND[0] * storey) & (ground <= _GROUND[1] * storey)
    eaves = np.where(roof_fits, -_EAVES * rows.count * parting, np.inf)
    ground_top = np.where(ground_fits, -_GROUND_TOP * rows.count * parting, np.inf)
    return heights, _neutral(storey, unlike), eaves, boundary, ground_top


def _neutral(storey: int, unlike: NDArray[np.float64]) -> float:
    """The dissimilarity of floors that are nothing alike: that of rows part of a storey apart."""
    offsets = range(max(1, int(0.4 * storey)), max(2, int(0.9 * storey)))
    return _NEUTRAL * max(map(float, unlike[offsets.start : offsets.stop]), default=1.0)
