"""Paris, second half of the 19th century: stone, iron balconies, shops, a mansard of zinc."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.layout import (
    Balcony,
    Band,
    Chimney,
    Layout,
    Opening,
    Paint,
    RailPattern,
    Rect,
    Roof,
    centred,
    column_centres,
)
from veduta.synthetic.panes import WindowLook
from veduta.synthetic.styles.colours import pick

PATTERNS: tuple[RailPattern, ...] = ("rings", "crosses", "scrolls")


def haussmann(rng: np.random.Generator, floors: int | None, columns: int | None) -> Layout:
    """Running balconies on the second and the last floor, single railings on the others."""
    floors = floors or int(rng.integers(5, 7))
    columns = columns or int(rng.integers(3, 6))
    heights = [float(rng.uniform(3.9, 4.4))]
    heights += [float(rng.uniform(3.15, 3.4)) - 0.06 * min(i, 4) for i in range(floors - 1)]
    margin = float(rng.uniform(0.35, 0.7))
    width = columns * float(rng.uniform(2.45, 2.9)) + 2 * margin
    centres = column_centres(width, columns, margin)
    openings, balconies = _upper_floors(rng, tuple(heights), centres, width)
    openings += _ground_floor(rng, centres, width, heights[0])
    eaves = sum(heights)
    bands = (
        Band(0.0, 0.35, 0.05),
        Band(heights[0] - 0.24, 0.2, 0.14),
        Band(eaves - 0.42, 0.42, 0.36, cornice=True),
    )
    return Layout(
        style="haussmann",
        width_m=width,
        depth_m=11.0,
        floors_m=tuple(heights),
        columns=columns,
        roof=_roof(rng, width, eaves, centres),
        paint=_paint(rng),
        openings=tuple(openings),
        balconies=tuple(balconies),
        bands=bands,
        setback_m=0.26,
    )


def _upper_floors(
    rng: np.random.Generator,
    heights_m: tuple[float, ...],
    centres_m: tuple[float, ...],
    width_m: float,
) -> tuple[list[Opening], list[Balcony]]:
    """French windows from the floor up, each behind a railing."""
    window_m = float(rng.uniform(1.12, 1.3))
    pattern = PATTERNS[int(rng.integers(len(PATTERNS)))]
    last = len(heights_m) - 1
    openings: list[Opening] = []
    balconies: list[Balcony] = []
    for floor in range(1, len(heights_m)):
        level = sum(heights_m[:floor])
        clear = heights_m[floor] - (0.72 if floor < last else 0.8)
        running = floor in (2, last)
        for column, x in enumerate(centres_m):
            rect = centred(x, level + 0.12, window_m, clear)
            openings.append(Opening("window", rect, floor, column))
            if not running:
                rail = Rect(rect.x_m - 0.12, level + 0.02, rect.width_m + 0.24, 0.98)
                balconies.append(Balcony(rail, 0.26, floor, column, pattern))
        if running:
            rail = Rect(0.15, level - 0.14, width_m - 0.3, 1.16)
            balconies.append(Balcony(rail, 0.7, floor, None, pattern))
    return openings, balconies


def _ground_floor(
    rng: np.random.Generator, centres_m: tuple[float, ...], width_m: float, height_m: float
) -> list[Opening]:
    """A door in one bay and shop fronts in what is left and right of it."""
    columns = len(centres_m)
    bay = int(rng.integers(columns))
    door = centred(centres_m[bay], 0.0, 1.4, 3.0)
    openings = [Opening("door", door, 0, bay, fanlight_m=0.6)]
    gap = 0.45
    for left, right, column in (
        (gap, door.x_m - gap, 0),
        (door.right_m + gap, width_m - gap, columns - 1),
    ):
        if right - left > 1.4:
            rect = Rect(left, 0.0, right - left, height_m - 0.5)
            openings.append(Opening("shop", rect, 0, column, surround=False))
    return openings


def _roof(
    rng: np.random.Generator, width_m: float, eaves_m: float, centres_m: tuple[float, ...]
) -> Roof:
    """A mansard with a dormer on every axis, and chimney walls at one end or both."""
    rise = float(rng.uniform(2.5, 3.0))
    far = width_m - 0.7
    ends = [0.0, far] if rng.random() < 0.6 else [float(rng.choice([0.0, far]))]
    chimneys = tuple(
        Chimney(x, eaves_m + rise - 1.2, 0.7, 2.3 + 0.4 * float(rng.random()), 1.6, 2.6, 5)
        for x in ends
    )
    return Roof(
        kind="mansard",
        cover="zinc" if rng.random() < 0.7 else "slate",
        rise_m=rise,
        run_m=1.0,
        dormers=tuple(centred(x, eaves_m + 0.45, 1.0, 1.5) for x in centres_m),
        chimneys=chimneys,
    )


def _paint(rng: np.random.Generator) -> Paint:
    return Paint(
        wall="ashlar",
        wall_colour=pick(rng, [(0.83, 0.77, 0.66), (0.80, 0.75, 0.67), (0.86, 0.80, 0.68)]),
        trim=pick(rng, [(0.84, 0.79, 0.70)]),
        door=pick(rng, [(0.17, 0.24, 0.19), (0.24, 0.12, 0.09), (0.10, 0.15, 0.26)]),
        shop=pick(rng, [(0.15, 0.26, 0.22), (0.36, 0.10, 0.11), (0.13, 0.17, 0.28)]),
        sign=(0.85, 0.75, 0.45),
        iron=(0.07, 0.075, 0.08),
        shutter=(0.75, 0.75, 0.73),
        roof=(0.30, 0.33, 0.38),
        window=WindowLook("casement", (0.88, 0.87, 0.84), "sheer", (0.90, 0.88, 0.83)),
    )
