"""What changes from one side of a column to the other, where one house may end."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float
from veduta.facade.eyes import Seen, SeenElement
from veduta.facade.seen_front import WALL

SIGNS = ("rows", "sizes", "colour", "lightness", "lines", "classes", "roof", "line", "parapet")
"""The names of the signs, in their order."""
_KINDS: tuple[tuple[str, ...], ...] = (
    ("window", "blind"),
    ("balcony",),
    ("shop", "door"),
    ("roof",),
    ("sky",),
    ("cornice", "ornament", "sill"),
)


@dataclass(frozen=True)
class SignParameters:
    """How far is looked to both sides, in storeys, and what counts as seen.

    reach: windows. strip: wall, lines and outline. bay: classes, about a column of windows and what
    is beside it. bands: heights at which walls are compared, of pixels with this chance of `wall`;
    a band counts where so much (`least`) of a strip is wall. smooth: spread of the profiles of
    lines. seen: share of a strip's pixels that must be photo. line_px: half the width of a line.
    """

    reach: float = 2.5
    strip: float = 0.9
    bay: float = 1.3
    bands: int = 10
    wall: float = 0.5
    least: float = 0.12
    smooth: float = 0.03
    seen: float = 0.6
    line_px: int = 2


@dataclass(frozen=True)
class Fronts:
    """A row of fronts at analysis size, ready to be asked at each column.

    wall (h, w): its chance; kinds (k, h, w): chances of groups of classes; top (w,): the first row
    that is no sky. windows: in pixels of the evidence. storey: its height (px).
    """

    evidence: Evidence
    wall: Float
    kinds: Float
    top: NDArray[np.float64]
    windows: tuple[SeenElement, ...]
    storey: float


def fronts_of(
    evidence: Evidence, seen: Seen, windows: Sequence[SeenElement], storey: float
) -> Fronts:
    """Gather what the signs look at."""
    size = evidence.width, evidence.height
    kinds = np.stack([seen.chance_at(size, *names) for names in _KINDS])
    sky = (kinds[4] > 0.5) | ~evidence.valid
    top = np.where(sky.all(axis=0), evidence.height, (~sky).argmax(axis=0)).astype(np.float64)
    wall = seen.chance_at(size, *WALL)
    return Fronts(evidence, wall, kinds, top, tuple(windows), storey)


def signs_at(
    fronts: Fronts, x: int, parameters: SignParameters | None = None
) -> NDArray[np.float64] | None:
    """The signs (9,) at a column, each about 0 within a house and 1 or more at a border.

    rows: how far the windows of both sides are out of line, in fifths of a storey. sizes: how much
    wider or higher they are (natural logarithm, by 0.25). colour and lightness: of the walls, in 10
    steps of OpenCV's Lab. lines: how little the horizontal edges of both sides are alike (one less
    their correlation). classes: how unlike they are in what is at each height. roof: the step of
    the outline against the sky, in half a storey. line: how much of the height a vertical line
    runs. parapet: how unlike the uppermost storey is. None where a side shows too little.
    """
    p = parameters or SignParameters()
    unit = fronts.storey
    left, right = strips = _strips(fronts, x, p.strip)
    if min(_shown(fronts, left), _shown(fronts, right)) < p.seen * max(4, round(p.strip * unit)):
        return None
    a, b = _beside(fronts, x, p.reach * unit)
    if not len(a) or not len(b):
        return None
    classes, parapet = _classes(fronts, *_strips(fronts, x, p.bay))
    rows = min(_apart(a, b), _apart(b, a)) / (0.2 * unit)
    sizes = _sizes(a, b) / 0.25
    return np.array([rows, sizes, *_of_walls(fronts, x, strips, classes, p), parapet])


def edge_signs(
    fronts: Fronts, x: int, *, is_left: bool, parameters: SignParameters | None = None
) -> NDArray[np.float64] | None:
    """The signs (6,) that need no windows: colour, lightness, lines, classes, roof, line.

    Of a column between the border of the picture and the outermost window; the strip towards the
    border may be narrow. None where it shows too little.
    """
    p = parameters or SignParameters()
    strips = _strips(fronts, x, p.strip)
    outer = strips[0] if is_left else strips[1]
    if _shown(fronts, outer) < max(3.0, 0.5 * p.seen * (outer.stop - outer.start)):
        return None
    classes, _ = _classes(fronts, *strips)
    return np.array(_of_walls(fronts, x, strips, classes, p))


def _strips(fronts: Fronts, x: int, storeys: float) -> tuple[slice, slice]:
    """The columns left and right of one, so many storeys wide where the picture is."""
    strip = max(4, round(storeys * fronts.storey))
    return slice(max(0, x - strip), x), slice(x, min(fronts.evidence.width, x + strip))


def _of_walls(
    fronts: Fronts, x: int, strips: tuple[slice, slice], classes: float, p: SignParameters
) -> list[float]:
    """The six signs that need no windows, of which the classes are known."""
    colour, light = _walls(fronts, *strips, p)
    left, right = (float(np.median(fronts.top[strip])) for strip in strips)
    return [
        colour / 10.0,
        light / 10.0,
        _unlike(fronts, *strips, p),
        classes,
        abs(left - right) / (0.5 * fronts.storey),
        _line(fronts, x, p),
    ]


def _shown(fronts: Fronts, span: slice) -> float:
    """Columns of a strip of which half and more is photo."""
    return float((fronts.evidence.valid[:, span].mean(axis=0) > 0.5).sum())


def _beside(
    fronts: Fronts, x: int, reach: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Boxes (n, 4) of the windows left and right of a column, near it."""
    boxes = np.array([[e.x0, e.y0, e.x1, e.y1] for e in fronts.windows]).reshape(-1, 4)
    middle = 0.5 * (boxes[:, 0] + boxes[:, 2])
    return boxes[(middle < x) & (middle >= x - reach)], boxes[(middle >= x) & (middle <= x + reach)]


def _apart(some: NDArray[np.float64], others: NDArray[np.float64]) -> float:
    """How far windows are from the nearest ones in height, in the median (px)."""
    rows = np.abs(some[:, None, [1, 3]] - others[None][..., [1, 3]]).mean(axis=2)
    return float(np.median(rows.min(axis=1)))


def _sizes(some: NDArray[np.float64], others: NDArray[np.float64]) -> float:
    one, other = (np.median(boxes[:, 2:] - boxes[:, :2], axis=0) for boxes in (some, others))
    return float(np.abs(np.log(np.maximum(one, 1.0) / np.maximum(other, 1.0))).max())


def _walls(fronts: Fronts, left: slice, right: slice, p: SignParameters) -> tuple[float, float]:
    """How far the walls of two strips are apart in colour and lightness, in the median of bands."""
    lab, edges = fronts.evidence.lab, np.linspace(0, fronts.evidence.height, p.bands + 1)
    found = []
    for top, bottom in zip(edges[:-1].astype(int), edges[1:].astype(int), strict=True):
        means = []
        for span in (left, right):
            mask = (fronts.wall[top:bottom, span] > p.wall) & fronts.evidence.valid[
                top:bottom, span
            ]
            if mask.mean() >= p.least:
                means.append(np.median(lab[top:bottom, span][mask], axis=0))
        if len(means) == 2:
            found.append(np.abs(means[0] - means[1]))
    if len(found) < 2:
        return 0.0, 0.0
    light, a, b = np.median(np.array(found), axis=0).tolist()
    return float(np.hypot(a, b)), float(light)


def _unlike(fronts: Fronts, left: slice, right: slice, p: SignParameters) -> float:
    """One less the correlation of the horizontal edges of two strips."""
    valid = fronts.evidence.valid
    rows = (valid[:, left].mean(axis=1) > 0.5) & (valid[:, right].mean(axis=1) > 0.5)
    if rows.sum() < 2.0 * fronts.storey:
        return 0.0
    spread = max(0.7, p.smooth * fronts.storey)
    lines = []
    for span in (left, right):
        edge = fronts.evidence.gy[:, span].mean(axis=1)
        line = cv2.GaussianBlur(edge.reshape(-1, 1), (0, 0), spread).ravel()[rows]
        lines.append(line - line.mean())
    power = float(np.linalg.norm(lines[0]) * np.linalg.norm(lines[1]))
    return 1.0 - float(lines[0] @ lines[1]) / power if power > 1e-6 else 0.0


def _classes(fronts: Fronts, left: slice, right: slice) -> tuple[float, float]:
    """How unlike two strips are in what is at each height: on all, and on the uppermost storey."""
    valid = fronts.evidence.valid
    rows = (valid[:, left].mean(axis=1) > 0.5) & (valid[:, right].mean(axis=1) > 0.5)
    apart = np.abs(fronts.kinds[:, :, left].mean(axis=2) - fronts.kinds[:, :, right].mean(axis=2))
    whole = apart.sum(axis=0)
    top = min(float(np.median(fronts.top[left])), float(np.median(fronts.top[right])))
    high = np.zeros(len(rows), dtype=np.bool_)
    high[max(0, round(top - 0.3 * fronts.storey)) : round(top + 0.8 * fronts.storey)] = True
    return _mean(whole[rows]), _mean(whole[rows & high])


def _mean(values: NDArray[np.floating]) -> float:
    return float(values.mean()) if len(values) else 0.0


def _line(fronts: Fronts, x: int, p: SignParameters) -> float:
    """Of the height below the outline, how much has a vertical edge here and none beside it."""
    gx, width = np.abs(fronts.evidence.gx), fronts.evidence.width
    near = gx[:, max(0, x - p.line_px) : min(width, x + p.line_px + 1)].max(axis=1)
    aside = max(6, round(0.25 * fronts.storey))
    around = gx[:, max(0, x - aside) : min(width, x + aside)]
    usual = np.median(around, axis=1)
    below = np.arange(len(near)) >= fronts.top[x]
    return _mean(((near > 2.5 * usual + 1.0) & (near > 3.0))[below].astype(np.float64))
