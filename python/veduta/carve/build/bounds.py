"""The box around the object: the pyramids over the silhouettes' boxes, cut with each other (4.3.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from veduta.carve.views import View
from veduta.run.errors import InputError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class BoundsRule:
    """margin_px: that a silhouette's box may be wrong. far: of the distances to the cameras, beyond
    which a box counts as open. worst: views that are named where the pyramids do not meet.
    """

    margin_px: float = 1.0
    far: float = 20.0
    worst: int = 3


@dataclass(frozen=True, eq=False)
class Bounds:
    """low_m, high_m: (3,) corners of the box."""

    low_m: Floats
    high_m: Floats

    @property
    def size_m(self) -> Floats:
        """(3,) along x, y and z."""
        return self.high_m - self.low_m


def find_bounds(views: Sequence[View], rule: BoundsRule | None = None) -> Bounds:
    """The axis-parallel box of all points that lie in every silhouette's box.

    InputError where there are none (the cameras do not look at one place), with the views that stand
    in the way; or where the pyramids do not close.
    """
    rule = rule or BoundsRule()
    planes = np.concatenate([_planes(view, rule.margin_px) for view in views])
    centres = np.array([view.camera.centre() for view in views])
    middle = centres.mean(axis=0)
    reach = max(float(np.linalg.norm(centres - middle, axis=1).max()), 1e-9)
    moved = planes.copy()
    moved[:, 3] += planes[:, :3] @ middle  # about the middle, in units of the cameras' distances
    moved[:, :3] *= reach
    moved /= np.linalg.norm(moved[:, :3], axis=1, keepdims=True)
    corners = np.empty((2, 3))
    for axis in range(3):
        for side, sign in enumerate((1.0, -1.0)):
            aim = np.zeros(3)
            aim[axis] = sign
            found = linprog(
                aim, A_ub=moved[:, :3], b_ub=-moved[:, 3], bounds=[(-rule.far, rule.far)] * 3
            )
            if found.x is None:
                raise _apart(views, moved, rule)
            corners[side, axis] = found.x[axis]
    if np.abs(corners).max() > 0.999 * rule.far:
        raise InputError(
            f"{len(views)} views",
            "the silhouettes leave the object's size open: all cameras look the same way",
            "Add photos from other sides.",
        )
    return Bounds(corners[0] * reach + middle, corners[1] * reach + middle)


def _planes(view: View, margin_px: float) -> Floats:
    """(5, 4) half-spaces n · x + d <= 0: the four sides of the pyramid, and what is behind it."""
    left, top, right, low = view.box_px
    x, y, depth = view.camera.projection()
    rows = [
        (left - margin_px) * depth - x,
        x - (right + margin_px) * depth,
        (top - margin_px) * depth - y,
        y - (low + margin_px) * depth,
        -depth,
    ]
    planes = np.array(rows)
    return np.asarray(planes / np.linalg.norm(planes[:, :3], axis=1, keepdims=True))


def _apart(views: Sequence[View], planes: Floats, rule: BoundsRule) -> InputError:
    """The views that would have to give way most for the pyramids to meet."""
    count = len(views)
    slack = np.zeros((len(planes), count))
    slack[np.arange(len(planes)), np.arange(len(planes)) // 5] = -1.0
    aim = np.concatenate([np.zeros(3), np.ones(count)])
    found = linprog(
        aim,
        A_ub=np.hstack([planes[:, :3], slack]),
        b_ub=-planes[:, 3],
        bounds=[(None, None)] * 3 + [(0.0, None)] * count,
    )
    given = np.zeros(count) if found.x is None else found.x[3:]
    worst = [n for n in np.argsort(-given)[: rule.worst] if given[n] > 1e-6]
    names = ", ".join(views[n].name for n in worst) or "the cameras"
    return InputError(
        names,
        "the silhouettes' boxes do not meet in space: the cameras do not look at one place",
        "Check that these cameras belong to these photos, or leave the photos out.",
    )
