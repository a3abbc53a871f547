"""The plan with the tour: the way coloured by time, where one looks, and the stops by numbers."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from veduta.imaging.lettering import write
from veduta.plan.drawing import Drawing, Shape
from veduta.plan.outputs.colours import USE_COLOURS, Rgb, rgb
from veduta.plan.outputs.overlay import haloed
from veduta.plan.tour.find import EYE_M, Tour

SIDE_PX = 1500
"""Of the longer side of a storey."""
MARGIN_M = 0.8
LOOK_S = 1.0
"""A line of sight is drawn so often."""
LOOK_M = 0.55
_PAPER: Rgb = (250, 249, 246)
_WALL: Rgb = (70, 78, 88)
_LINE: Rgb = (150, 158, 166)
_INK: Rgb = (31, 42, 55)
_ROOM = 0.35
_SHIFT = 4
_FIRST: Rgb = (30, 90, 190)
_LAST: Rgb = (205, 50, 60)


def tour_picture(drawings: Sequence[Drawing], tour: Tour) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB: the storeys that the tour passes, below each other."""
    panels = [_storey(drawing, tour) for drawing in drawings if _on(drawing, tour).any()]
    width = max(panel.shape[1] for panel in panels)
    canvas = np.full((sum(panel.shape[0] for panel in panels), width, 3), _PAPER, dtype=np.uint8)
    top = 0
    for panel in panels:
        canvas[top : top + panel.shape[0], : panel.shape[1]] = panel
        top += panel.shape[0]
    return canvas


class _Sheet:
    """A picture of a part of the plan."""

    def __init__(self, low_m: NDArray[np.float64], high_m: NDArray[np.float64]) -> None:
        size = high_m - low_m
        self.scale = SIDE_PX / float(size.max())
        self.origin = np.array([low_m[0], high_m[1]])
        width, height = np.ceil(size * self.scale).astype(int).tolist()
        self.pixels = np.full((height, width, 3), _PAPER, dtype=np.uint8)

    def at(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """(n, 2) pixels."""
        placed: NDArray[np.float64] = (points_m - self.origin) * [self.scale, -self.scale]
        return placed

    def fine(self, points_m: NDArray[np.float64]) -> NDArray[np.int32]:
        """(n, 2) as OpenCV takes them."""
        return np.round((self.at(points_m) - 0.5) * (1 << _SHIFT)).astype(np.int32)

    def line(self, points_m: NDArray[np.float64], colour: Rgb, width: int) -> None:
        """An open line."""
        cv2.polylines(self.pixels, [self.fine(points_m)], False, colour, width, cv2.LINE_AA, _SHIFT)


def _on(drawing: Drawing, tour: Tour) -> NDArray[np.bool_]:
    """(n,) the keys of the tour in a storey."""
    height = tour.path.eyes_m[:, 2] - EYE_M
    storey = drawing.storey
    on: NDArray[np.bool_] = np.abs(height - storey.elevation_m) < storey.height_m / 2.0
    return on


def _storey(drawing: Drawing, tour: Tour) -> NDArray[np.uint8]:
    on = _on(drawing, tour)
    eyes = tour.path.eyes_m[on, :2]
    left, bottom, right, top = drawing.bounds_m
    low = np.minimum([left, bottom], eyes.min(axis=0)) - MARGIN_M
    high = np.maximum([right, top], eyes.max(axis=0)) + MARGIN_M
    sheet = _Sheet(low, high)
    for shape in drawing.shapes:
        _draw(sheet, shape)
    _draw_way(sheet, tour, on)
    image = Image.fromarray(sheet.pixels)
    _write(ImageDraw.Draw(image), sheet, drawing, tour, on)
    return np.asarray(image, dtype=np.uint8)


def _draw(sheet: _Sheet, shape: Shape) -> None:
    rings = [sheet.fine(ring) for ring in shape.rings]
    if shape.layer == "rooms":
        colour = np.array(rgb({str(use): code for use, code in USE_COLOURS.items()}[shape.kind]))
        pale = np.array(_PAPER) + _ROOM * (colour - np.array(_PAPER))
        cv2.fillPoly(sheet.pixels, rings, pale.tolist(), cv2.LINE_AA, _SHIFT)
    elif shape.layer == "walls":
        cv2.fillPoly(sheet.pixels, rings, _WALL, cv2.LINE_AA, _SHIFT)
    else:
        for line in (*shape.lines, *(np.vstack([ring, ring[:1]]) for ring in shape.rings)):
            sheet.line(line, _LINE, 1)


def _draw_way(sheet: _Sheet, tour: Tour, on: NDArray[np.bool_]) -> None:
    path = tour.path
    share = path.times_s / path.times_s[-1]
    for row in np.flatnonzero(on[:-1] & on[1:]):
        sheet.line(path.eyes_m[row : row + 2, :2], _at_share(float(share[row])), 3)
    seconds = np.arange(0.0, path.times_s[-1], LOOK_S)
    rows = np.unique(np.searchsorted(path.times_s, seconds))
    for row in rows[on[rows]]:
        eye, way = path.eyes_m[row, :2], path.directions[row, :2]
        sheet.line(np.stack([eye, eye + LOOK_M * way]), _at_share(float(share[row])), 1)


def _at_share(share: float) -> Rgb:
    """From the first colour to the last."""
    mixed = (1.0 - share) * np.array(_FIRST) + share * np.array(_LAST)
    red, green, blue = mixed.round().astype(int).tolist()
    return (red, green, blue)


def _write(
    pen: ImageDraw.ImageDraw, sheet: _Sheet, drawing: Drawing, tour: Tour, on: NDArray[np.bool_]
) -> None:
    """Names of rooms, and numbers in the order in which one comes into them first."""
    for label in drawing.labels:
        at = sheet.at(np.array([label.at_m]))[0]
        haloed(pen, (float(at[0]), float(at[1])), label.text, 21, _INK)
    seen: dict[str, int] = {}
    path = tour.path
    for stretch in tour.stretches:
        if stretch.room is None:
            continue
        middle = (stretch.start_s + stretch.end_s) / 2.0
        row = int(np.searchsorted(path.times_s, middle))
        key = f"{stretch.room} {round(float(path.eyes_m[row, 2]), 1)}"
        number = seen.setdefault(key, len(seen) + 1)
        if not on[row] or number != len(seen):
            continue
        at = sheet.at(path.eyes_m[row : row + 1, :2])[0]
        _badge(
            pen,
            (float(at[0]), float(at[1])),
            str(number),
            _at_share(middle / path.times_s[-1]),
        )
    place = (MARGIN_M * sheet.scale / 2, MARGIN_M * sheet.scale / 3)
    words = f"{drawing.storey.name}: {tour.length_m:.0f} m, {path.times_s[-1]:.0f} s"
    write(pen, place, words, 21, _INK, anchor="left")


def _badge(
    pen: ImageDraw.ImageDraw,
    at: tuple[float, float],
    text: str,
    colour: Rgb,
) -> None:
    x, y = at
    pen.ellipse((x - 12, y - 12, x + 12, y + 12), fill=colour, outline=_PAPER, width=2)
    write(pen, at, text, 16, _PAPER)
