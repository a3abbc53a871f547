"""A plain grid of the second half of the 20th century: panels, wide windows, a flat roof."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.layout import Band, Layout, Opening, Paint, Roof, centred, column_centres
from veduta.synthetic.panes import WindowLook
from veduta.synthetic.styles.colours import pick


def modern(rng: np.random.Generator, floors: int | None, columns: int | None) -> Layout:
    """The same window everywhere, but for the entrance; no balconies, no visible roof."""
    floors = floors or int(rng.integers(4, 8))
    columns = columns or int(rng.integers(4, 8))
    heights = (float(rng.uniform(3.3, 3.7)), *([float(rng.uniform(2.85, 3.1))] * (floors - 1)))
    bay = float(rng.uniform(2.4, 3.0))
    width = columns * bay + 0.6
    window = (float(rng.uniform(0.55, 0.7)) * bay, float(rng.uniform(1.45, 1.75)))
    entrance = int(rng.integers(columns))
    openings = []
    for floor in range(floors):
        level = sum(heights[:floor]) + (0.95 if floor == 0 else 0.88)
        for column, x in enumerate(column_centres(width, columns, 0.3)):
            if floor == 0 and column == entrance:
                door = centred(x, 0.0, 1.8, 2.6)
                openings.append(Opening("door", door, 0, column, 0.5, surround=False))
            else:
                rect = centred(x, level, *window)
                openings.append(Opening("window", rect, floor, column, surround=False))
    return Layout(
        style="modern",
        width_m=width,
        depth_m=12.0,
        floors_m=heights,
        columns=columns,
        roof=Roof("flat", "gravel", 0.0, 0.0),
        paint=_paint(rng, (bay / 2, heights[-1] / 2)),
        openings=tuple(openings),
        bands=(Band(sum(heights) - 0.12, 0.12, 0.06, cornice=True),),
        setback_m=0.18,
    )


def _paint(rng: np.random.Generator, panel_m: tuple[float, float]) -> Paint:
    frame = pick(rng, [(0.24, 0.25, 0.27), (0.90, 0.90, 0.89)])
    return Paint(
        wall="panels",
        wall_colour=pick(rng, [(0.72, 0.72, 0.70), (0.80, 0.77, 0.70), (0.60, 0.56, 0.50)]),
        trim=pick(rng, [(0.45, 0.46, 0.48), (0.72, 0.72, 0.72)]),
        door=(0.22, 0.23, 0.25),
        shop=(0.3, 0.3, 0.32),
        sign=(0.9, 0.9, 0.9),
        iron=(0.5, 0.5, 0.52),
        shutter=(0.5, 0.5, 0.5),
        roof=(0.5, 0.5, 0.48),
        window=WindowLook("tilt", frame, "blind", (0.86, 0.85, 0.81)),
        panel_m=panel_m,
    )
