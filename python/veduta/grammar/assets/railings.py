"""Railings: tiles that repeat along x. Their feet lie at y = 0, and they stand about z = 0."""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import GLASS, IRON, STEEL, STONE
from veduta.grammar.assets.modelling import Model, arc, spiral

WIDTH = 0.6
"""Of a tile of ironwork (m)."""


def rails(model: Model, width: float, heights: list[tuple[float, float]], half: float) -> None:
    """Bars along the whole tile; their ends meet those of the next."""
    for low, high in heights:
        model.box((0.0, low, -half), (width, high, half), "iron", without="left right")


def post(model: Model, x: float, low: float, high: float, half: float) -> None:
    """An upright bar between two rails."""
    model.box((x - half, low, -half), (x + half, high, half), "iron", without="bottom top")


def iron(name: str, level: int) -> Asset:
    """A French balcony's wrought iron: scrolls between bars under a frieze, 0.6 m by 0.95 m."""
    model = Model(IRON)
    rails(model, WIDTH, [(0.06, 0.085), (0.74, 0.76)], 0.011)
    rails(model, WIDTH, [(0.915, 0.95)], 0.022)
    if level == 2:
        for k in range(4):
            post(model, (k + 0.5) * WIDTH / 4, 0.085, 0.915, 0.011)
        return model.asset(name)
    for x in (0.075, 0.525):
        post(model, x, 0.0 if x < 0.1 else 0.085, 0.915, 0.009)
    turns, steps, sides = ((1.6, 18, 5), (0.8, 4, 3))[level]
    for side in (-1.0, 1.0):
        scroll(model, 0.3, side, (0.085, 0.74), turns, steps, sides)
    frieze(model, (0.76, 0.915), level)
    return model.asset(name)


def scroll(
    model: Model,
    middle: float,
    side: float,
    y: tuple[float, float],
    turns: float,
    steps: int,
    sides: int,
) -> None:
    """Half of a lyre: an S with volutes, from the foot up to the frieze."""
    height = y[1] - y[0]
    low, high = 0.3 * height, 0.24 * height
    lower = spiral(
        (middle + side * 0.095, y[0] + 0.085), (0.018, 0.078), (-360 * turns, -90), steps
    )
    upper = spiral((middle + side * 0.085, y[1] - 0.08), (0.016, 0.07), (360 * turns, 90), steps)
    if side < 0:
        lower[:, 0] = 2 * (middle + side * 0.095) - lower[:, 0]
        upper[:, 0] = 2 * (middle + side * 0.085) - upper[:, 0]
    start, end = lower[-1], upper[-1]
    share = np.linspace(0.0, 1.0, 9 if sides > 3 else 5)[1:-1, None]
    pull = np.array([[-side * 0.28, 0.0]])
    swing = (1 - share) ** 3 * start + 3 * (1 - share) ** 2 * share * (start + pull + [0.0, low])
    swing += 3 * (1 - share) * share**2 * (end + pull - [0.0, high]) + share**3 * end
    model.tube(np.concatenate([lower, swing, upper[::-1]]), 0.0075, "iron", sides=sides)


def frieze(model: Model, y: tuple[float, float], level: int) -> None:
    """A row of rings under the hand rail."""
    middle, radius = (y[0] + y[1]) / 2, (y[1] - y[0]) / 2 - 0.006
    for k in range(4):
        x = (k + 0.5) * WIDTH / 4
        if level == 0:
            ring = arc((x, middle), radius, 0, 330, 11)
            model.sweep(
                [(0.0, -0.005), (0.012, -0.005), (0.012, 0.005), (0.0, 0.005)],
                ring,
                "iron",
                closed=True,
            )
        else:
            post(model, x, y[0], y[1], 0.008)


def bars(name: str, level: int) -> Asset:
    """Plain upright bars under a hand rail, 0.6 m by 1.0 m."""
    model = Model(IRON)
    rails(model, WIDTH, [(0.08, 0.105)], 0.011)
    rails(model, WIDTH, [(0.965, 1.0)], 0.022)
    for k in range(5):
        x = (k + 0.5) * WIDTH / 5
        post(model, x, 0.105, 0.965, 0.008 if level < 2 else 0.01)
        if level == 0:
            model.lathe(
                [(0.008, 0.5), (0.018, 0.515), (0.022, 0.535), (0.018, 0.555), (0.008, 0.57)],
                (x, 0.0),
                "iron",
                sides=8,
            )
    return model.asset(name)


def glass(name: str, level: int) -> Asset:
    """A sheet of glass between slim posts under a steel rail, 1.2 m by 1.05 m."""
    model = Model(GLASS, STEEL)
    model.box((0.02, 0.06, -0.006), (1.18, 0.98, 0.006), "glass")
    model.box((0.0, 1.01, -0.025), (1.2, 1.05, 0.025), "steel", without="left right")
    for x in (0.03, 1.17):
        model.box((x - 0.02, 0.0, -0.02), (x + 0.02, 1.01, 0.02), "steel", without="bottom top")
        if level == 0:
            for y in (0.2, 0.8):
                model.box((x - 0.03, y, -0.03), (x + 0.03, y + 0.06, 0.03), "steel")
    return model.asset(name)


BALUSTER = [
    (0.055, 0.0), (0.055, 0.035), (0.04, 0.045), (0.045, 0.07), (0.032, 0.085), (0.052, 0.14),
    (0.062, 0.2), (0.058, 0.26), (0.04, 0.36), (0.028, 0.46), (0.03, 0.5), (0.042, 0.51),
    (0.03, 0.525), (0.034, 0.55), (0.05, 0.565), (0.055, 0.6),
]  # fmt: skip
"""Radius and height (m) of a turned baluster of the double-belly kind, from its foot."""


def balustrade(name: str, level: int) -> Asset:
    """A stone balustrade with turned balusters, 0.6 m by 0.95 m."""
    model = Model(STONE)
    base = [(-0.11, 0.0), (0.11, 0.0), (0.11, 0.13), (0.09, 0.16), (-0.09, 0.16), (-0.11, 0.13)]
    rail = [
        (-0.09, 0.76),
        (0.09, 0.76),
        (0.13, 0.81),
        (0.13, 0.88),
        (0.1, 0.95),
        (-0.1, 0.95),
        (-0.13, 0.88),
        (-0.13, 0.81),
    ]
    if level == 2:
        base, rail = (
            [*base[:3], (-0.11, 0.13)],
            [(-0.12, 0.76), (0.12, 0.76), (0.12, 0.95), (-0.12, 0.95)],
        )
    model.prism(base, (0.0, WIDTH), "stone", axis="x", caps="none")
    model.prism(rail, (0.0, WIDTH), "stone", axis="x", caps="none")
    outline = BALUSTER if level == 0 else [BALUSTER[k] for k in (0, 4, 6, 9, 11, 15)]
    for k in range(3):
        x = (k + 0.5) * WIDTH / 3
        if level == 2:
            model.box(
                (x - 0.045, 0.16, -0.045), (x + 0.045, 0.76, 0.045), "stone", without="bottom top"
            )
        else:
            turned = [(radius, height + 0.16) for radius, height in outline]
            model.lathe(turned, (x, 0.0), "stone", sides=(10, 6)[level])
    return model.asset(name)
