"""How bright each photo is: a gain per photo and channel, so that photos agree where they overlap.

In linear light the photos of one place differ by factors: exposure and white balance. For a place i
that photo v shows, log light = a_i + g_v; all a and g together by least squares, robustly (Huber,
then Geman and McClure, who let what is far off go), with a weak pull of all g to nothing: photos
without overlap keep their light.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, diags_array

ROUNDS, FIRST_ROUNDS = 12, 4
_HUBER = 0.08
"""Of log light: beyond, photos show other things (shadows, cars) or are burnt out."""
_PRIOR = 1e-3
DARKEST, BRIGHTEST = 0.004, 0.85
"""Linear light that a photo tells apart."""


def photo_gains(
    light: NDArray[np.floating],
    photo: NDArray[np.int64],
    place: NDArray[np.int64],
    photos: int,
) -> NDArray[np.float64]:
    """(photos, 3) what each photo's linear light is to be multiplied with.

    light: (s, 3) linear samples, of a photo and a place each; what is too dark or burnt is left
    out. The mean logarithm of the gains of the photos that have samples is 0; others have 1.
    """
    told = ((light > DARKEST) & (light < BRIGHTEST)).all(axis=1)
    gains = np.ones((photos, 3))
    if not told.any():
        return gains
    photo, value = photo[told], np.log(light[told].astype(np.float64))
    place = np.unique(place[told], return_inverse=True)[1].reshape(-1)
    shown = np.bincount(photo, minlength=photos) > 0
    for channel in range(3):
        log_gain = _solved(photos, photo, place, value[:, channel])
        log_gain[shown] -= log_gain[shown].mean()
        gains[:, channel] = np.exp(-log_gain)
    return gains


def _solved(
    photos: int, photo: NDArray[np.int64], place: NDArray[np.int64], value: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(photos,) g of value = a[place] + g[photo], with the places' own values eliminated."""
    weight: NDArray[np.float64] = np.ones(len(value))
    places = int(place.max()) + 1
    found: NDArray[np.float64] = np.zeros(photos)
    for turn in range(ROUNDS):
        total = np.bincount(place, weight, places)
        weights = coo_array((weight, (place, photo)), shape=(places, photos)).tocsr()
        shared = (weights.T @ diags_array(1.0 / total) @ weights).toarray()
        pull = _PRIOR * len(value) / photos
        normal = np.diag(np.bincount(photo, weight, photos) + pull) - shared
        mean = np.bincount(place, weight * value, places) / total
        right = np.bincount(photo, weight * (value - mean[place]), photos)
        found = np.asarray(np.linalg.solve(normal, right), dtype=np.float64)
        own = np.bincount(place, weight * (value - found[photo]), places) / total
        error = np.abs(value - found[photo] - own[place])
        if turn < FIRST_ROUNDS:
            weight = np.minimum(1.0, _HUBER / np.maximum(error, 1e-9)).astype(np.float64)
        else:
            weight = 1.0 / (1.0 + (error / _HUBER) ** 2) ** 2
    return found
