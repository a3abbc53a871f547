"""Windows by texture and contours (6.4.1): blobs of rows and columns, cut by the grid's energy.

Texture error (6.1) and contours are projected onto rows and columns (6.2), multiplied, averaged
over the segments of a fine segmentation, and projected again (6.3). Of several thresholds that one
is taken whose boxes have the highest energy (6.4), and they are aligned to each other. Where the
best energy is low, this is no grid of windows, and nothing is found.

The projections of a whole front are dominated by its height; as in the thesis they give one grid.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.elements.grid_energy import EnergyParameters, aligned, grid_energy
from veduta.facade.elements.texture_error import TextureParameters, blobs, texture_error
from veduta.facade.elements.working_size import at_working_size, segments_of

Boxes = NDArray[np.float64]
"""(n, 4): left, top, right, bottom in pixels."""


@dataclass(frozen=True)
class WindowParameters:
    """The thesis's window detector.

    long_px: the longer side that pictures are brought to: windows of a front of seven storeys are
    about 40 px high then. contour_low, contour_high: Canny's thresholds in grey levels.
    sigma_px, segment_k, least_px: of the segmentation (Felzenszwalb 2004): smoothing, scale and
    smallest area; fine, so that a pane is several segments. thresholds: levels of the blobs that
    are tried. smooth_px: of the profiles. least_side, most_side: of a window, of the picture's
    longer side. least_energy: per window, below which the grid is none: chosen on CMP's training
    fold, where the pictures below it have fewer than one window in five right.
    """

    long_px: int = 600
    contour_low: float = 40.0
    contour_high: float = 120.0
    sigma_px: float = 0.5
    segment_k: float = 200.0
    least_px: int = 40
    thresholds: tuple[float, ...] = tuple(np.linspace(0.08, 0.8, 37).round(3).tolist())
    smooth_px: float = 2.0
    least_side: float = 0.03
    most_side: float = 0.3
    least_energy: float = 2.1
    texture: TextureParameters = field(default_factory=TextureParameters)
    energy: EnergyParameters = field(default_factory=EnergyParameters)


@dataclass(frozen=True)
class WindowsFound:
    """boxes: (n, 4) windows in pixels of the picture. energy: the best one (6.4), per window.

    threshold: the level of the blobs that has it. is_grid: whether the energy speaks for a grid;
    where it does not, `boxes` is what the best threshold gave all the same.
    """

    boxes: Boxes
    energy: float
    threshold: float
    is_grid: bool


def find_windows(
    pixels: NDArray[np.uint8], parameters: WindowParameters | None = None
) -> WindowsFound:
    """The windows of (h, w, 3) uint8 sRGB pixels of a rectified front."""
    own = parameters or WindowParameters()
    small = at_working_size(pixels, own.long_px)
    level = _final_blobs(small.pixels, own)
    best: tuple[float, float, Boxes] = (-np.inf, 0.0, np.zeros((0, 4)))
    for threshold in own.thresholds:
        boxes = _boxes(level, threshold, own)
        if len(boxes):
            energy = grid_energy(boxes, own.energy)
            best = max(best, (energy, threshold, boxes), key=lambda one: one[0])
    energy, threshold, boxes = best
    if not len(boxes):
        return WindowsFound(boxes, 0.0, 0.0, False)
    boxes = aligned(boxes, own.energy)
    own_energy = grid_energy(boxes, own.energy) / len(boxes)
    boxes = small.in_picture(boxes)
    return WindowsFound(boxes, own_energy, threshold, own_energy >= own.least_energy)


def _final_blobs(small: NDArray[np.uint8], own: WindowParameters) -> Boxes:
    """B_f of (6.3), 0 to 1."""
    grey = np.asarray(cv2.cvtColor(small, cv2.COLOR_RGB2GRAY), np.uint8)
    contours = cv2.Canny(grey, own.contour_low, own.contour_high).astype(np.float64) / 255.0
    by_texture = blobs(_smooth(texture_error(grey, own.texture), own))
    by_contours = blobs(_smooth(contours, own))
    both = by_texture * by_contours
    segments = segments_of(small, own.sigma_px, own.segment_k, own.least_px)
    sums = np.bincount(segments.ravel(), weights=both.ravel())
    means = sums / np.maximum(np.bincount(segments.ravel()), 1)
    return blobs(_smooth(means[segments], own))


def _smooth(values: Boxes, own: WindowParameters) -> Boxes:
    return np.asarray(cv2.GaussianBlur(values, (0, 0), own.smooth_px), np.float64)


def _boxes(level: Boxes, threshold: float, own: WindowParameters) -> Boxes:
    """Connected parts above a threshold that are as large as windows are."""
    _, _, stats, _ = cv2.connectedComponentsWithStats((level > threshold).astype(np.uint8))
    found = stats[1:, :4].astype(np.float64)
    side = max(level.shape)
    sizes = found[:, 2:]
    fits = ((sizes >= own.least_side * side) & (sizes <= own.most_side * side)).all(axis=1)
    kept = found[fits]
    return np.column_stack([kept[:, :2], kept[:, :2] + kept[:, 2:]])
