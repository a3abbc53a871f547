"""Shop fronts, with or without their panes, and the rooms that one sees behind open ones.

Fronts lie in the shape's plane as windows do. Rooms lie behind it: shallow boxes that look
inwards, with what stands in them.
"""

from __future__ import annotations

from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.assets.looks import (
    BRASS,
    CEILING,
    FLOOR,
    LAMP,
    LEAF,
    PANE,
    PAPER,
    SHELF,
    WARE_BLUE,
    WARE_RED,
    WARE_YELLOW,
)
from veduta.grammar.assets.modelling import Model
from veduta.grammar.assets.windows import raised

Span = tuple[float, float]
SILL, HEAD = 0.55, 2.5
"""Where the panes of a shop front begin and end (m)."""
DEEP = 1.5
"""How far a room goes back (m)."""
NEAR = -0.16
"""Where it begins: behind the front's own woodwork."""
WARES = ("ware-red", "ware-blue", "ware-yellow")


def glazed(name: str, level: int) -> Asset:
    """A wooden shop front: sill panels, three panes, a fascia with a cornice, 3.0 m by 3.2 m."""
    model = Model(LEAF, PANE, BRASS)
    model.pane((0.0, 3.0), (0.5, HEAD + 0.05), -0.12, "pane")
    _window(model, level)
    return model.asset(name)


def window(name: str, level: int) -> Asset:
    """The same without panes, to be seen through, 3.0 m by 3.2 m."""
    model = Model(LEAF, BRASS)
    _window(model, level)
    return model.asset(name)


def door(name: str, level: int) -> Asset:
    """A shop's door in its front, without panes, under a light and the fascia, 1.1 m by 3.2 m."""
    model = Model(LEAF, BRASS)
    for x in ((0.0, 0.12), (0.98, 1.1)):
        model.box((x[0], 0.0, -0.15), (x[1], 3.0, 0.05), "leaf", without="back")
    _fascia(model, 1.1, level)
    model.box((0.12, 2.1, -0.14), (0.98, 2.2, -0.02), "leaf", without="back left right")
    model.box((0.12, 0.0, -0.13), (0.98, 0.5, -0.06), "leaf", without="back left right")
    for x in ((0.12, 0.24), (0.86, 0.98)):
        model.box((x[0], 0.5, -0.13), (x[1], 2.1, -0.06), "leaf", without="back top bottom")
    model.box((0.24, 1.98, -0.13), (0.86, 2.1, -0.06), "leaf", without="back left right")
    if level < 2:
        raised(model, (0.24, 0.86), (0.1, 0.42), (-0.06, -0.04), "leaf", level)
        model.box((0.83, 0.95, -0.06), (0.87, 1.25, 0.0), "brass", without="back")
    return model.asset(name)


def _window(model: Model, level: int) -> None:
    """The woodwork of a front of three panes."""
    model.box((0.0, 0.0, -0.15), (3.0, SILL, 0.0), "leaf", without="back left right")
    for x in ((0.0, 0.14), (2.86, 3.0)):
        model.box((x[0], 0.0, -0.15), (x[1], 3.0, 0.05), "leaf", without="back")
    _fascia(model, 3.0, level)
    for at in (0.98, 2.02):
        low, high = (at - 0.03, SILL, -0.13), (at + 0.03, HEAD, -0.05)
        model.box(low, high, "leaf", without="back bottom top")
    if level == 2:
        return
    model.box((0.14, 2.05, -0.13), (2.86, 2.1, -0.06), "leaf", without="back left right")
    for k in range(3):
        left = 0.17 + k * 0.9
        raised(model, (left, left + 0.85), (0.08, 0.48), (0.0, 0.03), "leaf", level)
    model.box((0.14, 0.52, 0.0), (2.86, 0.58, 0.05), "leaf", without="back")
    if level == 0:
        for x in ((0.03, 0.11), (2.89, 2.97)):
            raised(model, x, (0.6, 2.4), (0.05, 0.065), "leaf", level)
        for at in (0.98, 2.02):
            model.lathe(
                [(0.012, 0.58), (0.02, 0.62), (0.012, 0.66), (0.012, 1.98), (0.02, 2.03)],
                (at, -0.04),
                "leaf",
                sides=6,
            )


def _fascia(model: Model, width: float, level: int) -> None:
    """The board over a front, with its cornice."""
    model.box((0.0, HEAD, -0.15), (width, 3.2, 0.02), "leaf", without="back left right")
    if level == 2:
        return
    raised(model, (0.2, width - 0.2), (2.6, 2.98), (0.02, 0.045), "leaf", level)
    section = [(0.02, 3.02), (0.1, 3.04), (0.14, 3.1), (0.18, 3.12), (0.18, 3.2), (0.02, 3.2)]
    model.prism(section, (0.0, width), "leaf", axis="x")


def shelves(name: str, level: int) -> Asset:
    """A lit shop behind its panes: shelves with wares along the wall, 3.0 m by 2.9 m."""
    model = _room(3.0, 2.9, PAPER, SHELF, WARE_RED, WARE_BLUE, WARE_YELLOW)
    if level == 2:
        return model.asset(name)
    back = NEAR - DEEP
    boards = (0.45, 1.0, 1.5, 2.0)
    model.box((0.1, 0.0, back), (0.14, 2.3, back + 0.3), "shelf", without="back bottom")
    model.box((2.86, 0.0, back), (2.9, 2.3, back + 0.3), "shelf", without="back bottom")
    for y in boards:
        model.box((0.14, y, back), (2.86, y + 0.03, back + 0.3), "shelf", without="back left right")
    every = 0.34 if level else 0.17
    for row, y in enumerate(boards):
        _wares(model, row, y + 0.03, back, every)
    # In the window itself: a low table with a few things.
    model.box((0.5, 0.0, NEAR - 0.65), (2.5, 0.62, NEAR - 0.2), "shelf", without="back bottom")
    for k in range(3):
        x = 0.7 + 0.6 * k
        low, high = (x, 0.62, NEAR - 0.5), (x + 0.32, 0.85 + 0.1 * (k % 2), NEAR - 0.3)
        model.box(low, high, WARES[k], without="back bottom")
    return model.asset(name)


def _wares(model: Model, row: int, y: float, back: float, every: float) -> None:
    """Things side by side on a board, of heights and kinds that repeat nowhere near."""
    count = int(2.6 / every)
    for k in range(count):
        step = (7 * k + 5 * row) % 11
        if step == 3:
            continue
        x = 0.2 + k * every
        high = y + 0.12 + 0.022 * step
        low = (x, y, back + 0.04)
        model.box(
            low, (x + 0.78 * every, high, back + 0.24), WARES[step % 3], without="back bottom"
        )


def counter(name: str, level: int) -> Asset:
    """A lit shop behind its panes: a counter and a picture on the wall, 3.0 m by 2.9 m."""
    model = _room(3.0, 2.9, PAPER, SHELF, WARE_RED, WARE_BLUE, WARE_YELLOW)
    if level == 2:
        return model.asset(name)
    back = NEAR - DEEP
    model.box((0.25, 0.0, back + 0.3), (1.9, 0.95, back + 0.75), "shelf", without="back bottom")
    model.box((0.2, 0.95, back + 0.25), (1.95, 1.0, back + 0.82), "ware-yellow", without="back")
    model.box((0.4, 1.35, back), (1.3, 1.95, back + 0.03), "ware-blue", without="back")
    model.box((2.15, 0.0, back), (2.75, 2.1, back + 0.35), "shelf", without="back bottom")
    for k in range(3 if level else 6):
        y = 0.25 + k * (0.6 if level else 0.3)
        low, high = (2.2, y, back + 0.35), (2.7, y + 0.18, back + 0.37)
        model.box(low, high, WARES[k % 3], without="back")
    for x in (0.8, 2.2):
        model.box((x - 0.16, 2.35, back + 0.7), (x + 0.16, 2.55, back + 1.0), "lamp", without="top")
        model.box(
            (x - 0.01, 2.55, back + 0.84), (x + 0.01, 2.9, back + 0.86), "shelf", without="top"
        )
    return model.asset(name)


def hall(name: str, level: int) -> Asset:
    """A lit entrance behind a glazed door: letter boxes and a further door, 2.0 m by 2.4 m."""
    model = _room(2.0, 2.4, PAPER, SHELF, WARE_RED, WARE_BLUE, WARE_YELLOW)
    if level == 2:
        return model.asset(name)
    back = NEAR - DEEP
    model.box((1.0, 0.0, back), (1.85, 2.05, back + 0.04), "shelf", without="back bottom")
    model.box((1.08, 1.2, back + 0.04), (1.77, 1.95, back + 0.05), "lamp", without="back")
    for k in range(6):
        x, y = 0.15 + 0.25 * (k % 3), 1.1 + 0.35 * (k // 3)
        model.box((x, y, back), (x + 0.22, y + 0.3, back + 0.12), "ware-blue", without="back")
    return model.asset(name)


def _room(width: float, height: float, *slots: Slot) -> Model:
    """Walls, floor and ceiling that look inwards, and a row of lamps."""
    model = Model(*slots, FLOOR, CEILING, LAMP)
    far, x, y = NEAR - DEEP, (0.0, width), (0.0, height)
    model.pane(x, y, far, "paper")
    sides: list[tuple[list[tuple[float, float, float]], str]] = [
        ([(0, 0, NEAR), (0, 0, far), (0, height, far), (0, height, NEAR)], "paper"),
        ([(width, 0, far), (width, 0, NEAR), (width, height, NEAR), (width, height, far)], "paper"),
        ([(0, 0, NEAR), (width, 0, NEAR), (width, 0, far), (0, 0, far)], "floor"),
        (
            [(0, height, far), (width, height, far), (width, height, NEAR), (0, height, NEAR)],
            "ceiling",
        ),
    ]
    for corners, slot in sides:
        model.facet(corners, slot)
    middle = NEAR - 0.5 * DEEP
    model.box(
        (0.2, height - 0.06, middle - 0.1),
        (width - 0.2, height, middle + 0.1),
        "lamp",
        without="top",
    )
    return model
