"""Silhouettes of an animal with limbs as windows that follow it, in its own lengths."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d

from veduta.fauna.motion.figure import Floats
from veduta.fauna.read.laid_on import Shown, laid_on
from veduta.fauna.read.occupancy import Singles
from veduta.fauna.read.silhouettes import Masks

_MARGIN = 0.09
_ALL = 0.999
"""A cell is looked at where a frame shows so much of it."""


@dataclass(frozen=True, eq=False)
class Windows:
    """shares: (t, h, w) how much of each cell the animal covers, NaN where a frame that cuts it
    shows nothing. middle_px: (t, 2) of the windows, x and y down in the picture. cell_px: the side
    of a cell. faces: 1 where the animal looks to the right of the picture, -1 where the windows are
    mirrored so that it does. pins: (t, 2) px by joint, where somebody has marked it; NaN elsewhere.
    trust: (t,) by joint how much each mark counts, where they differ in that. turned: (t,) -1 for
    the windows of an animal that turns round which are mirrored once more than `faces` says; empty
    where it does not turn.
    """

    shares: Singles
    middle_px: Floats
    cell_px: float
    faces: float
    pins: Mapping[str, Floats] = field(default_factory=dict)
    trust: Mapping[str, Floats] = field(default_factory=dict)
    turned: Floats = field(default_factory=lambda: np.zeros(0))

    def ways(self) -> Floats:
        """(t,) 1 where the animal looks to the right of the picture, -1 to the left."""
        turned = self.turned if len(self.turned) else np.ones(len(self.shares))
        return np.asarray(self.faces * turned)

    def _flips(self) -> Floats:
        """(t, 1, 2) what brings places from the windows into the picture, y down."""
        ways = self.ways()
        return np.stack([ways, -np.ones_like(ways)], axis=1)[:, None]

    def places(self, px_per_length: float) -> Singles:
        """(h * w, 2) the middles of the cells from the window's, x right, y up, in lengths."""
        height, width = self.shares.shape[1:]
        scale = self.cell_px / px_per_length
        x = (np.arange(width) + 0.5 - 0.5 * width) * scale
        y = (0.5 * height - np.arange(height) - 0.5) * scale
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        return np.asarray(grid, dtype=np.float32)

    def flat(self) -> Singles:
        """(t, h * w) the shares in the order of `places`."""
        return np.asarray(self.shares.reshape(len(self.shares), -1))

    def weights(self, most: float = 5.0) -> Singles:
        """(h * w,) how much each place counts: most where it is now the animal, now not. There the
        legs are, of which a body's outline would otherwise have more to say.
        """
        known = np.isfinite(self.shares)
        mean = np.where(known, self.shares, 0.0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)
        changes = 4.0 * mean * (1.0 - mean)
        return np.asarray((1.0 + (most - 1.0) * changes).reshape(-1), dtype=np.float32)

    def in_picture(self, points: Floats, px_per_length: float) -> Floats:
        """(t, n, 2) px, y down, of points in lengths from the windows' middles."""
        flipped = points * self._flips() * px_per_length
        return np.asarray(self.middle_px[:, None] + flipped)

    def from_picture(self, points: Floats, px_per_length: float) -> Floats:
        """(t, n, 2) lengths from the windows' middles of points in the picture."""
        away = (points - self.middle_px[:, None]) / px_per_length
        return np.asarray(away * self._flips())

    def of(self, rows: NDArray[np.int64]) -> Windows:
        """Those of some frames."""
        pins, trust = (
            {name: values[rows] for name, values in own.items()} for own in (self.pins, self.trust)
        )
        shares, middle = self.shares[rows], self.middle_px[rows]
        turned = self.turned[rows] if len(self.turned) else self.turned
        return replace(self, shares=shares, middle_px=middle, pins=pins, trust=trust, turned=turned)

    def marked(self, pins: Mapping[str, Floats], trust: Mapping[str, Floats]) -> Windows:
        """The same with marked joints."""
        return replace(self, pins=pins, trust=trust)

    def turned_where(self, turned: Floats) -> Windows:
        """The same with the windows mirrored in which `turned` (t,) is -1."""
        shares = self.shares.copy()
        back = turned < 0.0
        shares[back] = shares[back][:, :, ::-1]
        return replace(self, shares=shares, turned=turned)

    def mirrored(self) -> Windows:
        """The same animal looking the other way."""
        turned = np.ascontiguousarray(self.shares[:, :, ::-1])
        return replace(self, shares=turned, faces=-self.faces)


def middles_of(masks: Masks, shown: Shown | None = None) -> Floats:
    """(t, 2) the silhouettes' middles, px, smooth through time.

    Where a frame shows but a part of the animal its middle is that of the nearest whole silhouette,
    laid on the part.
    """
    middle = _centroids(masks)
    if shown is not None:
        middle = laid_on(masks, middle, shown)
    return np.asarray(gaussian_filter1d(middle, 2.0, axis=0, mode="nearest"))


def _centroids(masks: Masks) -> Floats:
    rows = masks.sum(axis=2).astype(np.float64)
    columns = masks.sum(axis=1).astype(np.float64)
    area = np.maximum(rows.sum(axis=1), 1.0)
    y = rows @ (np.arange(rows.shape[1]) + 0.5) / area
    x = columns @ (np.arange(columns.shape[1]) + 0.5) / area
    return np.stack([x, y], axis=1)


def windows_of(
    masks: Masks, cells: int, middle_px: Floats | None = None, shown: Shown | None = None
) -> Windows:
    """Windows about the silhouettes, so many cells along the longer side of the largest one.

    shown: of each frame (h, w) what it shows where the border cuts the animal; None: all of it.
    """
    middle = middles_of(masks) if middle_px is None else middle_px
    left, right, up, down = _reach(masks, middle)
    # A figure must feel that it reaches out of the silhouettes: what lies beyond is not looked at.
    margin = _MARGIN * max(left + right, up + down) + 2.0
    half_w, half_h = max(left, right) + margin, max(up, down) + margin
    cell = 2.0 * max(half_w, half_h) / cells
    width, height = (int(np.ceil(2.0 * half / cell)) for half in (half_w, half_h))
    shares = np.empty((len(masks), height, width), dtype=np.float32)
    fine = max(1, round(cell))
    for row, mask in enumerate(masks):
        step = cell / fine
        corner = middle[row] - 0.5 * np.array([width, height]) * cell
        matrix = np.array([[step, 0.0, corner[0] + 0.5 * step - 0.5],
                           [0.0, step, corner[1] + 0.5 * step - 0.5]])  # fmt: skip
        large = cv2.warpAffine(
            mask.astype(np.float32), matrix, (width * fine, height * fine),
            flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
        )  # fmt: skip
        shares[row] = cv2.resize(large, (width, height), interpolation=cv2.INTER_AREA)
        inside = None if shown is None else shown[row]
        if inside is not None:
            seen = cv2.warpAffine(
                inside.astype(np.float32), matrix, (width * fine, height * fine),
                flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
            )  # fmt: skip
            share = cv2.resize(seen, (width, height), interpolation=cv2.INTER_AREA)
            shares[row][np.asarray(share) < _ALL] = np.nan
    return Windows(shares, middle, cell, 1.0)


def _reach(masks: Masks, middle: Floats) -> tuple[float, float, float, float]:
    columns: Masks = np.asarray(masks.any(axis=1))
    rows: Masks = np.asarray(masks.any(axis=2))
    first, last = columns.argmax(axis=1), columns.shape[1] - columns[:, ::-1].argmax(axis=1)
    top, low = rows.argmax(axis=1), rows.shape[1] - rows[:, ::-1].argmax(axis=1)
    return (
        float((middle[:, 0] - first).max()), float((last - middle[:, 0]).max()),
        float((middle[:, 1] - top).max()), float((low - middle[:, 1]).max()),
    )  # fmt: skip


def _apart(first: NDArray[np.float32], second: NDArray[np.float32]) -> float:
    """The mean difference where both are known."""
    off = np.abs(first - second)
    known = np.isfinite(off)
    return float(off[known].mean()) if known.any() else 1.0


def repeat_of(windows: Windows, least: int = 4, *, top: bool = False) -> tuple[float, float] | None:
    """After how many frames silhouettes look the same again, and how well (0..1); None: never.

    From the side the lower half of the windows is compared, where the legs are. Of a symmetrical
    gait this is half a cycle: then the left legs stand where the right ones stood. From above
    (top) it is the whole one.
    """
    from_row = 0 if top else windows.shares.shape[1] // 2
    legs: NDArray[np.float32] = windows.shares[:, from_row:].reshape(len(windows.shares), -1)
    count = len(legs)
    lags = np.arange(1, max(2, int(count * 0.75)))
    apart = np.array([_apart(legs[lag:], legs[:-lag]) for lag in lags])
    usual = float(np.median(apart))
    lows = [
        k for k in range(least - 1, len(lags) - 1)
        if apart[k] <= apart[k - 1] and apart[k] < apart[k + 1] and apart[k] < 0.75 * usual
    ]  # fmt: skip
    if not lows or usual <= 0.0:
        return None
    best = min(apart[k] for k in lows)
    first = next(k for k in lows if apart[k] <= best + 0.55 * (usual - best))
    low, here, high = apart[first - 1], apart[first], apart[first + 1]
    bend = low - 2.0 * here + high
    shift = 0.5 * (low - high) / bend if bend > 0.0 else 0.0
    return float(lags[first] + np.clip(shift, -0.5, 0.5)), float(1.0 - here / usual)
