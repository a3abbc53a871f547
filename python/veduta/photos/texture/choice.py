"""Which photo shows each cell of a face: finely, not aside, undisturbed, and with few seams."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.photos.choosing import FEWEST, OUTVOTED_COST, cheapest, median_of, outvoted
from veduta.photos.texture.cells import SAMPLES, Sights, by_cell

SAMPLE_DIFFERS = 0.12
"""Difference of a sample's channels (sRGB, 0..1) from all that the median has around it at which a
view shows something else."""
MARGIN = 0.06
"""Closer to the picture's border (share of its smaller side) lenses are blurred and known less."""
BURNT = 250
_BLIND = 1.0
_BURNT_COST, _DIFFERENCE_COST, _MARGIN_COST = 1.0, 2.0, 0.3


@dataclass(frozen=True)
class Choice:
    """label: (rows, columns) which of the face's views; -1 where none sees the cell.

    order: (k, rows, columns) the views from best to worst by cell alone, for what the chosen one
    does not show. usable: (k, rows, columns) which views show the cell undisturbed. clear: (k, rows
    S, columns S) the same of samples: a leaf or a bumper is smaller than a cell.
    """

    label: NDArray[np.int64]
    order: NDArray[np.int64]
    usable: NDArray[np.bool_]
    clear: NDArray[np.bool_]


def signal(sights: Sights, gains: NDArray[np.float64]) -> NDArray[np.float32]:
    """(k, rows S, columns S, 3) levelled sRGB, 0..1 and above; NaN where unseen."""
    light = linear_of_srgb(np.arange(256) / 255.0)
    found = np.empty(sights.colour.shape, dtype=np.float32)
    for row, view in enumerate(sights.views.tolist()):
        for channel in range(3):
            table = srgb_of_linear(light * gains[view, channel]).astype(np.float32)
            found[row, ..., channel] = table[sights.colour[row, ..., channel]]
    found[~sights.seen] = np.nan
    return found


def undisturbed(
    sights: Sights, levelled: NDArray[np.float32]
) -> tuple[NDArray[np.bool_], NDArray[np.float32]]:
    """(k, rows, columns) whether each view shows what the others do, and how far it is off.

    Where fewer than `FEWEST` views show a cell nothing can be said: all are believed, 0 off.
    """
    seen = sights.seen
    middle = median_of(levelled)
    off = ((levelled - middle) ** 2).mean(axis=-1)
    off = np.where(seen, off, 0.0).astype(np.float32)
    count = by_cell(seen.astype(np.float32))
    with np.errstate(divide="ignore", invalid="ignore"):
        distance = np.sqrt(np.where(count > 0, by_cell(off) / count, np.nan))
    known = np.where((count > 0) & ((count > 0).sum(axis=0) >= FEWEST), distance, 0.0)
    return np.asarray((count > 0) & ~outvoted(distance)), known.astype(np.float32)


def choose(
    sights: Sights,
    levelled: NDArray[np.float32],
    believed: NDArray[np.bool_],
    distance: NDArray[np.float32],
    enough_px_m2: float,
) -> Choice:
    """The choice for a face. enough_px_m2: finer than the texture itself is no gain."""
    share = sights.share()
    cost = costs_of(sights, believed, distance, enough_px_m2)
    label = cheapest(cost, share > 0, cell_colours(levelled, share))
    order = np.argsort(cost, axis=0, kind="stable")
    return Choice(label, order, believed, clear_samples(sights, levelled))


def clear_samples(sights: Sights, levelled: NDArray[np.float32]) -> NDArray[np.bool_]:
    """(k, rows S, columns S) where each view shows about what the median of all does.

    Edges may lie a sample off: a view is compared with all that the median has around. Where fewer
    than `FEWEST` views see a sample, or none is near the median, all are believed.
    """
    middle = median_of(levelled)
    around = np.ones((3, 3), dtype=np.uint8)
    low = cv2.erode(np.nan_to_num(middle, nan=np.inf), around)
    high = cv2.dilate(np.nan_to_num(middle, nan=-np.inf), around)
    many = sights.seen.sum(axis=0) >= FEWEST
    other = np.zeros(sights.seen.shape, dtype=np.bool_)
    for k, own in enumerate(levelled):
        with np.errstate(invalid="ignore"):
            off = np.maximum(low - own, own - high).max(axis=-1)
            differs = (many & sights.seen[k] & (off > SAMPLE_DIFFERS)).astype(np.uint8)
        # A sample alone is noise; what lies beside those that differ is a part of the same thing.
        differs = cv2.morphologyEx(differs, cv2.MORPH_OPEN, np.ones((2, 2), np.uint8))
        other[k] = cv2.dilate(differs, around) > 0
    shown = (sights.seen & ~other).any(axis=0)
    return ~(other & shown)


def costs_of(
    sights: Sights,
    believed: NDArray[np.bool_],
    distance: NDArray[np.float32],
    enough_px_m2: float,
) -> NDArray[np.float32]:
    """(k, rows, columns) what each view costs at each cell; small is good."""
    share = sights.share()
    fine = np.minimum(sights.density / enough_px_m2, 1.0)
    cost = 1.0 - fine + _DIFFERENCE_COST * distance + _BLIND * (1.0 - share)
    cost += _MARGIN_COST * np.clip(1.0 - sights.margin / MARGIN, 0.0, 1.0)
    burnt = ((sights.colour >= BURNT).any(axis=-1) & sights.seen).astype(np.float32)
    cost += _BURNT_COST * by_cell(burnt)
    cost += np.where(believed, 0.0, OUTVOTED_COST)
    return np.where(share > 0, cost, np.inf).astype(np.float32)


def cell_colours(levelled: NDArray[np.float32], share: NDArray[np.float32]) -> NDArray[np.float32]:
    """(k, rows, columns, 3) mean of what is seen of each cell; NaN where nothing is."""
    filled = np.nan_to_num(levelled, nan=0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(
            share[..., None] > 1.0 / (SAMPLES * SAMPLES) / 2,
            by_cell(filled) / share[..., None],
            np.nan,
        ).astype(np.float32)
