"""How much brighter one photo is than another, by channel, from places that both show."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

ROUNDS = 12
_HUBER = 0.15
"""Difference in the logarithm of light from which a sample counts less: it shows something else."""
_PRIOR = 3.0
"""Samples' worth of belief that a photo is like the others: it holds those that share nothing."""
DARKEST, BRIGHTEST = 0.004, 0.9
"""Linear light outside of which a sample is noise, or saturated."""


def photo_gains(
    light: NDArray[np.float64],
    photo: NDArray[np.int64],
    place: NDArray[np.int64],
    photos: int,
) -> NDArray[np.float64]:
    """(photos, 3) factors on linear light that make the photos alike; their median is 1.

    light: (s, 3) linear samples, of a photo and a place each. A model of one factor per photo and
    channel, log light = what the place reflects + gain of the photo, solved by turns with weights
    that forgive what stands before a place or glints.
    """
    good = ((light > DARKEST) & (light < BRIGHTEST)).all(axis=1)
    if not good.any():
        return np.ones((photos, 3))
    value, photo = np.log(light[good]), photo[good]
    place = np.unique(place[good], return_inverse=True)[1]
    places = int(place.max()) + 1
    gain, base = np.zeros((photos, 3)), np.zeros((places, 3))
    weight = np.ones_like(value)
    for _ in range(ROUNDS):
        base = _means(value - gain[photo], weight, place, places, 0.0)
        gain = _means(value - base[place], weight, photo, photos, _PRIOR)
        off = np.abs(value - base[place] - gain[photo])
        weight = _HUBER / np.maximum(off, _HUBER)
    used = np.bincount(photo, minlength=photos) > 0
    found: NDArray[np.float64] = np.exp(np.median(gain[used], axis=0) - gain)
    found[~used] = 1.0
    return found


def _means(
    value: NDArray[np.float64],
    weight: NDArray[np.float64],
    group: NDArray[np.int64],
    groups: int,
    prior: float,
) -> NDArray[np.float64]:
    """(groups, 3) weighted means, drawn towards 0 by the prior."""
    sums, weights = np.zeros((groups, 3)), np.full((groups, 3), prior)
    np.add.at(sums, group, weight * value)
    np.add.at(weights, group, weight)
    found: NDArray[np.float64] = sums / np.maximum(weights, 1e-12)
    return found
