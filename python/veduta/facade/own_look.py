"""What windows, railings and wall look like in this very image.

A first reading with the general cues (`appearance`) says roughly where windows and railings are.
From it the image's own colours and textures are counted per class, which gives sharper log-odds
for a second reading; nothing is carried from one image to another.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.appearance import Scores, Wall
from veduta.facade.evidence import Evidence, Float, blur
from veduta.facade.floors import Floors

# Kinds of pixels that are told apart, and pixels from which the kinds are taken.
_KINDS = 32
_SAMPLE = 4000
_ROUNDS = 12
# In storeys: the neighbourhood of a pixel's colour, and of its texture.
_COLOUR = 0.012
_TEXTURE = 0.02
# Differences from the wall in L, a, b that weigh as much as a factor e in texture.
_UNITS = (20.0, 6.0, 6.0)
# Part of each class that may be of any kind; weight of the own look against the general cues.
_ANY = 0.02
_OWN = 0.7
_CLIP = 1.5
# Pixels under which a class has not been seen.
_SEEN = 50


def look_again(
    kinds: NDArray[np.int64], scores: Scores, labels: NDArray[np.uint8], storey: float
) -> Scores:
    """Scores from the kinds of pixels (see `find_kinds`) that the classes of a first reading hold.

    `labels` (n, w) are 0 wall, 1 window, 2 railing, others not looked at. The general `scores` keep
    a part, so that a first reading's faults can mend.
    """
    counts = np.stack(
        [np.bincount(kinds[labels == c], minlength=_KINDS).astype(np.float64) for c in range(3)]
    )
    share = counts / np.maximum(counts.sum(1, keepdims=True), 1) + _ANY / _KINDS
    odds = np.log(share / share[0]).astype(np.float32)
    window, railing = (
        _mix(odds[c][kinds], old, storey) if counts[c].sum() >= _SEEN else old
        for c, old in ((1, scores.window), (2, scores.railing))
    )
    return Scores(window, railing, scores.level)


def _mix(own: Float, general: Float, storey: float) -> Float:
    own = blur(own, _COLOUR * storey, _COLOUR * storey)
    return np.clip(_OWN * own + (1 - _OWN) * general, -_CLIP, _CLIP).astype(np.float32)


def _cues(evidence: Evidence, wall: Wall, top: int, storey: float) -> Float:
    """Colour against the wall, and texture across x and y: (n, w, 5)."""
    lab = evidence.lab[top : top + len(wall.colour)]
    reach = _COLOUR * storey
    cues = [
        blur(lab[:, :, c] - wall.colour[:, :, c], reach, reach) / unit
        for c, unit in enumerate(_UNITS)
    ]
    lightness, fine = lab[:, :, 0], storey / 48
    for sigma in ((fine, 0.0), (0.0, fine)):
        detail = np.minimum(np.abs(lightness - blur(lightness, *sigma)), 30)
        texture = blur(detail, _TEXTURE * storey, 1.4 * _TEXTURE * storey)
        cues.append(np.log(texture / max(float(np.median(texture)), 1e-3) + 0.1))
    return np.dstack(cues).astype(np.float32)


def find_kinds(evidence: Evidence, wall: Wall, floors: Floors) -> NDArray[np.int64]:
    """The kind (n, w) of each pixel of the floors: the nearest of the image's k-means centres."""
    cues = _cues(evidence, wall, floors.eaves, floors.mean_storey)
    pixels = cues.reshape(-1, cues.shape[-1])
    sample = np.ascontiguousarray(pixels[:: max(1, len(pixels) // _SAMPLE)])
    start = _median_cut(sample).astype(np.int32).reshape(-1, 1)
    criteria = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, _ROUNDS, 0.01)
    flags = cv2.KMEANS_USE_INITIAL_LABELS
    centres = cv2.kmeans(sample, _KINDS, start, criteria, 1, flags)[2]
    distance = (centres * centres).sum(1)[None] - 2 * pixels @ centres.T
    return np.asarray(distance.argmin(1).reshape(cues.shape[:2]), np.int64)


def _median_cut(sample: Float) -> NDArray[np.int64]:
    """Groups (n,) by halving each group at the median of its widest cue, until there are enough."""
    groups = [np.arange(len(sample))]
    while len(groups) < _KINDS:
        halves = []
        for group in groups:
            axis = int(sample[group].var(0).argmax())
            order = group[np.argsort(sample[group, axis], kind="stable")]
            halves += [order[: len(order) // 2], order[len(order) // 2 :]]
        groups = halves
    labels = np.zeros(len(sample), np.int64)
    for i, group in enumerate(groups):
        labels[group] = i
    return labels
