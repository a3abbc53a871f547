"""Tables, desks and what stands beside beds and sofas."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body, oval

Legs = Literal["square", "round", "trestle", "sled", "splayed"]


def table(body: Body, *, legs: Legs, top_m: float = 0.03, apron: bool = True) -> None:
    """A rectangular top on four legs or two trestles."""
    top = body.height - top_m
    body.board((body.left, body.right), (body.front, body.back), (top, body.height), "top")
    inset = 0.05 if body.width > 0.8 else 0.03
    x0, x1 = body.left + inset, body.right - inset
    y0, y1 = body.front + inset, body.back - inset
    if legs == "trestle":
        _trestles(body, top)
        return
    if legs == "sled":
        for x in (x0 + 0.06, x1 - 0.06):
            body.box((x - 0.02, x + 0.02), (y0, y1), (0.0, 0.03), "legs")
            body.box((x - 0.02, x + 0.02), (y0, y1), (top - 0.03, top), "legs")
            for y in (y0, y1 - 0.04):
                body.box((x - 0.02, x + 0.02), (y, y + 0.04), (0.03, top - 0.03), "legs")
        return
    thick = 0.03 if body.width > 0.9 else 0.02
    for x in (x0, x1):
        for y in (y0, y1):
            if legs == "square":
                body.box((x - thick, x + thick), (y - thick, y + thick), (0.0, top), "legs")
            else:
                out = 0.03 if legs == "splayed" else 0.0
                foot = (x + np.sign(x) * out, y + np.sign(y) * out, 0.0)
                body.rod(foot, (x, y, top), (0.5 * thick, 0.85 * thick), "legs")
    if apron:
        low = top - min(0.08, 0.12 * body.height)
        for y in (y0, y1):
            body.box((x0, x1), (y - 0.01, y + 0.01), (low, top), "legs")
        for x in (x0, x1):
            body.box((x - 0.01, x + 0.01), (y0, y1), (low, top), "legs")


def _trestles(body: Body, top: float) -> None:
    for x in (body.left + 0.22 * body.width, body.right - 0.22 * body.width):
        for y in (-0.36 * body.depth, 0.36 * body.depth):
            body.rod((x, y, 0.0), (x, 0.35 * y, top), (0.028, 0.028), "legs")
        body.box((x - 0.02, x + 0.02), (-0.4 * body.depth, 0.4 * body.depth),
                 (top - 0.05, top), "legs")  # fmt: skip
    body.box((body.left + 0.22 * body.width, body.right - 0.22 * body.width), (-0.02, 0.02),
             (0.28, 0.34), "legs")  # fmt: skip


def round_table(body: Body, *, foot: Literal["pedestal", "tripod", "legs", "drum"]) -> None:
    """A round or oval top."""
    n = 12 if body.coarse else 36
    stretch = (1.0, body.depth / body.width)
    radius, top = body.width / 2.0, body.height
    thick = min(0.03, 0.08 * top)
    if foot == "drum":
        body.turned([(0.94 * radius, 0.0), (radius, 0.02), (radius, top - 0.02),
                     (0.98 * radius, top)], "top", stretch=stretch, sides=n)  # fmt: skip
        return
    body.turned(
        [(0.97 * radius, top - thick), (radius, top - 0.7 * thick), (radius, top - 0.2 * thick),
         (0.985 * radius, top)],
        "top", stretch=stretch, sides=n,
    )  # fmt: skip
    if foot == "pedestal":
        wide = 0.55 * radius
        body.turned(
            [(wide, 0.0), (wide, 0.02), (0.35 * wide, 0.06), (0.05, 0.16), (0.045, 0.6 * top),
             (0.07, top - 0.08), (0.4 * wide, top - thick)],
            "legs",
        )  # fmt: skip
        return
    count = 3 if foot == "tripod" else 4
    for k in range(count):
        angle = 2.0 * np.pi * (k + 0.5) / count
        way = np.array([np.cos(angle), np.sin(angle)])
        end, start = 0.84 * radius * way, (0.62 if foot == "legs" else 0.45) * radius * way
        body.rod((*end, 0.0), (*start, top - thick), (0.012, 0.019), "legs")


def box_table(body: Body) -> None:
    """A low table with a shelf below."""
    body.board((body.left, body.right), (body.front, body.back), (body.height - 0.035, body.height),
               "top")  # fmt: skip
    for x in (body.left + 0.03, body.right - 0.03):
        for y in (body.front + 0.03, body.back - 0.03):
            body.box((x - 0.022, x + 0.022), (y - 0.022, y + 0.022), (0.0, body.height - 0.035),
                     "legs")  # fmt: skip
    body.board((body.left + 0.02, body.right - 0.02), (body.front + 0.02, body.back - 0.02),
               (0.12, 0.14), "top")  # fmt: skip


def side_table(body: Body, *, style: Literal["drawer", "open", "cube"]) -> None:
    """A bedside or side table."""
    x, y = (body.left, body.right), (body.front, body.back)
    top = body.height
    if style == "cube":
        body.board(x, y, (0.0, 0.02), "top")
        for a in ((x[0], x[0] + 0.02), (x[1] - 0.02, x[1])):
            body.box(a, y, (0.02, top - 0.02), "top")
        body.box((x[0] + 0.02, x[1] - 0.02), (y[1] - 0.015, y[1]), (0.02, top - 0.02), "top")
        body.box((x[0] + 0.02, x[1] - 0.02), y, (0.5 * top, 0.5 * top + 0.018), "top")
        body.board(x, y, (top - 0.02, top), "top")
        return
    for foot in (x[0] + 0.025, x[1] - 0.025):
        for b in (y[0] + 0.025, y[1] - 0.025):
            body.rod((foot, b, 0.0), (foot, b, top - 0.02), (0.011, 0.017), "legs")
    body.board(x, y, (top - 0.022, top), "top")
    if style == "open":
        body.board((x[0] + 0.01, x[1] - 0.01), (y[0] + 0.01, y[1] - 0.01),
                   (0.16, 0.178), "top")  # fmt: skip
        return
    depth = 0.16 if top < 0.6 else 0.2
    body.box((x[0] + 0.012, x[1] - 0.012), (y[0] + 0.02, y[1] - 0.01),
             (top - 0.02 - depth, top - 0.02), "top")  # fmt: skip
    body.board((x[0] + 0.02, x[1] - 0.02), (y[0] + 0.004, y[0] + 0.02),
               (top - 0.012 - depth, top - 0.03), "front")  # fmt: skip
    knob(body, 0.0, y[0] + 0.004, top - 0.02 - depth / 2)


def knob(body: Body, x: float, y: float, z: float, slot: str = "handle") -> None:
    """A round knob on a front at y."""
    if not body.coarse:
        body.rod((x, y, z), (x, y - 0.022, z), (0.008, 0.013), slot)


def bar(body: Body, x: tuple[float, float], y: float, z: tuple[float, float]) -> None:
    """A bar handle on a front at y, from one corner to the other."""
    if not body.coarse:
        body.box(x, (y - 0.022, y - 0.012), z, "handle")
        across = (x[1] - x[0]) > (z[1] - z[0])
        for share in (0.12, 0.88):
            if across:
                at = x[0] + share * (x[1] - x[0])
                body.box((at - 0.005, at + 0.005), (y - 0.012, y), z, "handle")
            else:
                at = z[0] + share * (z[1] - z[0])
                body.box(x, (y - 0.012, y), (at - 0.005, at + 0.005), "handle")


def desk(body: Body, *, drawers: Literal["none", "one side", "both"]) -> None:
    """A desk; who sits at it sits at its front."""
    top = body.height - 0.028
    body.board((body.left, body.right), (body.front, body.back), (top, body.height), "top")
    wide = min(0.42, 0.32 * body.width)
    blocks = {"none": [], "one side": [1], "both": [-1, 1]}[drawers]
    for side in (-1, 1):
        edge = side * (body.width / 2.0 - 0.03)
        x = (edge - wide, edge) if side > 0 else (edge, edge + wide)
        if side in blocks:
            y = (body.front + 0.03, body.back - 0.03)
            body.box(x, (y[0] + 0.018, y[1]), (0.06, top), "top", without="top")
            for low, high in ((0.08, 0.3), (0.31, 0.5), (0.51, 0.69)):
                z = (low / 0.7 * top, high / 0.7 * top)
                body.board((x[0] + 0.004, x[1] - 0.004), (y[0], y[0] + 0.018), z, "front")
                middle = (x[0] + x[1]) / 2
                height = (z[0] + z[1]) / 2
                bar(body, (middle - 0.06, middle + 0.06), y[0], (height, height + 0.008))
            body.box((x[0] + 0.02, x[1] - 0.02), (y[0] + 0.05, y[1] - 0.02), (0.0, 0.06), "legs")
        else:
            at = edge - side * 0.02
            for y_at in (body.front + 0.04, body.back - 0.04):
                body.rod((at, y_at, 0.0), (at, y_at, top), (0.016, 0.022), "legs")
    if drawers == "none":
        body.box((body.left + 0.06, body.right - 0.06), (body.back - 0.05, body.back - 0.03),
                 (top - 0.25, top), "front")  # fmt: skip


def dressing_table(body: Body) -> None:
    """A table with a drawer and an oval mirror on it."""
    top = 0.76
    body.board((body.left, body.right), (body.front, body.back), (top - 0.022, top), "top")
    for x in (body.left + 0.03, body.right - 0.03):
        for y in (body.front + 0.03, body.back - 0.03):
            body.rod((x, y, 0.0), (x, y, top - 0.02), (0.012, 0.02), "legs")
    body.box((body.left + 0.02, body.right - 0.02), (body.front + 0.03, body.back - 0.02),
             (top - 0.13, top - 0.022), "top")  # fmt: skip
    for side in (-1, 1):
        span = sorted((side * 0.01, side * (body.width / 2 - 0.03)))
        body.board((span[0], span[1]), (body.front + 0.014, body.front + 0.03),
                   (top - 0.125, top - 0.03), "front")  # fmt: skip
        knob(body, (span[0] + span[1]) / 2, body.front + 0.014, top - 0.078)
    high = body.height - top - 0.05
    n = 12 if body.coarse else 28
    with body.placed((0.0, body.back - 0.05, top + 0.05 + high / 2)):
        body.drawn(oval(0.62 * body.width, high, n), (-0.004, 0.02), "legs", axis="y")
        body.drawn(oval(0.57 * body.width, high - 0.05, n), (-0.008, -0.003), "mirror", axis="y")
    body.rod((0.0, body.back - 0.04, top), (0.0, body.back - 0.04, top + 0.08), 0.02, "legs")


def workbench(body: Body) -> None:
    """A heavy top and a shelf below."""
    table(body, legs="square", top_m=0.06)
    body.board((body.left + 0.06, body.right - 0.06), (body.front + 0.06, body.back - 0.06),
               (0.18, 0.21), "legs")  # fmt: skip
