"""The horizontal split: window stripes with gaps (paper section 3.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.facade.evidence import Evidence, Float, blur, blur_line, two_class_threshold
from veduta.facade.floors import Floors

# In storeys (3 m): stripes of 0.55 to 2.4 m, gaps of 0.25 to 7.5 m.
_WIDTH = (0.18, 0.8)
_GAP = (0.08, 2.5)
_JAMB = 0.018
_WIDTH_CHANGE = 0.6


@dataclass(frozen=True)
class Wall:
    """How far each pixel of the floors is from the wall's colour around it.

    `unlike` (h, w) is a colour distance, zero outside the floors; `colour` (h, w, 3) Lab.
    """

    unlike: Float
    colour: Float


@dataclass(frozen=True)
class Columns:
    """Window stripes `(x, width)` in analysis pixels, left to right."""

    stripes: list[tuple[int, int]]
    wall: Wall
    energy: float
    labels: int


def split_columns(evidence: Evidence, floors: Floors) -> Columns:
    """Solve the chain of stripes on the evidence of all floors above the ground floor."""
    top, bottom = floors.eaves, floors.ground_top
    storey = (bottom - top) / (len(floors.boundaries) - 1)
    wall = wall_colour(evidence, top, bottom, storey)
    profile, jambs = _profiles(evidence, wall, top, bottom, storey)
    widths = list(range(max(3, int(_WIDTH[0] * storey)), int(_WIDTH[1] * storey) + 1))
    energy, stripes = _core.column_chain(
        np.zeros((evidence.width, evidence.width), np.float32),
        profile,
        jambs,
        widths,
        step=1,
        gap_min=max(2, int(_GAP[0] * storey)),
        gap_max=int(_GAP[1] * storey),
        jamb_weight=_JAMB * storey,
        similarity=0.0,
        width_change=_WIDTH_CHANGE / storey,
        gap_symmetry=0.0,
        stripe_symmetry=0.0,
        neutral=0.0,
    )
    return Columns(stripes, wall, energy / evidence.width, len(widths) * evidence.width)


def _texture(evidence: Evidence, top: int, bottom: int, storey: float) -> Float:
    edges = np.minimum(np.abs(evidence.gx[top:bottom]), 20)
    return blur(edges, max(1.0, storey / 20), storey / 6)


def wall_colour(evidence: Evidence, top: int, bottom: int, storey: float) -> Wall:
    """Colour of the wall around each pixel: a mean of the smooth pixels at about the same height.

    Repeated with the pixels that are unlike it left out, so it follows shadows across the facade.
    """
    lab = evidence.lab[top:bottom]
    texture = _texture(evidence, top, bottom, storey)
    smooth = np.exp(-((texture / max(float(np.percentile(texture, 35)), 1e-3)) ** 2))
    weight = smooth + 1e-4
    colour, distance = lab, np.zeros(lab.shape[:2], np.float32)
    for _ in range(3):
        total = blur(weight, 0.7 * storey, 0.06 * storey) + 1e-6
        spread = [blur(weight * lab[:, :, c], 0.7 * storey, 0.06 * storey) for c in range(3)]
        colour = np.dstack([s / total for s in spread])
        distance = np.sqrt((((lab - colour) * np.array([0.7, 1.3, 1.3], np.float32)) ** 2).sum(-1))
        weight = smooth * np.exp(-((distance / 12) ** 2)) + 1e-4
    unlike = np.zeros(evidence.lab.shape[:2], np.float32)
    unlike[top:bottom] = distance
    whole = evidence.lab.copy()
    whole[top:bottom] = colour
    return Wall(unlike, whole)


def _standard(values: Float) -> Float:
    centred = values - two_class_threshold(values)
    return np.asarray(centred / (float(values.std()) + 1e-6), np.float32)


def _profiles(
    evidence: Evidence, wall: Wall, top: int, bottom: int, storey: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Window evidence per pixel column (w,) and jamb evidence per column boundary (w + 1,)."""
    unlike = np.minimum(wall.unlike[top:bottom], 40)
    rows = blur_line(unlike.std(1), 2.0)
    rows = rows / max(float(rows.sum()), 1e-6)
    edges = np.minimum(np.abs(evidence.gx[top:bottom]), 20)
    texture = np.minimum(_texture(evidence, top, bottom, storey), 20)
    colour = _standard(blur_line(rows @ unlike, 1.0))
    evidence_x = np.clip(colour + 0.7 * _standard(rows @ texture), -1.5, 1.5)
    edge = blur_line(rows @ edges, 0.8)
    edge = (edge - edge.mean()) / (float(edge.std()) + 1e-6)
    jambs = np.zeros(len(edge) + 1)
    jambs[1:-1] = np.clip(np.maximum(edge[:-1], edge[1:]), -1, 3)
    return evidence_x.astype(np.float64), jambs
