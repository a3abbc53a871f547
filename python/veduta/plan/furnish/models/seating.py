"""Sofas, armchairs, chairs, stools and benches. Backs are at +y, who sits looks to -y."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body

Arms = Literal["rolled", "slim", "boxy", "none"]
_SEAT_M = 0.43


def sofa(body: Body, *, arms: Arms, legs_m: float, tufted: bool = False) -> None:
    """Upholstered, with loose cushions, as many as its width asks for."""
    arm = {"rolled": 0.20, "slim": 0.11, "boxy": 0.17, "none": 0.0}[arms]
    inner = (body.left + arm, body.right - arm)
    back_m = 0.20 if arms != "slim" else 0.15
    seat_back = body.back - back_m
    seat = min(_SEAT_M, 0.55 * body.height)
    base_top = seat - 0.14
    _feet(body, legs_m, 0.09)
    body.cushion(
        (body.left + 0.4 * arm, body.right - 0.4 * arm), (body.front + 0.02, body.back - 0.02),
        (legs_m, base_top), "fabric", radius=0.02,
    )  # fmt: skip
    body.cushion(
        (body.left + 0.4 * arm, body.right - 0.4 * arm), (seat_back, body.back),
        (legs_m + 0.02, body.height - 0.06), "fabric", radius=0.05,
    )  # fmt: skip
    if arm:
        _arms(body, arms, arm, legs_m)
    count = max(1, round((inner[1] - inner[0]) / 0.72))
    width = (inner[1] - inner[0]) / count
    for k in range(count):
        x = (inner[0] + k * width + 0.004, inner[0] + (k + 1) * width - 0.004)
        body.cushion(
            x, (body.front, seat_back), (base_top, seat), "fabric", radius=0.05, crown=0.018
        )
        with body.placed(((x[0] + x[1]) / 2, seat_back - 0.02, seat - 0.01), tilt=0.16):
            half = width / 2 - 0.006
            top = body.height - seat + 0.01
            body.cushion((-half, half), (-0.16, 0.0), (0.0, top), "fabric", radius=0.07, along="y")
    if tufted and not body.coarse:
        _throw_cushion(body, inner[0] + 0.22, seat_back - 0.16, seat)
        _throw_cushion(body, inner[1] - 0.22, seat_back - 0.16, seat)


def _throw_cushion(body: Body, x: float, y: float, z: float) -> None:
    with body.placed((x, y, z), tilt=0.35):
        body.cushion(
            (-0.2, 0.2), (-0.06, 0.06), (0.0, 0.38), "accent", radius=0.055, along="y", crown=0.03
        )


def _feet(body: Body, height: float, inset: float) -> None:
    if height <= 0.03:
        return
    for x in (body.left + inset, body.right - inset):
        for y in (body.front + inset, body.back - inset):
            body.rod((x, y, 0.0), (x, y, height + 0.01), (0.016, 0.024), "legs")


def _arms(body: Body, arms: Arms, arm: float, legs_m: float) -> None:
    top = {"rolled": 0.62, "slim": 0.60, "boxy": 0.66}.get(arms, 0.6)
    top = min(top, body.height - 0.06) if arms != "boxy" else min(body.height - 0.04, 0.68)
    for side in (-1.0, 1.0):
        outer = side * body.width / 2.0
        x = tuple(sorted((outer, outer - side * arm)))
        if arms == "rolled":
            inset = tuple(sorted((outer - side * 0.03, outer - side * (arm - 0.02))))
            body.cushion(
                (inset[0], inset[1]), (body.front + 0.03, body.back - 0.03),
                (legs_m, top - 0.06), "fabric", radius=0.03,
            )  # fmt: skip
            body.cushion(
                (x[0], x[1]), (body.front + 0.01, body.back - 0.02), (top - 0.17, top), "fabric",
                radius=0.083, along="y",
            )  # fmt: skip
        else:
            body.cushion(
                (x[0], x[1]), (body.front + 0.01, body.back - 0.02), (legs_m, top), "fabric",
                radius=0.03 if arms == "boxy" else 0.045,
            )  # fmt: skip


def corner_sofa(body: Body) -> None:
    """A sofa with a chaise at its left end."""
    arm, back_m, legs, seat = 0.13, 0.18, 0.08, 0.42
    base = seat - 0.15
    chaise = (body.left, body.left + 0.92)
    seat_back = body.back - back_m
    main_front = body.back - 0.95
    for x in (body.left + 0.08, chaise[1] - 0.1, body.right - 0.08):
        for y in (body.back - 0.08, (body.front if x < chaise[1] else main_front) + 0.08):
            body.rod((x, y, 0.0), (x, y, legs + 0.01), (0.016, 0.022), "legs")
    body.cushion(chaise, (body.front, body.back), (legs, base), "fabric", radius=0.025)
    body.cushion(
        (chaise[1], body.right), (main_front, body.back), (legs, base), "fabric", radius=0.025
    )
    body.cushion(
        (body.left, body.right), (seat_back, body.back), (base - 0.02, body.height - 0.06),
        "fabric", radius=0.05,
    )  # fmt: skip
    for across, deep in (
        ((body.right - arm, body.right), (main_front, body.back - 0.02)),
        ((body.left, body.left + arm), (body.back - 1.05, body.back - 0.02)),
    ):
        body.cushion(across, deep, (legs, 0.6), "fabric", radius=0.04)
    inner = (body.left + arm, body.right - arm)
    body.cushion(
        (body.left + 0.01, chaise[1] - 0.004), (body.front, seat_back), (base, seat), "fabric",
        radius=0.05, crown=0.015,
    )  # fmt: skip
    count = max(1, round((inner[1] - chaise[1]) / 0.8))
    edges = np.linspace(chaise[1], inner[1], count + 1)
    for low, high in zip(edges, edges[1:], strict=False):
        body.cushion(
            (low + 0.004, high - 0.004), (main_front, seat_back), (base, seat), "fabric",
            radius=0.05, crown=0.015,
        )  # fmt: skip
    edges = np.linspace(inner[0], inner[1], count + 2)
    for low, high in zip(edges, edges[1:], strict=False):
        with body.placed(((low + high) / 2, seat_back - 0.02, seat - 0.01), tilt=0.16):
            half = (high - low) / 2 - 0.006
            top = body.height - seat + 0.01
            body.cushion((-half, half), (-0.15, 0.0), (0.0, top), "fabric", radius=0.07, along="y")
    if not body.coarse:
        _throw_cushion(body, inner[1] - 0.24, seat_back - 0.16, seat)


def wing_chair(body: Body) -> None:
    """An armchair with a high back and wings."""
    legs, seat, arm = 0.16, 0.44, 0.11
    _feet(body, legs, 0.07)
    inner = (body.left + arm, body.right - arm)
    body.cushion(inner, (body.front + 0.02, body.back - 0.1), (legs, seat - 0.1), "fabric")
    body.cushion(
        inner, (body.front, body.back - 0.16), (seat - 0.1, seat + 0.02), "fabric", radius=0.05,
        crown=0.02,
    )  # fmt: skip
    with body.placed((0.0, body.back - 0.16, seat - 0.04), tilt=0.1):
        body.cushion(
            inner, (-0.04, 0.08), (0.0, body.height - seat + 0.02), "fabric", radius=0.055,
            along="y",
        )  # fmt: skip
    for x in ((body.left, inner[0] + 0.01), (inner[1] - 0.01, body.right)):
        body.cushion(x, (body.front + 0.04, body.back - 0.06), (legs, 0.62), "fabric", radius=0.05)
        body.cushion(
            x, (body.back - 0.30, body.back - 0.04), (0.56, body.height - 0.1), "fabric",
            radius=0.05,
        )  # fmt: skip


def lounge_chair(body: Body) -> None:
    """An open wooden frame with two cushions."""
    seat = 0.40
    for side in (body.left + 0.025, body.right - 0.025):
        y0, y1 = body.front + 0.05, body.back - 0.05
        body.rod((side, y0, 0.0), (side, y0 - 0.01, 0.58), (0.015, 0.02), "legs")
        body.rod((side, y1, 0.0), (side, y1 - 0.06, 0.58), (0.015, 0.02), "legs")
        body.board((side - 0.025, side + 0.025), (body.front, y1), (0.57, 0.595), "legs")
        body.box((side - 0.012, side + 0.012), (y0, y1 - 0.03), (seat - 0.13, seat - 0.09), "legs")
    inner = (body.left + 0.06, body.right - 0.06)
    with body.placed((0.0, 0.0, seat - 0.1), tilt=-0.06):
        body.cushion(
            inner, (body.front + 0.02, body.back - 0.14), (0.0, 0.12), "fabric", radius=0.05,
            crown=0.015,
        )  # fmt: skip
    with body.placed((0.0, body.back - 0.17, seat - 0.02), tilt=0.28):
        top = (body.height - seat) / math.cos(0.28) - 0.02
        half = (inner[1] - inner[0]) / 2
        body.cushion((-half, half), (-0.13, 0.0), (0.0, top), "fabric", radius=0.055, along="y")


def pouf(body: Body) -> None:
    """A round seat."""
    radius, top = body.width / 2.0, body.height
    body.turned(
        [(0.86 * radius, 0.0), (0.97 * radius, 0.06), (radius, 0.5 * top), (0.97 * radius,
         top - 0.07), (0.86 * radius, top - 0.02), (0.45 * radius, top)],
        "fabric", stretch=(1.0, body.depth / body.width),
    )  # fmt: skip


def ottoman(body: Body) -> None:
    """A padded stool on legs."""
    _feet(body, 0.14, 0.06)
    body.cushion(
        (body.left, body.right), (body.front, body.back), (0.13, body.height - 0.015), "fabric",
        radius=0.05, crown=0.015,
    )  # fmt: skip


def chair(body: Body, *, back: Literal["slats", "padded", "shell", "cross"]) -> None:
    """A dining chair."""
    seat = 0.46
    x0, x1 = body.left + 0.03, body.right - 0.03
    y0, y1 = body.front + 0.035, body.back - 0.03
    if back == "shell":
        for x, out in ((x0 + 0.05, -0.04), (x1 - 0.05, 0.04)):
            for y, way in ((y0 + 0.05, -0.04), (y1 - 0.08, 0.04)):
                body.rod((x + out, y + way, 0.0), (x, y, seat - 0.02), (0.011, 0.017), "legs")
        _shell(body, seat)
        return
    for x in (x0, x1):
        body.rod((x, y0, 0.0), (x, y0 + 0.01, seat - 0.02), (0.014, 0.02), "legs")
        top = body.height - 0.015
        path = [(x, y1 + 0.01, 0.0), (x, y1 - 0.02, seat), (x, body.back - 0.016, top)]
        body.bent(path, (0.017, 0.014), "legs")
    for x in (x0, x1):
        body.box((x - 0.009, x + 0.009), (y0, y1), (seat - 0.07, seat - 0.02), "legs")
    for y in (y0 + 0.005, y1 - 0.015):
        body.box((x0, x1), (y - 0.009, y + 0.009), (seat - 0.07, seat - 0.02), "legs")
    padded = back == "padded"
    body.cushion(
        (body.left, body.right), (body.front, body.back - 0.05), (seat - 0.03, seat + 0.015),
        "fabric" if padded else "seat", radius=0.022, crown=0.012 if padded else 0.0,
    )  # fmt: skip
    _chair_back(body, back, (x0, x1), seat)


def _chair_back(body: Body, back: str, x: tuple[float, float], seat: float) -> None:
    top = body.height
    lean = body.back - 0.045
    if back == "padded":
        with body.placed((0.0, body.back - 0.05, seat + 0.1), tilt=0.07):
            body.cushion(
                (x[0] - 0.015, x[1] + 0.015), (-0.03, 0.03), (0.0, top - seat - 0.1), "fabric",
                radius=0.028, along="y",
            )  # fmt: skip
        return
    body.cushion(
        (x[0] - 0.012, x[1] + 0.012), (lean + 0.012, lean + 0.044), (top - 0.075, top), "legs",
        radius=0.014,
    )  # fmt: skip
    if back == "cross":
        for a, b in ((x[0], x[1]), (x[1], x[0])):
            body.rod((a, lean + 0.005, seat + 0.04), (b, lean + 0.028, top - 0.05), 0.009, "legs")
        return
    for share in (0.2, 0.4, 0.6, 0.8) if not body.coarse else (0.33, 0.66):
        at = x[0] + share * (x[1] - x[0])
        body.rod((at, lean - 0.012, seat), (at, lean + 0.026, top - 0.06), 0.0075, "legs")


def _shell(body: Body, seat: float) -> None:
    """Seat and back of one bent piece: a profile in y and z, narrower above."""
    half, thick = body.width / 2.0, 0.018
    y0, y1 = body.front, body.back
    line = np.array(
        [(y0, seat - 0.015), (y0 + 0.04, seat + 0.004), (y0 + 0.2, seat - 0.012),
         (y1 - 0.16, seat - 0.002), (y1 - 0.09, seat + 0.05), (y1 - 0.05, seat + 0.16),
         (y1 - 0.025, 0.72 * body.height + 0.1), (y1 - 0.018, body.height)]
    )  # fmt: skip
    widths = half * np.array([0.88, 0.96, 1.0, 0.98, 0.96, 0.98, 0.92, 0.66])
    along = np.gradient(line, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    normal = np.column_stack([-along[:, 1], along[:, 0]])
    rings = []
    for (y, z), wide, (ny, nz) in zip(line, widths, normal, strict=True):
        share = (-1.0, -0.55, 0.55, 1.0)
        bow = [0.03 * abs(s) ** 2 for s in share]
        upper = [(s * wide, y + b * ny, z + b * nz) for s, b in zip(share, bow, strict=True)]
        lower = [(s, a - thick * ny, c - thick * nz) for s, a, c in upper[::-1]]
        rings.append(np.array(upper + lower))
    body.rings(rings, "seat")


def office_chair(body: Body) -> None:
    """A turning chair on five castors."""
    seat, hub = 0.47, 0.09
    arms = 3 if body.coarse else 5
    reach = 0.46 * min(body.width, body.depth)
    for k in range(arms):
        angle = math.pi / 2 + 2.0 * math.pi * k / arms
        end = (reach * math.cos(angle), reach * math.sin(angle))
        body.rod((0.0, 0.0, hub), (*end, 0.065), (0.025, 0.014), "legs")
        body.turned([(0.012, 0.0), (0.024, 0.012), (0.024, 0.04), (0.012, 0.055)], "legs", end,
                    sides=8)  # fmt: skip
    body.rod((0.0, 0.0, hub - 0.02), (0.0, 0.0, seat - 0.05), 0.028, "legs")
    half = 0.40 * body.width
    body.cushion(
        (-half, half), (body.front + 0.04, body.back - 0.12), (seat - 0.06, seat), "fabric",
        radius=0.04, crown=0.012,
    )  # fmt: skip
    body.rod((0.0, body.back - 0.16, seat - 0.05), (0.0, body.back - 0.05, seat + 0.22), 0.016,
             "legs")  # fmt: skip
    with body.placed((0.0, body.back - 0.1, seat + 0.1), tilt=0.07):
        body.cushion(
            (-0.92 * half, 0.92 * half), (-0.03, 0.035), (0.0, body.height - seat - 0.1),
            "fabric", radius=0.032, along="y",
        )  # fmt: skip
    for x in (body.left + 0.035, body.right - 0.035):
        body.board((x - 0.03, x + 0.03), (-0.14, 0.12), (0.64, 0.665), "legs")
        body.bent(
            [(x, 0.0, 0.645), (x, 0.0, seat - 0.02), (0.7 * x, 0.0, seat - 0.05)], 0.012, "legs"
        )


def stool(body: Body, *, padded: bool) -> None:
    """Round, on four splayed legs."""
    top = body.height
    radius = 0.46 * body.width
    for sx in (-1, 1):
        for sy in (-1, 1):
            foot = (sx * 0.46 * body.width, sy * 0.46 * body.depth, 0.0)
            body.rod(foot, (sx * 0.6 * radius, sy * 0.6 * radius, top - 0.03), 0.014, "legs")
    if top > 0.55 and not body.coarse:
        r = 0.40 * body.width
        corners = [(r, r, 0.25), (r, -r, 0.25), (-r, -r, 0.25), (-r, r, 0.25)]
        for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
            body.rod(start, end, 0.008, "legs")
    thick = 0.06 if padded else 0.03
    body.turned(
        [(0.9 * radius, top - thick), (radius, top - 0.7 * thick), (radius, top - 0.25 * thick),
         (0.9 * radius, top)],
        "fabric" if padded else "seat",
    )  # fmt: skip


def bench(body: Body, *, padded: bool = False, back: bool = False) -> None:
    """A bench of boards on two trestles."""
    top = 0.45 if back else body.height
    x0, x1 = body.left + 0.12, body.right - 0.12
    for x in (x0, x1):
        for y in (body.front + 0.04, body.back - 0.04):
            body.box((x - 0.025, x + 0.025), (y - 0.025, y + 0.025), (0.0, top - 0.03), "legs")
        body.box((x - 0.02, x + 0.02), (body.front + 0.03, body.back - 0.03),
                 (top - 0.09, top - 0.03), "legs")  # fmt: skip
    count = 1 if padded else max(2, round(body.depth / 0.13))
    edges = np.linspace(body.front, body.back, count + 1)
    for low, high in zip(edges, edges[1:], strict=False):
        body.board((body.left, body.right), (low + 0.004, high - 0.004), (top - 0.03, top), "seat")
    if padded:
        body.cushion(
            (body.left + 0.01, body.right - 0.01), (body.front + 0.01, body.back - 0.01),
            (top - 0.03, top), "fabric", radius=0.028,
        )  # fmt: skip
    if back:
        for x in (x0, x1):
            body.rod((x, body.back - 0.04, top - 0.03), (x, body.back - 0.015, body.height - 0.02),
                     0.02, "legs")  # fmt: skip
        for z in (top + 0.14, body.height - 0.11):
            body.board((body.left, body.right), (body.back - 0.045, body.back - 0.02),
                       (z, z + 0.1), "seat")  # fmt: skip


def lounger(body: Body) -> None:
    """A garden lounger with a raised head end."""
    for x in (body.left + 0.06, body.right - 0.06):
        body.box((x - 0.025, x + 0.025), (body.front, body.back - 0.05), (0.24, 0.30), "legs")
        for y in (body.front + 0.15, body.back - 0.35):
            body.box((x - 0.025, x + 0.025), (y - 0.025, y + 0.025), (0.0, 0.24), "legs")
    hinge = body.back - 0.75
    body.cushion((body.left, body.right), (body.front, hinge), (0.30, 0.37), "fabric", radius=0.03)
    rise = math.asin(min(0.95, (body.height - 0.37) / 0.78))
    with body.placed((0.0, hinge, 0.30), tilt=-rise):
        body.cushion((body.left, body.right), (0.0, 0.78), (0.0, 0.07), "fabric", radius=0.03)
