"""Shutters and blinds of the windows of a document: open beside them, or closed before them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.facade.casements import Casement, CasementParameters, casements
from veduta.facade.document import Element, FacadeDocument, Shutter, ShutterKind
from veduta.facade.eyes import Seen, SeenElement

Mask = NDArray[np.bool_]
Rows = tuple[float, float, float, float]


@dataclass(frozen=True)
class ShutterParameters:
    """When what the eyes call blind is a shutter of a window.

    own: how far one goes on beside a window, and from which chance on: 0.2 was best of eight on
    32 pictures of CMP that the eyes were trained on (F1 0.785; 0.766 with 0.3, 0.756 with 0.1).
    filled: the least share of a row (or a column) of a window that is under blinds where a blind
    (or a leaf) covers it. whole: the share of a window from which on all of it is closed. least:
    the least share of its area that counts. narrow: the least width of an open leaf, in widths of
    its window.
    """

    own: CasementParameters = field(default_factory=lambda: CasementParameters(chance=0.2))
    filled: float = 0.5
    whole: float = 0.8
    least: float = 0.12
    narrow: float = 0.15


def seen_shutters(
    seen: Seen, document: FacadeDocument, parameters: ShutterParameters | None = None
) -> list[Shutter]:
    """The shutters of a document's windows, in pixels of what was seen; open leaves first."""
    p = parameters or ShutterParameters()
    windows = [e for e in document.elements if e.class_ == "window"]
    looked = [_looked_at(e) for e in windows]
    chance = seen.chance("blind")
    scale = chance.shape[1] / seen.width_px, chance.shape[0] / seen.height_px
    found: list[Shutter] = []
    for window, one in zip(windows, casements(seen, looked, p.own), strict=True):
        found += _leaves(one, _free(window, windows), chance, scale, p)
    for box in looked:
        found += _closed(box, chance, scale, p)
    return found


def _looked_at(window: Element) -> SeenElement:
    x, y = window.x_px, window.y_px
    return SeenElement("window", x, y, x + window.width_px, y + window.height_px, window.score)


def _free(window: Element, windows: Sequence[Element]) -> tuple[float, float]:
    """From where to where leaves of a window may lie: half of the way to the next ones."""
    left, right = -np.inf, np.inf
    for other in windows:
        in_rows = (
            other.y_px < window.y_px + window.height_px
            and window.y_px < other.y_px + other.height_px
        )
        if other is window or not in_rows:
            continue
        if other.x_px >= window.x_px + window.width_px:
            right = min(right, 0.5 * (other.x_px + window.x_px + window.width_px))
        elif other.x_px + other.width_px <= window.x_px:
            left = max(left, 0.5 * (other.x_px + other.width_px + window.x_px))
    return left, right


def _leaves(
    one: Casement,
    free: tuple[float, float],
    chance: NDArray[np.float32],
    scale: tuple[float, float],
    p: ShutterParameters,
) -> list[Shutter]:
    """The open leaves on both sides of a window."""
    window, (left, top, right, foot) = one.window, one.box
    spans = []
    if one.left:
        spans.append((max(left, free[0]), window.x0))
    if one.right:
        spans.append((window.x1, min(right, free[1])))
    return [
        _shutter("open", (a, top, b, foot), chance, scale)
        for a, b in spans
        if b - a >= p.narrow * window.width
    ]


def _closed(
    window: SeenElement,
    chance: NDArray[np.float32],
    scale: tuple[float, float],
    p: ShutterParameters,
) -> list[Shutter]:
    """What covers a window: a blind from its head down, leaves from its sides, or all of it."""
    part = _part(chance, (window.x0, window.y0, window.x1, window.y1), scale) >= p.own.chance
    if part.size == 0 or part.mean() < p.least:
        return []
    ways = [[(0.0, 0.0, 1.0, 1.0)], _from_head(part, p), _from_sides(part, p)]
    if part.mean() < p.whole:
        ways = ways[1:]
    best = max(ways, key=lambda way: _likeness(part, way))
    return [
        _shutter("closed", _in_window(window, share), chance, scale)
        for share in best
        if (share[2] - share[0]) * (share[3] - share[1]) >= p.least
    ]


def _from_head(part: Mask, p: ShutterParameters) -> list[Rows]:
    """The rows from the first on that are covered, as shares of the window."""
    rows = _first_run(part.mean(axis=1) >= p.filled) / len(part)
    return [(0.0, 0.0, 1.0, rows)]


def _from_sides(part: Mask, p: ShutterParameters) -> list[Rows]:
    """The columns from both sides on that are covered, as shares of the window."""
    covered = part.mean(axis=0) >= p.filled
    left, right = _first_run(covered), _first_run(covered[::-1])
    if len(covered) in (left, right):
        return [(0.0, 0.0, 1.0, 1.0)]
    wide = len(covered)
    return [(0.0, 0.0, left / wide, 1.0), (1.0 - right / wide, 0.0, 1.0, 1.0)]


def _first_run(covered: Mask) -> int:
    """How many of a line are covered from its first on; a border of a tenth may be a frame."""
    start = int(np.argmax(covered)) if covered.any() else len(covered)
    if start > 0.1 * len(covered):
        return 0
    gaps = np.flatnonzero(~covered[start:])
    return len(covered) if not len(gaps) else start + int(gaps[0])


def _likeness(part: Mask, shares: Sequence[Rows]) -> float:
    """Intersection over union of the covered part of a window with rectangles."""
    drawn = np.zeros_like(part)
    high, wide = part.shape
    for x0, y0, x1, y1 in shares:
        drawn[round(y0 * high) : round(y1 * high), round(x0 * wide) : round(x1 * wide)] = True
    return float((drawn & part).sum() / max(1, (drawn | part).sum()))


def _in_window(window: SeenElement, share: Rows) -> Rows:
    x0, y0, x1, y1 = share
    return (
        window.x0 + x0 * window.width,
        window.y0 + y0 * window.height,
        window.x0 + x1 * window.width,
        window.y0 + y1 * window.height,
    )


def _part(
    chance: NDArray[np.float32], box: Rows, scale: tuple[float, float]
) -> NDArray[np.float32]:
    """What of a map lies in a box of the picture."""
    x0, x1 = (max(0, round(x * scale[0])) for x in (box[0], box[2]))
    y0, y1 = (max(0, round(y * scale[1])) for y in (box[1], box[3]))
    return chance[y0:y1, x0:x1]


def _shutter(
    kind: ShutterKind, box: Rows, chance: NDArray[np.float32], scale: tuple[float, float]
) -> Shutter:
    """The shutter in a box; its score is the mean chance of blind there."""
    part = _part(chance, box, scale)
    return Shutter(
        kind=kind,
        x_px=round(box[0], 2),
        y_px=round(box[1], 2),
        width_px=round(box[2] - box[0], 2),
        height_px=round(box[3] - box[1], 2),
        score=float(part.mean()) if part.size else 0.0,
    )
