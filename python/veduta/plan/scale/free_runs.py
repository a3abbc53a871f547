"""The paper between walls, left and right, above and below a text (FPSE: the distance of walls).

It needs no room with a closed outline: a missed wall elsewhere does not spoil it. Walls are what
remains of the ink when all that is thinner than a wall is taken away, text and furniture with it.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text

_THIN = 0.6  # of a wall's thickness: what is thinner is no wall
_QUANTILES = (0.05, 0.25, 0.5)  # of the thicknesses: the thinnest, partitions, and the usual wall
_MOST = 6  # different runs in a direction
_LEAST_PX = 3
_OFFSETS = (0.0, -1.5, 1.5, -3.0, 3.0)  # heights of the text beside it, where it is measured too
_SAME = 0.01


def wall_masks(
    ink: NDArray[np.float32], walls_px: Sequence[float]
) -> tuple[NDArray[np.uint8], ...]:
    """1 where ink is as thick as the thin walls, and as the usual ones; the thin ones first.

    `ink` (h, w) is 0 to 1, `walls_px` are thicknesses of walls. Hollow walls leave nothing: their
    rooms are measured by their outlines alone.
    """
    usual = np.quantile(walls_px, _QUANTILES) if len(walls_px) else np.array([2.0 * _LEAST_PX])
    sides = sorted({max(_LEAST_PX, round(_THIN * float(thickness))) for thickness in usual})
    solid = (ink > 0.5).astype(np.uint8)
    opened = (
        cv2.morphologyEx(solid, cv2.MORPH_OPEN, np.ones((side, side), np.uint8)) for side in sides
    )
    return tuple(np.asarray(one, dtype=np.uint8) for one in opened)


def free_runs(masks: Sequence[NDArray[np.uint8]], text: Text) -> tuple[list[float], list[float]]:
    """Widths and heights, in pixels, of the paper between walls around a text, each once.

    Both are empty where a side has no wall; the runs through the text itself come first.
    """
    widths, heights = free_spans(masks, text)
    return [high - low for low, high in widths], [high - low for low, high in heights]


def free_spans(
    masks: Sequence[NDArray[np.uint8]], text: Text
) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """As `free_runs`: from where to where they go, in x and in y."""
    box = np.asarray(text.box_px)
    x, y = box.mean(axis=0)
    step = float(np.linalg.norm(box[3] - box[0]))
    places = [(walls, offset * step) for offset in _OFFSETS for walls in masks]
    across = [_run(walls, y + offset, x) for walls, offset in places]
    down = [_run(walls.T, x + offset, y) for walls, offset in places]
    return _distinct(across), _distinct(down)


def _run(walls: NDArray[np.uint8], row: float, column: float) -> tuple[float, float] | None:
    """Ends of the free run of a row around a column; None if the sheet ends before a wall."""
    if not (0 <= row < walls.shape[0] and 0 <= column < walls.shape[1]):
        return None
    line = walls[int(row)]
    if line[int(column)]:
        return None
    before = np.flatnonzero(line[: int(column)])
    after = np.flatnonzero(line[int(column) :])
    if not len(before) or not len(after):
        return None
    return float(before[-1] + 1), float(int(column) + after[0])


def _distinct(runs: list[tuple[float, float] | None]) -> list[tuple[float, float]]:
    """Runs of different lengths."""
    kept: list[tuple[float, float]] = []
    for run in runs:
        if run is None or run[1] <= run[0]:
            continue
        length = run[1] - run[0]
        others = [high - low for low, high in kept]
        if all(abs(length - other) > max(1.0, _SAME * other) for other in others):
            kept.append(run)
    return kept[:_MOST]
