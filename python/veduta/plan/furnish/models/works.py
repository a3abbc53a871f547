"""Garage, technical rooms, outdoors, fireplaces, instruments."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body


def car(body: Body, *, estate: bool) -> None:
    """A car of a few smooth pieces; its front is at -y."""
    half, front, back, top = body.width / 2, body.front, body.back, body.height
    length = body.depth
    belt = 0.62 * top
    sections = []
    # Along the car: place, half width, lower and upper edge of the body.
    for share, wide, low, high in (
        (0.0, 0.72, 0.2, 0.34), (0.03, 0.86, 0.14, 0.46), (0.12, 0.96, 0.13, 0.52),
        (0.3, 1.0, 0.13, 0.59), (0.5, 1.0, 0.13, 0.62), (0.8, 1.0, 0.13, 0.63),
        (0.95, 0.95, 0.14, 0.62), (0.99, 0.85, 0.2, 0.58 if estate else 0.55),
    ):  # fmt: skip
        y, w = front + share * length, 0.93 * wide * half
        z0, z1 = low * top, high * top
        mid = (z0 + z1) / 2
        sections.append(
            np.array([(-0.92 * w, y, z0), (0.92 * w, y, z0), (w, y, mid), (0.97 * w, y, z1 - 0.03),
                      (0.9 * w, y, z1), (-0.9 * w, y, z1), (-0.97 * w, y, z1 - 0.03),
                      (-w, y, mid)])
        )  # fmt: skip
    body.rings(sections, "paint")
    roof_end = 0.97 if estate else 0.88
    for slot, inset, low, high in (("glass", 0.0, belt - 0.02, top - 0.05),
                                   ("paint", 0.005, top - 0.055, top)):  # fmt: skip
        spots = ((0.27, 0.4), (roof_end - 0.06, roof_end - 0.2 if not estate else roof_end - 0.08))
        lower_w, upper_w = 0.84 * half, 0.66 * half
        share = (low - belt + 0.02) / (top - belt)
        rings = []
        for t, z in ((share, low), ((high - belt + 0.02) / (top - belt), high)):
            w = lower_w + (upper_w - lower_w) * min(1.0, t) + inset
            y0 = front + (spots[0][0] + (spots[0][1] - spots[0][0]) * min(1.0, t)) * length
            y1 = front + (spots[1][0] + (spots[1][1] - spots[1][0]) * min(1.0, t)) * length
            rings.append(np.array([(-w, y0, z), (w, y0, z), (w, y1, z), (-w, y1, z)]))
        body.rings(rings, slot)
    n = 12 if body.coarse else 24
    angle = 2 * np.pi * np.arange(n) / n
    r = 0.215 * top
    for y in (front + 0.19 * length, back - 0.2 * length):
        for side in (-1, 1):
            x = sorted((side * (half - 0.02) * 0.95, side * (half - 0.24) * 0.95))
            with body.placed((0.0, y, r)):
                ring = r * np.column_stack([np.cos(angle), np.sin(angle)])
                body.drawn(ring, (x[0], x[1]), "tyre", axis="x")
                face = sorted((side * (half - 0.02) * 0.95, side * (half - 0.012) * 0.95))
                body.drawn(0.62 * ring, (face[0], face[1]), "steel", axis="x")
    for side in (-1, 1):
        x = sorted((side * 0.45 * half, side * 0.72 * half))
        body.box((x[0], x[1]), (front + 0.015 * length, front + 0.06 * length),
                 (0.36 * top, 0.43 * top), "light")  # fmt: skip
        body.box((x[0], x[1]), (back - 0.04 * length, back - 0.008 * length),
                 (0.45 * top, 0.53 * top), "tail")  # fmt: skip
        mirror = sorted((side * 0.86 * half, side * half))
        body.cushion((mirror[0], mirror[1]), (front + 0.29 * length, front + 0.325 * length),
                     (0.64 * top, 0.72 * top), "paint", radius=0.03)  # fmt: skip


def bicycle(body: Body) -> None:
    """A bicycle; its front wheel is at -y."""
    r = 0.19 * body.depth
    y0, y1 = body.front + r, body.back - r
    n = 10 if body.coarse else 26
    angle = np.linspace(0, 2 * np.pi, n)
    for y in (y0, y1):
        body.bent([(0.0, y + 0.97 * r * np.cos(a), r + 0.97 * r * np.sin(a)) for a in angle],
                  0.018, "tyre")  # fmt: skip
        for a in angle[:-1:3]:
            body.rod((0.0, y, r), (0.0, y + 0.95 * r * np.cos(a), r + 0.95 * r * np.sin(a)),
                     0.002, "steel")  # fmt: skip
    crank = (0.0, y1 - 0.44 * (y1 - y0), 0.8 * r)
    saddle = (0.0, y1 - 0.3 * (y1 - y0), 0.84 * body.height)
    head = (0.0, y0 + 0.16 * (y1 - y0), 0.8 * body.height)
    for a, b in ((crank, saddle), (crank, head), (saddle, head), (crank, (0.0, y1, r)),
                 ((saddle[0], saddle[1], 0.78 * saddle[2]), (0.0, y1, r)),
                 (head, (0.0, y0, r))):  # fmt: skip
        body.rod(a, b, 0.016, "paint")
    body.rod(head, (0.0, head[1] + 0.03, body.height - 0.02), 0.014, "steel")
    body.bent([(body.left, head[1] + 0.12, body.height - 0.03), (0.6 * body.left, head[1] + 0.02,
               body.height - 0.015), (0.6 * body.right, head[1] + 0.02, body.height - 0.015),
               (body.right, head[1] + 0.12, body.height - 0.03)], 0.014, "tyre")  # fmt: skip
    body.cushion((-0.07, 0.07), (saddle[1] - 0.1, saddle[1] + 0.15),
                 (saddle[2], saddle[2] + 0.05), "tyre", radius=0.024)  # fmt: skip
    body.rod((-0.09, crank[1] - 0.1, crank[2] - 0.1), (0.09, crank[1] + 0.1, crank[2] + 0.1), 0.01,
             "steel")  # fmt: skip


def boiler(body: Body, *, tank: bool) -> None:
    """A boiler, or an upright tank of hot water."""
    if tank:
        r = body.width / 2.0
        body.turned([(0.9 * r, 0.0), (0.9 * r, 0.1), (r, 0.1), (r, body.height - 0.16), (0.85 * r,
                     body.height - 0.1), (0.4 * r, body.height - 0.08)], "case")  # fmt: skip
        for x in (-0.12, 0.12):
            body.rod((x, 0.0, body.height - 0.1), (x, 0.0, body.height), 0.016, "pipe")
        return
    body.cushion((body.left, body.right), (body.front, body.back), (0.12, body.height), "case",
                 radius=0.02)  # fmt: skip
    body.box((body.left + 0.08, body.right - 0.08), (body.front - 0.004, body.front + 0.001),
             (0.3, 0.42), "dark")  # fmt: skip
    for at in np.linspace(body.left + 0.08, body.right - 0.08, 4).tolist():
        body.rod((at, 0.02, 0.0), (at, 0.02, 0.13), 0.011, "pipe")


def utility_sink(body: Body) -> None:
    """A deep sink on a frame."""
    rim = body.height - 0.16
    for a in (body.left + 0.02, body.right - 0.02):
        for b in (body.front + 0.02, body.back - 0.02):
            body.box((a - 0.015, a + 0.015), (b - 0.015, b + 0.015), (0.0, rim - 0.2), "steel")
    x, y, t = (body.left, body.right), (body.front, body.back), 0.02
    low = rim - 0.3
    body.box(x, y, (low, low + t), "ceramic")
    for across, deep in (((x[0], x[0] + t), y), ((x[1] - t, x[1]), y), (x, (y[0], y[0] + t)),
                         (x, (y[1] - t, y[1]))):  # fmt: skip
        body.box(across, deep, (low + t, rim), "ceramic")
    body.rod((0.0, y[1] - 0.01, rim + 0.1), (0.0, y[1] - 0.17, rim + 0.12), 0.012, "steel")
    body.rod((-0.07, y[1] - 0.012, rim + 0.1), (0.07, y[1] - 0.012, rim + 0.1), 0.018, "steel")
    body.rod((0.0, y[1] - 0.015, rim + 0.1), (0.0, y[1] - 0.015, body.height), 0.01, "steel")


def fireplace(body: Body, *, stove: bool) -> None:
    """An open fireplace with a mantel, or an iron stove with its pipe."""
    if stove:
        r = 0.48 * body.width
        for k in range(4):
            a = np.pi / 4 + k * np.pi / 2
            body.rod((0.8 * r * np.cos(a), 0.8 * r * np.sin(a), 0.0),
                     (0.7 * r * np.cos(a), 0.7 * r * np.sin(a), 0.18), 0.018, "iron")  # fmt: skip
        body.cushion((-r, r), (body.front + 0.01, body.back - 0.02), (0.15, 0.78), "iron",
                     radius=0.03)  # fmt: skip
        body.box((-0.7 * r, 0.7 * r), (body.front, body.front + 0.012), (0.3, 0.68), "ember")
        body.board((-r, r), (body.front, body.back), (0.78, 0.81), "iron")
        body.rod((0.0, 0.06, 0.8), (0.0, 0.06, body.height), 0.07, "iron")
        return
    wing = 0.2 * body.width
    x, y, lintel = (body.left, body.right), (body.front, body.back), 0.76 * body.height
    body.box((x[0] + 0.03, x[0] + wing), (y[0] + 0.06, y[1]), (0.0, lintel), "stone")
    body.box((x[1] - wing, x[1] - 0.03), (y[0] + 0.06, y[1]), (0.0, lintel), "stone")
    body.box((x[0] + 0.03, x[1] - 0.03), (y[0] + 0.06, y[1]), (lintel, body.height - 0.05), "stone")
    body.board(x, y, (body.height - 0.05, body.height), "stone", edge=0.01)
    body.box((x[0] + wing, x[1] - wing), (y[1] - 0.03, y[1]), (0.03, lintel), "dark")
    body.box((x[0] + wing, x[1] - wing), (y[0] + 0.06, y[1] - 0.03), (0.0, 0.03), "dark")
    for k, (a, z) in enumerate(((-0.06, 0.075), (0.06, 0.075), (0.0, 0.16))):
        half = 0.6 * (x[1] - wing)
        body.rod((-half, a, z), (half, a + 0.03 * (k - 1), z), 0.042, "log")


def piano(body: Body) -> None:
    """An upright piano; who plays it sits at its front."""
    x, y = (body.left, body.right), (body.front, body.back)
    body.box(x, (y[1] - 0.36, y[1]), (0.0, body.height - 0.025), "case")
    body.board(x, (y[1] - 0.38, y[1]), (body.height - 0.025, body.height), "case")
    body.box(x, (y[0], y[1] - 0.36), (0.58, 0.64), "case")
    body.box((x[0] + 0.05, x[1] - 0.05), (y[0] + 0.01, y[1] - 0.37), (0.64, 0.66), "paper")
    for a in (x[0] + 0.03, x[1] - 0.03):
        body.box((a - 0.03, a + 0.03), (y[0] + 0.01, y[0] + 0.07), (0.0, 0.58), "case")
        body.box((a - 0.03, a + 0.03), (y[0], y[1] - 0.36), (0.64, 0.72), "case")
    if not body.coarse:
        keys = np.linspace(x[0] + 0.06, x[1] - 0.06, 52)
        for k, at in enumerate(keys.tolist()):
            if k % 7 not in (2, 6):
                body.box((at + 0.007, at + 0.017), (y[0] + 0.06, y[1] - 0.37), (0.66, 0.67),
                         "dark", without="bottom")  # fmt: skip
        body.box((x[0] + 0.3, x[1] - 0.3), (y[1] - 0.375, y[1] - 0.36), (0.78, 1.0), "case")


def parasol(body: Body) -> None:
    """A garden umbrella."""
    r, top = body.width / 2.0, body.height
    body.turned([(0.25, 0.0), (0.25, 0.05), (0.05, 0.08)], "stone")
    body.rod((0.0, 0.0, 0.05), (0.0, 0.0, top), 0.022, "legs")
    body.turned([(r, top - 0.52), (r, top - 0.5), (0.06, top - 0.06), (0.02, top - 0.05)],
                "fabric", sides=8)  # fmt: skip


def planter(body: Body) -> None:
    """A trough with flowers."""
    x, y, top = (body.left, body.right), (body.front, body.back), 0.55 * body.height
    body.board(x, y, (0.0, top), "pot")
    body.box((x[0] + 0.02, x[1] - 0.02), (y[0] + 0.02, y[1] - 0.02), (top, top + 0.002), "soil")
    rng = np.random.default_rng(3)
    for k in range(8 if body.coarse else 26):
        at = rng.uniform(-0.42, 0.42, 2) * (body.width, body.depth)
        r = float(rng.uniform(0.05, 0.085)) * min(1.0, body.depth / 0.3)
        z = top - 0.01 + float(rng.uniform(0.0, 0.35)) * (body.height - top)
        high = min(body.height - z, 2.0 * r)
        slot = ("leaf", "flower-1", "leaf", "flower-2")[k % 4]
        body.turned([(0.4 * r, z), (r, z + 0.4 * high), (0.75 * r, z + 0.75 * high),
                     (0.25 * r, z + high)], slot, (float(at[0]), float(at[1])),
                    sides=9)  # fmt: skip


def grill(body: Body) -> None:
    """A kettle grill on three legs."""
    r, top = 0.46 * body.width, body.height
    for k in range(3):
        a = 2 * np.pi * k / 3 + 0.5
        body.rod((0.95 * r * np.cos(a), 0.95 * r * np.sin(a), 0.0),
                 (0.5 * r * np.cos(a), 0.5 * r * np.sin(a), 0.62 * top), 0.014,
                 "steel")  # fmt: skip
    z = 0.55 * top
    angle = np.linspace(-1.35, 1.35, 6 if body.coarse else 12)
    rise = (top - z - 0.05) / 2
    body.turned(np.column_stack([r * np.cos(angle), z + rise + rise * np.sin(angle)]), "iron")
    body.rod((-0.07, 0.0, top - 0.03), (0.07, 0.0, top - 0.03), 0.014, "log")


def balance(body: Body, *, kind: Literal["treadmill", "ball"]) -> None:
    """What one exercises with."""
    if kind == "ball":
        r = body.width / 2.0
        angle = np.linspace(-1.4, 1.45, 7 if body.coarse else 14)
        body.turned(np.column_stack([r * np.cos(angle), r + r * np.sin(angle)]), "fabric")
        return
    body.board((body.left, body.right), (body.front, body.back), (0.06, 0.18), "case")
    body.box((body.left + 0.1, body.right - 0.1), (body.front + 0.1, body.back - 0.35),
             (0.18, 0.185), "dark")  # fmt: skip
    for x in (body.left + 0.04, body.right - 0.04):
        body.rod((x, body.back - 0.25, 0.1), (x, body.back - 0.05, body.height - 0.1), 0.025,
                 "case")  # fmt: skip
    body.box((body.left, body.right), (body.back - 0.12, body.back), (body.height - 0.14,
             body.height), "dark")  # fmt: skip
