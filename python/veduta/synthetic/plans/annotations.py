"""Around the house: dimension lines, a scale bar, the ratio and the title."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from veduta.synthetic.plans.canvas import Canvas
from veduta.synthetic.plans.house import Storey
from veduta.synthetic.plans.names import STOREYS
from veduta.synthetic.plans.styles import Style

CHAIN_M = 0.75
TOTAL_M = 1.35
TICK_M = 0.09
INK_GAP_M = 0.14
LEAST_STEP_M = 0.6
RATIO = 100


def draw_dimension_lines(
    canvas: Canvas, style: Style, storey: Storey, bounds: tuple[float, float, float, float]
) -> None:
    """Below and left of the house: a chain by the walls that end there, and the whole."""
    left, bottom, right, top = bounds
    xs = _chain([(w.start_m, w.end_m) for w in storey.walls], 0, left, right)
    ys = _chain([(w.start_m, w.end_m) for w in storey.walls], 1, bottom, top)
    for places, off in ((xs, CHAIN_M), ([left, right], TOTAL_M)):
        _row(canvas, style, places, bottom - off, False)
    for places, off in ((ys, CHAIN_M), ([bottom, top], TOTAL_M)):
        _row(canvas, style, places, left - off, True)


def _chain(
    ends: Sequence[tuple[tuple[float, float], tuple[float, float]]],
    axis: int,
    low: float,
    high: float,
) -> list[float]:
    """Places along an axis: both faces, and the centres of long walls across it."""
    across: dict[float, float] = {}
    for start, end in ends:
        if abs(start[axis] - end[axis]) < 1e-6:
            place = round(start[axis], 3)
            across[place] = across.get(place, 0.0) + abs(start[1 - axis] - end[1 - axis])
    inner = [place for place, length in sorted(across.items()) if length > 1.5]
    chain = [low]
    for place in inner:
        if place - chain[-1] > LEAST_STEP_M and high - place > LEAST_STEP_M:
            chain.append(place)
    return [*chain, high]


def _row(canvas: Canvas, style: Style, places: Sequence[float], at: float, upright: bool) -> None:
    def spot(along: float, off: float = 0.0) -> tuple[float, float]:
        return (at + off, along) if upright else (along, at + off)

    pen = 0.7 * style.pen_px
    canvas.line([spot(places[0] - TICK_M), spot(places[-1] + TICK_M)], pen, style.ink)
    for place in places:
        canvas.line(
            [spot(place - TICK_M, -TICK_M), spot(place + TICK_M, TICK_M)], style.pen_px, style.ink
        )
        canvas.line([spot(place, -1.6 * TICK_M), spot(place, 1.6 * TICK_M)], pen, style.ink)
    height = float(np.clip(0.17 / canvas.metres_per_px, 9.0, 18.0))
    lift = 0.75 * height * canvas.metres_per_px + 0.02
    for low, high in pairwise(places):
        text = f"{high - low:.2f}"
        if style.sizes in ("comma", "area"):
            text = text.replace(".", ",")
        middle = spot((low + high) / 2, -lift if upright else lift)
        canvas.text(text, middle, height, style.font, style.ink, upright=not upright)


def draw_scale_bar(canvas: Canvas, style: Style, corner: tuple[float, float]) -> None:
    """A bar of five metres with its first metre black, from its lower left corner."""
    x, y = corner
    height = float(np.clip(0.17 / canvas.metres_per_px, 9.0, 18.0))
    for start in range(5):
        bar = [(x + start, y), (x + start + 1, y), (x + start + 1, y + 0.1), (x + start, y + 0.1)]
        canvas.line(bar, 0.8 * style.pen_px, style.ink, True)
        if start % 2 == 0:
            canvas.line(
                [(x + start, y + 0.05), (x + start + 1, y + 0.05)],
                0.08 / canvas.metres_per_px,
                style.ink,
            )
    for mark in (0, 1, 5):
        text = f"{mark} m" if mark == 5 else str(mark)
        canvas.text(
            text,
            (x + mark, y + 0.14 + 0.6 * height * canvas.metres_per_px),
            height,
            style.font,
            style.ink,
        )


def draw_title(
    canvas: Canvas, style: Style, number: int, area_m2: float, at: tuple[float, float]
) -> None:
    """The storey's name and its floor area, centred."""
    height = float(np.clip(0.3 / canvas.metres_per_px, 15.0, 32.0))
    name = STOREYS[style.language][number]
    canvas.text(name, at, height, style.font, style.ink, max(style.weight, 600))
    if style.sizes.startswith("feet"):
        words = f"Approx. {area_m2:.1f} sq m ({area_m2 / 0.09290304:.0f} sq ft)"
    else:
        words = f"{area_m2:.1f} m²".replace(".", ",")
    below = (at[0], at[1] - 1.3 * height * canvas.metres_per_px)
    canvas.text(words, below, 0.7 * height, style.font, style.ink)


def draw_ratio(canvas: Canvas, style: Style, at: tuple[float, float]) -> None:
    """`1:100`; the file says how many pixels a metre of paper has."""
    height = float(np.clip(0.22 / canvas.metres_per_px, 11.0, 22.0))
    canvas.text(f"1:{RATIO}", at, height, style.font, style.ink)
