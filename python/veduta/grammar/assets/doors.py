"""Doors: the front of the leaves lies in the shape's plane."""

from __future__ import annotations

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import BRASS, FRAME, LEAF, PANE, STEEL, STONE
from veduta.grammar.assets.modelling import Model, rectangle
from veduta.grammar.assets.windows import bars, moulding, raised

Span = tuple[float, float]
BACK, FRONT = -0.07, -0.01


def leaf(model: Model, x: Span, y: Span, rows: list[Span], columns: int, level: int) -> None:
    """A panelled leaf: `rows` are the heights of its panels, as shares of its own."""
    model.box((x[0], y[0], BACK), (x[1], y[1], FRONT), "leaf", without="back")
    if level == 2:
        return
    height, stile = y[1] - y[0], 0.09
    width = (x[1] - x[0] - stile * (columns + 1)) / columns
    for low, high in rows:
        for column in range(columns):
            left = x[0] + stile + column * (width + stile)
            panel = (left, left + width), (y[0] + low * height, y[0] + high * height)
            bead(model, *panel, level)


def bead(model: Model, x: Span, y: Span, level: int) -> None:
    """A panel within a moulded border that stands off the leaf."""
    if level == 0:
        section = [(0.0, FRONT), (0.035, FRONT), (0.03, FRONT + 0.008), (0.012, FRONT + 0.02)]
        model.sweep([*section, (0.0, FRONT + 0.01)], rectangle_of(x, y), "leaf", closed=True)
    inset = 0.06 if level == 0 else 0.02
    inner = (x[0] + inset, x[1] - inset), (y[0] + inset, y[1] - inset)
    raised(model, *inner, (FRONT, FRONT + 0.014), "leaf", level)


def rectangle_of(x: Span, y: Span) -> list[tuple[float, float]]:
    """The corners of a rectangle from its spans."""
    return [tuple(corner) for corner in rectangle((x[0], y[0]), (x[1], y[1])).tolist()]


def knob(model: Model, x: float, y: float, level: int) -> None:
    """A round handle on a leaf."""
    if level == 0:
        for radius, z in ((0.03, (FRONT, FRONT + 0.01)), (0.022, (FRONT + 0.01, FRONT + 0.05))):
            turned = [(x + radius * c, y + radius * s) for c, s in OCTAGON]
            model.prism(turned, z, "brass")


OCTAGON = [
    (1.0, 0.0),
    (0.7, 0.7),
    (0.0, 1.0),
    (-0.7, 0.7),
    (-1.0, 0.0),
    (-0.7, -0.7),
    (0.0, -1.0),
    (0.7, -0.7),
]


def double(name: str, level: int) -> Asset:
    """A carriage door of two panelled leaves under a light, 1.6 m by 3.2 m."""
    model = Model(LEAF, PANE, BRASS)
    frame(model, 1.6, 3.2, level)
    for x in ((0.07, 0.8), (0.8, 1.53)):
        leaf(model, x, (0.0, 2.5), [(0.05, 0.2), (0.26, 0.48), (0.54, 0.96)], 1, level)
    model.box((0.77, 0.0, FRONT), (0.83, 2.5, FRONT + 0.025), "leaf", without="back bottom")
    transom(model, (0.07, 1.53), (2.5, 3.13), 4, level)
    for at in (0.7, 0.9):
        knob(model, at, 1.25, level)
    return model.asset(name)


def single(name: str, level: int) -> Asset:
    """A house door of six panels under a narrow light, 1.0 m by 2.4 m."""
    model = Model(LEAF, PANE, BRASS)
    frame(model, 1.0, 2.4, level)
    leaf(model, (0.07, 0.93), (0.0, 2.05), [(0.08, 0.3), (0.36, 0.7), (0.76, 0.94)], 2, level)
    transom(model, (0.07, 0.93), (2.05, 2.33), 3, level)
    knob(model, 0.86, 1.0, level)
    return model.asset(name)


def frame(model: Model, width: float, height: float, level: int) -> None:
    """The lining around a door; it has no sill."""
    path = [(width, 0.0), (width, height), (0.0, height), (0.0, 0.0)]
    model.sweep(moulding(0.07, BACK, 0.01, level), path, "leaf")


def transom(model: Model, x: Span, y: Span, panes: int, level: int) -> None:
    """A bar over the leaves, and the light above it."""
    model.box((x[0], y[0], BACK), (x[1], y[0] + 0.07, 0.005), "leaf", without="back left right")
    model.pane(x, (y[0] + 0.07, y[1]), -0.045, "pane")
    if level < 2:
        bars(model, x, (y[0] + 0.07, y[1]), panes, 1, (-0.045, -0.02), 0.03, "leaf")


def garage(name: str, level: int) -> Asset:
    """A sectional garage door, 2.5 m by 2.2 m."""
    model = Model(LEAF, STEEL)
    model.pane((0.0, 2.5), (0.0, 2.2), -0.04, "leaf")
    if level == 2:
        return model.asset(name)
    rows, columns = 4, 4
    height, width = 2.2 / rows, 2.5 / columns
    for row in range(rows):
        y = (row * height + 0.008, (row + 1) * height - 0.008)
        model.box((0.0, y[0], -0.04), (2.5, y[1], -0.015), "leaf", without="back left right")
        for column in range(columns) if level == 0 else ():
            x = (column * width + 0.07, (column + 1) * width - 0.07)
            raised(model, x, (y[0] + 0.09, y[1] - 0.09), (-0.015, 0.0), "leaf", level)
    model.box((1.18, 0.16, -0.015), (1.32, 0.19, 0.02), "steel", without="back")
    return model.asset(name)


def glazed(name: str, level: int) -> Asset:
    """A modern entrance: a glazed leaf beside a fixed light, 1.8 m by 2.3 m."""
    model = Model(FRAME, PANE, STEEL)
    for x in ((0.06, 1.07), (1.13, 1.74)):
        model.pane(x, (0.0, 2.24), -0.04, "pane")
    _entrance(model, level)
    return model.asset(name)


def entrance(name: str, level: int) -> Asset:
    """The same without panes, to be seen through, 1.8 m by 2.3 m."""
    model = Model(FRAME, STEEL)
    _entrance(model, level)
    return model.asset(name)


def _entrance(model: Model, level: int) -> None:
    """The frame of a modern entrance and that of its leaf."""
    path = [(1.8, 0.0), (1.8, 2.3), (0.0, 2.3), (0.0, 0.0)]
    model.sweep(moulding(0.06, BACK, 0.0, 1), path, "frame")
    model.box((1.07, 0.0, BACK), (1.13, 2.24, 0.0), "frame", without="back bottom top")
    for x in ((0.06, 1.07), (1.13, 1.74)):
        if level < 2:
            model.sweep(
                moulding(0.07, -0.06, -0.015, 1), rectangle_of(x, (0.0, 2.24)), "frame", closed=True
            )
    if level == 0:
        model.lathe([(0.014, 0.6), (0.014, 1.7)], (0.97, 0.04), "steel", sides=8)
        for y in (0.7, 1.6):
            model.box((0.962, y, -0.015), (0.978, y + 0.016, 0.04), "steel", without="back")


def step(name: str, level: int) -> Asset:
    """A stone doorstep of two risers, 1.4 m wide."""
    model = Model(STONE)
    for y, z in (((0.0, 0.15), 0.6), ((0.15, 0.3), 0.3)):
        edge = [
            (0.0, y[0]),
            (z - 0.02, y[0]),
            (z - 0.02, y[1] - 0.04),
            (z, y[1] - 0.04),
            (z, y[1]),
            (0.0, y[1]),
        ]
        plain = [(0.0, y[0]), (z, y[0]), (z, y[1]), (0.0, y[1])]
        model.prism(edge if level == 0 else plain, (0.0, 1.4), "stone", axis="x")
    return model.asset(name)
