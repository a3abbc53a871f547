"""The driven path over the surface model (the paper's figure 3), and what was corrected of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.drive.document.model import Correction, DriveSegment
from veduta.drive.record import Overview
from veduta.run.page import Table
from veduta.run.report import Count

Floats = NDArray[np.float64]
Pixels = NDArray[np.uint8]
MARGIN_M = 30.0
"""What of the surface model is shown around the path."""
_OUTSIDE = (24, 24, 28)
_FATES = {"build": (90, 220, 120), "as-is": (250, 170, 60), "leave-out": (190, 190, 190)}


@dataclass(frozen=True)
class PathReportParameters:
    """longest_px: the picture's longer side. finest: pixels of a metre at most. beside_m: segments
    are drawn so far beside the path, on the side to which they look. larger: corrections are drawn
    so many times as long as they are. every_m: one is drawn so often. most_rows: of the table.
    """

    longest_px: int = 1400
    finest: float = 12.0
    beside_m: float = 2.5
    larger: float = 10.0
    every_m: float = 8.0
    most_rows: int = 40


class _Canvas:
    """A picture from above. low: (2,) of its lower left corner (m), scale: pixels of a metre."""

    def __init__(self, base: Overview, low: Floats, high: Floats, scale: float) -> None:
        size = np.ceil((high - low) * scale).astype(int)
        self.low, self.scale, self.height = low, scale, int(size[1])
        map_of = np.array([
            [scale * base.cell_m, 0.0, (base.low[0] - low[0]) * scale],
            [0.0, scale * base.cell_m, (base.low[1] - low[1]) * scale],
        ])  # fmt: skip
        drawn = np.full((int(size[1]), int(size[0]), 3), _OUTSIDE, dtype=np.uint8)
        if base.pixels.size:
            cv2.warpAffine(
                base.pixels, map_of, (int(size[0]), int(size[1])), dst=drawn,
                flags=cv2.INTER_NEAREST, borderMode=cv2.BORDER_TRANSPARENT,
            )  # fmt: skip
        self.pixels: Pixels = np.ascontiguousarray(drawn[::-1])

    def at(self, places: Floats) -> NDArray[np.int32]:
        """(n, 2) pixels, in sixteenths, of (n, 2) places."""
        across = (places - self.low) * self.scale
        across[:, 1] = self.height - across[:, 1]
        return np.rint(across * 16).astype(np.int32)

    def line(self, places: Floats, colour: tuple[int, int, int], width: int) -> None:
        """Through all places."""
        cv2.polylines(self.pixels, [self.at(places)], False, colour, width, cv2.LINE_AA, 4)

    def name(self, place: Floats, text: str, colour: tuple[int, int, int]) -> None:
        """Written beside a place, with a dark rim."""
        x, y = (self.at(place[None])[0] // 16).tolist()
        for tone, width in (((15, 15, 18), 3), (colour, 1)):
            cv2.putText(
                self.pixels,
                text,
                (x + 4, y),
                cv2.FONT_HERSHEY_SIMPLEX,
                0.42,
                tone,
                width,
                cv2.LINE_AA,
            )


def path_picture(
    base: Overview,
    line: Floats,
    segments: Sequence[DriveSegment],
    moved: Sequence[tuple[Floats, Floats]],
    parameters: PathReportParameters | None = None,
) -> Pixels:
    """(h, w, 3). line: (n, 3) the path (m, world). moved: of each correction where it ends, and by
    how much (m): drawn from where the path was, enlarged.
    """
    chosen = parameters or PathReportParameters()
    low, high = line[:, :2].min(axis=0) - MARGIN_M, line[:, :2].max(axis=0) + MARGIN_M
    scale = min(chosen.longest_px / float((high - low).max()), chosen.finest)
    canvas = _Canvas(base, low, high, scale)
    canvas.line(line[:, :2], (20, 20, 24), 5)
    canvas.line(line[:, :2], (255, 255, 255), 2)
    for one in segments:
        own = np.array(one.line)[:, :2]
        along = np.gradient(own, axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        left = np.column_stack([-along[:, 1], along[:, 0]])
        side = chosen.beside_m if one.side == "left" else -chosen.beside_m
        canvas.line(own + side * left, _FATES[one.fate], 3)
        canvas.name(own[len(own) // 2] + side * left[len(own) // 2], one.id, _FATES[one.fate])
    last = np.full(2, np.inf)
    for place, by in moved:
        if np.linalg.norm(place[:2] - last) >= chosen.every_m:
            canvas.line(np.stack([place[:2] - chosen.larger * by[:2], place[:2]]), (255, 80, 80), 2)
            last = place[:2]
    start = (canvas.at(line[:1, :2])[0] // 16).tolist()
    cv2.circle(canvas.pixels, (start[0], start[1]), 6, (90, 170, 255), -1, cv2.LINE_AA)
    _bar(canvas)
    return canvas.pixels


def _bar(canvas: _Canvas) -> None:
    """A scale in the lower left corner."""
    length = 50.0 if canvas.pixels.shape[1] / canvas.scale > 120.0 else 10.0
    begin = canvas.low + 12.0 / canvas.scale
    canvas.line(np.stack([begin, begin + [length, 0.0]]), (255, 255, 255), 3)
    canvas.name(begin + [0.0, 6.0 / canvas.scale], f"{length:.0f} m", (255, 255, 255))


def corrections_table(
    corrections: Sequence[Correction], parameters: PathReportParameters | None = None
) -> Table:
    """Each with its reason; of many, some at equal distances, the largest among them."""
    chosen = parameters or PathReportParameters()
    length = np.array([float(np.linalg.norm(one.moved_m)) for one in corrections])
    rows = np.arange(len(corrections))
    if len(rows) > chosen.most_rows:
        even = np.linspace(0, len(rows) - 1, chosen.most_rows - 1).astype(int)
        rows = np.unique(np.append(even, int(length.argmax())))
    told: list[list[Count | None]] = []
    for row in rows.tolist():
        one = corrections[row]
        told.append([one.sweep, *(round(value, 3) for value in one.moved_m),
                     round(float(length[row]), 3), one.reason])  # fmt: skip
    note = (
        f"{len(corrections)} corrections, {length.mean():.2f} m on average and {length.max():.2f} m"
        f" at most; {len(told)} are shown, drive.json has all"
    )
    columns = ["scan", "to the east (m)", "to the north (m)", "up (m)", "by (m)", "why"]
    return Table("Corrections of the path", columns, told, note=note)
