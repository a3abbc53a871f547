"""A camera that pans: its frames on one canvas, on which the background stands still."""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.read.footage import Footage
from veduta.run.errors import NotFoundError

Floats = NDArray[np.float64]
_MOST_BYTES = 3_000_000_000
_FOR_MEDIAN, _BAND = 21, 64
"""Frames that the median is taken of, and rows of the canvas at a time."""
_COMPARED = 7
"""Frames that are compared with the middle one."""
_AROUND = 5
"""So near to the animal (px) nothing is followed where its silhouettes are known."""


@dataclass(frozen=True)
class CameraLooks:
    """When a camera moves, and how its motion is found."""

    still_px: float = 1.5
    """Corners that move by less over the footage are noise."""
    points: int = 600
    quality: float = 0.001
    inlier_px: float = 1.5
    fewest: int = 16
    """Points on the background that must be followed from frame to frame."""
    steepness: float = 1.0
    """Grey levels on a pixel: an edge is steeper."""
    changed: float = 8.0
    """Grey levels by which a picture's rim differs from the next one's if the camera moved."""
    largest: float = 3.0
    """The canvas has so many times a frame's pixels at most, along each side."""


def stilled(
    footage: Footage, looks: CameraLooks, name: str, animal: NDArray[np.bool_] | None = None
) -> Footage:
    """The footage as a camera that stands still would have it, where it moves; else as it is.

    Points are followed from each frame to the next (Lucas and Kanade) and a homography is found
    that most of them agree with: the background's, for the animal has fewer, and none where its
    silhouettes (t, h, w) are known. Where a frame does not
    reach, the canvas has the median of the others. NotFoundError where the picture's rim changes
    and nothing can be followed, or where the pan is too wide.
    """
    if _stands_still(footage.frames, looks, animal):
        return footage
    steps = _steps(footage.frames, looks, name, animal)
    middle = len(footage.frames) // 2
    onto = _chained(steps, middle)
    height, width = footage.size
    corners = np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
    moved = np.stack([_through(matrix, corners) for matrix in onto])
    if np.abs(moved - corners).max() < looks.still_px:
        return footage
    low = np.floor(moved.min(axis=(0, 1)))
    size = np.ceil(moved.max(axis=(0, 1)) - low).astype(int)
    too_wide = (size > looks.largest * np.array([width, height])).any()
    if too_wide or 3 * int(size[0]) * int(size[1]) * len(onto) > _MOST_BYTES:
        raise NotFoundError(
            "a canvas for all frames",
            f"the camera of {name} turns too far: it would have {size[0]} x {size[1]} px",
            "Give masks (--masks), or a shorter piece of the footage.",
        )
    shift = np.array([[1.0, 0.0, -low[0]], [0.0, 1.0, -low[1]], [0.0, 0.0, 1.0]])
    laid = shift @ onto
    return replace(
        footage,
        frames=_on_canvas(footage.frames, laid, (size[0], size[1])),
        onto=laid,
        framed=footage.size,
    )


def _stands_still(
    frames: NDArray[np.uint8], looks: CameraLooks, animal: NDArray[np.bool_] | None
) -> bool:
    """Whether edges of some frames lie where they lie in the middle one, by most of their pixels.

    How far an edge has moved is what changes there over how steep it is. Small errors of
    homographies from frame to frame would add up to a motion.
    """
    middle = len(frames) // 2
    here = _calm(frames[middle])
    across, down = cv2.Sobel(here, cv2.CV_32F, 1, 0), cv2.Sobel(here, cv2.CV_32F, 0, 1)
    steep = np.asarray(cv2.magnitude(across, down)) / 8.0  # a Sobel's sum for a ramp of 1 is 8
    chosen = steep >= max(float(np.percentile(steep, 80.0)), looks.steepness)
    if animal is not None:
        chosen &= _beside(animal[middle]) > 0
    if chosen.sum() < looks.fewest:
        return False
    for row in np.unique(np.linspace(0, len(frames) - 1, _COMPARED).round().astype(int)):
        apart = np.abs(_calm(frames[row]) - here)[chosen] / steep[chosen]
        if float(np.median(apart)) > looks.still_px / 2.0:
            return False
    return True


def _calm(frame: NDArray[np.uint8]) -> NDArray[np.float32]:
    grey = cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY).astype(np.float32)
    return np.asarray(cv2.GaussianBlur(grey, (0, 0), 1.5), dtype=np.float32)


def _beside(animal: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """(h, w) 255 where no animal is near."""
    reach = np.ones((2 * _AROUND + 1, 2 * _AROUND + 1), np.uint8)
    return np.asarray(255 - 255 * cv2.dilate(animal.astype(np.uint8), reach), dtype=np.uint8)


def _steps(
    frames: NDArray[np.uint8], looks: CameraLooks, name: str, animal: NDArray[np.bool_] | None
) -> Floats:
    """(t, 3, 3) from each frame to the one before it; the first is no motion."""
    grey = [np.asarray(cv2.cvtColor(frame, cv2.COLOR_RGB2GRAY), dtype=np.uint8) for frame in frames]
    found = np.tile(np.eye(3), (len(frames), 1, 1))
    for row in range(1, len(grey)):
        free = None if animal is None else _beside(animal[row])
        matrix = _between(grey[row], grey[row - 1], looks, free)
        if matrix is not None:
            found[row] = matrix
        elif _rim_changes(grey[row], grey[row - 1]) > looks.changed:
            raise NotFoundError(
                "the camera's motion",
                f"from frame {row - 1} to {row} of {name} the whole picture changes, and it has"
                " nothing that can be followed",
                "Give masks (--masks), or footage from a camera that stands still.",
            )
    return found


def _between(
    here: NDArray[np.uint8], before: NDArray[np.uint8], looks: CameraLooks,
    free: NDArray[np.uint8] | None,
) -> Floats | None:  # fmt: skip
    places = cv2.goodFeaturesToTrack(here, looks.points, looks.quality, 7.0, mask=free)
    if places is None or len(places) < looks.fewest:
        return None
    there, good, _ = cv2.calcOpticalFlowPyrLK(here, before, places, places.copy(), winSize=(21, 21))
    kept = good.ravel() > 0
    if kept.sum() < looks.fewest:
        return None
    matrix, inside = cv2.findHomography(
        places[kept], there[kept], cv2.USAC_MAGSAC, looks.inlier_px, maxIters=2000
    )
    if matrix is None or int(inside.sum()) < max(looks.fewest, 0.3 * kept.sum()):
        return None
    return np.asarray(matrix, dtype=np.float64)


def _rim_changes(here: NDArray[np.uint8], before: NDArray[np.uint8]) -> float:
    """The mean difference in the outer tenth of the picture."""
    apart = cv2.absdiff(here, before).astype(np.float64)
    reach = max(2, min(apart.shape) // 10)
    rim = np.ones(apart.shape, dtype=np.bool_)
    rim[reach:-reach, reach:-reach] = False
    return float(apart[rim].mean())


def _chained(steps: Floats, middle: int) -> Floats:
    """(t, 3, 3) from each frame to the middle one."""
    found = np.tile(np.eye(3), (len(steps), 1, 1))
    for row in range(middle + 1, len(steps)):
        found[row] = found[row - 1] @ steps[row]
    for row in range(middle - 1, -1, -1):
        found[row] = found[row + 1] @ np.linalg.inv(steps[row + 1])
    return found / found[:, 2:, 2:]


def _through(matrix: Floats, points: Floats) -> Floats:
    moved = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return np.asarray(moved[:, :2] / moved[:, 2:])


def _on_canvas(
    frames: NDArray[np.uint8], matrices: Floats, size: tuple[int, int]
) -> NDArray[np.uint8]:
    """The frames there; what a frame does not show is as the median of those that do."""
    warped = np.empty((len(frames), size[1], size[0], 3), dtype=np.uint8)
    seen = np.empty((len(frames), size[1], size[0]), dtype=np.bool_)
    full = np.full(frames.shape[1:3], 255, np.uint8)
    for row, (frame, matrix) in enumerate(zip(frames, matrices, strict=True)):
        warped[row] = cv2.warpPerspective(frame, matrix, size, flags=cv2.INTER_LINEAR)
        seen[row] = cv2.warpPerspective(full, matrix, size, flags=cv2.INTER_LINEAR) > 250
    few = np.linspace(0, len(frames) - 1, min(len(frames), _FOR_MEDIAN)).round().astype(int)
    median = np.zeros(warped.shape[1:], dtype=np.uint8)
    for top in range(0, size[1], _BAND):
        band = slice(top, top + _BAND)
        shown = seen[few, band]
        values = np.where(shown[..., None], warped[few, band].astype(np.float32), np.nan)
        known = shown.any(axis=0)
        median[band][known] = np.nanmedian(values[:, known], axis=0).astype(np.uint8)
    for frame, shown in zip(warped, seen, strict=True):
        np.copyto(frame, median, where=~shown[..., None])
    return warped
