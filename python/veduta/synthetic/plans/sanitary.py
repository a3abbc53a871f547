"""Baths, basins, toilets, kitchens and beds as drawn by hand: rounded, with taps and drains.

Each says what it drew, so that a truth of fittings is what stands on the sheet.
"""

from __future__ import annotations

import math

import numpy as np
from shapely.geometry import Point, box

from veduta.synthetic.plans.canvas import Canvas, Colour
from veduta.synthetic.plans.house import Fitting

Spot = tuple[float, float]


def bath(canvas: Canvas, at: Spot, pen_px: float, ink: Colour) -> Fitting:
    """0.72 by 1.7 m with its head at the top; `at` is the lower left corner in metres."""
    x, y = at
    canvas.outline(box(x, y, x + 0.72, y + 1.7), pen_px, ink)
    inner = box(x + 0.24, y + 0.24, x + 0.48, y + 1.46).buffer(0.16)
    canvas.outline(inner, pen_px, ink)
    canvas.outline(Point(x + 0.36, y + 1.46).buffer(0.04), pen_px, ink)
    for side in (0.3, 0.42):
        canvas.outline(Point(x + side, y + 1.64).buffer(0.025), pen_px, ink)
    return Fitting("bathtub", (x, y, x + 0.72, y + 1.7))


def basin(canvas: Canvas, at: Spot, pen_px: float, ink: Colour) -> Fitting:
    """0.42 deep and 0.55 wide on a wall at its left."""
    x, y = at
    half = [
        (x + 0.42 * math.sin(turn), y + 0.275 - 0.275 * math.cos(turn))
        for turn in np.linspace(0.0, math.pi, 24)
    ]
    canvas.line([(x, y), *half, (x, y + 0.55)], pen_px, ink, closed=True)
    canvas.outline(Point(x + 0.2, y + 0.275).buffer(0.13), pen_px, ink)
    canvas.outline(Point(x + 0.05, y + 0.275).buffer(0.02), pen_px, ink)
    return Fitting("basin", (x, y, x + 0.42, y + 0.55))


def closet(canvas: Canvas, at: Spot, pen_px: float, ink: Colour) -> Fitting:
    """A cistern on a wall at its left, and the bowl before it."""
    x, y = at
    canvas.outline(box(x, y, x + 0.18, y + 0.42), pen_px, ink)
    turn = np.linspace(0.0, 2.0 * math.pi, 40)
    bowl = np.column_stack([x + 0.4 + 0.24 * np.cos(turn), y + 0.21 + 0.18 * np.sin(turn)])
    canvas.line(bowl, pen_px, ink, closed=True)
    canvas.line(0.7 * bowl + 0.3 * np.array([x + 0.42, y + 0.21]), pen_px, ink, closed=True)
    return Fitting("toilet", (x, y, x + 0.64, y + 0.42))


def counter(
    canvas: Canvas, run: tuple[float, float, float], pen_px: float, ink: Colour
) -> tuple[Fitting, ...]:
    """Along a wall at its right from one height to another, with a hob and a sink in it.

    `run` is the wall's face and the two ends in metres.
    """
    face, low, high = run
    if high - low < 1.9:
        return ()
    canvas.outline(box(face - 0.6, low, face, high), pen_px, ink)
    hob = (face - 0.3, low + 0.45)
    canvas.outline(box(hob[0] - 0.25, hob[1] - 0.28, hob[0] + 0.25, hob[1] + 0.28), pen_px, ink)
    for dx, dy in ((-0.12, -0.13), (0.12, -0.13), (-0.12, 0.13), (0.12, 0.13)):
        radius = 0.09 if dx * dy > 0.0 else 0.07
        canvas.outline(Point(hob[0] + dx, hob[1] + dy).buffer(radius), pen_px, ink)
    bowl = box(face - 0.45, high - 0.72, face - 0.15, high - 0.34).buffer(0.05)
    canvas.outline(bowl, pen_px, ink)
    for rib in np.arange(high - 1.2, high - 0.84, 0.08):
        canvas.line([(face - 0.48, rib), (face - 0.12, rib)], 0.7 * pen_px, ink)
    return (
        Fitting("hob", (hob[0] - 0.25, hob[1] - 0.28, hob[0] + 0.25, hob[1] + 0.28)),
        Fitting("kitchen-sink", (face - 0.5, high - 1.2, face - 0.1, high - 0.29)),
    )


def bed(canvas: Canvas, at: Spot, pen_px: float, ink: Colour) -> Fitting:
    """1.4 by 2 m with its head at the top, two pillows and a cover that is turned back."""
    x, y = at
    canvas.outline(box(x, y, x + 1.4, y + 2.0), pen_px, ink)
    for left in (x + 0.12, x + 0.75):
        canvas.outline(box(left + 0.05, y + 1.62, left + 0.48, y + 1.84).buffer(0.05), pen_px, ink)
    canvas.line([(x, y + 1.35), (x + 1.4, y + 1.35)], pen_px, ink)
    canvas.line([(x + 0.9, y + 1.35), (x + 1.4, y + 0.95)], pen_px, ink)
    return Fitting("bed", (x, y, x + 1.4, y + 2.0))
