"""What stands on roofs: dormers, whose front is the plane z = 0 and whose body reaches back into
the roof (z < 0), and chimneys, which stand about their middle.
"""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import BRICK, CHEEK, FRAME, PANE, POT, STONE, TILE, ZINC
from veduta.grammar.assets.modelling import Model, arc
from veduta.grammar.assets.windows import flat_window, framed, french_leaf

Span = tuple[float, float]
DEPTH = -1.6
"""How far dormers reach back (m)."""


def casement_in(model: Model, x: Span, y: Span, z: float, level: int) -> None:
    """A two-leaf window set back by -z within a dormer's front."""
    own = Model(FRAME, PANE)
    width, height = x[1] - x[0], y[1] - y[0]
    if level == 2:
        flat_window(own, width, height, 0.07, 2, 2)
    else:
        framed(own, (0.0, width), (0.0, height), 0.045, (-0.06, 0.0), level)
        for leaf in ((0.04, width / 2), (width / 2, width - 0.04)):
            french_leaf(own, leaf, (0.04, height - 0.04), 0.0, 2, level)
    model.insert(own, (x[0], y[0], z))


def pediment(name: str, level: int) -> Asset:
    """A French dormer in stone: pilasters, pediment and zinc cheeks, 1.5 m by 2.5 m."""
    model = Model(STONE, FRAME, PANE, CHEEK, ZINC)
    surround(model, 1.5, 1.85, level)
    casement_in(model, (0.26, 1.24), (0.12, 1.72), -0.08, level)
    section = [(0.0, 0.0), (0.05, 0.0), (0.08, 0.05), (0.16, 0.07), (0.18, 0.13), (0.0, 0.13)]
    outline = section if level == 0 else [section[0], section[1], section[4], section[5]]
    model.prism([(z, y + 1.85) for z, y in outline], (-0.08, 1.58), "stone", axis="x")
    gable = [(-0.08, 1.98), (1.58, 1.98), (0.75, 2.42)]
    model.prism(gable, (-0.12, 0.05), "stone", caps="high")
    rake = [(-0.09, -0.12), (-0.09, 0.19), (-0.03, 0.16), (0.0, 0.16), (0.0, -0.12)]
    model.sweep(
        rake if level == 0 else [rake[0], rake[1], rake[3], rake[4]],
        [(1.62, 1.99), (0.75, 2.49), (-0.12, 1.99)],
        "stone",
    )
    model.prism(
        [(0.02, 0.0), (1.48, 0.0), (1.48, 1.98), (0.75, 2.4), (0.02, 1.98)],
        (DEPTH, -0.12),
        "cheek",
        caps="none",
    )
    for side in (0, 1):
        eaves = [(-0.04, 1.96), (0.75, 2.42), (0.75, 2.45), (-0.04, 1.99)]
        slope = [(1.5 - x if side else x, y) for x, y in eaves]
        model.prism(slope, (DEPTH, -0.1), "zinc")
    return model.asset(name)


def surround(model: Model, width: float, height: float, level: int) -> None:
    """Pilasters, sill and lintel around a dormer's window."""
    for x in ((0.0, 0.26), (width - 0.26, width)):
        model.box((x[0], 0.0, -0.14), (x[1], height, 0.0), "stone", without="back bottom")
        if level == 0:
            model.box(
                (x[0] + 0.05, 0.2, 0.0),
                (x[1] - 0.05, height - 0.15, 0.025),
                "stone",
                without="back",
            )
            model.box(
                (x[0] - 0.02, 0.0, 0.0), (x[1] + 0.02, 0.14, 0.05), "stone", without="back bottom"
            )
            model.box(
                (x[0] - 0.02, height - 0.1, 0.0),
                (x[1] + 0.02, height, 0.045),
                "stone",
                without="back top",
            )
    model.box(
        (0.26, height - 0.13, -0.14),
        (width - 0.26, height, -0.01),
        "stone",
        without="back left right",
    )
    model.prism(
        [(-0.14, 0.0), (0.06, 0.0), (0.06, 0.06), (-0.14, 0.12)],
        (0.2, width - 0.2),
        "stone",
        axis="x",
    )


def arched(name: str, level: int) -> Asset:
    """A dormer under a round zinc head, 1.3 m by 2.1 m."""
    model = Model(STONE, FRAME, PANE, CHEEK, ZINC)
    steps = (14, 8, 5)[level]
    head = arc((0.65, 1.5), 0.65, 0, 180, steps)
    outer = np.concatenate([[(0.0, 0.0), (1.3, 0.0)], head])
    model.prism(outer, (DEPTH, -0.1), "zinc", caps="none")
    casement_in(model, (0.17, 1.13), (0.1, 1.5), -0.06, level)
    lunette = np.concatenate([[(0.17, 1.5)], arc((0.65, 1.5), 0.48, 0, 180, steps)[::1]])[1:]
    model.sheet(lunette, -0.06, "pane")
    model.box((0.15, 1.47, -0.1), (1.15, 1.54, -0.03), "frame", without="back")
    path = np.concatenate([[(1.3, 0.0)], head, [(0.0, 0.0)]])
    section = [(0.0, -0.12), (0.17, -0.12), (0.17, -0.03), (0.11, 0.0), (0.04, 0.04), (0.0, 0.06)]
    model.sweep(
        section if level == 0 else [section[0], section[1], section[2], section[5]], path, "stone"
    )
    model.prism(
        [(-0.12, 0.0), (0.08, 0.0), (0.08, 0.06), (-0.12, 0.1)], (0.0, 1.3), "stone", axis="x"
    )
    return model.asset(name)


def shed(name: str, level: int) -> Asset:
    """A dormer under one slope, 1.8 m by 1.5 m."""
    model = Model(FRAME, PANE, CHEEK, TILE)
    model.prism(
        [(DEPTH, 0.0), (-0.1, 0.0), (-0.1, 1.32), (DEPTH, 1.55)], (0.04, 1.76), "cheek", axis="x"
    )
    framed(model, (0.04, 1.76), (0.0, 1.32), 0.14, (-0.08, 0.0), 1)
    casement_in(model, (0.17, 1.63), (0.13, 1.2), -0.03, level)
    model.prism(
        [(0.22, 1.3), (0.22, 1.37), (DEPTH, 1.65), (DEPTH, 1.56)], (-0.1, 1.9), "tile", axis="x"
    )
    return model.asset(name)


def gabled(name: str, level: int) -> Asset:
    """A dormer under a small gable roof, 1.4 m by 1.9 m."""
    model = Model(FRAME, PANE, CHEEK, TILE)
    front = [(0.05, 0.0), (1.35, 0.0), (1.35, 1.3), (0.7, 1.82), (0.05, 1.3)]
    model.prism(front, (DEPTH, -0.05), "cheek", caps="high")
    framed(model, (0.12, 1.28), (0.02, 1.28), 0.1, (-0.05, 0.015), 1)
    casement_in(model, (0.21, 1.19), (0.11, 1.19), 0.0, level)
    for side in (0, 1):
        slope = [(-0.14, 1.16), (0.7, 1.84), (0.7, 1.92), (-0.14, 1.24)]
        model.prism([(1.4 - x if side else x, y) for x, y in slope], (DEPTH, 0.16), "tile")
    if level == 0:
        for side in (0, 1):
            board = [(-0.14, 1.12), (0.7, 1.79), (0.7, 1.85), (-0.14, 1.18)]
            model.prism([(1.4 - x if side else x, y) for x, y in board], (0.16, 0.19), "frame")
    return model.asset(name)


def skylight(name: str, level: int) -> Asset:
    """A window in the roof's plane, 0.8 m by 1.2 m: for shapes that lie in the slope."""
    model = Model(FRAME, PANE, ZINC)
    model.pane((0.07, 0.73), (0.07, 1.13), 0.03, "pane")
    if level == 2:
        model.pane((0.0, 0.8), (0.0, 1.2), 0.02, "frame")
        return model.asset(name)
    framed(model, (0.0, 0.8), (0.0, 1.2), 0.08, (0.0, 0.06), 1)
    if level == 0:
        model.box((-0.05, -0.12, 0.0), (0.85, 0.0, 0.015), "zinc", without="back")
        model.box((-0.05, 1.2, 0.0), (0.85, 1.3, 0.04), "zinc", without="back")
    return model.asset(name)


POT_SECTION = [
    (0.12, 0.0), (0.12, 0.05), (0.1, 0.07), (0.095, 0.38), (0.115, 0.4), (0.12, 0.44),
    (0.1, 0.46), (0.085, 0.46), (0.08, 0.3),
]  # fmt: skip
"""Radius and height (m) of a chimney pot, up its outside and a way down its flue."""


def pot(model: Model, x: float, z: float, foot: float, level: int) -> None:
    """A clay pot on a stack."""
    outline = POT_SECTION if level == 0 else [POT_SECTION[k] for k in (0, 2, 3, 5, 7)]
    if level == 2:
        outline = [(0.11, 0.0), (0.1, 0.46)]
    turned = [(radius, foot + height) for radius, height in outline]
    model.lathe(turned, (x, z), "pot", sides=(10, 7, 4)[level])


def stack(name: str, level: int) -> Asset:
    """A long party-wall stack with a row of pots, 1.8 m by 2.4 m, 0.5 m deep."""
    model = Model(BRICK, STONE, POT)
    _body(model, 0.9, 1.7, level)
    for k in range(5):
        pot(model, -0.68 + 0.34 * k, 0.0, 1.93, level)
    return model.asset(name)


def single(name: str, level: int) -> Asset:
    """A square stack with two pots, 0.9 m by 2.2 m."""
    model = Model(BRICK, STONE, POT)
    _body(model, 0.45, 1.5, level)
    for x in (-0.2, 0.2):
        pot(model, x, 0.0, 1.73, level)
    return model.asset(name)


def _body(model: Model, half: float, height: float, level: int) -> None:
    """A stack with corbelled courses and a cap; its foot may lie under the roof."""
    top = height if level < 2 else height + 0.15
    model.box((-half + 0.06, 0.0, -0.22), (half - 0.06, top, 0.22), "brick", without="bottom top")
    courses = [(0.03, 0.0, 0.07), (0.0, 0.07, 0.15)] if level < 2 else []
    for inset, low, high in courses:
        model.box(
            (-half + inset, height + low, -0.28 + inset),
            (half - inset, height + high, 0.28 - inset),
            "brick",
        )
    if level == 0:
        model.box((-half + 0.03, 0.55, -0.25), (half - 0.03, 0.62, 0.25), "brick")
    model.box((-half - 0.02, height + 0.15, -0.3), (half + 0.02, height + 0.23, 0.3), "stone")


def one_pot(name: str, level: int) -> Asset:
    """A chimney pot alone, 0.46 m high."""
    model = Model(POT)
    pot(model, 0.0, 0.0, 0.0, level)
    return model.asset(name)
