"""Cornices as groups of elongated segments (6.4.3), and bands of what the learned eyes call one.

Horizontal segments of a fine segmentation that are much longer than high are joined where they are
of one height; what crosses windows is left out; a group that spans half of the front is a cornice.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.elements.working_size import at_working_size, segments_of
from veduta.facade.eyes import Seen

Boxes = NDArray[np.float64]
"""(n, 4): left, top, right, bottom in pixels."""


@dataclass(frozen=True)
class CorniceParameters:
    """The thesis's cornice detector; lengths as shares of the picture's longer side.

    long_px: the longer side that pictures are brought to. sigma_px, segment_k, least_px: of the
    segmentation (smoothing, scale, smallest area). elongated: the least width by height of a
    segment; the thesis says 20, which at this resolution leaves next to none, so that single
    segments need half of it. thick: the highest that a segment and a group
    may be. near: segments that are no
    further below each other are of one group. spans: share of the front's width that a group
    covers at least (the thesis's half). crossed: share of a band's length that windows may cover.
    """

    long_px: int = 900
    sigma_px: float = 0.5
    segment_k: float = 80.0
    least_px: int = 30
    elongated: float = 10.0
    thick: float = 0.03
    near: float = 0.003
    spans: float = 0.5
    crossed: float = 0.25


@dataclass(frozen=True)
class BandParameters:
    """Bands of the learned pixels.

    chance: of a pixel, at least. elongated: the least width by height. least_wide: of the picture's
    width.
    """

    chance: float = 0.35
    elongated: float = 2.5
    least_wide: float = 0.03


def find_cornices(
    pixels: NDArray[np.uint8], windows: Boxes, parameters: CorniceParameters | None = None
) -> Boxes:
    """Boxes (n, 4) of the cornices in (h, w, 3) uint8 sRGB pixels of a rectified front.

    windows: (k, 4) in the same pixels.
    """
    own = parameters or CorniceParameters()
    small = at_working_size(pixels, own.long_px)
    size = small.size
    labels = segments_of(small.pixels, own.sigma_px, own.segment_k, own.least_px)
    segments = _extents(labels)
    wide, high = (segments[:, 2:] - segments[:, :2]).T
    is_long = (wide >= own.elongated * high) & (high <= own.thick * own.long_px)
    to_small = np.array([size[0] / pixels.shape[1], size[1] / pixels.shape[0]] * 2)
    bands = _grouped(segments[is_long], size[0], own)
    return np.asarray(_clear_of(bands, windows * to_small, own.crossed) / to_small, np.float64)


def _extents(labels: NDArray[np.intp]) -> Boxes:
    """(n, 4) the box of each segment."""
    count = int(labels.max()) + 1
    flat = labels.ravel()
    rows, columns = (place.ravel() for place in np.indices(labels.shape))
    boxes = np.empty((count, 4))
    for place, values in enumerate((columns, rows)):
        low, high = np.full(count, np.iinfo(np.int64).max), np.full(count, -1)
        np.minimum.at(low, flat, values)
        np.maximum.at(high, flat, values)
        boxes[:, place], boxes[:, 2 + place] = low, high + 1
    return boxes


def _grouped(segments: Boxes, width: int, own: CorniceParameters) -> Boxes:
    """One box for each group of segments of one height that spans the front."""
    if not len(segments):
        return np.zeros((0, 4))
    ordered = segments[np.argsort(segments[:, 1], kind="stable")]
    near, thick = own.near * own.long_px, own.thick * own.long_px
    cuts, top, bottom = [], ordered[0, 1], ordered[0, 3]
    for place, (_, upper, _, lower) in enumerate(ordered.tolist()):
        if upper > bottom + near or lower > top + thick:
            cuts.append(place)
            top, bottom = upper, lower
        bottom = max(bottom, lower)
    found = []
    for group in np.split(ordered, cuts):
        covered = np.zeros(width, np.bool_)
        for left, right in group[:, [0, 2]].astype(int).tolist():
            covered[left:right] = True
        if covered.mean() >= own.spans:
            found.append([*group[:, :2].min(axis=0), *group[:, 2:].max(axis=0)])
    return np.array(found).reshape(-1, 4)


def _clear_of(bands: Boxes, windows: Boxes, crossed: float) -> Boxes:
    """The bands of which windows cover little."""
    if not len(bands) or not len(windows):
        return bands
    middles = bands[:, [1, 3]].mean(axis=1)[:, None]
    inside = (windows[:, 1] < middles) & (middles < windows[:, 3])
    shared = np.minimum(bands[:, None, 2], windows[:, 2])
    shared -= np.maximum(bands[:, None, 0], windows[:, 0])
    covered = np.where(inside, np.clip(shared, 0.0, None), 0.0).sum(axis=1)
    return np.asarray(bands[covered <= crossed * (bands[:, 2] - bands[:, 0])], np.float64)


def seen_bands(seen: Seen, kind: str, parameters: BandParameters | None = None) -> Boxes:
    """Boxes (n, 4) of what the learned eyes call by this class (cornice, sill, ornament)."""
    own = parameters or BandParameters()
    chance = seen.chance(kind)
    height, width = chance.shape
    _, _, stats, _ = cv2.connectedComponentsWithStats((chance > own.chance).astype(np.uint8))
    x, y, w, h, _ = stats[1:].astype(np.float64).T
    fits = (w >= own.elongated * h) & (w >= own.least_wide * width)
    boxes = np.column_stack([x, y, x + w, y + h])[fits]
    across, down = seen.width_px / width, seen.height_px / height
    return np.asarray(boxes * (across, down, across, down), np.float64)
