"""The medial axis of a silhouette without spurs, and how wide the body is along it."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, map_coordinates
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra

from veduta.fauna.motion.angles import Floats, equal_steps

_SMALLEST_PX, _LARGEST_PX = 250, 900
"""A silhouette's box is brought between these sides before its axis is sought."""
_ROUNDS = 3
"""Of moving the axis to the middle between both sides."""
_NEIGHBOURS = ((0, 1), (1, -1), (1, 0), (1, 1))


@dataclass(frozen=True, eq=False)
class Axis:
    """points: (n, 2) px, x right and y down, from one end to the other, at equal steps.
    half_width: (n,) px.
    """

    points: Floats
    half_width: Floats


def main_axes(points: NDArray[np.floating]) -> tuple[Floats, Floats]:
    """The middle (2,) of points (n, 2), and the axes along which they spread, the longest first."""
    middle = np.asarray(points.mean(axis=0), dtype=np.float64)
    _, _, axes = np.linalg.svd(np.cov((points - middle).T))
    return middle, np.asarray(axes, dtype=np.float64)


def medial_axis(mask: NDArray[np.bool_], count: int) -> Axis | None:
    """The axis of a silhouette (h, w) with `count` points; None where it has none.

    The skeleton's longest way is taken, which leaves its spurs aside; it goes on to the outline at
    both ends, and each point then moves to the middle between both sides.
    """
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    if len(rows) == 0:
        return None
    corner = np.array([columns[0], rows[0]], dtype=np.float64) - 4.0
    cropped = np.pad(mask[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1], 4)
    factor = float(np.clip(_LARGEST_PX / max(cropped.shape), 0.0, 1.0))
    factor = max(factor, min(4.0, _SMALLEST_PX / max(cropped.shape)))
    resized = cv2.resize(
        cv2.GaussianBlur(cropped.astype(np.float32), (0, 0), 0.8), None, fx=factor, fy=factor,
        interpolation=cv2.INTER_AREA if factor < 1.0 else cv2.INTER_CUBIC,
    )  # fmt: skip
    soft = np.asarray(resized, dtype=np.float32)
    way = _longest_way(soft > 0.5)
    if way is None or len(way) < 8:
        return None
    line = _to_the_ends(_smoothed(way, soft), soft)
    points = equal_steps(line[None], count)[0]
    half = np.zeros(count)
    for _ in range(_ROUNDS):
        points, half = _centred(points, soft)
        points = equal_steps(points[None], count)[0]
    points = (points + 0.5) / factor + corner
    return Axis(points, half / factor)


def _longest_way(mask: NDArray[np.bool_]) -> Floats | None:
    """(n, 2) x, y of the skeleton's pixels along the longest of the shortest ways in it."""
    thin = cv2.ximgproc.thinning(mask.astype(np.uint8) * 255) > 0
    y, x = np.nonzero(thin)
    if len(x) < 8:
        return None
    number = np.full(thin.shape, -1, dtype=np.int64)
    number[y, x] = np.arange(len(x))
    padded = np.pad(number, 1, constant_values=-1)
    first, second, length = [], [], []
    for down, right in _NEIGHBOURS:
        other = padded[y + 1 + down, x + 1 + right]
        joined = other >= 0
        first.append(np.flatnonzero(joined))
        second.append(other[joined])
        length.append(np.full(int(joined.sum()), float(np.hypot(down, right))))
    shape = (len(x), len(x))
    pairs = coo_array(
        (np.concatenate(length), (np.concatenate(first), np.concatenate(second))), shape=shape
    )
    graph = csr_array(pairs)
    start = int(_farthest(graph, 0)[0])
    end, before = _farthest(graph, start)
    way = [end]
    while way[-1] != start:
        way.append(int(before[way[-1]]))
    return np.stack([x[way], y[way]], axis=1).astype(np.float64)


def _farthest(graph: csr_array, start: int) -> tuple[int, NDArray[np.int32]]:
    """The pixel that is farthest from one, and the way back from it."""
    found = dijkstra(graph, directed=False, indices=np.array([start]), return_predecessors=True)
    away = np.where(np.isfinite(found[0][0]), found[0][0], -1.0)
    return int(away.argmax()), found[1][0]


def _smoothed(way: Floats, soft: NDArray[np.float32]) -> Floats:
    """Without the steps of pixels, and without the ends that turn into a corner of the outline."""
    deep = cv2.distanceTransform((soft > 0.5).astype(np.uint8), cv2.DIST_L2, 5)
    x, y = way[:, 0].astype(int), way[:, 1].astype(int)
    usual = float(np.median(deep[y, x]))
    cut = min(round(0.8 * usual), len(way) // 5)
    inner = way[cut : len(way) - cut]
    return np.asarray(gaussian_filter1d(inner, max(1.0, 0.6 * usual), axis=0, mode="nearest"))


def _to_the_ends(line: Floats, soft: NDArray[np.float32]) -> Floats:
    """The line, gone on from both ends until it leaves the silhouette.

    It goes straight on, or aside to where the body goes on for longer: a bent tip of the nose.
    """
    reach = max(soft.shape)
    turns = np.radians(np.arange(-60.0, 61.0, 5.0))
    pieces = [line]
    span = max(2, len(line) // 16)
    for end, inside in ((0, span), (-1, -1 - span)):
        ahead = line[end] - line[inside]
        course = float(np.arctan2(ahead[1], ahead[0]))
        headings = np.stack([np.cos(course + turns), np.sin(course + turns)], axis=1)
        steps = np.arange(1, reach)[None, :, None] * headings[:, None] + line[end]
        inside_it = _at(soft, steps.reshape(-1, 2)).reshape(len(turns), -1) >= 0.5
        runs = np.where(inside_it.all(axis=1), reach - 1, inside_it.argmin(axis=1))
        best = int((runs * (0.4 + 0.6 * np.cos(turns))).argmax())
        more = steps[best, : int(runs[best])]
        pieces = [more[::-1], *pieces] if end == 0 else [*pieces, more]
    return np.concatenate(pieces)


def _centred(points: Floats, soft: NDArray[np.float32]) -> tuple[Floats, Floats]:
    """Each point in the middle of the body across the line there, and half the body's width."""
    ahead = np.gradient(gaussian_filter1d(points, 1.5, axis=0, mode="nearest"), axis=0)
    ahead /= np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    normal = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    widest = 2.5 * float(np.sqrt(float((soft > 0.5).sum()) / len(points)) + 4.0)
    widest = min(widest, 0.25 * float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum()))
    offsets = np.arange(0.0, max(widest, 4.0), 0.25)
    sides = []
    for side in (1.0, -1.0):
        probes = points[:, None] + side * offsets[None, :, None] * normal[:, None]
        inside = _at(soft, probes.reshape(-1, 2)).reshape(len(points), -1)
        sides.append(_outline(inside, offsets))
    shift = 0.5 * (sides[0] - sides[1])
    half = 0.5 * (sides[0] + sides[1])
    # The ends have no sides: they stay where the line leaves the silhouette.
    shift[:2], shift[-2:] = 0.0, 0.0
    return points + gaussian_filter1d(shift, 1.0)[:, None] * normal, half


def _outline(inside: Floats, offsets: Floats) -> Floats:
    """(n,) how far it is to where the body ends, between two of the offsets (k,) at which `inside`
    (n, k) is known; the last one where it does not end.
    """
    out = inside < 0.5
    row = np.arange(len(inside))
    after = out.argmax(axis=1)
    before = np.maximum(after - 1, 0)
    drop = np.maximum(inside[row, before] - inside[row, after], 1e-9)
    share = np.clip((inside[row, before] - 0.5) / drop, 0.0, 1.0)
    there = offsets[before] + share * (offsets[after] - offsets[before])
    return np.asarray(np.where(out.any(axis=1), there, offsets[-1]), dtype=np.float64)


def _at(soft: NDArray[np.float32], points: Floats) -> Floats:
    """The soft silhouette at points (n, 2) x, y; 0 outside."""
    return np.asarray(
        map_coordinates(soft, [points[:, 1], points[:, 0]], order=1, cval=0.0), dtype=np.float64
    )
