"""How far apart the bare faces of a room's walls are, from the ink itself, to parts of a pixel.

An outline of a room lies where its walls are by the median along whole axes. On coarse sheets what
stands along a wall is one stroke with it, and the face of a wall with much furniture lies 1 to 3 px
within the room: up to 2 % of a side. Where the wall is bare, its face is as sharp as the sheet.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

_INK = 0.5  # a face is where ink becomes paper, half of each
_THIN = 0.1  # quantile of the thicknesses: partitions
_LEAST_THIN_PX = 5.0  # of narrower walls, windows are lines as broad
_SOLID = 0.75  # of a thin wall: leaves in their pockets, panes and frames are less ink than that
_DARK, _EVEN = 0.75, 0.85  # ink in the middle of a wall, and as a share of that at its border: of a
# grey wall or a hollow one the face is the middle of its outline, and not where that ends
_BACK = 0.5  # thin walls by which a bare face may lie behind the outline ...
_AHEAD_PX = 4  # ... and pixels by which it may lie before it
_CORNER_PX = 2  # beside a corner there are two faces
_BARE = 0.12  # quantile of the places along a face: so many at least are bare, and no gap's edge
_SAME_PX = 0.6  # places of one face, around that
_FEWEST, _SHARE = 6, 0.1  # places, and share of a side, where wall of one face is seen


@dataclass(frozen=True)
class Span:
    """A rectangle in a frame turned by `turn_rad` about the origin of the pixels, x to y.

    In that frame it reaches from `low` to `high`, each (2,): along and across.
    """

    turn_rad: float
    low: NDArray[np.float64]
    high: NDArray[np.float64]

    @property
    def sides(self) -> tuple[float, float]:
        """Pixels along and across."""
        along, across = self.high - self.low
        return float(along), float(across)


def thin_wall(walls_px: Sequence[float]) -> float:
    """Thickness of partitions, in pixels, by that of all walls; 0 without walls."""
    return float(np.quantile(walls_px, _THIN)) if len(walls_px) else 0.0


def clear_sides(
    ink: NDArray[np.float32], room: Span, thin_px: float
) -> tuple[float | None, float | None]:
    """Pixels between bare faces of solid walls around a room, along and across.

    `ink` (h, w) is 0 paper to 1 ink; `thin_px` the thickness of thin walls. None where a wall is
    not filled with ink, or nowhere seen.
    """
    if thin_px < _LEAST_THIN_PX:
        return None, None
    cos, sin = math.cos(room.turn_rad), math.sin(room.turn_rad)
    axes = np.array([[cos, sin], [-sin, cos]])
    found: list[float | None] = []
    for axis in (0, 1):
        across = (float(room.low[1 - axis]), float(room.high[1 - axis]))
        # The room lies before its lower wall, and, seen the other way round, before its upper one.
        lower = _face(ink, axes[axis], axes[1 - axis], float(room.low[axis]), across, thin_px)
        upper = _face(ink, -axes[axis], axes[1 - axis], -float(room.high[axis]), across, thin_px)
        side = None if lower is None or upper is None else -upper - lower
        found.append(side if side is not None and side > 0.0 else None)
    return found[0], found[1]


def _face(
    ink: NDArray[np.float32],
    inwards: NDArray[np.float64],
    beside: NDArray[np.float64],
    about: float,
    reach: tuple[float, float],
    thin_px: float,
) -> float | None:
    """Where along `inwards` a wall's bare face lies, near `about`; None where it is not seen.

    `reach` is from where to where the wall runs along `beside`. Both are unit vectors.
    """
    solid = max(2, round(_SOLID * thin_px))
    back = math.ceil(_BACK * thin_px)
    places = int(reach[1] - reach[0]) - 2 * _CORNER_PX
    if places < _FEWEST:
        return None
    first = about - back - solid
    corner = first * inwards + (reach[0] + _CORNER_PX + 0.5) * beside
    strip = _strip(ink, corner, inwards, beside, (back + solid + _AHEAD_PX + 1, places))
    inked = strip > _INK
    walls = np.lib.stride_tricks.sliding_window_view(inked, solid, axis=1).all(axis=-1)
    ends = (walls & _filled(strip, solid, thin_px))[:, :-1] & ~inked[:, solid:]
    rows = np.flatnonzero(ends.any(axis=1))
    if len(rows) < max(_FEWEST, _SHARE * places):
        return None
    last = ends[rows].argmax(axis=1) + solid - 1  # the last pixel of the wall
    before, after = strip[rows, last], strip[rows, last + 1]
    faces = first + last + (before - _INK) / (before - after)
    bare = float(np.quantile(faces, _BARE, method="lower"))
    return float(faces[np.abs(faces - bare) <= _SAME_PX].mean())


def _filled(strip: NDArray[np.float32], solid: int, thin_px: float) -> NDArray[np.bool_]:
    """Whether `solid` pixels from each place of a row on end in a face of a wall filled with ink.

    `strip` is (rows, columns); the result is narrower by solid - 1. The middle of the wall is as
    dark as its border then.
    """
    half = min(solid - 1, int(thin_px / 2.0))
    border = np.lib.stride_tricks.sliding_window_view(strip, half + 1, axis=1)[
        :, solid - 1 - half :
    ]
    middle = border[..., 0]
    filled: NDArray[np.bool_] = (middle > _DARK) & (middle >= _EVEN * border.max(axis=-1))
    return filled


def _strip(
    ink: NDArray[np.float32],
    corner: NDArray[np.float64],
    right: NDArray[np.float64],
    down: NDArray[np.float64],
    size: tuple[int, int],
) -> NDArray[np.float32]:
    """Ink on a grid of `size` (columns, rows) from `corner` on, a pixel apart along both axes."""
    # OpenCV has the centres of pixels at whole numbers.
    matrix = np.column_stack([right, down, corner - 0.5])
    found = cv2.warpAffine(ink, matrix, size, flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP)
    return np.asarray(found, dtype=np.float32)
