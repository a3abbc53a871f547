"""Two views as a rectified pair: rows of one are rows of the other (thesis, 3.2)."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.cameras import Camera
from veduta.dense.document import Views

Matrix = NDArray[np.float64]
Side = tuple[NDArray[np.uint8], NDArray[np.bool_]]


@dataclass(frozen=True)
class RectifyParameters:
    """least_ahead: cosine of the angle between where the cameras look and what is across their
    baseline; below, one drives towards the other and rows run out of one spot. most_area: of a
    rectified picture, times the photo's. least_rows: share of the photo's that a pair must have in
    common.
    """

    least_ahead: float = 0.5
    most_area: float = 2.0
    least_rows: float = 0.25


@dataclass(frozen=True, eq=False)
class RectifiedPair:
    """rectified: (3, 3) of each view, its rectified pixels from its own. widths, height: of the
    rectified pictures (px). turn: (3, 3) rectified frame from world. focal_px, shift_px,
    baseline_m: what is at depth z lies at x there - x here = shift_px - focal_px * baseline_m / z.
    """

    rectified: tuple[Matrix, Matrix]
    widths: tuple[int, int]
    height: int
    turn: Matrix
    focal_px: float
    shift_px: float
    baseline_m: float

    def swapped(self) -> RectifiedPair:
        """With the other view as this one."""
        return RectifiedPair(
            (self.rectified[1], self.rectified[0]),
            (self.widths[1], self.widths[0]),
            self.height,
            self.turn,
            self.focal_px,
            -self.shift_px,
            -self.baseline_m,
        )

    def disparities(self, near_m: float, far_m: float) -> tuple[int, int]:
        """The least disparity (px) of what lies between two depths, and how many there are."""
        ends = [self.shift_px - self.focal_px * self.baseline_m / z for z in (near_m, far_m)]
        low, high = int(np.floor(min(ends))), int(np.ceil(max(ends)))
        return low, high - low + 1


def rectify_pair(here: Camera, there: Camera, parameters: RectifyParameters) -> RectifiedPair | str:
    """The pair, or why there is none: its rows would run out of a spot in the picture."""
    turn, length = _frame(here, there, parameters)
    if turn is None:
        return "one stands where the other looks to: rows of theirs run out of one spot"
    focal = float(np.sqrt(np.prod(here.focal_px) * np.prod(there.focal_px)) ** 0.5)
    bare = [_bare(one, turn) for one in (here, there)]
    corners = [_corners(one, matrix) for one, matrix in zip((here, there), bare, strict=True)]
    if any(one is None for one in corners):
        return "their rectified pictures would be without end"
    boxes = [(one.min(axis=0), one.max(axis=0)) for one in corners if one is not None]
    top, low = max(box[0][1] for box in boxes), min(box[1][1] for box in boxes)
    wide = max(box[1][0] - box[0][0] for box in boxes)
    photo = max(one.width_px * one.height_px for one in (here, there))
    area = focal**2 * wide * max(low - top, 0.0)
    focal *= min(1.0, float(np.sqrt(parameters.most_area * photo / max(area, 1.0))))
    rows = int((low - top) * focal)
    if rows < max(parameters.least_rows * min(here.height_px, here.width_px), 8):
        return "they have too few rows in common"
    lefts = [float(box[0][0]) * focal for box in boxes]
    matrices = [
        np.array([[focal, 0.0, -left], [0.0, focal, -top * focal], [0.0, 0.0, 1.0]]) @ matrix
        for left, matrix in zip(lefts, bare, strict=True)
    ]
    widths = [max(8, int((box[1][0] - box[0][0]) * focal)) for box in boxes]
    return RectifiedPair(
        (matrices[0], matrices[1]),
        (widths[0], widths[1]),
        rows,
        turn,
        focal,
        lefts[0] - lefts[1],
        length,
    )


def _frame(
    here: Camera, there: Camera, parameters: RectifyParameters
) -> tuple[Matrix | None, float]:
    """Rectified frame from world, x along the baseline; and the baseline with its sign (m)."""
    along = there.centre() - here.centre()
    length = float(np.linalg.norm(along))
    if length == 0.0:
        return None, 0.0
    along = along / length
    turns = [one.cam_from_world[:, :3] for one in (here, there)]
    middle = turns[0] + turns[1]
    ahead = middle[2] / np.linalg.norm(middle[2])
    across = ahead - (ahead @ along) * along
    if np.linalg.norm(across) < parameters.least_ahead:
        return None, 0.0
    # Along whichever axis of the photos the baseline runs, it points the way that axis does.
    axis = int(np.abs(middle[:2] @ along).argmax())
    if middle[axis] @ along < 0.0:
        along, length = -along, -length
    forward = across / np.linalg.norm(across)
    return np.stack([along, np.cross(forward, along), forward]), length


def _bare(camera: Camera, turn: Matrix) -> Matrix:
    """Rectified pixels at a focal length of 1 about 0, from a camera's pixels."""
    return np.asarray(turn @ camera.cam_from_world[:, :3].T @ np.linalg.inv(camera.matrix()))


def _corners(camera: Camera, bare: Matrix) -> Matrix | None:
    wide, high = float(camera.width_px), float(camera.height_px)
    given = np.array([[0, 0, 1], [wide, 0, 1], [wide, high, 1], [0, high, 1]], dtype=np.float64)
    seen = given @ bare.T
    if (seen[:, 2] <= 1e-3 * np.abs(seen).max()).any():
        return None
    return np.asarray(seen[:, :2] / seen[:, 2:])


def rectified_side(views: Views, view: int, matrix: Matrix, width: int, height: int) -> Side:
    """A view's rectified (h, w, 3) picture, and (h, w) where it has pixels."""
    half = np.array([[1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 1.0]])
    moved = half @ matrix @ np.linalg.inv(half)
    size = (width, height)
    pixels = cv2.warpPerspective(views.pixels(view), moved, size, flags=cv2.INTER_LINEAR)
    camera, hidden = views.cameras[view], views.hidden(view)
    whole = np.ones((camera.height_px, camera.width_px), dtype=np.uint8)
    if hidden is not None:
        whole[hidden] = 0
    shown = cv2.warpPerspective(whole, moved, size, flags=cv2.INTER_NEAREST) > 0
    return np.ascontiguousarray(pixels, dtype=np.uint8), np.ascontiguousarray(shown)
