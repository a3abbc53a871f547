"""The picture: crops of the photos, levelled, and squares of colour for what none shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.surfaces.texturing.charts import SWATCH_PX, Charts
from veduta.surfaces.texturing.drawing import draw_triangles
from veduta.surfaces.texturing.options import SurfaceView

_COARSE = 2
"""Corrections are even: they are drawn at this share of the atlas's size."""
_BAND_PX = 512
_GROWN_PX = 5
_ROUNDS = 2


def compose(
    charts: Charts,
    views: Sequence[SurfaceView],
    progress: Callable[[float], None] = lambda fraction: None,
) -> tuple[NDArray[np.uint8], NDArray[np.bool_]]:
    """(h, w, 3) the charts as the photos show them, and (h, w) where that is."""
    pixels = np.zeros((charts.height_px, charts.width_px, 3), dtype=np.uint8)
    seen = np.zeros(pixels.shape[:2], dtype=np.bool_)
    order = np.argsort(charts.views, kind="stable")
    taken = charts.views[order]
    for number in np.unique(taken):
        progress(float(number) / len(views))
        photo = views[number].read()
        if charts.scale != 1.0:
            size = (round(photo.shape[1] * charts.scale), round(photo.shape[0] * charts.scale))
            how = cv2.INTER_AREA if charts.scale < 1.0 else cv2.INTER_CUBIC
            photo = np.asarray(cv2.resize(photo, size, interpolation=how), dtype=np.uint8)
        for chart in order[taken == number]:
            _copy(photo, charts, int(chart), pixels, seen)
    return pixels, seen


def _copy(
    photo: NDArray[np.uint8],
    charts: Charts,
    chart: int,
    pixels: NDArray[np.uint8],
    seen: NDArray[np.bool_],
) -> None:
    """A box of the photo into the atlas; beyond the photo's border, its last pixels go on."""
    (left, top), (wide, high) = charts.lows[chart], charts.sizes[chart]
    x, y = charts.corners[chart]
    rows = np.clip(np.arange(top, top + high), 0, photo.shape[0] - 1)
    columns = np.clip(np.arange(left, left + wide), 0, photo.shape[1] - 1)
    pixels[y : y + high, x : x + wide] = photo[rows[:, None], columns]
    seen[y : y + high, x : x + wide] = True


def level(
    pixels: NDArray[np.uint8], places: NDArray[np.float64], corrections: NDArray[np.float64]
) -> None:
    """Add (t, 3, 3) corrections of triangles' corners at (t, 3, 2) px to the atlas, in place."""
    height, width = pixels.shape[:2]
    shape = (-(-height // _COARSE), -(-width // _COARSE))
    drawn, covered = draw_triangles(places / _COARSE, corrections, shape)
    for _ in range(_ROUNDS):
        _grow(drawn, covered)
    for top in range(0, height, _BAND_PX):
        rows = min(_BAND_PX, height - top)
        first = max(0, top // _COARSE - 1)
        last = min(shape[0], (top + rows) // _COARSE + 2)
        wide = cv2.resize(
            drawn[first:last],
            (shape[1] * _COARSE, (last - first) * _COARSE),
            interpolation=cv2.INTER_LINEAR,
        )
        own = wide[top - first * _COARSE : top - first * _COARSE + rows, :width]
        added = pixels[top : top + rows].astype(np.float32) + own
        pixels[top : top + rows] = np.clip(np.rint(added), 0.0, 255.0).astype(np.uint8)


def _grow(drawn: NDArray[np.float32], covered: NDArray[np.bool_]) -> None:
    """What was drawn goes on for some pixels around, in place."""
    size = (_GROWN_PX, _GROWN_PX)
    weight = cv2.boxFilter(covered.astype(np.float32), -1, size, normalize=False)
    summed = cv2.boxFilter(drawn * covered[..., None], -1, size, normalize=False)
    new = ~covered & (weight > 0.5)
    drawn[new] = summed[new] / weight[new][:, None]
    covered |= new


def lay_swatches(
    pixels: NDArray[np.uint8], corners: NDArray[np.int64], squares: NDArray[np.float64]
) -> None:
    """Lay (s, 3, 3, 3) squares of colours into the atlas at (s, 2)."""
    steps = np.arange(SWATCH_PX)
    rows = corners[:, 1, None, None] + steps[None, :, None]
    columns = corners[:, 0, None, None] + steps[None, None, :]
    pixels[rows, columns] = np.clip(np.rint(squares), 0.0, 255.0).astype(np.uint8)
