"""Which pixels of an image show what stands before the facades, from scan points on (7.1)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.drive.build.backdrop import Drawn
from veduta.drive.build.misfit import Frame


@dataclass(frozen=True)
class FloodParameters:
    """reach_px: half of the window around a scan point (the paper's is 61 x 61). colour: no channel
    differs more from the point's (of 255). slack_px: pixels may fit the background so much better
    than the point. least_px: pixels that fit it better are background. before_m: points are seeds
    where they are so much nearer than the background. thin_px: of points in a square of this side
    the nearest is a seed.
    grown_px: above what the scanner saw, what fits worse than this and touches what was flooded is
    of the same object. closed_px: gaps in it up to this are of it, too. fewest_px: less is noise.
    """

    reach_px: int = 30
    colour: int = 24
    slack_px: float = 1.0
    least_px: float = 1.5
    before_m: float = 0.4
    nearest_m: float = 1.5
    thin_px: int = 2
    grown_px: float = 1.9
    closed_px: int = 9
    fewest_px: int = 60


def flood_foreground(
    one: Frame,
    misfit: NDArray[np.float32],
    drawn: Drawn,
    foreground: NDArray[np.float64],
    sky: NDArray[np.bool_],
    parameters: FloodParameters | None = None,
) -> NDArray[np.float32]:
    """(h, w) float32 depth of the foreground that was found (m), inf where there is none.

    misfit: (h, w) correspondence error (px), drawn: the background in the image. foreground: (n, 3)
    scan points (m, world).
    """
    chosen = parameters or FloodParameters()
    places, depth = _seeds(one, drawn, foreground, chosen)
    if not len(places):
        return np.full(misfit.shape, np.inf, dtype=np.float32)
    flooded = _core.flood_foreground(
        np.ascontiguousarray(one.pixels), np.where(sky, np.nan, misfit).astype(np.float32),
        places, depth, reach=chosen.reach_px, colour=chosen.colour, slack=chosen.slack_px,
        least=chosen.least_px,
    )  # fmt: skip
    return np.minimum(flooded, _grown(flooded, misfit, drawn.inferred & ~sky, chosen))


def _seeds(
    one: Frame, drawn: Drawn, foreground: NDArray[np.float64], chosen: FloodParameters
) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
    """(k, 2) columns and rows of the scan points that an image shows, and (k,) how far they are."""
    pixels, away = one.shot.project(foreground)
    height, width = drawn.depth.shape
    at = np.floor(np.clip(pixels, -1.0, 1e6)).astype(np.int64)
    inside = (away > chosen.nearest_m) & (at >= 0).all(axis=1)
    inside &= (at[:, 0] < width) & (at[:, 1] < height)
    at, depth = at[inside], away[inside].astype(np.float32)
    with np.errstate(invalid="ignore"):
        before = ~(depth > drawn.depth[at[:, 1], at[:, 0]] - chosen.before_m)
    at, depth = at[before], depth[before]
    order = np.argsort(depth, kind="stable")
    cell = (at[order, 1] // chosen.thin_px) * width + at[order, 0] // chosen.thin_px
    _, first = np.unique(cell, return_index=True)
    kept = order[np.sort(first)]
    return np.ascontiguousarray(at[kept]), np.ascontiguousarray(depth[kept])


def _grown(
    flooded: NDArray[np.float32],
    misfit: NDArray[np.float32],
    above: NDArray[np.bool_],
    chosen: FloodParameters,
) -> NDArray[np.float32]:
    """Objects go on above what the scanner saw as far as nothing there fits the background: it has
    no points in the crowns of trees, from which a window could be flooded.
    """
    with np.errstate(invalid="ignore"):
        unfit = (misfit >= chosen.grown_px) & above
    square = np.ones((chosen.closed_px, chosen.closed_px), dtype=np.uint8)
    joined = cv2.morphologyEx(unfit.astype(np.uint8), cv2.MORPH_CLOSE, square)
    count, label, boxes, _ = cv2.connectedComponentsWithStats(joined)
    nearest = np.full(count, np.inf, dtype=np.float32)
    beside = cv2.erode(flooded, np.ones((3, 3), dtype=np.uint8))
    touched = np.isfinite(beside) & (label > 0)
    own = np.asarray(label[touched], dtype=np.int64)
    np.minimum.at(nearest, own, beside[touched])
    nearest[boxes[:, cv2.CC_STAT_AREA] < chosen.fewest_px] = np.inf
    nearest[0] = np.inf
    return np.asarray(nearest[label], dtype=np.float32)
