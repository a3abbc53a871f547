"""Beds: the head is at +y."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body

Head = Literal["panel", "upholstered", "platform", "metal", "slats"]


def bed(body: Body, *, head: Head) -> None:
    """A bed with a mattress, pillows and a duvet turned down."""
    x = (body.left, body.right)
    base = 0.30 if head != "platform" else 0.24
    board = 0.10 if head == "upholstered" else 0.045
    lying = (body.front + (0.03 if head != "metal" else 0.04), body.back - board)
    if head == "metal":
        _metal_ends(body, base)
    elif head == "upholstered":
        body.cushion(x, (lying[1], body.back), (0.05, body.height), "frame", radius=0.045)
        body.cushion(x, (body.front, lying[1]), (0.08, base), "frame", radius=0.03)
        _feet(body, 0.08)
    elif head == "platform":
        body.board(x, (body.front, body.back), (0.12, base), "frame", edge=0.006)
        body.box((x[0] + 0.18, x[1] - 0.18), (body.front + 0.18, body.back - 0.1), (0.0, 0.12),
                 "frame")  # fmt: skip
        body.board(x, (lying[1], body.back), (base, body.height), "frame", edge=0.006)
    else:
        _wooden(body, head, lying, base)
    _bedding(body, (x[0] + 0.03, x[1] - 0.03), lying, base)


def _feet(body: Body, height: float) -> None:
    for x in (body.left + 0.08, body.right - 0.08):
        for y in (body.front + 0.08, body.back - 0.08):
            body.rod((x, y, 0.0), (x, y, height + 0.01), (0.02, 0.028), "legs")


def _wooden(body: Body, head: Head, lying: tuple[float, float], base: float) -> None:
    x = (body.left, body.right)
    for at in (x[0] + 0.025, x[1] - 0.025):
        body.box((at - 0.025, at + 0.025), (lying[1], body.back), (0.0, body.height), "frame")
        body.box((at - 0.025, at + 0.025), (body.front, body.front + 0.05), (0.0, base + 0.06),
                 "frame")  # fmt: skip
        body.box((at - 0.014, at + 0.014), (body.front + 0.05, lying[1]), (base - 0.14, base),
                 "frame")  # fmt: skip
    inner = (x[0] + 0.05, x[1] - 0.05)
    body.box(inner, (body.front + 0.01, body.front + 0.035), (base - 0.14, base + 0.03), "frame")
    if head == "slats":
        count = max(5, round((inner[1] - inner[0]) / 0.12))
        for at in np.linspace(inner[0] + 0.03, inner[1] - 0.03, count):
            body.box((at - 0.015, at + 0.015), (lying[1] + 0.01, body.back - 0.012),
                     (base, body.height - 0.06), "frame")  # fmt: skip
        body.box(inner, (lying[1], body.back), (body.height - 0.06, body.height), "frame")
        return
    body.box(inner, (lying[1] + 0.01, body.back - 0.01), (base - 0.1, body.height - 0.05), "frame")
    body.board((x[0], x[1]), (lying[1] - 0.005, body.back), (body.height - 0.05, body.height),
               "frame")  # fmt: skip


def _metal_ends(body: Body, base: float) -> None:
    for y, top in ((body.back - 0.02, body.height), (body.front + 0.02, 0.62 * body.height)):
        x0, x1 = body.left + 0.02, body.right - 0.02
        body.bent(
            [(x0, y, 0.0), (x0, y, top - 0.08), (x0 + 0.08, y, top - 0.018),
             (x1 - 0.08, y, top - 0.018), (x1, y, top - 0.08), (x1, y, 0.0)],
            0.016, "frame",
        )  # fmt: skip
        for at in np.linspace(x0, x1, 3 if body.coarse else 7)[1:-1]:
            body.rod((at, y, base - 0.03), (at, y, top - 0.02), 0.008, "frame")
        body.rod((x0, y, base - 0.03), (x1, y, base - 0.03), 0.012, "frame")
    for at in (body.left + 0.02, body.right - 0.02):
        body.box((at - 0.012, at + 0.012), (body.front + 0.02, body.back - 0.02),
                 (base - 0.08, base - 0.02), "frame")  # fmt: skip


def _bedding(
    body: Body, x: tuple[float, float], y: tuple[float, float], base: float, thick: float = 0.2
) -> None:
    top = base + thick
    body.cushion(x, y, (base - 0.03, top), "sheet", radius=0.05)
    width = x[1] - x[0]
    count = 2 if width > 1.25 else 1
    each = width / count
    for k in range(count):
        middle = x[0] + (k + 0.5) * each
        half = min(0.36, 0.46 * each)
        with body.placed((middle, y[1] - 0.27, top - 0.02), tilt=-0.16):
            body.cushion(
                (-half, half), (-0.22, 0.22), (0.0, 0.12), "pillow", radius=0.058, crown=0.03
            )
    fold = y[1] - 0.62
    over = 0.018
    body.cushion(
        (x[0] - over, x[1] + over), (y[0] - 0.02, fold), (top - 0.12, top + 0.05), "cover",
        radius=0.05, crown=0.02,
    )  # fmt: skip
    body.cushion(
        (x[0] - over, x[1] + over), (fold - 0.16, fold + 0.14), (top + 0.012, top + 0.075),
        "sheet", radius=0.028,
    )  # fmt: skip


def bunk(body: Body) -> None:
    """Two beds over each other, with a ladder."""
    for x in (body.left + 0.03, body.right - 0.03):
        for y in (body.front + 0.03, body.back - 0.03):
            body.box((x - 0.03, x + 0.03), (y - 0.03, y + 0.03), (0.0, body.height), "frame")
    for base in (0.32, body.height - 0.42):
        for x in (body.left + 0.03, body.right - 0.03):
            body.box((x - 0.012, x + 0.012), (body.front + 0.06, body.back - 0.06),
                     (base - 0.14, base + 0.02), "frame")  # fmt: skip
        for y in (body.front + 0.03, body.back - 0.03):
            body.box((body.left + 0.06, body.right - 0.06), (y - 0.012, y + 0.012),
                     (base - 0.14, base + 0.16), "frame")  # fmt: skip
        _bedding(body, (body.left + 0.06, body.right - 0.06),
                 (body.front + 0.07, body.back - 0.06), base, 0.13)  # fmt: skip
    rail = body.height - 0.05
    for x in (body.left + 0.03, body.right - 0.03):
        body.box((x - 0.012, x + 0.012), (body.front + 0.5, body.back - 0.06),
                 (rail - 0.09, rail), "frame")  # fmt: skip
    at = body.right - 0.012
    for y in (body.front + 0.12, body.front + 0.46):
        body.box((at - 0.02, at + 0.012), (y - 0.02, y + 0.02), (0.0, rail), "frame")
    for z in np.arange(0.25, rail - 0.1, 0.28):
        body.rod((at - 0.004, body.front + 0.12, z), (at - 0.004, body.front + 0.46, z), 0.014,
                 "frame")  # fmt: skip


def cot(body: Body) -> None:
    """A baby's bed with barred sides."""
    top, base = body.height, 0.38
    x0, x1, y0, y1 = body.left + 0.02, body.right - 0.02, body.front + 0.02, body.back - 0.02
    for x in (x0, x1):
        for y in (y0, y1):
            body.box((x - 0.02, x + 0.02), (y - 0.02, y + 0.02), (0.0, top), "frame")
    for x in (x0, x1):
        for z in (base - 0.06, top - 0.04):
            body.box((x - 0.012, x + 0.012), (y0, y1), (z, z + 0.04), "frame")
        for y in np.linspace(y0, y1, 4 if body.coarse else 13)[1:-1]:
            body.rod((x, y, base - 0.03), (x, y, top - 0.02), 0.008, "frame")
    for y in (y0, y1):
        body.box((x0, x1), (y - 0.01, y + 0.01), (base - 0.06, top), "frame")
    body.cushion((x0 + 0.02, x1 - 0.02), (y0 + 0.02, y1 - 0.02), (base, base + 0.1), "sheet")
    body.cushion((x0 + 0.03, x1 - 0.03), (y0 + 0.03, y1 - 0.45), (base + 0.09, base + 0.13),
                 "cover", radius=0.018)  # fmt: skip
