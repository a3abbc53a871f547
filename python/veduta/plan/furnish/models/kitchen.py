"""Kitchen units and appliances. Base units have a worktop that reaches over their fronts."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body, Span
from veduta.plan.furnish.models.storage import front
from veduta.plan.furnish.models.tables import bar

_TOP_M = 0.038
_PLINTH_M = 0.1


def base_unit(
    body: Body, *, fitted: Literal["cupboard", "drawers", "sink", "hob", "dishwasher", "island"]
) -> None:
    """A base unit, plain or with what is let into it."""
    top = body.height - _TOP_M
    body.box((body.left, body.right), (body.front + 0.07, body.back), (0.0, _PLINTH_M), "plinth")
    body.box((body.left, body.right), (body.front + 0.038, body.back), (_PLINTH_M, top), "case")
    count = max(1, round(body.width / 0.55))
    xs = np.linspace(body.left, body.right, count + 1).tolist()
    with body.placed((0.0, 0.02, 0.0)):
        for k, x in enumerate(zip(xs, xs[1:], strict=False)):
            _unit_fronts(body, x, top, fitted, k)
    worktop = (body.left, body.right), (body.front, body.back)
    if fitted == "sink":
        _sink(body, *worktop, top)
        return
    body.board(*worktop, (top, body.height), "worktop")
    if fitted == "hob":
        _hob(body)


def _unit_fronts(body: Body, x: Span, top: float, fitted: str, k: int) -> None:
    low, drawer = _PLINTH_M, top - 0.17
    if fitted == "hob":
        _oven(body, x, (low + 0.02, top - 0.02))
        return
    if fitted in {"drawers", "island"} or (fitted == "cupboard" and k % 3 == 1):
        for z in ((low, low + 0.3), (low + 0.3, low + 0.56), (low + 0.56, top)):
            front(body, x, z)
            bar(body, (x[0] + 0.08, x[1] - 0.08), body.front, (z[1] - 0.05, z[1] - 0.04))
        return
    if fitted == "cupboard":
        front(body, x, (drawer, top))
        bar(body, (x[0] + 0.08, x[1] - 0.08), body.front, (top - 0.06, top - 0.05))
    high = drawer if fitted == "cupboard" else top
    front(body, x, (low, high), "steel" if fitted == "dishwasher" else "front")
    bar(body, (x[0] + 0.08, x[1] - 0.08), body.front, (high - 0.06, high - 0.05))


def _oven(body: Body, x: Span, z: Span) -> None:
    front(body, x, z, "steel")
    y = (body.front - 0.004, body.front)
    body.box((x[0] + 0.06, x[1] - 0.06), y, (z[0] + 0.12, z[1] - 0.22), "dark")
    bar(body, (x[0] + 0.06, x[1] - 0.06), body.front, (z[1] - 0.17, z[1] - 0.15))
    if not body.coarse:
        for share in (0.2, 0.4, 0.6, 0.8):
            at = x[0] + share * (x[1] - x[0])
            body.rod((at, body.front, z[1] - 0.06), (at, body.front - 0.02, z[1] - 0.06), 0.018,
                     "dark")  # fmt: skip


def _hob(body: Body) -> None:
    z = body.height
    x, y = (-0.29, 0.29), (body.front + 0.07, body.back - 0.06)
    x = (max(x[0], body.left + 0.01), min(x[1], body.right - 0.01))
    body.box(x, y, (z, z + 0.006), "dark", without="bottom")
    if body.coarse:
        return
    for a, b, r in (
        (-0.14, -0.1, 0.09),
        (0.14, -0.1, 0.07),
        (-0.14, 0.13, 0.07),
        (0.14, 0.13, 0.09),
    ):
        centre = (a, b + (y[0] + y[1]) / 2)
        body.turned([(r, z + 0.006), (r, z + 0.0075)], "ring", centre)
        body.turned([(r - 0.008, z + 0.0075), (r - 0.008, z + 0.0085)], "dark", centre)


def _sink(body: Body, x: Span, y: Span, top: float) -> None:
    """The worktop around a bowl, the bowl, a tap."""
    half = min(0.26, body.width / 2.0 - 0.06)
    bowl_x, bowl_y = (-half, half), (y[0] + 0.09, y[1] - 0.11)
    z = (top, body.height)
    body.box((x[0], bowl_x[0]), y, z, "worktop")
    body.box((bowl_x[1], x[1]), y, z, "worktop")
    body.box(bowl_x, (y[0], bowl_y[0]), z, "worktop")
    body.box(bowl_x, (bowl_y[1], y[1]), z, "worktop")
    floor = body.height - 0.17
    for a, b in (
        ((bowl_x[0], bowl_x[0] + 0.006), bowl_y), ((bowl_x[1] - 0.006, bowl_x[1]), bowl_y),
        (bowl_x, (bowl_y[0], bowl_y[0] + 0.006)), (bowl_x, (bowl_y[1] - 0.006, bowl_y[1])),
    ):  # fmt: skip
        body.box(a, b, (floor, body.height + 0.003), "steel")
    body.box(bowl_x, bowl_y, (floor - 0.006, floor), "steel")
    tap(body, (0.0, y[1] - 0.06), body.height, 0.28, 0.19)


def tap(body: Body, at: tuple[float, float], z: float, high: float, reach: float) -> None:
    """A tap that bends to the front."""
    if body.coarse:
        body.rod((*at, z), (*at, z + high), 0.014, "steel")
        return
    x, y = at
    angle = np.linspace(0.0, np.pi, 8)
    bow = [
        (x, y - reach / 2 + reach / 2 * np.cos(a), z + high - reach / 2 + reach / 2 * np.sin(a))
        for a in angle
    ]
    body.bent([(x, y, z), *bow, (x, y - reach, z + high - reach / 2 - 0.03)], 0.011, "steel")
    body.turned([(0.024, z), (0.024, z + 0.01), (0.016, z + 0.04)], "steel", at, sides=12)
    body.rod((x + 0.015, y, z + 0.04), (x + 0.08, y - 0.01, z + 0.055), 0.006, "steel")


def wall_unit(body: Body) -> None:
    """Cupboards on the wall over a worktop."""
    body.box((body.left, body.right), (body.front + 0.018, body.back), (0.0, body.height), "case")
    count = max(1, round(body.width / 0.55))
    xs = np.linspace(body.left, body.right, count + 1).tolist()
    for k, x in enumerate(zip(xs, xs[1:], strict=False)):
        front(body, x, (0.0, body.height))
        at = x[1] - 0.04 if k % 2 == 0 else x[0] + 0.04
        bar(body, (at - 0.005, at + 0.005), body.front, (0.05, 0.2))


def hood(body: Body) -> None:
    """A cooker hood: a canopy and its duct."""
    low = 0.1
    body.box((body.left, body.right), (body.front, body.back), (0.0, 0.05), "steel")
    rings = []
    for share, z in ((1.0, 0.05), (0.42, 0.05 + 2 * low)):
        x, y = share * body.width / 2, body.back - share * body.depth * 0.98
        rings.append(np.array([(-x, y, z), (x, y, z), (x, body.back, z), (-x, body.back, z)]))
    body.rings(rings, "steel")
    x = 0.18 * body.width
    body.box((-x, x), (body.back - 0.38 * body.depth, body.back), (0.05 + 2 * low, body.height),
             "steel")  # fmt: skip


def fridge(body: Body, *, doors: Literal["freezer below", "single", "double"]) -> None:
    """A refrigerator."""
    top = body.height
    body.box((body.left, body.right), (body.front + 0.06, body.back), (0.02, top), "case")
    body.box((body.left + 0.02, body.right - 0.02), (body.front + 0.1, body.back), (0.0, 0.03),
             "dark")  # fmt: skip
    split = {"freezer below": 0.38 * top, "single": 0.03, "double": 0.38 * top}[doors]
    xs = [body.left, body.right] if doors != "double" else [body.left, 0.0, body.right]
    zs = [0.03, split, top] if doors != "single" else [0.03, top]
    for x in zip(xs, xs[1:], strict=False):
        for z in zip(zs, zs[1:], strict=False):
            body.cushion((x[0] + 0.003, x[1] - 0.003), (body.front + 0.012, body.front + 0.06),
                         (z[0] + 0.004, z[1] - 0.004), "front", radius=0.01, along="y")  # fmt: skip
            near_hinge = (
                x[1] - 0.05 if x[1] < body.right - 0.01 or doors != "double" else x[0] + 0.05
            )
            low = (
                max(z[0] + 0.08, z[1] - 0.55) if z[0] < 0.1 and doors != "single" else split + 0.08
            )
            low = low if doors != "single" else 0.45 * top
            bar(body, (near_hinge - 0.007, near_hinge + 0.007), body.front + 0.012,
                (low, min(low + 0.4, z[1] - 0.05)))  # fmt: skip


def tall_oven(body: Body) -> None:
    """A tall cupboard with an oven in it."""
    body.box((body.left, body.right), (body.front + 0.018, body.back), (0.08, body.height), "case")
    body.box((body.left, body.right), (body.front + 0.06, body.back), (0.0, 0.08), "plinth")
    x = (body.left, body.right)
    for z in ((0.08, 0.72), (1.36, body.height)):
        front(body, x, z)
        bar(body, (x[0] + 0.08, x[1] - 0.08), body.front,
            (z[1] - 0.06, z[1] - 0.05) if z[0] < 1 else (z[0] + 0.05, z[0] + 0.06))  # fmt: skip
    _oven(body, x, (0.74, 1.34))


def washer(body: Body, *, dryer: bool = False) -> None:
    """A washing machine or a dryer."""
    body.cushion((body.left, body.right), (body.front + 0.02, body.back), (0.015, body.height),
                 "case", radius=0.012)  # fmt: skip
    z, r = 0.44 * body.height, 0.36 * body.width
    n = 12 if body.coarse else 28
    angle = 2 * np.pi * np.arange(n) / n
    for radius, y0, y1, slot in (
        (r, body.front, body.front + 0.021, "steel"),
        (0.78 * r, body.front - 0.004, body.front + 0.001, "dark"),
    ):
        with body.placed((0.0, 0.0, z)):
            ring = radius * np.column_stack([np.cos(angle), np.sin(angle)])
            body.drawn(ring, (y0, y1), slot, axis="y")
    top = body.height
    body.box((body.left + 0.02, body.right - 0.02), (body.front + 0.012, body.front + 0.022),
             (top - 0.13, top - 0.02), "panel")  # fmt: skip
    body.rod((0.0 if dryer else 0.12, body.front + 0.012, top - 0.075),
             (0.0 if dryer else 0.12, body.front - 0.005, top - 0.075), 0.028, "steel")  # fmt: skip
    if not body.coarse:
        body.box((body.left + 0.05, body.left + 0.2), (body.front + 0.008, body.front + 0.014),
                 (top - 0.11, top - 0.04), "case")  # fmt: skip


def small_appliance(
    body: Body, *, kind: Literal["microwave", "toaster", "kettle", "coffee", "blocks"]
) -> None:
    """What stands on a worktop."""
    x, y, top = (body.left, body.right), (body.front, body.back), body.height
    if kind == "microwave":
        body.cushion(x, (y[0] + 0.01, y[1]), (0.01, top), "steel", radius=0.012)
        body.box((x[0] + 0.02, x[1] - 0.13), (y[0], y[0] + 0.012), (0.03, top - 0.02), "dark")
        body.box((x[1] - 0.11, x[1] - 0.02), (y[0] + 0.004, y[0] + 0.012), (0.03, top - 0.02),
                 "dark")  # fmt: skip
        bar(body, (x[1] - 0.125, x[1] - 0.115), y[0] + 0.012, (0.05, top - 0.05))
    elif kind == "toaster":
        body.cushion(x, y, (0.01, top), "steel", radius=0.035)
        for b in (-0.03, 0.03):
            body.box((x[0] + 0.04, x[1] - 0.04), (b - 0.012, b + 0.012), (top - 0.01, top + 0.001),
                     "dark")  # fmt: skip
    elif kind == "kettle":
        r = 0.36 * body.width
        body.turned([(0.95 * r, 0.0), (r, 0.02), (0.78 * r, 0.8 * top), (0.6 * r, 0.93 * top),
                     (0.12 * r, 0.95 * top), (0.12 * r, top)], "steel")  # fmt: skip
        body.bent([(0.7 * r, 0, 0.85 * top), (1.35 * r, 0, 0.8 * top), (1.35 * r, 0, 0.3 * top),
                   (0.95 * r, 0, 0.18 * top)], 0.011, "dark")  # fmt: skip
        body.rod((-0.7 * r, 0, 0.6 * top), (-1.35 * r, 0, 0.85 * top), (0.02, 0.012), "steel")
    elif kind == "coffee":
        body.cushion(x, (y[0] + 0.55 * body.depth, y[1]), (0.0, top), "dark", radius=0.02)
        body.cushion(x, y, (top - 0.1, top), "dark", radius=0.02)
        body.cushion(x, y, (0.0, 0.03), "dark", radius=0.012)
        body.turned([(0.05, 0.035), (0.065, 0.1), (0.05, 0.16)], "glass", (0.0, -0.06))
    else:
        for k, a in enumerate(np.linspace(x[0] + 0.04, x[1] - 0.04, 3).tolist()):
            r, high = 0.036, top * (1.0, 0.82, 0.66)[k]
            body.turned([(r, 0.0), (r, 0.85 * high)], "pot", (a, 0.0))
            body.turned([(r, 0.85 * high), (0.9 * r, high)], "lid", (a, 0.0))
