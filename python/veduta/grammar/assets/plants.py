"""Trees and shrubs: a trunk, and crowns of a few uneven balls that are shaded as round."""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import BARK, LEAVES
from veduta.grammar.assets.modelling import Model

Centre = tuple[float, float, float]
RINGS, SIDES = (7, 4, 3), (12, 8, 5)
"""Of a ball, by the level of detail."""
UNEVEN = 0.16
"""How much the radius of a ball varies, as a share of it."""


def broad(name: str, level: int) -> Asset:
    """A broad tree with a crown of four balls, 3.0 m by 4.8 m."""
    model = Model(BARK, LEAVES)
    _trunk(model, 0.13, 2.4, level)
    balls: list[tuple[Centre, tuple[float, float]]] = [
        ((0.0, 3.1, 0.0), (1.25, 1.35)),
        ((0.62, 3.5, 0.3), (0.85, 0.9)),
        ((-0.6, 3.6, 0.2), (0.8, 0.85)),
        ((-0.05, 3.9, -0.45), (0.9, 0.9)),
    ]
    for number, (centre, radii) in enumerate(balls[: 1 if level == 2 else None]):
        grown = (1.45, 1.6) if level == 2 else radii
        _ball(model, centre, grown, level, number)
    return model.asset(name)


def slim(name: str, level: int) -> Asset:
    """A slim tree as along streets, 1.6 m by 5.0 m."""
    model = Model(BARK, LEAVES)
    _trunk(model, 0.09, 2.2, level)
    balls: list[tuple[Centre, tuple[float, float]]] = [
        ((0.0, 3.2, 0.0), (0.75, 1.3)),
        ((0.12, 4.1, -0.1), (0.5, 0.9)),
        ((-0.1, 2.7, 0.12), (0.65, 0.8)),
    ]
    for number, (centre, radii) in enumerate(balls[: 1 if level == 2 else None]):
        grown = (0.8, 1.75) if level == 2 else radii
        _ball(model, centre, grown, level, number + 7)
    return model.asset(name)


def shrub(name: str, level: int) -> Asset:
    """A round shrub that stands on the ground, 1.1 m by 0.9 m."""
    model = Model(LEAVES)
    _ball(model, (0.0, 0.38, 0.0), (0.52, 0.5), level, 13)
    if level < 2:
        _ball(model, (0.26, 0.42, 0.12), (0.33, 0.36), level, 14)
    return model.asset(name)


def _trunk(model: Model, radius: float, height: float, level: int) -> None:
    sides = (8, 6, 4)[level]
    model.lathe(
        [(1.35 * radius, 0.0), (radius, 0.3), (0.75 * radius, height)],
        (0.0, 0.0),
        "bark",
        sides=sides,
    )


def _ball(
    model: Model, centre: Centre, radii: tuple[float, float], level: int, number: int
) -> None:
    """An uneven ball; radii: to the side and upwards (m)."""
    rings, sides = RINGS[level], SIDES[level]
    rng = np.random.default_rng([19, number])
    points = [(0.0, -1.0, 0.0)]
    for ring in range(1, rings):
        turn = np.pi * ring / rings
        angles = 2.0 * np.pi * (np.arange(sides) + 0.5 * (ring % 2)) / sides
        out = 1.0 + UNEVEN * rng.uniform(-1.0, 1.0, sides)
        across = np.sin(turn) * out
        points += zip(
            across * np.cos(angles), -np.cos(turn) * out, across * np.sin(angles), strict=True
        )
    points.append((0.0, 1.0, 0.0))
    scaled = np.array(points) * (radii[0], radii[1], radii[0]) + centre
    last = len(points) - 1
    faces = []
    for k in range(sides):
        after = (k + 1) % sides
        faces.append([0, 1 + k, 1 + after])
        top = 1 + (rings - 2) * sides
        faces.append([last, top + after, top + k])
        for ring in range(rings - 2):
            low, high = 1 + ring * sides, 1 + (ring + 1) * sides
            # Rings are turned by half a side in turn.
            if ring % 2 == 0:
                faces += [[low + k, high + k, low + after], [low + after, high + k, high + after]]
            else:
                faces += [[low + k, high + k, high + after], [low + k, high + after, low + after]]
    model.solid(scaled, faces, "leaves")
