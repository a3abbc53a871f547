"""Lamps, plants, rugs, pictures, screens, and small things that stand on others."""

from __future__ import annotations

from typing import Literal

import numpy as np

from veduta.plan.furnish.models.body import Body, rounded


def floor_lamp(body: Body, *, style: Literal["stem", "tripod", "arc"]) -> None:
    """A lamp that stands on the floor."""
    top, r = body.height, body.width / 2.0
    low = top - 0.28
    if style == "tripod":
        for k in range(3):
            turn = 2.0 * np.pi * k / 3 + 0.5
            foot = (0.95 * r * np.cos(turn), 0.95 * r * np.sin(turn), 0.0)
            body.rod(foot, (0.02 * np.cos(turn), 0.02 * np.sin(turn), low), 0.012, "legs")
        _shade(body, (0.0, 0.0), 0.95 * r, low - 0.02, top)
        return
    at = (0.0, 0.0) if style == "stem" else (0.0, body.back - 0.16)
    base = min(0.15, 0.9 * r)
    body.turned([(base, 0.0), (base, 0.015), (0.02, 0.03)], "legs", at)
    if style == "stem":
        body.rod((*at, 0.02), (*at, low + 0.1), 0.011, "legs")
        _shade(body, at, 0.95 * r, low, top)
        return
    end = body.front + 0.18
    angle = np.linspace(0.0, 0.8 * np.pi, 5 if body.coarse else 12)
    span, rise = (at[1] - end) / 1.81, 0.3
    bow = [(0.0, at[1] - span * (1.0 - np.cos(a)), top - rise + rise * np.sin(a)) for a in angle]
    body.bent([(*at, 0.02), (*at, 0.5 * top), *bow], 0.011, "legs")
    z = bow[-1][2]
    body.turned([(0.16, z - 0.16), (0.15, z - 0.09), (0.08, z - 0.02), (0.02, z + 0.01)], "shade",
                (0.0, bow[-1][1]))  # fmt: skip


def _shade(body: Body, at: tuple[float, float], radius: float, low: float, top: float) -> None:
    """A drum of cloth, open below and above, as a thin skin."""
    body.turned(
        [(0.97 * radius, low), (radius, low), (0.82 * radius, top), (0.79 * radius, top),
         (0.78 * radius, top - 0.02), (0.4 * radius, top - 0.025)],
        "shade", at,
    )  # fmt: skip


def table_lamp(body: Body, *, style: Literal["vase", "stick", "desk", "globe"]) -> None:
    """A lamp that stands on a table."""
    top, r = body.height, body.width / 2.0
    if style == "globe":
        body.turned([(0.5 * r, 0.0), (0.5 * r, 0.03), (0.25 * r, 0.05)], "legs")
        angle = np.linspace(-1.2, 1.45, 5 if body.coarse else 10)
        ball = (top - 0.045) / 2
        profile = np.column_stack([r * np.cos(angle), 0.045 + ball + ball * np.sin(angle)])
        body.turned(profile, "shade")
    elif style == "desk":
        body.turned([(0.09, 0.0), (0.09, 0.018), (0.03, 0.026)], "legs", (0.0, body.back - 0.1))
        elbow = (0.0, body.back - 0.05, 0.62 * top)
        head = (0.0, body.front + 0.1, 0.93 * top)
        body.rod((0.0, body.back - 0.1, 0.02), elbow, 0.007, "legs")
        body.rod(elbow, head, 0.007, "legs")
        body.turned([(0.07, head[2] - 0.11), (0.05, head[2] - 0.03), (0.02, head[2] + 0.01)],
                    "legs", (0.0, head[1]))  # fmt: skip
    else:
        low = 0.52 * top
        if style == "vase":
            body.turned([(0.45 * r, 0.0), (0.5 * r, 0.02), (0.62 * r, 0.4 * low), (0.3 * r, 0.85 *
                         low), (0.12 * r, low), (0.1 * r, low + 0.06)], "legs")  # fmt: skip
        else:
            body.turned([(0.5 * r, 0.0), (0.5 * r, 0.018), (0.1 * r, 0.03), (0.08 * r, low + 0.06)],
                        "legs")  # fmt: skip
        _shade(body, (0.0, 0.0), r, low, top)


def plant(
    body: Body, *, habit: Literal["tree", "palm", "swords", "bush", "hanging"], pot: float = 0.3
) -> None:
    """A plant in a pot, whose height is a share of the whole."""
    high, r = pot * body.height, 0.5 * min(body.width, body.depth)
    radius = min(0.62 * r, 0.7 * high + 0.03)
    body.turned([(0.72 * radius, 0.0), (0.95 * radius, 0.9 * high), (radius, 0.9 * high),
                 (radius, high), (0.88 * radius, high), (0.86 * radius, high - 0.03)],
                "pot")  # fmt: skip
    body.turned([(0.86 * radius, high - 0.035), (0.86 * radius, high - 0.028)], "soil")
    rng = np.random.default_rng(11)
    start = np.array([0.0, 0.0, high - 0.03])
    if habit == "swords":
        for k in range(7 if body.coarse else 15):
            angle, out = 2.4 * k, rng.uniform(0.1, 0.75) * radius
            foot = start + np.array([out * np.cos(angle), out * np.sin(angle), 0.0])
            tip_out = 1.5 * out / radius * 0.5 * r
            tip = (tip_out * np.cos(angle), tip_out * np.sin(angle),
                   body.height * rng.uniform(0.72, 1.0))  # fmt: skip
            _leaf(body, foot, np.array(tip), 0.028 + 0.03 * r, bend=0.02)
        return
    if habit == "tree":
        crown = np.array([0.02 * r, 0.0, 0.62 * body.height])
        middle = np.array([0.04, 0.02, 0.45 * body.height])
        body.bent(np.array([start, middle, crown]), (0.018, 0.01), "trunk")
        count, centre = (24, crown) if body.coarse else (85, crown)
        for k in range(count):
            way = _direction(k, count, -0.45)
            size = np.array([r, r, 0.36 * body.height])
            foot = centre + 0.45 * way * size * rng.uniform(0.3, 1.0)
            tip = centre + way * size * rng.uniform(0.85, 1.0)
            tip[2] = min(tip[2], body.height)
            _leaf(body, foot, tip, 0.16 * r, bend=0.05)
        return
    count = {"palm": 11, "bush": 30, "hanging": 26}[habit]
    count = count // 2 if body.coarse else count
    for k in range(count):
        way = _direction(k, count, 0.25 if habit != "hanging" else -0.5)
        reach = np.array([r, r, body.height - high])
        if habit == "palm":
            tip = start + way * reach * (1.0, 1.0, rng.uniform(0.6, 1.0))
            _frond(body, start, tip, 0.09 * r + 0.02)
            continue
        tip = start + way * reach * rng.uniform(0.75, 1.0)
        tip[2] = np.clip(tip[2], 0.25 * high, body.height)
        foot = start + 0.3 * radius * way * (1.0, 1.0, 0.0)
        _leaf(body, foot, tip, 0.22 * r, bend=0.1 * r)


def _direction(k: int, count: int, least_up: float) -> np.ndarray:
    """Directions spread evenly over a part of the sphere (Fibonacci's spiral)."""
    up = least_up + (1.0 - least_up) * (k + 0.5) / count
    angle = 2.399963 * k
    out = np.sqrt(max(0.0, 1.0 - up * up))
    return np.array([out * np.cos(angle), out * np.sin(angle), up])


def _leaf(body: Body, foot: np.ndarray, tip: np.ndarray, wide: float, bend: float) -> None:
    """A thin pointed blade, seen from both sides."""
    along = tip - foot
    side = np.cross(along, [0.0, 0.0, 1.0])
    if np.linalg.norm(side) < 1e-3 * np.linalg.norm(along):
        side = np.array([1.0, 0.0, 0.0])
    side = side / np.linalg.norm(side) * wide / 2.0
    up = np.cross(side, along)
    up = up / np.linalg.norm(up)
    middle = foot + 0.5 * along + bend * up
    thick = 0.0015 * up
    ring = [foot - 0.15 * side, middle - side, tip, middle + side, foot + 0.15 * side]
    points = [point + thick for point in ring] + [point - thick for point in ring]
    faces = [[0, 1, 3, 4], [1, 2, 3], [9, 8, 6, 5], [8, 7, 6]]
    faces += [[j, j + 5, (j + 1) % 5 + 5, (j + 1) % 5] for j in range(5)]
    body.solid(np.array(points), faces, "leaf")


def _frond(body: Body, foot: np.ndarray, tip: np.ndarray, wide: float) -> None:
    """A bowed stalk with leaflets on both sides."""
    count = 4 if body.coarse else 9
    rise = 0.35 * float(np.linalg.norm(tip - foot))
    shares = np.linspace(0.0, 1.0, count)
    line = [foot + s * (tip - foot) + (0.0, 0.0, rise * s * (1.0 - s) * 2.0) for s in shares]
    line = [np.array((p[0], p[1], min(p[2], body.height - 0.005))) for p in line]
    body.bent(line, (0.007, 0.003), "leaf")
    out = np.cross(tip - foot, [0.0, 0.0, 1.0])
    norm = np.linalg.norm(out)
    out = out / norm if norm > 1e-6 else np.array([1.0, 0.0, 0.0])
    for k in range(1, count):
        way = line[k] - line[k - 1]
        for sign in (-1.0, 1.0):
            reach = (2.2 * wide * (1.15 - shares[k])) * out * sign + 0.8 * way
            end = line[k] + reach - (0.0, 0.0, 0.35 * abs(float(np.linalg.norm(reach))))
            _leaf(body, line[k], end, 0.03, bend=0.0)


def rug(body: Body, *, shape: Literal["plain", "bordered", "round", "striped"]) -> None:
    """A rug on the floor."""
    top = body.height
    if shape == "round":
        stretch, sides = (1.0, body.depth / body.width), 24 if body.coarse else 48
        outer, inner = 0.5 * body.width, 0.42 * body.width
        body.turned([(outer, 0.0), (0.996 * outer, top)], "fabric", stretch=stretch, sides=sides)
        body.turned([(inner, top), (inner, top + 0.0008)], "accent", stretch=stretch, sides=sides)
        return
    x, y = (body.left, body.right), (body.front, body.back)
    body.box(x, y, (0.0, top), "fabric")
    over = (top, top + 0.0008)
    if shape == "bordered":
        body.box((x[0] + 0.12, x[1] - 0.12), (y[0] + 0.12, y[1] - 0.12), over, "accent",
                 without="bottom")  # fmt: skip
        body.box((x[0] + 0.18, x[1] - 0.18), (y[0] + 0.18, y[1] - 0.18),
                 (over[0], over[1] + 0.0008), "fabric", without="bottom")  # fmt: skip
    elif shape == "striped":
        for k in range(1, 10, 2):
            a = x[0] + (k - 0.25) / 10 * body.width
            body.box((a, a + 0.05 * body.width), y, over, "accent", without="bottom")


def picture(body: Body, *, subject: Literal["bands", "circles", "blocks"], mount: bool) -> None:
    """A framed picture of flat shapes."""
    y = (body.front, body.back)
    edge = 0.022
    body.board((body.left, body.right), (y[0] + 0.004, y[1]), (0.0, body.height), "frame")
    x, z = (body.left + edge, body.right - edge), (edge, body.height - edge)
    skin = [y[0] + 0.003, y[0] + 0.002, y[0] + 0.001, y[0]]
    body.box(x, (skin[0], y[0] + 0.005), z, "paper")
    if body.coarse:
        return
    inset = 0.16 * min(body.width, body.height) if mount else 0.0
    x, z = (x[0] + inset, x[1] - inset), (z[0] + inset, z[1] - inset)
    wide, high = x[1] - x[0], z[1] - z[0]
    body.box(x, (skin[1], skin[0]), z, "paint-1")
    if subject == "bands":
        body.box(x, (skin[2], skin[1]), (z[0], z[0] + 0.38 * high), "paint-2")
        body.box(x, (skin[3], skin[2]), (z[0], z[0] + 0.16 * high), "paint-3")
    elif subject == "blocks":
        body.box((x[0], x[0] + 0.55 * wide), (skin[2], skin[1]), (z[0], z[0] + 0.62 * high),
                 "paint-2")  # fmt: skip
        body.box((x[0] + 0.4 * wide, x[1]), (skin[3], skin[2]), (z[0] + 0.45 * high, z[1]),
                 "paint-3")  # fmt: skip
    else:
        angle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
        circle = np.column_stack([np.cos(angle), np.sin(angle)])
        for a, b, r, k in ((0.4, 0.6, 0.27, 2), (0.62, 0.36, 0.2, 3)):
            disc = (x[0] + a * wide, z[0] + b * high) + r * min(wide, high) * circle
            body.drawn(disc, (skin[k], skin[k - 1]), f"paint-{k}", axis="y")


def clock(body: Body) -> None:
    """A round clock on the wall."""
    n = 14 if body.coarse else 36
    r = body.width / 2.0
    angle = 2.0 * np.pi * np.arange(n) / n
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    with body.placed((0.0, 0.0, body.height / 2)):
        body.drawn(r * circle, (body.front + 0.006, body.back), "frame", axis="y")
        body.drawn(0.9 * r * circle, (body.front + 0.004, body.front + 0.007), "paper", axis="y")
        y = (body.front, body.front + 0.004)
        body.box((-0.007, 0.007), y, (-0.05 * r, 0.72 * r), "frame")
        body.box((-0.05 * r, 0.5 * r), y, (-0.009, 0.009), "frame")


def television(body: Body, *, on_wall: bool) -> None:
    """A flat screen."""
    low = 0.06 if not on_wall else 0.0
    y = body.back - 0.03 if on_wall else 0.0
    body.box((body.left, body.right), (y - 0.02, y + 0.015), (low, body.height), "dark")
    body.box((body.left + 0.012, body.right - 0.012), (y - 0.022, y - 0.018),
             (low + 0.02, body.height - 0.012), "screen")  # fmt: skip
    if on_wall:
        body.box((-0.25, 0.25), (y + 0.015, body.back), (0.25 * body.height, 0.7 * body.height),
                 "dark")  # fmt: skip
        return
    for x in (0.36 * body.left * 2 * 0.8, 0.36 * body.right * 2 * 0.8):
        body.box((x - 0.012, x + 0.012), (body.front, body.back), (0.0, 0.012), "dark")
        body.box((x - 0.012, x + 0.012), (y - 0.02, y + 0.01), (0.012, low + 0.01), "dark")


def computer(body: Body, *, laptop: bool) -> None:
    """A monitor with its keyboard, or a laptop."""
    if laptop:
        body.board((body.left, body.right), (body.front, body.back - 0.05), (0.0, 0.016), "case")
        body.box((body.left + 0.02, body.right - 0.02), (body.front + 0.09, body.back - 0.07),
                 (0.016, 0.018), "dark")  # fmt: skip
        with body.placed((0.0, body.back - 0.05, 0.012), tilt=0.22):
            body.board((body.left, body.right), (-0.008, 0.0), (0.0, body.height - 0.012), "case")
            body.box((body.left + 0.012, body.right - 0.012), (-0.0095, -0.007),
                     (0.015, body.height - 0.025), "screen")  # fmt: skip
        return
    y = body.back - 0.06
    body.board((-0.12, 0.12), (body.back - 0.2, body.back), (0.0, 0.014), "case")
    body.box((-0.025, 0.025), (y, y + 0.03), (0.014, 0.5 * body.height), "case")
    body.box((body.left, body.right), (y - 0.03, y), (0.13, body.height), "dark")
    body.box((body.left + 0.01, body.right - 0.01), (y - 0.032, y - 0.028),
             (0.145, body.height - 0.01), "screen")  # fmt: skip
    body.board((-0.2, 0.14), (body.front, body.front + 0.13), (0.0, 0.016), "keys")
    body.cushion((0.19, 0.25), (body.front + 0.02, body.front + 0.12), (0.0, 0.03), "keys",
                 radius=0.014)  # fmt: skip


def vase(body: Body, *, style: Literal["bottle", "bowl", "fruit", "flowers", "candles"]) -> None:
    """A vase, a bowl, or candles."""
    r, top = body.width / 2.0, body.height
    if style == "bottle":
        body.turned([(0.6 * r, 0.0), (0.95 * r, 0.15 * top), (r, 0.35 * top), (0.62 * r, 0.62 *
                     top), (0.26 * r, 0.78 * top), (0.26 * r, 0.95 * top), (0.34 * r, top),
                     (0.24 * r, top), (0.2 * r, 0.9 * top)], "pot")  # fmt: skip
        return
    if style == "candles":
        for x, high in ((-0.55 * r, 1.0), (0.1 * r, 0.75), (0.62 * r, 0.55)):
            body.turned([(0.3 * r, 0.0), (0.3 * r, high * top - 0.02), (0.27 * r, high * top -
                         0.015)], "paper", (x, 0.0))  # fmt: skip
            body.rod((x, 0.0, high * top - 0.016), (x, 0.0, high * top), 0.003, "dark")
        return
    if style == "flowers":
        low = 0.5 * top
        body.turned([(0.3 * r, 0.0), (0.42 * r, 0.4 * low), (0.3 * r, 0.85 * low), (0.36 * r, low),
                     (0.3 * r, low), (0.26 * r, 0.9 * low)], "pot")  # fmt: skip
        count = 6 if body.coarse else 13
        for k in range(count):
            way = _direction(k, count, 0.45)
            tip = np.array([0, 0, low]) + way * (0.85 * r, 0.85 * r, top - low - 0.02)
            body.rod((0.0, 0.0, low - 0.03), tip, 0.003, "leaf")
            size = 0.13 * r + 0.008
            with body.placed((tip[0], tip[1], tip[2] - 0.5 * size)):
                body.turned([(0.4 * size, 0.0), (size, 0.6 * size), (0.5 * size, 1.1 * size)],
                            f"flower-{k % 2 + 1}", sides=8)  # fmt: skip
        return
    high = top if style == "bowl" else 0.6 * top
    body.turned([(0.4 * r, 0.0), (0.45 * r, 0.1 * high), (0.8 * r, 0.5 * high), (r, high),
                 (0.96 * r, high), (0.72 * r, 0.5 * high), (0.3 * r, 0.22 * high)],
                "pot")  # fmt: skip
    if style == "fruit":
        for k in range(6):
            angle, out = 2 * np.pi * k / 5, 0.0 if k == 5 else 0.45 * r
            s, z = 0.3 * r, 0.42 * high + (0.3 * r if k == 5 else 0.0)
            profile = [(0.25 * s, 0.0), (0.8 * s, 0.35 * s), (s, 0.95 * s), (0.75 * s, 1.55 * s),
                       (0.25 * s, 1.85 * s)]  # fmt: skip
            with body.placed((out * np.cos(angle), out * np.sin(angle), z)):
                body.turned(profile, f"flower-{k % 2 + 1}", sides=10)


def books(body: Body) -> None:
    """A few books lying on each other."""
    each = body.height / 3
    for k in range(3):
        shrink = 1.0 - 0.1 * k
        with body.placed((0.0, 0.0, k * each), turn=(0.0, 0.16, -0.1)[k]):
            half = 0.42 * np.array([body.width, body.depth]) * shrink
            body.board((-half[0], half[0]), (-half[1], half[1]), (0.0, each), f"book-{k + 1}",
                       edge=0.002)  # fmt: skip


def speaker(body: Body) -> None:
    """A loudspeaker."""
    body.board((body.left, body.right), (body.front + 0.006, body.back), (0.0, body.height), "case")
    n = 12 if body.coarse else 24
    angle = 2.0 * np.pi * np.arange(n) / n
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    for share, size in ((0.35, 0.36), (0.72, 0.24)) if body.height < 0.6 else (
        (0.45, 0.36), (0.68, 0.36), (0.87, 0.22)
    ):  # fmt: skip
        with body.placed((0.0, 0.0, share * body.height)):
            body.drawn(size * body.width * circle, (body.front, body.front + 0.008), "dark",
                       axis="y")  # fmt: skip


def curtain(body: Body) -> None:
    """Two gathered curtains on a rod, drawn open."""
    body.rod((body.left, 0.0, body.height - 0.03), (body.right, 0.0, body.height - 0.03), 0.011,
             "legs")  # fmt: skip
    share = 0.17
    for x0, x1 in ((body.left, body.left + share * body.width),
                   (body.right - share * body.width, body.right)):  # fmt: skip
        n = 8 if body.coarse else 28
        u = np.linspace(0.0, 1.0, n)
        wave = 0.32 * body.depth * np.sin(u * np.pi * 2 * max(2, round((x1 - x0) / 0.09)))
        line = np.column_stack([x0 + u * (x1 - x0), wave])
        thick = np.array([0.0, 0.006])
        skin = np.vstack([line - thick, line[::-1] + thick])
        body.drawn(skin, (0.015, body.height - 0.045), "fabric")


def umbrella_stand(body: Body) -> None:
    """A round stand with an umbrella in it."""
    r = body.width / 2.0
    high = 0.6 * body.height
    body.turned([(0.9 * r, 0.0), (0.95 * r, high), (0.85 * r, high), (0.8 * r, 0.03)], "case")
    body.rod((0.1 * r, 0.0, 0.03), (0.4 * r, 0.2 * r, 0.85 * body.height), (0.012, 0.035), "dark")
    body.rod((0.4 * r, 0.2 * r, 0.85 * body.height), (0.5 * r, 0.2 * r, body.height), 0.011, "legs")


def rounded_board(body: Body) -> None:
    """A bath mat: a flat board with round corners."""
    steps = 3 if body.coarse else 6
    half = np.array([body.width, body.depth]) / 2.0
    rings = [
        np.column_stack([rounded(half - a, 0.06, steps), np.full(4 * steps, z)])
        for a, z in ((0.0, 0.0), (0.0, 0.6 * body.height), (0.01, body.height))
    ]
    body.rings(rings, "fabric")
