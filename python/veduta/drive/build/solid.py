"""What is below the scan points of low objects, down to the ground: images show it, scans do not."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from veduta.drive.build.layers import Layers, PointClass


@dataclass(frozen=True)
class SolidParameters:
    """tall_m: cars and hedges are lower. cell_m: below the highest point of each such square all is
    solid. step_m: between the points that stand for it. foot_m: what stands on the ground has
    points so low. joined_m: squares of points that touch are of one object; awnings have no foot.
    """

    tall_m: float = 1.9
    cell_m: float = 0.1
    step_m: float = 0.12
    foot_m: float = 0.6
    joined_m: float = 0.3


def solid_below(layers: Layers, parameters: SolidParameters | None = None) -> NDArray[np.float64]:
    """(n, 3) points below low foreground, down to the ground (m, world, z up).

    The ends of a car have no scan points where the planes of the scanner run along them; without
    them its ends are painted on the road (the mask of section 7.1 is of scan points alone).
    """
    chosen = parameters or SolidParameters()
    low = (layers.kind == PointClass.FOREGROUND) & (layers.above < chosen.tall_m)
    points, above = layers.points.points[low].astype(np.float64), layers.above[low]
    if not len(points):
        return np.zeros((0, 3))
    standing = _standing(points, above, chosen)
    points, above = points[standing], above[standing]
    highest_first = np.argsort(-above, kind="stable")
    cell = np.floor(points[highest_first, :2] / chosen.cell_m).astype(np.int64)
    _, first = np.unique(cell, axis=0, return_index=True)
    top = highest_first[first]
    steps = np.maximum(above[top] / chosen.step_m, 0.0).astype(np.int64)
    number = np.arange(int(steps.sum())) - np.repeat(np.cumsum(steps) - steps, steps)
    found = np.repeat(points[top], steps, axis=0)
    found[:, 2] -= (number + 1) * chosen.step_m
    return found


def _standing(
    points: NDArray[np.float64], above: NDArray[np.floating], chosen: SolidParameters
) -> NDArray[np.bool_]:
    """(n,) points of objects that come down to the ground somewhere."""
    cell = np.floor(points[:, :2] / chosen.joined_m).astype(np.int64)
    cell -= cell.min(axis=0)
    there = np.zeros(cell.max(axis=0) + 1, dtype=bool)
    there[cell[:, 0], cell[:, 1]] = True
    label, count = ndimage.label(there, structure=np.ones((3, 3)))
    own = label[cell[:, 0], cell[:, 1]]
    has_foot = np.zeros(count + 1, dtype=bool)
    has_foot[own[above < chosen.foot_m]] = True
    return np.asarray(has_foot[own], dtype=bool)
