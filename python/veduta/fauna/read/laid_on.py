"""Where the middle of an animal is that a frame's border cuts: a whole silhouette on the part."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import fftconvolve

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.silhouettes import Masks

Shown = Sequence[Masks | None]
"""Of each frame whose border cuts the animal (h, w) what it shows; None: the animal is whole."""
_SMALL_PX = 160
"""Pictures are so large where one is laid on another."""
_AWAY = 0.5
"""A whole silhouette that lies so many of its lengths from where the animal was going must cover
the part so much better, as a share of both.
"""


def laid_on(masks: Masks, middle: Floats, shown: Shown) -> Floats:
    """The middles (t, 2) px of silhouettes; those of parts by the nearest whole one.

    From whole frames outwards: an animal that leaves goes on as it went, unless the part that is
    still seen says otherwise.
    """
    whole = np.flatnonzero([one is None for one in shown])
    found = middle.copy()
    if len(whole) in (0, len(masks)):
        return found
    small = max(1, round(max(masks.shape[1:]) / _SMALL_PX))
    parts = np.setdiff1d(np.arange(len(masks)), whole)
    apart = np.abs(parts[:, None] - whole).min(axis=1)
    done = [int(row) for row in whole]
    for row in parts[np.argsort(apart, kind="stable")]:
        nearest = np.array(done)[np.argsort(np.abs(np.array(done) - row), kind="stable")][:2]
        guess = found[nearest[0]].copy()
        if len(nearest) == 2:
            pace = (found[nearest[0]] - found[nearest[1]]) / (nearest[0] - nearest[1])
            guess += pace * (row - nearest[0])
        source = int(whole[np.abs(whole - row).argmin()])
        inside = shown[row]
        if inside is not None:
            planes = [plane[::small, ::small] for plane in (masks[source], masks[row], inside)]
            shift = _shift(planes[0], planes[1], planes[2], (guess - middle[source]) / small)
            found[row] = middle[source] + shift * small
        done.append(int(row))
    return found


def _shift(whole: Masks, part: Masks, inside: Masks, guess: Floats) -> Floats:
    """(2,) px, x and y, by which a whole silhouette covers a part best.

    inside: (h, w) what is seen. guess: the shift that is expected.
    """
    rows, columns = np.flatnonzero(whole.any(axis=1)), np.flatnonzero(whole.any(axis=0))
    if not len(rows) or not part.any():
        return guess
    own = whole[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1].astype(np.float32)
    turned = own[::-1, ::-1]
    both = fftconvolve(part.astype(np.float32), turned, mode="full")
    lit = fftconvolve(inside.astype(np.float32), turned, mode="full")
    covers = both / np.maximum(lit + float(part.sum()) - both, 1.0)
    y = np.arange(covers.shape[0]) - (own.shape[0] - 1) - rows[0]
    x = np.arange(covers.shape[1]) - (own.shape[1] - 1) - columns[0]
    away = np.hypot(x[None] - guess[0], y[:, None] - guess[1]) / max(own.shape)
    best = np.unravel_index(int((covers - _AWAY * away).argmax()), covers.shape)
    return np.array([x[best[1]], y[best[0]]], dtype=np.float64)
