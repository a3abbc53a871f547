"""The styles: from a seed to a layout. One function per style; sizes are those of real streets."""

from __future__ import annotations

from collections.abc import Callable

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
    Style,
    column_centres,
)
from veduta.synthetic.panes import WindowLook
from veduta.synthetic.seeds import stream
from veduta.synthetic.textures import Colour

Rng = np.random.Generator


def design(style: Style, seed: int, floors: int | None = None, columns: int | None = None) -> Layout:
    """The layout of one facade; `floors` (with the ground floor) and `columns` may be fixed."""
    return _DESIGNERS[style](stream(seed, f"layout {style}"), floors, columns)


def _vary(rng: Rng, colour: Colour, amount: float = 0.03) -> Colour:
    value = np.clip(np.asarray(colour) * (1 + amount * rng.standard_normal()), 0, 1)
    value = np.clip(value + 0.4 * amount * rng.standard_normal(3), 0.02, 0.98)
    return (float(value[0]), float(value[1]), float(value[2]))


def _pick(rng: Rng, colours: list[Colour]) -> Colour:
    return _vary(rng, colours[int(rng.integers(len(colours)))])


def _window_rect(centre_m: float, base_m: float, width_m: float, height_m: float) -> Rect:
    return Rect(centre_m - width_m / 2, base_m, width_m, height_m)


def _haussmann(rng: Rng, floors: int | None, columns: int | None) -> Layout:
    floors = floors or int(rng.integers(5, 7))
    columns = columns or int(rng.integers(3, 6))
    heights = [float(rng.uniform(3.9, 4.4))]
    heights += [float(rng.uniform(3.15, 3.4)) - 0.06 * i for i in range(floors - 1)]
    margin = float(rng.uniform(0.35, 0.7))
    width = columns * float(rng.uniform(2.45, 2.9)) + 2 * margin
    centres = column_centres(width, columns, margin)
    window_w = float(rng.uniform(1.12, 1.3))
    openings: list[Opening] = []
    balconies: list[Balcony] = []
    pattern: RailPattern = ("rings", "crosses", "scrolls")[int(rng.integers(3))]
    running = {2, floors - 1}
    level = heights[0]
    for floor in range(1, floors):
        clear = heights[floor] - (0.72 if floor < floors - 1 else 0.8)
        for column, x in enumerate(centres):
            rect = _window_rect(x, level + 0.12, window_w, clear)
            openings.append(Opening("window", rect, floor, column))
            if floor not in running:
                rail = Rect(rect.x_m - 0.12, level + 0.02, rect.width_m + 0.24, 0.98)
                balconies.append(Balcony(rail, 0.26, floor, column, pattern))
        if floor in running:
            rail = Rect(0.15, level - 0.14, width - 0.3, 1.16)
            balconies.append(Balcony(rail, 0.7, floor, None, pattern))
        level += heights[floor]
    openings += _ground_shops(rng, centres, width, heights[0])
    bands = (
        Band(0.0, 0.35, 0.05),
        Band(heights[0] - 0.24, 0.2, 0.14),
        Band(level - 0.42, 0.42, 0.36, cornice=True),
    )
    rise = float(rng.uniform(2.5, 3.0))
    dormers = tuple(_window_rect(x, level + 0.45, 1.0, 1.5) for x in centres)
    roof = Roof(
        "mansard", "zinc" if rng.random() < 0.7 else "slate", rise, 1.0,
        dormers=dormers, chimneys=_gable_stacks(rng, width, level + rise),
    )  # fmt: skip
    paint = Paint(
        wall="ashlar",
        wall_colour=_pick(rng, [(0.83, 0.77, 0.66), (0.80, 0.75, 0.67), (0.86, 0.80, 0.68)]),
        trim=_pick(rng, [(0.84, 0.79, 0.70)]),
        door=_pick(rng, [(0.17, 0.24, 0.19), (0.24, 0.12, 0.09), (0.10, 0.15, 0.26)]),
        shop=_pick(rng, [(0.15, 0.26, 0.22), (0.36, 0.10, 0.11), (0.13, 0.17, 0.28)]),
        sign=(0.85, 0.75, 0.45),
        iron=(0.07, 0.075, 0.08),
        shutter=(0.75, 0.75, 0.73),
        roof=(0.30, 0.33, 0.38),
        window=WindowLook("casement", (0.88, 0.87, 0.84), "sheer", (0.90, 0.88, 0.83)),
    )
    return Layout("haussmann", width, 11.0, tuple(heights), columns, roof, paint,
                  tuple(openings), tuple(balconies), bands, 0.26)  # fmt: skip


def _ground_shops(
    rng: Rng, centres: tuple[float, ...], width_m: float, height_m: float
) -> list[Opening]:
    """A door in one bay and shop fronts in what is left and right of it."""
    columns = len(centres)
    bay = int(rng.integers(columns))
    door = Opening("door", Rect(centres[bay] - 0.7, 0.0, 1.4, 3.0), 0, bay, fanlight_m=0.6)
    openings = [door]
    gap = 0.45
    for left, right, column in (
        (gap, centres[bay] - 0.7 - gap, 0),
        (centres[bay] + 0.7 + gap, width_m - gap, columns - 1),
    ):
        if right - left > 1.4:
            rect = Rect(left, 0.0, right - left, height_m - 0.5)
            openings.append(Opening("shop", rect, 0, column, surround=False))
    return openings


def _gable_stacks(rng: Rng, width_m: float, ridge_m: float) -> tuple[Chimney, ...]:
    """A chimney wall at one end or both, as over Paris party walls."""
    ends = [0.0, width_m - 0.7] if rng.random() < 0.6 else [float(rng.choice([0.0, width_m - 0.7]))]
    return tuple(
        Chimney(x, ridge_m - 1.2, 0.7, 2.3 + 0.4 * float(rng.random()), 1.6, 2.6, 5) for x in ends
    )


def _terrace(rng: Rng, floors: int | None, columns: int | None) -> Layout:
    floors = floors or int(rng.integers(2, 5))
    columns = columns or int(rng.choice([4, 6]))
    house_columns = 2 if columns % 2 == 0 else columns
    heights = [float(rng.uniform(3.2, 3.5))]
    heights += [float(rng.uniform(2.9, 3.2)) for _ in range(floors - 1)]
    width = columns * float(rng.uniform(2.3, 2.7)) + 0.5
    centres = column_centres(width, columns, 0.25)
    window_w = float(rng.uniform(0.98, 1.16))
    openings: list[Opening] = []
    level = 0.0
    for floor in range(floors):
        tall = heights[floor] - (1.45 if floor < floors - 1 else 1.55)
        for column, x in enumerate(centres):
            if floor == 0 and column % house_columns == 0:
                rect = Rect(x - 0.5, 0.0, 1.0, 2.65)
                openings.append(Opening("door", rect, 0, column, fanlight_m=0.45))
            else:
                rect = _window_rect(x, level + 0.85, window_w, tall)
                openings.append(Opening("window", rect, floor, column))
        level += heights[floor]
    bands = (Band(0.0, 0.3, 0.04), Band(level - 0.22, 0.22, 0.2, cornice=True))
    rise = float(rng.uniform(2.2, 2.9))
    stacks = tuple(
        Chimney(width * i * house_columns / columns - 0.55, level + rise - 0.5, 1.1, 1.5, 3.6, 0.8, 4)
        for i in range(1, columns // house_columns)
    ) or (Chimney(width - 1.4, level + rise - 0.5, 1.1, 1.5, 3.6, 0.8, 4),)
    paint = Paint(
        wall="brick",
        wall_colour=_pick(rng, [(0.58, 0.29, 0.21), (0.66, 0.52, 0.35), (0.50, 0.25, 0.20)]),
        trim=_pick(rng, [(0.87, 0.85, 0.79)]),
        door=_pick(rng, [(0.10, 0.20, 0.34), (0.42, 0.08, 0.08), (0.08, 0.24, 0.16), (0.1, 0.1, 0.1)]),
        shop=(0.2, 0.2, 0.22),
        sign=(0.9, 0.9, 0.85),
        iron=(0.06, 0.06, 0.06),
        shutter=(0.3, 0.35, 0.4),
        roof=_pick(rng, [(0.31, 0.33, 0.37), (0.36, 0.34, 0.35)]),
        window=WindowLook("sash", (0.92, 0.92, 0.90), "drapes", (0.85, 0.80, 0.72), 3, 0.055, 0.025),
    )  # fmt: skip
    return Layout("terrace", width, 9.0, tuple(heights), columns,
                  Roof("pitched", "slate", rise, 4.0, 0.15, (), stacks), paint,
                  tuple(openings), (), bands, 0.12)  # fmt: skip


def _modern(rng: Rng, floors: int | None, columns: int | None) -> Layout:
    floors = floors or int(rng.integers(4, 8))
    columns = columns or int(rng.integers(4, 8))
    heights = [float(rng.uniform(3.3, 3.7))] + [float(rng.uniform(2.85, 3.1))] * (floors - 1)
    bay = float(rng.uniform(2.4, 3.0))
    width = columns * bay + 0.6
    centres = column_centres(width, columns, 0.3)
    window_w = float(rng.uniform(0.55, 0.7)) * bay
    window_h = float(rng.uniform(1.45, 1.75))
    entrance = int(rng.integers(columns))
    openings: list[Opening] = []
    for column, x in enumerate(centres):
        if column == entrance:
            openings.append(Opening("door", Rect(x - 0.9, 0.0, 1.8, 2.6), 0, column, 0.5, False))
        else:
            rect = _window_rect(x, 0.95, window_w, window_h)
            openings.append(Opening("window", rect, 0, column, surround=False))
    level = heights[0]
    for floor in range(1, floors):
        for column, x in enumerate(centres):
            rect = _window_rect(x, level + 0.88, window_w, window_h)
            openings.append(Opening("window", rect, floor, column, surround=False))
        level += heights[floor]
    bands = (Band(level - 0.12, 0.12, 0.06, cornice=True),)
    paint = Paint(
        wall="panels",
        wall_colour=_pick(rng, [(0.72, 0.72, 0.70), (0.80, 0.77, 0.70), (0.60, 0.56, 0.50)]),
        trim=_pick(rng, [(0.45, 0.46, 0.48), (0.72, 0.72, 0.72)]),
        door=(0.22, 0.23, 0.25),
        shop=(0.3, 0.3, 0.32),
        sign=(0.9, 0.9, 0.9),
        iron=(0.5, 0.5, 0.52),
        shutter=(0.5, 0.5, 0.5),
        roof=(0.5, 0.5, 0.48),
        window=WindowLook("tilt", _pick(rng, [(0.24, 0.25, 0.27), (0.90, 0.90, 0.89)]), "blind",
                          (0.86, 0.85, 0.81)),
        panel_m=(bay / 2, heights[-1] / 2),
    )  # fmt: skip
    return Layout("modern", width, 12.0, tuple(heights), columns,
                  Roof("flat", "gravel", 0.0, 0.0), paint, tuple(openings), (), bands, 0.18)  # fmt: skip


def _stucco(rng: Rng, floors: int | None, columns: int | None) -> Layout:
    floors = floors or int(rng.integers(3, 6))
    columns = columns or int(rng.integers(3, 6))
    heights = [float(rng.uniform(3.5, 3.9))]
    heights += [float(rng.uniform(3.0, 3.4)) for _ in range(floors - 1)]
    width = columns * float(rng.uniform(2.7, 3.2)) + 1.0
    centres = column_centres(width, columns, 0.5)
    window_w = float(rng.uniform(0.98, 1.12))
    shutters = bool(rng.random() < 0.6)
    entrance = columns // 2
    openings: list[Opening] = []
    balconies: list[Balcony] = []
    level = 0.0
    for floor in range(floors):
        tall = heights[floor] - (1.4 if floor < floors - 1 else 1.5)
        for column, x in enumerate(centres):
            if floor == 0 and column == entrance:
                openings.append(Opening("door", Rect(x - 0.65, 0.0, 1.3, 2.75), 0, column, 0.5))
            elif floor == 1 and column == entrance:
                rect = _window_rect(x, level + 0.1, window_w + 0.1, tall + 0.65)
                openings.append(Opening("window", rect, floor, column))
                rail = Rect(x - 1.0, level - 0.14, 2.0, 1.14)
                balconies.append(Balcony(rail, 0.8, floor, column, "bars"))
            else:
                rect = _window_rect(x, level + (1.0 if floor == 0 else 0.75), window_w, tall)
                openings.append(Opening("window", rect, floor, column, shutters=shutters and floor > 0))
        level += heights[floor]
    bands = (
        Band(0.0, 0.7, 0.05),
        Band(heights[0] - 0.2, 0.16, 0.09),
        Band(level - 0.34, 0.34, 0.24, cornice=True),
    )
    stacks = (Chimney(width * float(rng.uniform(0.15, 0.8)), level + 0.9, 0.7, 1.6, 2.4, 0.7, 2),)
    paint = Paint(
        wall="stucco",
        wall_colour=_pick(rng, [(0.86, 0.72, 0.46), (0.82, 0.62, 0.50), (0.84, 0.82, 0.74),
                                (0.66, 0.75, 0.72), (0.84, 0.66, 0.56)]),
        trim=_pick(rng, [(0.91, 0.89, 0.83)]),
        door=_pick(rng, [(0.30, 0.18, 0.10), (0.16, 0.26, 0.22)]),
        shop=(0.3, 0.2, 0.15),
        sign=(0.9, 0.85, 0.7),
        iron=(0.08, 0.08, 0.08),
        shutter=_pick(rng, [(0.22, 0.38, 0.31), (0.36, 0.25, 0.18), (0.30, 0.40, 0.50)]),
        roof=_pick(rng, [(0.70, 0.38, 0.25), (0.62, 0.35, 0.25)]),
        window=WindowLook("casement", (0.90, 0.89, 0.86), "sheer", (0.88, 0.86, 0.82), 3),
    )  # fmt: skip
    return Layout("stucco", width, 10.0, tuple(heights), columns,
                  Roof("pitched", "tiles", 1.9, 4.5, 0.45, (), stacks), paint,
                  tuple(openings), tuple(balconies), bands, 0.2)  # fmt: skip


_DESIGNERS: dict[Style, Callable[[Rng, int | None, int | None], Layout]] = {
    "haussmann": _haussmann,
    "terrace": _terrace,
    "modern": _modern,
    "stucco": _stucco,
}
