"""A painted town house of the south: shutters, one balcony over the door, clay tiles."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.layout import (
    Balcony,
    Band,
    Chimney,
    Layout,
    Opening,
    Paint,
    Rect,
    Roof,
    centred,
    column_centres,
)
from veduta.synthetic.panes import WindowLook
from veduta.synthetic.styles.colours import pick


def stucco(rng: np.random.Generator, floors: int | None, columns: int | None) -> Layout:
    """Windows with surrounds and (often) shutters; the door in the middle."""
    floors = floors or int(rng.integers(3, 6))
    columns = columns or int(rng.integers(3, 6))
    heights = [float(rng.uniform(3.5, 3.9))]
    heights += [float(rng.uniform(3.0, 3.4)) for _ in range(floors - 1)]
    width = columns * float(rng.uniform(2.7, 3.2)) + 1.0
    centres = column_centres(width, columns, 0.5)
    openings = _openings(rng, tuple(heights), centres)
    rail = Rect(centres[columns // 2] - 1.0, heights[0] - 0.14, 2.0, 1.14)
    balconies = (Balcony(rail, 0.8, 1, columns // 2, "bars"),) if floors > 1 else ()
    eaves = sum(heights)
    stack = Chimney(width * float(rng.uniform(0.15, 0.8)), eaves + 0.9, 0.7, 1.6, 2.4, 0.7, 2)
    return Layout(
        style="stucco",
        width_m=width,
        depth_m=10.0,
        floors_m=tuple(heights),
        columns=columns,
        roof=Roof("pitched", "tiles", 1.9, 4.5, 0.45, (), (stack,)),
        paint=_paint(rng),
        openings=tuple(openings),
        balconies=balconies,
        bands=(
            Band(0.0, 0.7, 0.05),
            Band(heights[0] - 0.2, 0.16, 0.09),
            Band(eaves - 0.34, 0.34, 0.24, cornice=True),
        ),
        setback_m=0.2,
    )


def _openings(
    rng: np.random.Generator, heights_m: tuple[float, ...], centres_m: tuple[float, ...]
) -> list[Opening]:
    window_m = float(rng.uniform(0.98, 1.12))
    shutters = bool(rng.random() < 0.6)
    entrance = len(centres_m) // 2
    openings = []
    for floor, height in enumerate(heights_m):
        level = sum(heights_m[:floor])
        tall = height - (1.4 if floor < len(heights_m) - 1 else 1.5)
        for column, x in enumerate(centres_m):
            if floor == 0 and column == entrance:
                door = centred(x, 0.0, 1.3, 2.75)
                openings.append(Opening("door", door, 0, column, 0.5))
            elif floor == 1 and column == entrance:
                rect = centred(x, level + 0.1, window_m + 0.1, tall + 0.65)
                openings.append(Opening("window", rect, floor, column))
            else:
                rect = centred(x, level + (1.0 if floor == 0 else 0.75), window_m, tall)
                closable = shutters and floor > 0
                openings.append(Opening("window", rect, floor, column, shutters=closable))
    return openings


def _paint(rng: np.random.Generator) -> Paint:
    walls = [
        (0.86, 0.72, 0.46),
        (0.82, 0.62, 0.50),
        (0.84, 0.82, 0.74),
        (0.66, 0.75, 0.72),
        (0.84, 0.66, 0.56),
    ]
    return Paint(
        wall="stucco",
        wall_colour=pick(rng, walls),
        trim=pick(rng, [(0.91, 0.89, 0.83)]),
        door=pick(rng, [(0.30, 0.18, 0.10), (0.16, 0.26, 0.22)]),
        shop=(0.3, 0.2, 0.15),
        sign=(0.9, 0.85, 0.7),
        iron=(0.08, 0.08, 0.08),
        shutter=pick(rng, [(0.22, 0.38, 0.31), (0.36, 0.25, 0.18), (0.30, 0.40, 0.50)]),
        roof=pick(rng, [(0.70, 0.38, 0.25), (0.62, 0.35, 0.25)]),
        window=WindowLook("casement", (0.90, 0.89, 0.86), "sheer", (0.88, 0.86, 0.82), 3),
    )
