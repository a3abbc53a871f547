"""The window rectangle of each floor and column, and the balconies in front of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.columns import Columns
from veduta.facade.evidence import Evidence, Float, blur_line, two_class_threshold
from veduta.facade.floors import Floors

# In storeys: window heights, and depths of a balcony's railing in the image.
_WINDOW = (0.3, 0.95)
_RAILING = (0.12, 0.55)


@dataclass(frozen=True)
class Box:
    """A rectangle in analysis pixels, with what says that it is there (0..1)."""

    kind: str
    x: int
    y: int
    width: int
    height: int
    floor: int
    column: int | None
    score: float


def find_openings(evidence: Evidence, floors: Floors, columns: Columns) -> list[Box]:
    """Windows and balconies of every floor above the ground floor, eaves first."""
    boxes: list[Box] = []
    above = len(floors.boundaries) - 1
    storey = (floors.ground_top - floors.eaves) / above
    if not columns.stripes:
        return boxes
    for i, (top, bottom) in enumerate(
        zip(floors.boundaries[:-1], floors.boundaries[1:], strict=True)
    ):
        boxes += _floor(evidence, columns, top, bottom, storey, above - i)
    return boxes


def _masks(
    columns: Columns, width: int, storey: float
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Pixel columns surely inside a stripe, and surely between stripes."""
    inside = np.zeros(width, bool)
    wide = np.zeros(width, bool)
    margin = max(2, int(0.06 * storey))
    for x, w in columns.stripes:
        trim = max(1, w // 8)
        inside[x + trim : x + w - trim] = True
        wide[max(0, x - margin) : x + w + margin] = True
    return inside, ~wide if (~wide).sum() >= 5 else ~inside


def _floor(
    evidence: Evidence, columns: Columns, top: int, bottom: int, storey: float, floor: int
) -> list[Box]:
    inside, between = _masks(columns, evidence.width, storey)
    lightness = evidence.lab[top:bottom, :, 0]
    plain = float(np.percentile(lightness[:, between], 60))
    dark = np.clip((plain - lightness) / 30, -1, 2)
    unlike = np.minimum(columns.wall.unlike[top:bottom], 50)
    edges = np.minimum(np.abs(evidence.gy[top:bottom]), 25)[:, inside].mean(1)
    edges = (edges - edges.mean()) / (float(edges.std()) + 1e-6)
    y, end = _window_rows(unlike[:, inside].mean(1), edges, storey)
    boxes = [
        Box("window", x, top + y, w, end - y, floor, k, 0.5)
        for k, (x, w) in enumerate(columns.stripes)
    ]
    texture = np.clip(np.minimum(np.abs(evidence.gx[top:bottom]), 20) / 5 - 1.5, -1, 2)
    railing = blur_line((0.5 * texture + dark)[:, between].mean(1), 1.0) - 0.5
    run = _best_run(railing, storey)
    if run is not None:
        boxes.append(
            Box("balcony", 0, top + run[0], evidence.width, run[1] - run[0], floor, None, 0.5)
        )
        return boxes
    split = _railing_row(blur_line(dark[:, inside].mean(1), 1.0), edges, y, end)
    if split is not None:
        boxes += [
            Box("balcony", x, top + split, w, end - split, floor, k, 0.5)
            for k, (x, w) in enumerate(columns.stripes)
        ]
    return boxes


def _window_rows(unlike: Float, edges: Float, storey: float) -> tuple[int, int]:
    """Rows of the window: most of what is unlike wall, between two horizontal edges."""
    height = len(unlike)
    signed = (unlike - two_class_threshold(unlike)) / (float(unlike.std()) + 1e-6)
    running = np.concatenate([[0], np.cumsum(np.clip(signed, -1.5, 1.5))])
    start, end = np.meshgrid(np.arange(height), np.arange(height + 1), indexing="ij")
    gain = (running[end] - running[start]) * 2 / storey
    gain += 0.05 * (edges[start] + edges[np.minimum(end, height - 1)])
    span = end - start
    gain[(span < _WINDOW[0] * storey) | (span >= _WINDOW[1] * storey)] = -np.inf
    best = int(np.argmax(gain))
    return best // (height + 1), best % (height + 1)


def _best_run(railing: Float, storey: float) -> tuple[int, int] | None:
    """Rows of a balcony that runs along the wall, where the wall shows one."""
    height = len(railing)
    running = np.concatenate([[0], np.cumsum(railing)])
    start, end = np.meshgrid(np.arange(height), np.arange(height + 1), indexing="ij")
    gain = running[end] - running[start]
    span = end - start
    gain[(span < _RAILING[0] * storey) | (span > _RAILING[1] * storey)] = -np.inf
    best = int(np.argmax(gain))
    if gain.flat[best] < 0.05 * storey:
        return None
    return best // (height + 1), best % (height + 1)


def _railing_row(dark: Float, edges: Float, top: int, bottom: int) -> int | None:
    """Row at which a railing in front of the window begins, where one shows."""
    height = bottom - top
    rows = range(top + int(0.4 * height), bottom - int(0.14 * height))
    found = [
        (float(dark[k:bottom].mean() - dark[top + 2 : k].mean() + 0.15 * edges[k]), k)
        for k in rows
        if k > top + 2
    ]
    if not found or max(found)[0] <= 0.1:
        return None
    return max(found)[1]
