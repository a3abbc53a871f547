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
# Part of the picture below its middle that may look like sky at most (of 95 facades: 0.065).
_SKY_IN_WALL = 0.08
# Sum of the skyline's steps in heights of the picture (in 95 facades: at most 3.9).
_RAGGED = 4.2
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
class SeenSkyParameters:
    """What the sky that the learned eyes see counts.

    `weight`: how much their log-odds count beside the log-likelihood of the colours. `least`: the
    chance of sky, and of none, is taken for this at least. `edge`: the share of the upper edge that
    they must see as sky where its colours are not those of one.
    Set by hand: what they were tried on is not kept.
    """

    weight: float = 2.0
    least: float = 0.02
    edge: float = 0.2


_SEEN = SeenSkyParameters()


@dataclass(frozen=True)
class Skyline:
    """First row of building in each column (w,), at analysis resolution.

    `level` is the row of the roof's ridge: chimneys and the like reach above it. `reason` says
    why no sky was found, else it is empty.
    """

    rows: NDArray[np.int64]
    level: int
    reason: str = ""


def find_skyline(evidence: Evidence, seen: Float | None = None) -> Skyline:
    """Part sky from building with one row per column, smooth from column to column.

    seen: (h, w) the chance of sky by the learned eyes, where they are: its log-odds count beside
    the colours, and alone where the upper edge has no colours of a sky.

    The sky's colours are those of the smooth pixels at the upper edge. Each pixel pays for being
    unlike them or for being textured; the chain over columns is solved exactly. (Taking new seeds
    from all that was found to be sky, and solving again, lost more to white walls than it gained
    in clouds: error 1.51 % instead of 1.37 % of ECP's pixels.)
    """
    upper_edge = evidence.valid.argmax(0)
    none = upper_edge, ridge_row(upper_edge, evidence.valid)
    seeds, reason = _sky_seeds(evidence), ""
    if seeds is None:
        reason = "the upper edge is textured"
    elif not _is_skys(evidence, seeds):
        seeds, reason = None, "the upper edge is neither brighter than the facade nor blue"
    if reason and (seen is None or not _shows_sky(evidence, seen)):
        return Skyline(*none, reason)
    rows = np.asarray(
        _core.skyline_chain(_sky_cost(evidence, seeds, seen), _SLOPE, _JUMP), np.int64
    )
    if np.abs(np.diff(rows)).sum() > _RAGGED * evidence.height:
        return Skyline(*none, "what could be sky reaches down between windows")
    return Skyline(rows, ridge_row(rows, evidence.valid))


def _is_skys(evidence: Evidence, seeds: Float) -> bool:
    """Whether colours (n, 3) are brighter than the middle of the picture, or blue."""
    third = np.s_[evidence.height // 3 : 2 * evidence.height // 3]
    body = evidence.lab[third][evidence.valid[third]]
    brighter = not len(body) or np.median(seeds[:, 0]) >= np.median(body[:, 0]) + 10
    return bool(brighter or np.median(seeds[:, 2]) <= 122)


def _shows_sky(evidence: Evidence, seen: Float) -> bool:
    """Whether the eyes see sky along a part of the upper edge of the photo."""
    depth = np.cumsum(evidence.valid, axis=0)
    edge = evidence.valid & (depth > 1) & (depth <= max(3, round(evidence.height * 0.02)))
    return bool(edge.any()) and float((seen[edge] > 0.5).mean()) >= _SEEN.edge


def ridge_row(rows: NDArray[np.int64], valid: NDArray[np.bool_]) -> int:
    """The row of the ridge: most of the skyline is there, chimneys are above.

    `valid` (h, w) is false outside the photo: columns under one of its sides do not count.
    """
    under = _under_upper_edge(valid)
    return int(np.percentile(rows[under] if under.any() else rows, 60))


def _under_upper_edge(valid: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Columns (w,) in which the photo begins at its upper edge, not at a side that leans.

    The outline of a rectified photo is taken for its upper edge where it is more level than
    upright.
    """
    first = valid.argmax(0)
    reach = max(1, min(len(first) - 1, len(first) // 100))
    rise = np.abs(first[reach:] - first[:-reach])
    # A column counts if the outline is level to its left or to its right.
    level = np.concatenate([rise, rise[-1:].repeat(reach)]) <= reach
    level[reach:] |= rise <= reach
    return np.asarray(level & valid.any(0), bool)


def _texture(evidence: Evidence) -> Float:
    return np.hypot(evidence.gx, evidence.gy).astype(np.float32) * 2


def _sky_seeds(evidence: Evidence) -> Float | None:
    """Colours (n, 3) of the plain pixels at the upper edge of the photo, None where it has few."""
    depth = np.cumsum(evidence.valid, axis=0)
    edge = evidence.valid & (depth > 1) & (depth <= max(3, round(evidence.height * 0.02)))
    edge &= _under_upper_edge(evidence.valid)
    plain = edge & (_texture(evidence) < _PLAIN)
    if plain.sum() < max(9.0, 0.25 * edge.sum()):
        return None
    return np.asarray(cv2.GaussianBlur(evidence.lab, (0, 0), 1.0)[plain], np.float32)


def _sky_cost(evidence: Evidence, seeds: Float | None, seen: Float | None) -> Float:
    """Cost (rows + 1, w) of a skyline at each row: the building-likeness of all pixels above.

    Where the picture below its middle has the sky's colours (a grey or a white wall under clouds),
    pixels must be as much like the sky as few of the wall's are.
    """
    rows = round(evidence.height * _SEARCHED)
    likeness = np.zeros((rows, evidence.width), np.float32)
    if seeds is not None:
        unlike = _unlike_sky(evidence, seeds)
        middle = np.s_[evidence.height // 2 : len(unlike)]
        body = unlike[middle][evidence.valid[middle]]
        even = min(_EVEN, float(np.quantile(body, _SKY_IN_WALL))) if len(body) else _EVEN
        likeness = unlike[:rows] - even
    if seen is not None:
        chance = np.clip(seen[:rows], _SEEN.least, 1.0 - _SEEN.least)
        likeness = likeness + _SEEN.weight * np.log((1.0 - chance) / chance)
    # Nothing is known where there is no photo: it goes with the sky.
    likeness[~evidence.valid[:rows]] = -_EVEN
    cost = np.zeros((rows + 1, evidence.width), np.float32)
    np.cumsum(likeness, axis=0, out=cost[1:])
    return cost


def _unlike_sky(evidence: Evidence, seeds: Float) -> Float:
    """Half the squared distance to the nearest of the sky's colours, plus texture (rows, w)."""
    rows = 3 * evidence.height // 4
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
    return np.asarray(np.minimum(distance, 30) / 2 + texture / 3, np.float32)


@dataclass(frozen=True)
class RowHistograms:
    """Running chroma histograms of the building's rows: (2, h + 1, bins) counts."""

    running: NDArray[np.float64]

    def parting(self, half: int, step: int = 1) -> NDArray[np.float64]:
        """Earth mover's distance between the `half` rows above and below every `step`-th of the
        borders of rows, of which there are h + 1.

        Taken on the marginal histograms of a and b, where it is the L1 distance of the cumulative
        histograms (Rubner et al. 1998). Lightness is left out: it parts sun from shadow. On 75
        facades the eaves are the strongest of the floor boundaries on 67 with chroma alone, on 53
        with lightness beside it and on 35 with lightness alone.
        """
        rows = self.running.shape[1]
        at = np.arange(0, rows, step)
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
