"""Windows: in a flat shape, the frame's front lies in the shape's plane and the glass behind."""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import BRASS, FRAME, LEAF, PANE, STEEL, STONE
from veduta.grammar.assets.modelling import Model, Points, arc, rectangle

Span = tuple[float, float]


def moulding(width: float, back: float, front: float, level: int) -> list[Span]:
    """A frame's section, inwards and z: rebated and bevelled near by, a bar farther off."""
    if level > 0:
        return [(0.0, back), (width, back), (width, front), (0.0, front)]
    bevel = min(0.35 * width, 0.5 * (front - back))
    return [
        (0.0, back),
        (width, back),
        (width, front - bevel),
        (width - 0.4 * bevel, front - 0.7 * bevel),
        (width - bevel, front),
        (0.0, front),
    ]


def framed(model: Model, x: Span, y: Span, width: float, z: Span, level: int) -> None:
    """A rectangular frame around an opening."""
    path = rectangle((x[0], y[0]), (x[1], y[1]))
    model.sweep(moulding(width, z[0], z[1], level), path, "frame", closed=True)


def bars(
    model: Model,
    x: Span,
    y: Span,
    across: int,
    up: int,
    z: Span,
    width: float,
    slot: str = "frame",
) -> None:
    """Glazing bars that divide an opening into `across` by `up` panes."""
    half = width / 2
    for k in range(1, across):
        at = x[0] + (x[1] - x[0]) * k / across
        low, high = (at - half, y[0], z[0]), (at + half, y[1], z[1])
        model.box(low, high, slot, without="back bottom top")
    for k in range(1, up):
        at = y[0] + (y[1] - y[0]) * k / up
        low, high = (x[0], at - half, z[0]), (x[1], at + half, z[1])
        model.box(low, high, slot, without="back left right")


def flat_window(
    model: Model, width: float, height: float, border: float, across: int, up: int
) -> None:
    """What is left of a window from afar: a board, and panes a little before it."""
    model.pane((0.0, width), (0.0, height), -0.012, "frame")
    w, h = (width - border) / across, (height - border) / up
    for i in range(across):
        for k in range(up):
            x, y = border + i * w, border + k * h
            model.pane((x, x + w - border), (y, y + h - border), 0.0, "pane")


def casement(name: str, level: int) -> Asset:
    """A French window of two leaves with three panes each, 1.2 m by 2.1 m."""
    model = Model(FRAME, PANE, BRASS)
    if level == 2:
        flat_window(model, 1.2, 2.1, 0.09, 2, 3)
        return model.asset(name)
    framed(model, (0.0, 1.2), (0.0, 2.1), 0.055, (-0.07, 0.0), level)
    for x in ((0.05, 0.6), (0.6, 1.15)):
        french_leaf(model, x, (0.05, 2.05), 0.0, 3, level)
    meeting_stile(model, 0.6, (0.06, 2.04), 0.95, level)
    return model.asset(name)


def door(name: str, level: int) -> Asset:
    """A French window down to the floor, with a panel below, 1.2 m by 2.6 m."""
    model = Model(FRAME, PANE, BRASS)
    if level == 2:
        flat_window(model, 1.2, 2.6, 0.09, 2, 4)
        model.pane((0.09, 1.11), (0.09, 0.6), 0.01, "frame")
        return model.asset(name)
    framed(model, (0.0, 1.2), (0.0, 2.6), 0.055, (-0.07, 0.0), level)
    for x in ((0.05, 0.6), (0.6, 1.15)):
        french_leaf(model, x, (0.03, 2.55), 0.62, 3, level)
    meeting_stile(model, 0.6, (0.04, 2.54), 1.1, level)
    return model.asset(name)


def small_panes(name: str, level: int) -> Asset:
    """A window of two leaves with twelve small panes each, 1.2 m by 2.4 m."""
    model = Model(FRAME, PANE, BRASS)
    if level == 2:
        flat_window(model, 1.2, 2.4, 0.07, 4, 6)
        return model.asset(name)
    framed(model, (0.0, 1.2), (0.0, 2.4), 0.055, (-0.07, 0.0), level)
    for x in ((0.05, 0.6), (0.6, 1.15)):
        french_leaf(model, x, (0.05, 2.35), 0.0, 6, level, across=2)
    meeting_stile(model, 0.6, (0.06, 2.34), 1.1, level)
    return model.asset(name)


def french_leaf(
    model: Model, x: Span, y: Span, panel: float, up: int, level: int, *, across: int = 1
) -> None:
    """A leaf with glazing bars; `panel` is how high its solid foot is (m)."""
    stile, z = 0.06, (-0.06, -0.012)
    framed(model, x, y, stile, z, level)
    inner_x, foot = (x[0] + stile, x[1] - stile), y[0] + stile
    if panel:
        top = y[0] + panel
        model.box(
            (inner_x[0], top, z[0]),
            (inner_x[1], top + stile, z[1]),
            "frame",
            without="back left right",
        )
        model.pane(inner_x, (foot, top), -0.04, "frame")
        raised(
            model,
            (inner_x[0] + 0.03, inner_x[1] - 0.03),
            (foot + 0.03, top - 0.03),
            (-0.04, -0.018),
            "frame",
            level,
        )
        foot = top + stile
    inner_y = (foot, y[1] - stile)
    bars(model, inner_x, inner_y, across, up, (-0.045, -0.018), 0.028)
    model.pane(inner_x, inner_y, -0.042, "pane")


def raised(model: Model, x: Span, y: Span, z: Span, slot: str, level: int) -> None:
    """A raised panel with a sloping border."""
    slope = 0.0 if level else min(0.035, 0.25 * (x[1] - x[0]), 0.25 * (y[1] - y[0]))
    low = [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
    high = [
        (x[0] + slope, y[0] + slope),
        (x[1] - slope, y[0] + slope),
        (x[1] - slope, y[1] - slope),
        (x[0] + slope, y[1] - slope),
    ]
    points = [(*p, z[0]) for p in low] + [(*p, z[1]) for p in high]
    for face in ([0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [4, 5, 6, 7]):
        model.facet([points[corner] for corner in face], slot)


def meeting_stile(model: Model, x: float, y: Span, knob: float, level: int) -> None:
    """The strip over the joint of two leaves, with its bolt and knob."""
    if level:
        model.box((x - 0.025, y[0], -0.012), (x + 0.025, y[1], 0.006), "frame", without="back")
        return
    half_round = np.column_stack(
        [x + 0.028 * np.cos(a := np.radians([0, 36, 72, 108, 144, 180])), 0.02 * np.sin(a) - 0.012]
    )
    model.prism(half_round, y, "frame", axis="y", caps="both")
    model.lathe([(0.006, y[0] + 0.1), (0.006, y[1] - 0.1)], (x, 0.014), "brass", sides=5)
    model.lathe(
        [
            (0.008, knob - 0.05),
            (0.02, knob - 0.03),
            (0.024, knob),
            (0.02, knob + 0.03),
            (0.008, knob + 0.05),
        ],
        (x, 0.02),
        "brass",
        sides=7,
    )


def sash(name: str, level: int) -> Asset:
    """A sliding sash window, six panes over six, with its sill, 1.0 m by 1.8 m."""
    model = Model(FRAME, PANE, STONE)
    if level == 2:
        flat_window(model, 1.0, 1.8, 0.07, 3, 4)
        return model.asset(name)
    framed(model, (0.0, 1.0), (0.06, 1.8), 0.07, (-0.16, 0.0), level)
    for y, z in (((0.12, 0.95), (-0.13, -0.08)), ((0.92, 1.74), (-0.08, -0.03))):
        framed(model, (0.06, 0.94), y, 0.045, z, level)
        inner_x, inner_y = (0.105, 0.895), (y[0] + 0.045, y[1] - 0.045)
        bars(model, inner_x, inner_y, 3, 2, (z[0] + 0.01, z[1] - 0.008), 0.022)
        model.pane(inner_x, inner_y, z[0] + 0.02, "pane")
    if level == 0:
        for x in (0.075, 0.905):  # horns
            model.prism(
                [(x, 0.88), (x + 0.02, 0.88), (x + 0.02, 0.93), (x, 0.93)], (-0.07, -0.035), "frame"
            )
    model.prism(
        [(-0.18, 0.0), (0.07, 0.0), (0.07, 0.04), (-0.18, 0.07)], (0.0, 1.0), "stone", axis="x"
    )
    return model.asset(name)


def arched(name: str, level: int) -> Asset:
    """A window with a round head, 1.2 m by 2.2 m."""
    model = Model(FRAME, PANE)
    steps = (14, 8, 6)[level]
    outline = _round_head(0.0, 1.2, 0.0, 2.2, steps)
    if level == 2:
        model.sheet(outline, -0.012, "frame")
        model.sheet(_round_head(0.09, 1.11, 0.09, 2.11, steps), 0.0, "pane")
        return model.asset(name)
    model.sweep(moulding(0.06, -0.07, 0.0, level), outline, "frame", closed=True)
    inner = _round_head(0.06, 1.14, 0.06, 2.14, steps)
    model.sheet(inner, -0.042, "pane")
    z = (-0.05, -0.012)
    model.box((0.06, 1.56, z[0]), (1.14, 1.64, z[1]), "frame", without="back left right")
    for x in ((0.06, 0.6), (0.6, 1.14)):
        framed(model, x, (0.06, 1.58), 0.05, z, level)
        bars(model, (x[0] + 0.05, x[1] - 0.05), (0.11, 1.53), 1, 3, (-0.042, -0.018), 0.026)
    model.sweep(moulding(0.045, z[0], z[1], 1), arc((0.6, 1.6), 0.25, 0, 180, steps), "frame")
    for angle in (45, 90, 135):
        ray = [
            (0.6 + r * np.cos(np.radians(angle)), 1.6 + r * np.sin(np.radians(angle)))
            for r in (0.24, 0.5)
        ]
        model.sweep(
            [(-0.013, -0.042), (0.013, -0.042), (0.013, -0.018), (-0.013, -0.018)], ray, "frame"
        )
    return model.asset(name)


def _round_head(x0: float, x1: float, y0: float, y1: float, steps: int) -> Points:
    radius = (x1 - x0) / 2
    head = arc(((x0 + x1) / 2, y1 - radius), radius, 0, 180, steps)
    return np.concatenate([[(x0, y0), (x1, y0)], head])


def lancet(name: str, level: int) -> Asset:
    """A pointed Gothic window of two lights with a quatrefoil, in stone, 1.4 m by 3.2 m."""
    model = Model(STONE, PANE)
    steps = (10, 6, 4)[level]
    outline = pointed(0.0, 1.4, 0.0, 3.2, steps)
    model.sheet(pointed(0.05, 1.35, 0.05, 3.14, steps), -0.14, "pane")
    if level == 2:
        flat = [(0.0, -0.14), (0.12, -0.14), (0.12, -0.1), (0.0, 0.0)]
        model.sweep(flat, outline, "stone", closed=True)
        model.box((0.65, 0.0, -0.14), (0.75, 2.5, -0.1), "stone", without="back")
        return model.asset(name)
    splay = [(0.0, -0.16), (0.13, -0.16), (0.13, -0.1), (0.07, -0.08), (0.05, -0.02), (0.0, 0.0)]
    model.sweep(splay, outline, "stone", closed=True)
    mullion = [
        (-0.045, -0.15),
        (0.045, -0.15),
        (0.045, -0.1),
        (0.015, -0.07),
        (-0.015, -0.07),
        (-0.045, -0.1),
    ]
    model.sweep(mullion, [(0.7, 0.05), (0.7, 2.0)], "stone")
    bar = [(-0.03, -0.15), (0.03, -0.15), (0.03, -0.1), (0.0, -0.075), (-0.03, -0.1)]
    for x in ((0.12, 0.7), (0.7, 1.28)):
        head = pointed(x[0], x[1], 1.3, 2.25, steps)[1:]
        model.sweep(bar, head, "stone")
    model.sweep(bar, arc((0.7, 2.42), 0.27, 0, 360, 3 * steps)[:-1], "stone", closed=True)
    for angle in (45, 135, 225, 315) if level == 0 else ():
        at = (0.7 + 0.13 * np.cos(np.radians(angle)), 2.42 + 0.13 * np.sin(np.radians(angle)))
        model.sweep(
            [(-0.018, -0.15), (0.018, -0.15), (0.018, -0.1), (-0.018, -0.1)],
            arc(at, 0.115, angle - 130, angle + 130, 8),
            "stone",
        )
    if level == 0:
        leads(model)
    return model.asset(name)


def leads(model: Model) -> None:
    """Saddle bars across the lights of a Gothic window."""
    for y in np.arange(0.45, 2.0, 0.36).tolist():
        for x in ((0.12, 0.66), (0.74, 1.28)):
            model.box(
                (x[0], y - 0.008, -0.142),
                (x[1], y + 0.008, -0.128),
                "stone",
                without="back left right",
            )


def pointed(x0: float, x1: float, y0: float, y1: float, steps: int) -> Points:
    """The outline of an opening under a pointed arch, counter-clockwise from the lower left."""
    half = (x1 - x0) / 2
    rise = min(y1 - y0, 1.75 * half)
    # Both arcs pass through the apex: radius from half width and rise.
    radius = (half**2 + rise**2) / (2 * half)
    spring = y1 - rise
    turn = float(np.degrees(np.arcsin(rise / radius))) if radius >= rise else 90.0
    right = arc((x1 - radius, spring), radius, 0.0, turn, steps)
    left = arc((x0 + radius, spring), radius, 180.0 - turn, 180.0, steps)
    return np.concatenate([[(x0, y0), (x1, y0)], right, left[1:]])


def fixed(name: str, level: int) -> Asset:
    """A modern window of one pane in a slim metal frame, 1.4 m by 1.5 m."""
    model = Model(FRAME, PANE, STEEL)
    if level == 2:
        flat_window(model, 1.4, 1.5, 0.05, 1, 1)
        return model.asset(name)
    framed(model, (0.0, 1.4), (0.04, 1.5), 0.05, (-0.08, 0.0), 1)
    if level == 0:
        framed(model, (0.05, 1.35), (0.09, 1.45), 0.012, (-0.05, -0.025), 1)
    model.pane((0.05, 1.35), (0.09, 1.45), -0.045, "pane")
    model.prism(
        [(-0.08, 0.0), (0.06, 0.0), (0.06, 0.015), (-0.08, 0.04)], (0.0, 1.4), "steel", axis="x"
    )
    return model.asset(name)


def ribbon(name: str, level: int) -> Asset:
    """A bay of a modern ribbon window, a fixed light beside one that opens, 2.4 m by 1.5 m."""
    model = Model(FRAME, PANE, STEEL)
    if level == 2:
        flat_window(model, 2.4, 1.5, 0.06, 2, 1)
        return model.asset(name)
    framed(model, (0.0, 2.4), (0.0, 1.5), 0.05, (-0.08, 0.0), 1)
    model.box((1.57, 0.05, -0.08), (1.63, 1.45, 0.0), "frame", without="back bottom top")
    model.pane((0.05, 1.57), (0.05, 1.45), -0.045, "pane")
    framed(model, (1.63, 2.35), (0.05, 1.45), 0.05, (-0.06, -0.01), 1)
    model.pane((1.68, 2.3), (0.1, 1.4), -0.04, "pane")
    if level == 0:
        model.box((1.645, 0.66, -0.01), (1.665, 0.8, 0.015), "steel", without="back")
    return model.asset(name)


def shutter(name: str, level: int) -> Asset:
    """A louvred shutter that lies open on the wall, 0.55 m by 2.0 m."""
    model = Model(LEAF)
    width, height, stile, front = 0.55, 2.0, 0.06, 0.045
    if level == 2:
        model.box((0.0, 0.0, 0.0), (width, height, front), "leaf", without="back")
        return model.asset(name)
    framed_leaf = rectangle((0.0, 0.0), (width, height))
    model.sweep(moulding(stile, 0.0, front, level), framed_leaf, "leaf", closed=True)
    middle = height / 2
    low, high = (stile, middle - 0.045, 0.0), (width - stile, middle + 0.045, front)
    model.box(low, high, "leaf", without="back left right")
    for foot, top in ((stile, middle - 0.045), (middle + 0.045, height - stile)):
        louvres(model, (stile, width - stile), (foot, top), (20, 11)[level])
    return model.asset(name)


def louvres(model: Model, x: Span, y: Span, count: int) -> None:
    """Slats that shed the rain: each leans out at its lower edge."""
    back, front = 0.008, 0.034
    edges = np.linspace(y[0], y[1], count + 1)
    for low, high in zip(edges[:-1].tolist(), edges[1:].tolist(), strict=True):
        slope = [(x[0], low, front), (x[1], low, front), (x[1], high, back), (x[0], high, back)]
        under = [(x[0], high, back), (x[1], high, back), (x[1], high, front), (x[0], high, front)]
        model.facet(slope, "leaf")
        model.facet(under, "leaf")
