"""Where the sky ends, and how strongly the image parts at each row (paper section 3.4)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.evidence import Evidence, Float
from veduta.facade.regions import region_colours

# The sky is looked for in the upper part of the image only.
_SEARCHED = 0.5
# Log-likelihood at which a pixel is as likely building as sky.
_EVEN = 4.5
# Gradient (lightness steps per pixel, doubled) below which a pixel is plain.
_PLAIN = 6.0
_CLUSTERS = 4
# Cost per row of a step of the skyline, and of a jump of any height (chimneys).
_SLOPE = 0.5
_JUMP = 12.0
_BINS = 64
# Lightness steps per pixel below which a pixel is of a plain surface.
_SMOOTH = 3.0


@dataclass(frozen=True)
class Skyline:
    """First row of building in each column (w,), at analysis resolution.

    `level` is the row of the roof's ridge: chimneys and the like reach above it. `reason` says
    why no sky was found, else it is empty.
    """

    rows: NDArray[np.int64]
    level: int
    reason: str = ""


def find_skyline(evidence: Evidence) -> Skyline:
    """Part sky from building with one row per column, smooth from column to column.

    The sky's colours are those of the smooth pixels at the upper edge. Each pixel pays for being
    unlike them or for being textured; the chain over columns is solved exactly. (Taking new seeds
    from all that was found to be sky, and solving again, lost more to white walls than it gained
    in clouds: error 1.51 % instead of 1.37 % of ECP's pixels.)
    """
    none = np.zeros(evidence.width, np.int64)
    seeds = _sky_seeds(evidence)
    if seeds is None:
        return Skyline(none, 0, "the upper edge is textured")
    body = evidence.lab[evidence.height // 3 : 2 * evidence.height // 3]
    brighter = np.median(seeds[:, 0]) >= np.median(body[:, :, 0]) + 10
    blue = np.median(seeds[:, 2]) <= 122
    if not (brighter or blue):
        return Skyline(none, 0, "the upper edge is neither brighter than the facade nor blue")
    rows = np.asarray(_core.skyline_chain(_sky_cost(evidence, seeds), _SLOPE, _JUMP), np.int64)
    return Skyline(rows, ridge_row(rows))


def ridge_row(rows: NDArray[np.int64]) -> int:
    """The row of the ridge: most of the skyline is there, chimneys are above."""
    return int(np.percentile(rows, 60))


def _texture(evidence: Evidence) -> Float:
    return np.hypot(evidence.gx, evidence.gy).astype(np.float32) * 2


def _sky_seeds(evidence: Evidence) -> Float | None:
    """Colours (n, 3) of the plain pixels at the upper edge of the photo, None where it has few."""
    depth = np.cumsum(evidence.valid, axis=0)
    edge = evidence.valid & (depth > 1) & (depth <= max(3, round(evidence.height * 0.02)))
    plain = edge & (_texture(evidence) < _PLAIN)
    if plain.sum() < max(9.0, 0.25 * edge.sum()):
        return None
    return np.asarray(cv2.GaussianBlur(evidence.lab, (0, 0), 1.0)[plain], np.float32)


def _sky_cost(evidence: Evidence, seeds: Float) -> Float:
    """Cost (rows + 1, w) of a skyline at each row: the building-likeness of all pixels above."""
    rows = round(evidence.height * _SEARCHED)
    lab = cv2.GaussianBlur(evidence.lab[: rows + 4], (0, 0), 1.0)[:rows]
    stop = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 20, 1.0)
    cv2.setRNGSeed(0)
    _, labels, centres = cv2.kmeans(seeds, _CLUSTERS, np.empty(0), stop, 2, cv2.KMEANS_PP_CENTERS)
    distance = np.full(lab.shape[:2], np.inf, np.float32)
    for k in range(_CLUSTERS):
        members = seeds[labels.ravel() == k]
        if len(members) >= 0.05 * len(seeds):
            spread = members.var(0) + np.array([36, 6, 9], np.float32)
            distance = np.minimum(distance, (((lab - centres[k]) ** 2) / spread).sum(-1))
    texture = np.minimum(_texture(evidence)[:rows], 30)
    unlike = np.minimum(distance, 30) / 2 + texture / 3 - _EVEN
    # Nothing is known where there is no photo: it goes with the sky.
    unlike[~evidence.valid[:rows]] = -_EVEN
    cost = np.zeros((rows + 1, evidence.width), np.float32)
    np.cumsum(unlike, axis=0, out=cost[1:])
    return cost


@dataclass(frozen=True)
class RowHistograms:
    """Running chroma histograms of the building's rows: (2, h + 1, bins) counts."""

    running: NDArray[np.float64]

    def parting(self, half: int) -> NDArray[np.float64]:
        """Earth mover's distance between the `half` rows above and below each row (h + 1,).

        Taken on the marginal histograms of a and b, where it is the L1 distance of the cumulative
        histograms (Rubner et al. 1998). Lightness is left out: it parts sun from shadow. On 75
        facades the eaves are the strongest of the floor boundaries on 67 with chroma alone, on 53
        with lightness beside it and on 35 with lightness alone.
        """
        rows = self.running.shape[1]
        at = np.arange(rows)
        above = self.running[:, at] - self.running[:, np.maximum(at - half, 0)]
        below = self.running[:, np.minimum(at + half, rows - 1)] - self.running[:, at]
        moved = np.abs(_cumulative(above) - _cumulative(below)).sum(-1) * (256 / _BINS)
        return np.asarray(moved.sum(0), np.float64)


def _cumulative(counts: NDArray[np.float64]) -> NDArray[np.float64]:
    totals = np.maximum(counts.sum(-1, keepdims=True), 1)
    return np.asarray(np.cumsum(counts / totals, -1), np.float64)


def row_histograms(evidence: Evidence, skyline: Skyline) -> RowHistograms:
    """Histograms of every row's smooth building pixels, ready for `parting`.

    Each pixel counts with the colour of its region (`regions.py`). Smooth pixels are those of
    surfaces (wall, slate, awning) rather than of frames and railings.
    """
    rows, columns = evidence.height, evidence.width
    building = (np.arange(rows)[:, None] >= skyline.rows[None]) & evidence.valid
    building &= np.abs(evidence.gx) < _SMOOTH
    chroma = region_colours(evidence)[:, :, 1:]
    bins = np.clip(chroma / 256 * _BINS, 0, _BINS - 1).astype(np.int64)
    offset = np.broadcast_to(np.arange(rows)[:, None] * _BINS, (rows, columns))[building]
    running = np.zeros((2, rows + 1, _BINS))
    for channel in range(2):
        flat = np.bincount(offset + bins[:, :, channel][building], minlength=rows * _BINS)
        np.cumsum(flat.reshape(rows, _BINS), axis=0, out=running[channel, 1:])
    return RowHistograms(running)
