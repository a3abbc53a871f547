"""By which offsets a front repeats itself: from window to window."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Boxes = NDArray[np.float64]


_LEAST_PX = 1.0
"""A narrower box, which a person may have written, is no narrower than a pixel."""


@dataclass(frozen=True)
class OwnRepeats:
    """Offsets (k, 2) in pixels, x y, the most frequent first, and the height of a storey (px)."""

    offsets: NDArray[np.int64]
    storey_px: float


@dataclass(frozen=True)
class OwnRepeatParameters:
    """Which windows are alike, and how many offsets are kept.

    alike: by how much (share) the widths of two windows may differ. same: offsets closer than this
    share of a window are one. most: how many are kept.
    """

    alike: float = 0.35
    same: float = 0.08
    most: int = 28


def own_repeats(windows: Boxes, parameters: OwnRepeatParameters | None = None) -> OwnRepeats:
    """Offsets between windows (n, 4) that are about as wide: by their heads, and by their feet.

    Left, top, right, bottom in pixels. No offsets where there are fewer than two windows.
    """
    p = parameters or OwnRepeatParameters()
    if len(windows) < 2:
        return OwnRepeats(np.zeros((0, 2), np.int64), 0.0)
    width = np.maximum(windows[:, 2] - windows[:, 0], _LEAST_PX)
    middle = 0.5 * (windows[:, 0] + windows[:, 2])
    typical = float(np.median(width))
    one, other = np.nonzero(~np.eye(len(windows), dtype=np.bool_))
    alike = np.abs(np.log(width[one] / width[other])) < p.alike
    one, other = one[alike], other[alike]
    across = middle[other] - middle[one]
    by_head = np.stack([across, windows[other, 1] - windows[one, 1]], axis=1)
    by_foot = np.stack([across, windows[other, 3] - windows[one, 3]], axis=1)
    kept = _frequent(
        np.concatenate([by_head, by_foot]), max(2.0, p.same * typical), typical, p.most
    )
    return OwnRepeats(kept, _storey(windows, typical))


def _frequent(offsets: Boxes, near_px: float, least_px: float, most: int) -> NDArray[np.int64]:
    """The offsets that most others lie near to, each once."""
    offsets = offsets[np.abs(offsets).max(axis=1) > 0.5 * least_px]
    if not len(offsets):
        return np.zeros((0, 2), np.int64)
    keys = np.rint(offsets / near_px).astype(np.int64)
    _, inverse, counts = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    means = np.stack(
        [np.bincount(inverse.ravel(), offsets[:, axis]) / counts for axis in (0, 1)], axis=1
    )
    # Near offsets are more alike in light: they come before far ones that are as frequent.
    far = np.hypot(*means.T)
    order = np.lexsort((far, -counts))[:most]
    return np.rint(means[order]).astype(np.int64).reshape(-1, 2)


def _storey(windows: Boxes, typical: float) -> float:
    """The median step from one row of windows to the next; from their height where there is one."""
    heads = np.sort(windows[:, 1])
    steps = np.diff(heads)
    steps = steps[steps > 0.6 * typical]
    own = 1.6 * float(np.median(windows[:, 3] - windows[:, 1]))
    return float(np.median(steps)) if len(steps) else own
