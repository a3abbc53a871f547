"""Wardrobes, chests, shelves, cupboards. Doors and drawers are at the front, -y."""

from __future__ import annotations

import zlib
from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body, Span
from veduta.plan.furnish.models.tables import bar, knob

_FRONT_M = 0.018
_GAP_M = 0.003


def carcass(body: Body, *, plinth_m: float = 0.07, legs: bool = False, top: bool = True) -> Span:
    """The closed box behind the fronts; the heights between which fronts go."""
    low = plinth_m
    x = (body.left, body.right)
    y = (body.front + _FRONT_M, body.back)
    if legs:
        for a in (x[0] + 0.06, x[1] - 0.06):
            for b in (y[0] + 0.05, y[1] - 0.05):
                body.rod((a, b, 0.0), (a, b, low + 0.01), (0.012, 0.019), "legs")
    else:
        body.box((x[0] + 0.01, x[1] - 0.01), (y[0] + 0.03, y[1]), (0.0, low), "case")
    high = body.height - (0.022 if top else 0.0)
    body.box(x, y, (low, high), "case")
    if top:
        body.board(x, (body.front, body.back), (high, body.height), "top")
    return (low, high)


def front(body: Body, x: Span, z: Span, slot: str = "front") -> None:
    """A plain front with a shadow gap around it."""
    body.board(
        (x[0] + _GAP_M, x[1] - _GAP_M), (body.front, body.front + _FRONT_M),
        (z[0] + _GAP_M, z[1] - _GAP_M), slot, edge=0.003,
    )  # fmt: skip


def framed_front(body: Body, x: Span, z: Span, slot: str = "front") -> None:
    """A front with a raised frame around a panel."""
    front(body, x, z, slot)
    if body.coarse:
        return
    y = (body.front - 0.006, body.front)
    inner = 0.055
    a, b = x[0] + _GAP_M, x[1] - _GAP_M
    c, d = z[0] + _GAP_M, z[1] - _GAP_M
    body.box((a, a + inner), y, (c, d), slot)
    body.box((b - inner, b), y, (c, d), slot)
    body.box((a + inner, b - inner), y, (c, c + inner), slot)
    body.box((a + inner, b - inner), y, (d - inner, d), slot)


def wardrobe(body: Body, *, doors: Literal["hinged", "framed", "sliding", "mirror"]) -> None:
    """A tall cupboard with as many doors as its width asks for."""
    z = carcass(body, plinth_m=0.06)
    each = 0.8 if doors in {"sliding", "mirror"} else 0.5
    count = max(2, round(body.width / each))
    edges = np.linspace(body.left, body.right, count + 1)
    for k, x in enumerate(zip(edges.tolist(), edges[1:].tolist(), strict=False)):
        if doors == "framed":
            framed_front(body, x, z)
        else:
            front(body, x, z)
        if doors == "mirror" and k % 2 == count // 2 % 2 and not body.coarse:
            body.box((x[0] + 0.03, x[1] - 0.03), (body.front - 0.003, body.front),
                     (z[0] + 0.03, z[1] - 0.03), "mirror")  # fmt: skip
        if doors in {"hinged", "framed"}:
            right_hand = k % 2 == 0
            at = x[1] - 0.04 if right_hand else x[0] + 0.04
            bar(body, (at - 0.006, at + 0.006), body.front - (0.006 if doors == "framed" else 0.0),
                (0.9, 1.15))  # fmt: skip
        else:
            at = x[0] + 0.05 if k % 2 else x[1] - 0.05
            body.box((at - 0.012, at + 0.012), (body.front - 0.004, body.front), (0.85, 1.25),
                     "handle")  # fmt: skip


def chest(body: Body, *, rows: int, legs: bool, framed: bool = False) -> None:
    """A chest of drawers; wide ones have two in a row."""
    z = carcass(body, plinth_m=0.14 if legs else 0.06, legs=legs)
    columns = 2 if body.width > 1.05 else 1
    xs = np.linspace(body.left, body.right, columns + 1).tolist()
    zs = np.linspace(z[0], z[1], rows + 1).tolist()
    for x in zip(xs, xs[1:], strict=False):
        for at in zip(zs, zs[1:], strict=False):
            front(body, x, at)
            middle, height = (x[0] + x[1]) / 2, (at[0] + at[1]) / 2
            if framed:
                for share in (0.25, 0.75):
                    knob(body, x[0] + share * (x[1] - x[0]), body.front, height)
            else:
                bar(body, (middle - 0.08, middle + 0.08), body.front, (height, height + 0.009))


def sideboard(body: Body, *, legs: bool, drawers: bool = True) -> None:
    """A low cupboard: doors, and drawers in the middle."""
    z = carcass(body, plinth_m=0.16 if legs else 0.06, legs=legs)
    count = max(2, round(body.width / 0.5))
    edges = np.linspace(body.left, body.right, count + 1).tolist()
    for k, x in enumerate(zip(edges, edges[1:], strict=False)):
        if drawers and k == count // 2:
            zs = np.linspace(z[0], z[1], 4).tolist()
            for at in zip(zs, zs[1:], strict=False):
                front(body, x, at)
                knob(body, (x[0] + x[1]) / 2, body.front, (at[0] + at[1]) / 2)
        else:
            front(body, x, z)
            knob(body, x[1] - 0.05 if k % 2 == 0 else x[0] + 0.05, body.front,
                 z[1] - 0.1)  # fmt: skip


def tv_bench(body: Body, *, legs: bool) -> None:
    """A low board for a television: open in its middle, drawers at its ends."""
    low = 0.14 if legs else 0.05
    x, y = (body.left, body.right), (body.front, body.back)
    if legs:
        for a in (x[0] + 0.12, x[1] - 0.12):
            for b in (y[0] + 0.06, y[1] - 0.06):
                body.rod((a, b, 0.0), (a, b, low + 0.005), (0.011, 0.018), "legs")
    else:
        body.box((x[0] + 0.04, x[1] - 0.04), (y[0] + 0.05, y[1] - 0.02), (0.0, low), "case")
    top = body.height - 0.022
    body.board(x, y, (top, body.height), "top")
    body.box(x, y, (low, low + 0.02), "case")
    wing = 0.32 * body.width
    for a, b in ((x[0], x[0] + wing), (x[1] - wing, x[1])):
        body.box((a, b), (y[0] + _FRONT_M, y[1]), (low + 0.02, top), "case")
        front(body, (a, b), (low + 0.01, top))
        middle = (a + b) / 2
        bar(body, (middle - 0.06, middle + 0.06), body.front, (top - 0.06, top - 0.052))
    inner = (x[0] + wing, x[1] - wing)
    body.box(inner, (y[1] - 0.012, y[1]), (low + 0.02, top), "case")
    shelf = low + 0.55 * (top - low)
    body.box(inner, (y[0] + 0.03, y[1] - 0.012), (shelf, shelf + 0.016), "case")


def bookcase(body: Body, *, back: bool = True, books: bool = True, metal: bool = False) -> None:
    """Open shelves, with books on them."""
    x, y, top = (body.left, body.right), (body.front, body.back), body.height
    thick = 0.022
    columns = max(1, round(body.width / 0.85))
    xs = np.linspace(x[0] + thick / 2, x[1] - thick / 2, columns + 1).tolist()
    low = 0.06 if not metal else 0.0
    for at in xs:
        if metal:
            for b in (y[0] + 0.015, y[1] - 0.015):
                body.box((at - 0.012, at + 0.012), (b - 0.012, b + 0.012), (0.0, top), "case")
        else:
            body.box((at - thick / 2, at + thick / 2), y, (0.0, top - thick), "case")
    if back and not metal:
        body.box((x[0] + 0.01, x[1] - 0.01), (y[1] - 0.008, y[1]), (low, top - thick), "case")
    rows = max(1, round((top - low) / (0.36 if not metal else 0.45)))
    levels = np.linspace(low, top - thick, rows + 1).tolist()
    if metal:
        levels[0] = 0.1
    for level in levels[:-1]:
        body.box((x[0] + 0.004, x[1] - 0.004), (y[0] + 0.004, y[1] - 0.008),
                 (level, level + thick), "shelf")  # fmt: skip
    body.board(x, y, (top - thick, top), "shelf")
    if books:
        rng = np.random.default_rng(zlib.crc32(f"{body.width:.2f} {body.height:.2f}".encode()))
        for a, b in zip(xs, xs[1:], strict=False):
            for z in zip(levels, levels[1:], strict=False):
                _row_of_books(body, (a + 0.015, b - 0.015), (z[0] + thick, z[1]), rng)


def _row_of_books(body: Body, x: Span, z: Span, rng: np.random.Generator) -> None:
    """Spines of many widths and heights; a part of the shelf stays free."""
    slots = ("book-1", "book-2", "book-3")
    y1 = body.back - 0.012
    deep = min(0.2, body.depth - 0.05)
    free = z[1] - z[0] - 0.03
    end = x[0] + rng.uniform(0.45, 0.98) * (x[1] - x[0])
    if body.coarse:
        body.box((x[0], end), (y1 - deep, y1), (z[0], z[0] + 0.8 * free), "book-1")
        return
    at = x[0]
    while at < end - 0.05:
        width = float(rng.uniform(0.018, 0.05))
        high = float(rng.uniform(0.62, 0.96)) * free
        own = deep * float(rng.uniform(0.8, 1.0))
        slot = slots[int(rng.integers(3))]
        body.box((at, at + width - 0.0015), (y1 - own, y1), (z[0], z[0] + high), slot,
                 without="back bottom")  # fmt: skip
        at += width


def glass_cabinet(body: Body) -> None:
    """A cupboard with glazed doors above and closed ones below."""
    z = carcass(body, plinth_m=0.08, legs=False)
    split = 0.4 * body.height
    for x in ((body.left, 0.0), (0.0, body.right)):
        framed_front(body, x, (z[0], split))
        knob(body, x[1] - 0.03 if x[0] < 0 and x[1] == 0 else x[0] + 0.03, body.front - 0.006,
             split - 0.1)  # fmt: skip
        front(body, x, (split, z[1]), "glass")
        if not body.coarse:
            _rim(body, x, split, z[1])


def _rim(body: Body, x: Span, low: float, high: float) -> None:
    y = (body.front - 0.006, body.front)
    for a in ((x[0] + 0.003, x[0] + 0.045), (x[1] - 0.045, x[1] - 0.003)):
        body.box(a, y, (low, high), "front")
    for b in (
        (low, low + 0.045),
        (high - 0.045, high),
        ((low + high) / 2, (low + high) / 2 + 0.02),
    ):
        body.box((x[0] + 0.045, x[1] - 0.045), y, b, "front")


def wall_shelf(body: Body) -> None:
    """A board on the wall."""
    body.board((body.left, body.right), (body.front, body.back), (body.height - 0.03, body.height),
               "shelf")  # fmt: skip
    for x in (body.left + 0.12, body.right - 0.12):
        body.box((x - 0.012, x + 0.012), (body.back - 0.015, body.back), (0.0, body.height - 0.03),
                 "legs")  # fmt: skip
        body.box((x - 0.012, x + 0.012), (body.front + 0.04, body.back - 0.015),
                 (body.height - 0.045, body.height - 0.03), "legs")  # fmt: skip


def coat_rack(body: Body) -> None:
    """A board with hooks, on the wall, with coats."""
    body.board((body.left, body.right), (body.back - 0.022, body.back),
               (body.height - 0.12, body.height), "case")  # fmt: skip
    count = max(3, round(body.width / 0.16))
    spots = np.linspace(body.left + 0.08, body.right - 0.08, count).tolist()
    for k, x in enumerate(spots):
        z = body.height - 0.08
        body.bent([(x, body.back - 0.02, z), (x, body.back - 0.07, z - 0.01),
                   (x, body.back - 0.085, z + 0.03)], 0.007, "handle")  # fmt: skip
        if k % 2 == 0 and body.height > 0.6:
            length = (0.78, 0.9, 0.7)[k // 2 % 3] * (body.height - 0.12)
            with body.placed((x, body.back - 0.1, z - length), tilt=0.0):
                slot = ("coat-1", "coat-2")[k // 2 % 2]
                body.cushion((-0.075, 0.075), (-0.07, 0.06), (0.0, length), slot, radius=0.05)


def boxes(body: Body) -> None:
    """Cardboard boxes on each other."""
    half = 0.52 * body.height
    body.board((body.left, body.right), (body.front, body.back), (0.0, half), "card", edge=0.006)
    with body.placed((0.02, 0.0, half), turn=0.0):
        body.board((0.86 * body.left, 0.8 * body.right), (0.9 * body.front, 0.86 * body.back),
                   (0.0, body.height - half), "card", edge=0.006)  # fmt: skip


def basket(body: Body) -> None:
    """A laundry basket with a lid."""
    r, top = body.width / 2.0, body.height
    body.turned([(0.82 * r, 0.0), (0.97 * r, top - 0.05), (r, top - 0.05), (r, top - 0.015),
                 (0.9 * r, top)], "case", stretch=(1.0, body.depth / body.width))  # fmt: skip
