"""Cornices and courses that the learned eyes see: rows of which most are moulding."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import FacadeBox, Moulding
from veduta.facade.eyes import Seen

MouldingKind = Literal["cornice", "modillions", "string-course"]


@dataclass(frozen=True)
class MouldingParameters:
    """When rows are a moulding.

    `share`: how much of a row's width is moulding (the thesis, 6.4.3, asks half of the front's), in
    stretches of which the longest is `unbroken` of the width, where gaps of `gap_m` are none: rows
    of lintels and pediments are many short ones.
    `chance`: of a pixel. `least_m`, `most_m`: how high one is. `apart_m`: rows nearer than this are
    one. `eaves_m`: one that lies so near to the eaves is the main cornice, others are courses.
    `teeth`: how much of the variation of lightness
    along it a period of 0.2 to 0.8 m explains, from which on it stands on modillions.
    """

    share: float = 0.5
    unbroken: float = 0.5
    gap_m: float = 0.1
    chance: float = 0.4
    least_m: float = 0.1
    most_m: float = 1.6
    apart_m: float = 0.12
    eaves_m: float = 0.8
    teeth: float = 0.3


def seen_mouldings(
    seen: Seen,
    pixels: NDArray[np.uint8],
    box: FacadeBox,
    metres_per_px: float,
    parameters: MouldingParameters | None = None,
) -> list[Moulding]:
    """The mouldings between the sides of a front, from above.

    pixels: (h, w, 3) uint8 sRGB, what was looked at; box: the front in it.
    """
    p = parameters or MouldingParameters()
    if "cornice" not in seen.names:
        return []
    chance = seen.chance_at((seen.width_px, seen.height_px), "cornice")
    left, right = max(0, round(box.x_px)), round(box.x_px + box.width_px)
    top = max(0, round(box.y_px - p.eaves_m / metres_per_px))
    part = chance[top : round(box.y_px + box.height_px), left:right]
    if part.size == 0:
        return []
    moulded = _closed(part > p.chance, p.gap_m / metres_per_px)
    rows = (moulded.mean(axis=1) > p.share) & (_longest(moulded) > p.unbroken * part.shape[1])
    found = []
    for a, b in _runs(rows, round(p.apart_m / metres_per_px)):
        high = (b - a) * metres_per_px
        if not p.least_m <= high <= p.most_m:
            continue
        kind: MouldingKind = "string-course"
        if abs(0.5 * (a + b) + top - box.y_px) * metres_per_px <= p.eaves_m:
            strip = pixels[top + a : top + b, left:right]
            kind = "modillions" if _teeth(strip, metres_per_px) >= p.teeth else "cornice"
        score = float(part[a:b].mean())
        found.append(
            Moulding(
                kind=kind,
                x_px=box.x_px,
                y_px=float(top + a),
                width_px=box.width_px,
                height_px=float(b - a),
                score=min(1.0, score),
                provenance="inferred",  # how far it stands out, no photo says
            )
        )
    return found


def _closed(mask: NDArray[np.bool_], gap: float) -> NDArray[np.bool_]:
    """The same with gaps along the rows closed up to a length."""
    kernel = np.ones((1, 2 * round(0.5 * gap) + 1), np.uint8)
    return np.asarray(cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, kernel) > 0)


def _longest(mask: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(h,) the longest run in each row."""
    places = np.arange(1, mask.shape[1] + 1)
    last_gap = np.maximum.accumulate(np.where(mask, 0, places), axis=1)
    return np.asarray((places - last_gap).max(axis=1), np.int64)


def _runs(rows: NDArray[np.bool_], apart: int) -> Sequence[tuple[int, int]]:
    """First rows and ends of runs; gaps up to `apart` are closed."""
    ends = np.flatnonzero(np.diff(np.concatenate([[0], rows.astype(np.int8), [0]])))
    found: list[tuple[int, int]] = []
    for a, b in ends.reshape(-1, 2).tolist():
        if found and a - found[-1][1] <= apart:
            found[-1] = (found[-1][0], b)
        else:
            found.append((a, b))
    return found


def _teeth(strip: NDArray[np.uint8], metres_per_px: float) -> float:
    """How well the lower half of a strip repeats along it, 0..1: its best autocorrelation."""
    grey = cv2.cvtColor(strip, cv2.COLOR_RGB2GRAY).astype(np.float64)
    line = grey[len(grey) // 2 :].mean(axis=0)
    line -= cv2.GaussianBlur(line.reshape(1, -1), (0, 0), max(1.0, 0.6 / metres_per_px)).ravel()
    low, high = max(2, round(0.2 / metres_per_px)), round(0.8 / metres_per_px)
    power = float(line @ line)
    if power <= len(line) or high >= len(line) // 3 or low >= high or high < 4:
        return 0.0
    repeats = [float(line[k:] @ line[:-k]) / power for k in range(low, high + 1)]
    # A period has a dip before its peak: what only falls is no repeat.
    dip = int(np.argmin(repeats))
    return max(repeats[dip:], default=0.0)
