"""Sanitary ware: the wall is at +y."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body, oval, rounded
from veduta.plan.furnish.models.kitchen import tap
from veduta.plan.furnish.models.storage import front
from veduta.plan.furnish.models.tables import bar, knob


def _bowl(
    body: Body, y: tuple[float, float], wide: float, low: float, high: float, slot: str,
    *, foot: float = 0.6, inside: bool = True,
) -> None:  # fmt: skip
    """An oval bowl on a narrowing foot, hollow above, between two depths."""
    n = 14 if body.coarse else 32
    middle, deep = (y[0] + y[1]) / 2, y[1] - y[0]
    levels = ((foot, low), (foot, low + 0.3 * (high - low)), (0.86, low + 0.65 * (high - low)),
              (0.98, high - 0.03), (1.0, high))  # fmt: skip
    rings = [_level(wide * s, deep * s, middle + 0.25 * deep * (1 - s), z, n) for s, z in levels]
    if inside:
        rings += [
            _level(0.88 * wide, 0.9 * deep, middle, high, n),
            _level(0.72 * wide, 0.74 * deep, middle, high - 0.07, n),
            _level(0.38 * wide, 0.36 * deep, middle, high - 0.13, n),
        ]
    body.rings(rings, slot)


def _level(wide: float, deep: float, y: float, z: float, n: int) -> np.ndarray:
    return np.column_stack([oval(wide, deep, n) + np.array([0.0, y]), np.full(n, z)])


def toilet(body: Body, *, hung: bool) -> None:
    """A toilet with seat and lid, and its cistern, or the plate of one in the wall."""
    seat = 0.40
    tank = 0.17 if not hung else 0.02
    y = (body.front, body.back - tank + 0.02)
    low = 0.08 if hung else 0.0
    _bowl(body, y, 0.36, low, seat, "ceramic", foot=0.5 if hung else 0.62)
    if hung:
        body.box((-0.12, 0.12), (body.back - 0.25, body.back - 0.012), (0.14, seat - 0.03),
                 "ceramic")  # fmt: skip
        body.box((-0.12, 0.12), (body.back - 0.012, body.back), (body.height - 0.17, body.height),
                 "steel")  # fmt: skip
    else:
        body.cushion((-0.11, 0.11), (body.back - 0.3, body.back - 0.02), (0.0, seat - 0.02),
                     "ceramic", radius=0.04)  # fmt: skip
        body.cushion((body.left, body.right), (body.back - tank, body.back),
                     (seat - 0.02, body.height - 0.03), "ceramic", radius=0.035)  # fmt: skip
        body.cushion((body.left, body.right), (body.back - tank - 0.006, body.back),
                     (body.height - 0.03, body.height), "ceramic", radius=0.012)  # fmt: skip
    n = 14 if body.coarse else 32
    middle, deep = (y[0] + y[1]) / 2 - 0.01, y[1] - y[0] - 0.02
    lid = [
        _level(0.36 * s, deep * s, middle, z, n)
        for s, z in ((1.0, seat), (1.02, seat + 0.008), (1.02, seat + 0.032), (0.96, seat + 0.04))
    ]
    body.rings(lid, "seat")


def bidet(body: Body) -> None:
    """A bidet with its tap."""
    high = body.height - 0.09
    _bowl(body, (body.front, body.back), body.width, 0.0, high, "ceramic", foot=0.62)
    tap(body, (0.0, body.back - 0.07), high - 0.005, 0.095, 0.11)


def basin(body: Body, *, stand: Literal["pedestal", "cabinet", "console", "wall"]) -> None:
    """A washbasin; wide ones have two bowls."""
    rim = body.height - (0.12 if stand != "wall" else 0.1)
    slab = rim - 0.045 if stand == "cabinet" else rim - 0.14
    bowls = 2 if body.width > 1.15 else 1
    if stand == "cabinet":
        _vanity(body, rim - 0.03)
        body.cushion((body.left, body.right), (body.front, body.back), (rim - 0.03, rim), "ceramic",
                     radius=0.012)  # fmt: skip
    elif stand == "console":
        body.board((body.left, body.right), (body.front, body.back), (rim - 0.13, rim - 0.1),
                   "case")  # fmt: skip
        for x in (body.left + 0.03, body.right - 0.03):
            body.box((x - 0.015, x + 0.015), (body.front + 0.02, body.front + 0.05),
                     (0.0, rim - 0.13), "steel")  # fmt: skip
            body.box((x - 0.015, x + 0.015), (body.back - 0.05, body.back - 0.02),
                     (0.0, rim - 0.13), "steel")  # fmt: skip
        body.board((body.left + 0.03, body.right - 0.03), (body.front + 0.03, body.back - 0.03),
                   (0.25, 0.27), "case")  # fmt: skip
    else:
        body.cushion((body.left, body.right), (body.back - 0.12, body.back), (slab, rim), "ceramic",
                     radius=0.025)  # fmt: skip
        if stand == "pedestal":
            body.turned([(0.11, 0.0), (0.1, 0.03), (0.075, 0.25), (0.085, slab)], "ceramic",
                        (0.0, body.back - 0.17))  # fmt: skip
    each = body.width / bowls
    for k in range(bowls):
        x = body.left + (k + 0.5) * each
        with body.placed((x, 0.0, 0.0)):
            if stand == "cabinet":
                _let_in(body, rim, min(0.5, each - 0.1))
            else:
                low = rim - 0.1 if stand == "console" else slab - 0.04
                wide = min(0.46, each - 0.08) if stand == "console" else body.width
                _bowl(body, (body.front + (0.03 if stand == "console" else 0.0), body.back - 0.09),
                      wide, low, rim + 0.0, "ceramic", foot=0.6)  # fmt: skip
            tap(body, (0.0, body.back - 0.055), rim if stand != "console" else rim - 0.1,
                0.11 if stand != "console" else 0.21, 0.12)  # fmt: skip


def _let_in(body: Body, rim: float, wide: float) -> None:
    """A raised rim and a hollow that is dark at its bottom, on a flat top."""
    n = 14 if body.coarse else 32
    deep = body.depth - 0.19
    middle = -0.035
    body.rings(
        [
            _level(wide * s, deep * s, middle, z, n)
            for s, z in ((1.0, rim), (0.98, rim + 0.022), (0.9, rim + 0.022), (0.8, rim + 0.004),
                         (0.4, rim + 0.002))
        ],
        "ceramic",
    )  # fmt: skip
    body.turned([(0.022, rim + 0.002), (0.022, rim + 0.006)], "steel", (0.0, middle), sides=12)


def _vanity(body: Body, top: float) -> None:
    low = 0.28
    body.box((body.left, body.right), (body.front + 0.03, body.back), (low, top), "case")
    count = 2 if body.width > 0.75 else 1
    xs = np.linspace(body.left, body.right, count + 1).tolist()
    with body.placed((0.0, 0.012, 0.0)):
        for x in zip(xs, xs[1:], strict=False):
            for z in ((low, (low + top) / 2), ((low + top) / 2, top)):
                front(body, x, z)
                bar(body, (x[0] + 0.1, x[1] - 0.1), body.front, (z[1] - 0.05, z[1] - 0.042))


def bathtub(body: Body, *, free: bool) -> None:
    """A bathtub, built in or standing free; its tap is at the left."""
    if free:
        _free_tub(body)
        return
    rim, x, y = body.height, (body.left, body.right), (body.front, body.back)
    steps = 3 if body.coarse else 7

    def ring(inset: float, radius: float, z: float, shift: float = 0.0) -> np.ndarray:
        half = np.array([body.width / 2 - inset - abs(shift), body.depth / 2 - inset])
        points = rounded(half, min(radius, 0.95 * half.min()), steps)
        return np.column_stack([points + np.array([shift, 0.0]), np.full(len(points), z)])

    body.box(x, (y[0] + 0.012, y[1]), (0.0, rim - 0.04), "panel", without="top")
    body.rings(
        [ring(0.0, 0.02, rim - 0.04), ring(0.0, 0.02, rim - 0.008), ring(0.008, 0.02, rim),
         ring(0.07, 0.16, rim), ring(0.085, 0.17, rim - 0.02), ring(0.11, 0.2, rim - 0.2, 0.02),
         ring(0.17, 0.18, rim - 0.4, 0.04)],
        "ceramic",
    )  # fmt: skip
    _mixer(body, (body.left + 0.12, body.back - 0.03), rim)


def _mixer(body: Body, at: tuple[float, float], z: float) -> None:
    if body.coarse:
        return
    x, y = at
    body.rod((x, y, z), (x, y, z + 0.09), 0.014, "steel")
    body.rod((x - 0.05, y, z + 0.09), (x + 0.1, y, z + 0.09), 0.018, "steel")
    body.rod((x + 0.03, y, z + 0.09), (x + 0.03, y - 0.11, z + 0.075), 0.011, "steel")


def _free_tub(body: Body) -> None:
    n = 16 if body.coarse else 40
    rim = body.height
    levels = ((0.74, 0.0), (0.84, 0.06), (0.94, 0.5 * rim), (0.99, 0.95 * rim), (1.0, rim - 0.01),
              (0.98, rim), (0.92, rim), (0.9, rim - 0.03), (0.8, 0.45 * rim),
              (0.68, 0.24 * rim))  # fmt: skip
    body.rings([_level(body.width * s, body.depth * s, 0.0, z, n) for s, z in levels], "ceramic")


def shower(body: Body, *, quadrant: bool = False) -> None:
    """A tray with glass at its front and right side, a head on a bar at the back."""
    x, y, top = (body.left, body.right), (body.front, body.back), body.height
    body.board(x, y, (0.0, 0.06), "ceramic", edge=0.008)
    body.turned([(0.045, 0.06), (0.045, 0.063)], "steel", (0.0, 0.1), sides=14)
    t = 0.008
    if quadrant:
        n = 5 if body.coarse else 12
        angle = np.radians(np.linspace(-90.0, 0.0, n))
        r = 0.55 * min(body.width, body.depth)
        centre = np.array([x[1] - r, y[0] + r])
        bow = centre + r * np.column_stack([np.cos(angle), np.sin(angle)])
        line = np.vstack([[x[0], y[0]], bow, [x[1], y[1]]])
        inner = line.copy()
        inner[:, 0] -= t
        inner[:, 1] += t
        body.drawn(np.vstack([line, inner[::-1]]), (0.06, top), "glass")
    else:
        door = x[0] + 0.42 * body.width
        body.box((door, x[1]), (y[0], y[0] + t), (0.06, top), "glass")
        body.box((x[1] - t, x[1]), (y[0] + t, y[1]), (0.06, top), "glass")
        body.box((door - 0.012, door), (y[0], y[0] + 0.02), (0.06, top), "steel")
        body.box((x[0], x[1]), (y[0], y[0] + 0.016), (top - 0.02, top), "steel")
    body.box((x[1] - 0.02, x[1]), (y[1] - 0.02, y[1]), (0.06, top), "steel")
    body.rod((0.0, y[1] - 0.04, 0.95), (0.0, y[1] - 0.04, top - 0.02), 0.011, "steel")
    body.rod((0.0, y[1] - 0.04, top - 0.03), (0.0, y[1] - 0.34, top - 0.01), 0.011, "steel")
    body.turned([(0.11, top - 0.045), (0.11, top - 0.03)], "steel", (0.0, y[1] - 0.34))
    body.rod((-0.07, y[1] - 0.035, 1.05), (0.07, y[1] - 0.035, 1.05), 0.02, "steel")


def towel_rail(body: Body) -> None:
    """A heated rail with a towel over it."""
    y = body.back - 0.06
    for x in (body.left + 0.02, body.right - 0.02):
        body.rod((x, y, 0.0), (x, y, body.height), 0.016, "steel")
        for z in (0.1, body.height - 0.1):
            body.rod((x, y, z), (x, body.back, z), 0.01, "steel")
    count = 6 if body.coarse else round(body.height / 0.07)
    for k, z in enumerate(np.linspace(0.03, body.height - 0.03, count).tolist()):
        if k % 5 != 4:
            body.rod((body.left + 0.02, y, z), (body.right - 0.02, y, z), 0.009, "steel")
    towel = (body.left + 0.08, body.right - 0.08)
    body.cushion(towel, (y - 0.04, y + 0.025), (0.5 * body.height, 0.93 * body.height), "towel",
                 radius=0.03)  # fmt: skip


def mirror(
    body: Body, *, shape: Literal["plain", "framed", "round"], cabinet: bool = False
) -> None:
    """A mirror on the wall."""
    y = (body.back - body.depth, body.back)
    if shape == "round":
        n = 16 if body.coarse else 40
        with body.placed((0.0, 0.0, body.height / 2)):
            body.drawn(oval(body.width, body.height, n), (y[0] + 0.004, y[1]), "frame", axis="y")
            body.drawn(oval(body.width - 0.05, body.height - 0.05, n), (y[0], y[0] + 0.005),
                       "mirror", axis="y")  # fmt: skip
        return
    edge = 0.04 if shape == "framed" else 0.003
    body.board((body.left, body.right), (y[0] + 0.003, y[1]), (0.0, body.height), "frame")
    halves = ((body.left, 0.0), (0.0, body.right)) if cabinet else ((body.left, body.right),)
    for x in halves:
        body.box((x[0] + edge, x[1] - edge), (y[0], y[0] + 0.004), (edge, body.height - edge),
                 "mirror")  # fmt: skip


def standing_mirror(body: Body) -> None:
    """A tall mirror that leans against the wall."""
    lean = np.arctan2(body.depth - 0.03, body.height)
    with body.placed((0.0, body.front + 0.03, 0.0), tilt=lean):
        high = body.height / np.cos(lean) - 0.01
        body.board((body.left, body.right), (-0.026, 0.0), (0.0, high), "frame")
        body.box((body.left + 0.045, body.right - 0.045), (-0.03, -0.024), (0.045, high - 0.045),
                 "mirror")  # fmt: skip


def sauna_bench(body: Body) -> None:
    """Two steps of slats."""
    for deep, low, high in ((body.depth, 0.0, 0.45), (0.55 * body.depth, 0.45, body.height)):
        y0 = body.back - deep
        for y in np.arange(y0, body.back - 0.06, 0.1):
            body.board((body.left, body.right), (y, y + 0.085), (high - 0.03, high), "seat")
        for z in np.arange(low + 0.04, high - 0.12, 0.14):
            body.box((body.left, body.right), (y0 + 0.01, y0 + 0.035), (z, z + 0.09), "seat")
        for x in (body.left + 0.05, body.right - 0.05):
            body.box((x - 0.03, x + 0.03), (y0 + 0.035, body.back), (low, high - 0.03), "seat")


def sauna_stove(body: Body) -> None:
    """A stove with stones on it."""
    body.box((body.left, body.right), (body.front, body.back), (0.08, body.height - 0.1), "dark")
    for x in (body.left + 0.03, body.right - 0.03):
        for y in (body.front + 0.03, body.back - 0.03):
            body.box((x - 0.015, x + 0.015), (y - 0.015, y + 0.015), (0.0, 0.08), "steel")
    rng = np.random.default_rng(5)
    for k in range(6 if body.coarse else 14):
        x, y = rng.uniform(-0.36, 0.36, 2) * (body.width, body.depth)
        r = float(rng.uniform(0.04, 0.06))
        z = body.height - 0.12 + 0.03 * (k % 3)
        body.turned([(0.5 * r, z), (r, z + 0.4 * r), (0.9 * r, z + r), (0.3 * r, z + 1.35 * r)],
                    "stone", (float(x), float(y)), sides=7)  # fmt: skip
    knob(body, 0.0, body.front, 0.3, "steel")
