"""English terrace: two bays of brick a house, sash windows, a panelled door with a fanlight."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.layout import (
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


def terrace(rng: np.random.Generator, floors: int | None, columns: int | None) -> Layout:
    """Two or three houses that share one wall; no balconies."""
    floors = floors or int(rng.integers(2, 5))
    columns = columns or int(rng.choice([4, 6]))
    house = 2 if columns % 2 == 0 else columns
    heights = [float(rng.uniform(3.2, 3.5))]
    heights += [float(rng.uniform(2.9, 3.2)) for _ in range(floors - 1)]
    width = columns * float(rng.uniform(2.3, 2.7)) + 0.5
    centres = column_centres(width, columns, 0.25)
    eaves = sum(heights)
    return Layout(
        style="terrace",
        width_m=width,
        depth_m=9.0,
        floors_m=tuple(heights),
        columns=columns,
        roof=_roof(rng, width, eaves, columns, house),
        paint=_paint(rng),
        openings=tuple(_openings(rng, tuple(heights), centres, house)),
        bands=(Band(0.0, 0.3, 0.04), Band(eaves - 0.22, 0.22, 0.2, cornice=True)),
        setback_m=0.12,
    )


def _openings(
    rng: np.random.Generator, heights_m: tuple[float, ...], centres_m: tuple[float, ...], house: int
) -> list[Opening]:
    """A door in the first bay of each house, sash windows everywhere else."""
    window_m = float(rng.uniform(0.98, 1.16))
    openings = []
    for floor, height in enumerate(heights_m):
        level = sum(heights_m[:floor])
        tall = height - (1.45 if floor < len(heights_m) - 1 else 1.55)
        for column, x in enumerate(centres_m):
            if floor == 0 and column % house == 0:
                door = Rect(x - 0.5, 0.0, 1.0, 2.65)
                openings.append(Opening("door", door, 0, column, fanlight_m=0.45))
            else:
                rect = centred(x, level + 0.85, window_m, tall)
                openings.append(Opening("window", rect, floor, column))
    return openings


def _roof(
    rng: np.random.Generator, width_m: float, eaves_m: float, columns: int, house: int
) -> Roof:
    """Slates at a plain pitch; a stack over every party wall."""
    rise = float(rng.uniform(2.2, 2.9))
    party = [width_m * i * house / columns - 0.55 for i in range(1, columns // house)]
    foot = eaves_m + rise - 0.5
    chimneys = tuple(Chimney(x, foot, 1.1, 1.5, 3.6, 0.8, 4) for x in party or [width_m - 1.4])
    return Roof("pitched", "slate", rise, 4.0, 0.15, (), chimneys)


def _paint(rng: np.random.Generator) -> Paint:
    doors = [(0.10, 0.20, 0.34), (0.42, 0.08, 0.08), (0.08, 0.24, 0.16), (0.1, 0.1, 0.1)]
    return Paint(
        wall="brick",
        wall_colour=pick(rng, [(0.58, 0.29, 0.21), (0.66, 0.52, 0.35), (0.50, 0.25, 0.20)]),
        trim=pick(rng, [(0.87, 0.85, 0.79)]),
        door=pick(rng, doors),
        shop=(0.2, 0.2, 0.22),
        sign=(0.9, 0.9, 0.85),
        iron=(0.06, 0.06, 0.06),
        shutter=(0.3, 0.35, 0.4),
        roof=pick(rng, [(0.31, 0.33, 0.37), (0.36, 0.34, 0.35)]),
        window=WindowLook(
            "sash", (0.92, 0.92, 0.90), "drapes", (0.85, 0.80, 0.72), 3, 0.055, 0.025
        ),
    )
