"""The generic detector (6.4.4): boosted differences of rectangles, after Viola and Jones.

A window of the picture is a modillion, a console or a door where the sum of weighted stumps says
so. A stump compares the means of two rectangles in the window, divided by its contrast, with a
threshold. The first few stumps look everywhere, the rest where these leave hope. `boosted.json` has
the stumps; `training/facade/boosted.py` makes them.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

import cv2
import numpy as np
from numpy.typing import NDArray

Float = NDArray[np.float64]
Boxes = NDArray[np.float64]
"""(n, 4): left, top, right, bottom in pixels."""
WEIGHTS = "boosted.json"
_AS_SURE = 0.9
LEAST_CONTRAST = 3.0
"""Grey levels, which stand for the contrast of windows that have less."""


@dataclass(frozen=True)
class Boosted:
    """A detector of one kind.

    width, height: of its window (px). margin: of the window around the element, on each side, of
    the element's own width and height. rectangles: (k, 2, 4) left, top, right, bottom of two
    rectangles of each stump, in the window. thresholds, weights: (k,). first, hope: how many stumps
    look everywhere, and their least sum. least: the least sum of all for an element.
    """

    width: int
    height: int
    margin: float
    rectangles: NDArray[np.int64]
    thresholds: Float
    weights: Float
    first: int
    hope: float
    least: float


@dataclass(frozen=True)
class SearchedSizes:
    """Which elements are looked for; lengths as shares of the picture's longer side.

    low, high: the least and greatest height. step: from one size to the next. same: overlap (of the
    lesser box) from which two are one. alike: elements of a kind on one front differ in height
    from their median, the surer ones counting more, by no more than this factor.
    """

    low: float
    high: float
    step: float = 1.18
    same: float = 0.3
    alike: float = 1.5
    row: int = 0


SIZES = {
    "modillion": SearchedSizes(0.006, 0.025, alike=1.3, row=4),
    "console": SearchedSizes(0.012, 0.04, alike=1.3, row=2),
    "door": SearchedSizes(0.06, 0.3),
}


def find_boosted(pixels: NDArray[np.uint8], kind: str) -> tuple[Boxes, Float]:
    """Boxes (n, 4) and scores (n,) of the elements of a kind of `SIZES`, the surest first.

    pixels: (h, w, 3) uint8 sRGB of a rectified front.
    """
    return found_by(detector(kind), pixels, SIZES[kind])


def found_by(own: Boosted, pixels: NDArray[np.uint8], sizes: SearchedSizes) -> tuple[Boxes, Float]:
    """The same with a detector."""
    grey = np.asarray(cv2.cvtColor(pixels, cv2.COLOR_RGB2GRAY), np.uint8)
    longer = max(grey.shape)
    boxes, scores = [], []
    height = sizes.low * longer
    while height <= sizes.high * longer:
        scale = own.height / ((1.0 + 2.0 * own.margin) * height)
        x, y, sums = _at_scale(own, grey, scale)
        boxes.append(_elements(own, x, y) / scale)
        scores.append(sums)
        height *= sizes.step
    every, sums = np.concatenate(boxes), np.concatenate(scores)
    every, sums = _apart(every, sums, sizes.same)
    kept = np.flatnonzero(_alike(every, sums, sizes.alike))
    kept = kept[_in_rows(every[kept], sizes.row)]
    return every[kept], sums[kept]


def stump_values(own: Boosted, patches: NDArray[np.uint8]) -> Float:
    """(n, k) what each stump sees in (n, height, width) windows."""
    return _differences(own.rectangles, patches)


def _at_scale(
    own: Boosted, grey: NDArray[np.uint8], scale: float
) -> tuple[NDArray[np.int64], NDArray[np.int64], Float]:
    """Left and upper corners of windows in the scaled picture, with their sums."""
    way = cv2.INTER_AREA if scale < 1.0 else cv2.INTER_LINEAR
    small = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=way)
    rows, columns = small.shape[0] - own.height, small.shape[1] - own.width
    nothing = np.zeros(0, np.int64)
    if rows < 1 or columns < 1:
        return nothing, nothing, np.zeros(0)
    both = cv2.integral2(small, sdepth=cv2.CV_64F, sqdepth=cv2.CV_64F)
    sums, squares = (np.asarray(one, np.float64) for one in both[:2])
    everywhere = _Corners(rows, columns)
    contrast = _contrast(own, sums, squares, everywhere)
    score = _scores(own, slice(0, own.first), sums, contrast, everywhere)
    hope = np.flatnonzero(score > own.hope).astype(np.int64)
    rest = slice(own.first, len(own.weights))
    flat = hope // columns * sums.shape[1] + hope % columns
    late = _scores(own, rest, sums, _taken(contrast, hope), _Corners(rows, columns, flat))
    score = np.asarray(_taken(score, hope) + late, np.float64)
    found = hope[score > own.least]
    return found % columns, found // columns, score[score > own.least]


@dataclass(frozen=True)
class _Corners:
    """The upper left corners of windows: those of the first rows and columns, or some, which are
    given as places in the flattened sums.
    """

    rows: int
    columns: int
    some: NDArray[np.int64] | None = None

    def of(self, sums: Float, down: int, right: int) -> Float:
        """(n,) the sums at the corners, moved."""
        if self.some is not None:
            return _taken(sums.ravel(), self.some + (down * sums.shape[1] + right))
        return sums[down : down + self.rows, right : right + self.columns].ravel()


def _taken(values: Float, places: NDArray[np.int64]) -> Float:
    return np.asarray(np.take(values, places), np.float64)


def _contrast(own: Boosted, sums: Float, squares: Float, corners: _Corners) -> Float:
    area = own.width * own.height
    whole = np.array([0, 0, own.width, own.height])
    mean = _sum_in(sums, whole, corners) / area
    variance = _sum_in(squares, whole, corners) / area - mean**2
    return np.asarray(np.sqrt(np.maximum(variance, LEAST_CONTRAST**2)), np.float64)


def _scores(own: Boosted, some: slice, sums: Float, contrast: Float, corners: _Corners) -> Float:
    total = np.zeros(len(contrast))
    stumps = zip(own.rectangles[some], own.thresholds[some], own.weights[some], strict=True)
    for (one, other), threshold, weight in stumps:
        apart = _mean_in(sums, one, corners) - _mean_in(sums, other, corners)
        total += np.where(apart > threshold * contrast, weight, -weight)
    return total


def _mean_in(sums: Float, box: NDArray[np.int64], corners: _Corners) -> Float:
    area = float((box[2] - box[0]) * (box[3] - box[1]))
    return np.asarray(_sum_in(sums, box, corners) / area, np.float64)


def _sum_in(sums: Float, box: NDArray[np.int64], corners: _Corners) -> Float:
    left, top, right, bottom = box.tolist()
    upper = corners.of(sums, top, right) - corners.of(sums, top, left)
    lower = corners.of(sums, bottom, right) - corners.of(sums, bottom, left)
    return np.asarray(lower - upper, np.float64)


def _differences(rectangles: NDArray[np.int64], patches: NDArray[np.uint8]) -> Float:
    sums = np.zeros((len(patches), patches.shape[1] + 1, patches.shape[2] + 1))
    sums[:, 1:, 1:] = patches.astype(np.float64).cumsum(axis=1).cumsum(axis=2)
    left, top, right, bottom = rectangles.transpose(2, 0, 1)
    whole = sums[:, bottom, right] - sums[:, top, right] - sums[:, bottom, left]
    means = (whole + sums[:, top, left]) / ((right - left) * (bottom - top))
    contrast = np.maximum(patches.reshape(len(patches), -1).std(axis=1), LEAST_CONTRAST)
    return np.asarray((means[..., 0] - means[..., 1]) / contrast[:, None], np.float64)


def _elements(own: Boosted, x: NDArray[np.int64], y: NDArray[np.int64]) -> Boxes:
    """The elements in windows: without the margin."""
    across = own.width * own.margin / (1.0 + 2.0 * own.margin)
    down = own.height * own.margin / (1.0 + 2.0 * own.margin)
    right, bottom = x + own.width - across, y + own.height - down
    return np.column_stack([x + across, y + down, right, bottom]).astype(np.float64)


def _apart(boxes: Boxes, scores: Float, same: float) -> tuple[Boxes, Float]:
    """Of boxes that overlap the surest one, which comes first: the mean of those as sure as it."""
    areas = (boxes[:, 2:] - boxes[:, :2]).prod(axis=1)
    waiting = np.argsort(-scores, kind="stable")
    means, kept = [], []
    while len(waiting):
        one = int(waiting[0])
        low = np.maximum(boxes[one, :2], boxes[waiting, :2])
        high = np.minimum(boxes[one, 2:], boxes[waiting, 2:])
        shared = np.clip(high - low, 0.0, None).prod(axis=1)
        is_same = shared > same * np.minimum(areas[one], areas[waiting])
        is_same[0] = True
        sure = waiting[is_same]
        sure = sure[scores[sure] >= _AS_SURE * scores[one]]
        means.append(boxes[sure].mean(axis=0))
        kept.append(one)
        waiting = waiting[~is_same]
    return np.array(means).reshape(-1, 4), scores[kept]


def _alike(boxes: Boxes, scores: Float, most: float) -> NDArray[np.bool_]:
    """Those of about the height that most of them have."""
    if not len(boxes):
        return np.zeros(0, np.bool_)
    heights = boxes[:, 3] - boxes[:, 1]
    order = np.argsort(heights)
    total = np.cumsum(scores[order])
    middle = heights[order][int(np.searchsorted(total, 0.5 * total[-1]))]
    return np.asarray(np.abs(np.log(heights / middle)) <= np.log(most), np.bool_)


def _in_rows(boxes: Boxes, others: int) -> NDArray[np.bool_]:
    """Those with enough others beside them."""
    middles = boxes[:, [1, 3]].mean(axis=1)
    half = 0.5 * (boxes[:, 3] - boxes[:, 1])
    near = np.abs(middles[:, None] - middles) < half[:, None]
    return np.asarray(near.sum(axis=1) > others, np.bool_)


@cache
def detector(kind: str) -> Boosted:
    """The trained detector of a kind."""
    told = json.loads(files("veduta.facade.elements").joinpath(WEIGHTS).read_text("utf-8"))
    return boosted_of(told[kind])


def boosted_of(told: dict[str, Sequence[object] | float | int]) -> Boosted:
    """A detector from its numbers in `boosted.json`."""
    numbers = {key: told[key] for key in ("width", "height", "margin", "first", "hope", "least")}
    return Boosted(
        **numbers,  # type: ignore[arg-type]
        rectangles=np.array(told["rectangles"], np.int64),
        thresholds=np.array(told["thresholds"], np.float64),
        weights=np.array(told["weights"], np.float64),
    )
