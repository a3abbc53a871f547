"""A derived front as a picture of labels, on the cells of what was observed."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.style.elevation import Elevation
from veduta.facade.style.observed import KINDS, LABELS

_PLACE = {name: place for place, name in enumerate(LABELS)}
Float = NDArray[np.float64]


@dataclass(frozen=True)
class LabelParameters:
    """What of a derived front one sees from the street.

    roof_m: a lower roof is not seen. balcony_m: balconies that are lower are their slabs alone;
    their railings have boxes of their own. under_m: what carries a slab, consoles and their shadow,
    reaches so far below it, and is of the balcony for the eyes: CMP's balconies are drawn so.
    hides: a railing hides what is behind it where it is before so much of an opening's width.
    foot_m: how far above an opening's foot it may begin.
    """

    roof_m: float = 0.4
    balcony_m: float = 0.5
    under_m: float = 0.3
    hides: float = 0.6
    foot_m: float = 0.5


_OWN = LabelParameters()
_ON_SLAB_M = 0.2
"""A railing whose foot is so near to a slab's top stands on it."""


@dataclass(frozen=True)
class Front:
    """A derived front in metres of a document: boxes (k, 4) of each kind, the height of the eaves,
    outlines (k, 2) of the roof's surfaces.
    """

    width_m: float
    eaves_m: float
    roofs: tuple[Float, ...]
    boxes: dict[str, Float]

    @property
    def top_m(self) -> float:
        """The highest point of the roof, or the eaves."""
        return max([self.eaves_m, *(float(roof[:, 1].max()) for roof in self.roofs)])


def front_of(found: Elevation, width_m: float, scale: float) -> Front:
    """The front of an elevation. width_m: of the lot. scale: its metres in the document's one."""
    boxes = {kind: found.of(kind) / scale for kind in KINDS}
    boxes["balcony"] = _railings(boxes["balcony"])
    boxes["window"] = _above_railings(boxes["window"], boxes["balcony"])
    roofs = tuple(roof / scale for roof in found.roofs)
    return Front(width_m / scale, found.eaves_m / scale, roofs, boxes)


def painted(front: Front, shape: tuple[int, int], cell_m: float) -> NDArray[np.intp]:
    """(rows, columns) the label of each cell, row 0 the lowest."""
    rows, columns = shape
    labels = np.full(shape, _PLACE["sky"], dtype=np.int32)
    if front.top_m - front.eaves_m >= _OWN.roof_m:
        for roof in front.roofs:
            corners = np.rint(roof / cell_m).astype(np.int32)
            cv2.fillPoly(labels, [corners], _PLACE["roof"])
    labels[: round(front.eaves_m / cell_m)] = _PLACE["wall"]
    for kind in ("shop", "door", "window", "balcony"):
        cells = np.rint(front.boxes[kind] / cell_m).astype(np.intp)
        cells = np.clip(cells, 0, [columns, rows, columns, rows])
        for x0, z0, x1, z1 in cells.tolist():
            labels[z0:z1, x0:x1] = _PLACE[kind]
    return labels.astype(np.intp)


def _railings(boxes: Float) -> Float:
    """One box for each balcony: those of railings, each once, with the slab that carries one."""
    is_high = boxes[:, 3] - boxes[:, 1] >= _OWN.balcony_m
    high, slabs = np.unique(boxes[is_high].round(1), axis=0), boxes[~is_high]
    if not len(high) or not len(slabs):
        return high
    beside = np.minimum(high[:, None, 2], slabs[:, 2]) - np.maximum(high[:, None, 0], slabs[:, 0])
    carries = beside > _OWN.hides * (high[:, 2] - high[:, 0])[:, None]
    carries &= np.abs(high[:, None, 1] - slabs[:, 3]) < _ON_SLAB_M
    foot = np.where(carries, slabs[:, 1] - _OWN.under_m, np.inf).min(axis=1)
    high[:, 1] = np.minimum(high[:, 1], foot)
    return high


def _above_railings(windows: Float, railings: Float) -> Float:
    """What railings leave to be seen of windows that begin behind them."""
    if not len(windows) or not len(railings):
        return windows
    beside = np.minimum(windows[:, None, 2], railings[:, 2])
    beside -= np.maximum(windows[:, None, 0], railings[:, 0])
    before = beside > _OWN.hides * (windows[:, 2] - windows[:, 0])[:, None]
    before &= (railings[:, 1] < windows[:, None, 1] + _OWN.foot_m) & (
        railings[:, 3] > windows[:, None, 1]
    )
    seen = np.where(before, railings[:, 3], -np.inf).max(axis=1)
    clipped = windows.copy()
    clipped[:, 1] = np.minimum(np.maximum(windows[:, 1], seen), windows[:, 3])
    return clipped
