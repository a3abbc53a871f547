"""What juts out of a wall: cornices, brackets, quoins. The wall is the plane z = 0."""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import STONE
from veduta.grammar.assets.modelling import Model, Points, arc, spiral

Span = tuple[float, float]
CLASSICAL: list[Span] = [
    (0.0, 0.0), (0.05, 0.0), (0.05, 0.04), (0.06, 0.05), (0.07, 0.08), (0.1, 0.12), (0.13, 0.13),
    (0.13, 0.17), (0.36, 0.17), (0.36, 0.3), (0.38, 0.3), (0.38, 0.33), (0.4, 0.37), (0.45, 0.4),
    (0.48, 0.43), (0.5, 0.47), (0.5, 0.52), (0.0, 0.58),
]  # fmt: skip
"""z and y (m): bed moulding, corona and cyma recta, with a slope on top."""
STRING: list[Span] = [
    (0.0, 0.0), (0.03, 0.0), (0.045, 0.03), (0.07, 0.05), (0.11, 0.06), (0.12, 0.09), (0.12, 0.15),
    (0.0, 0.18),
]  # fmt: skip
BASE: list[Span] = [
    (0.0, 0.0), (0.12, 0.0), (0.12, 0.3), (0.1, 0.33), (0.09, 0.37), (0.06, 0.4), (0.05, 0.45),
    (0.0, 0.45),
]  # fmt: skip


def coarser(section: list[Span], level: int) -> list[Span]:
    """Every corner near by, half of them farther off, and the box of them from afar."""
    if level == 0:
        return section
    if level == 1:
        return [section[0], *section[1:-1:2], section[-2], section[-1]]
    out, up = max(z for z, _ in section), max(y for _, y in section)
    low = section[1][0]
    return [(0.0, 0.0), (low, 0.0), (out, 0.6 * up), (out, 0.9 * up), (0.0, up)]


def drawn(model: Model, section: list[Span], length: float, level: int) -> None:
    """A profile along x; the side at the wall and the ends are open, as tiles meet."""
    outline = np.array(coarser(section, level))
    k = len(outline)
    points = [(x, y, z) for x in (0.0, length) for z, y in outline.tolist()]
    faces = [[j, j + 1, k + j + 1, k + j][::-1] for j in range(k - 1)]
    ends = [list(range(k)), list(range(k, 2 * k))[::-1]]
    model.add(points, faces + ends, "stone")


def cornice(name: str, level: int) -> Asset:
    """A classical main cornice, 1 m of it, 0.58 m high and 0.5 m out."""
    model = Model(STONE)
    drawn(model, CLASSICAL, 1.0, level)
    return model.asset(name)


def dentils(name: str, level: int) -> Asset:
    """The same cornice over a row of dentils, 1 m of it, 0.72 m high."""
    model = Model(STONE)
    lifted = [(z, y + 0.14) for z, y in CLASSICAL]
    drawn(model, lifted, 1.0, level)
    model.box((0.0, 0.0, 0.0), (1.0, 0.14, 0.03), "stone", without="back left right top")
    for k in range(8) if level < 2 else ():
        x = (k + 0.25) / 8
        model.box((x, 0.03, 0.03), (x + 0.0625, 0.14, 0.1), "stone", without="back top")
    return model.asset(name)


def string_course(name: str, level: int) -> Asset:
    """A narrow moulding between floors, 1 m of it, 0.18 m high."""
    model = Model(STONE)
    drawn(model, STRING, 1.0, level)
    return model.asset(name)


def plinth(name: str, level: int) -> Asset:
    """A wall's foot with its moulding, 1 m of it, 0.45 m high."""
    model = Model(STONE)
    drawn(model, BASE, 1.0, level)
    return model.asset(name)


def console(name: str, level: int) -> Asset:
    """A bracket of two volutes under an abacus, 0.22 m wide, 0.6 m high, 0.42 m out."""
    model = Model(STONE)
    if level == 2:
        wedge = [(0.0, 0.0), (0.1, 0.0), (0.38, 0.4), (0.38, 0.54), (0.0, 0.54)]
        model.prism(wedge, (0.02, 0.2), "stone", axis="x")
        model.box((0.0, 0.54, 0.0), (0.22, 0.6, 0.42), "stone", without="back")
        return model.asset(name)
    steps = (14, 7)[level]
    model.prism(_s_curve(steps), (0.02, 0.2), "stone", axis="x")
    model.box((0.0, 0.54, 0.0), (0.22, 0.6, 0.42), "stone", without="back")
    if level == 0:
        for centre, radius in (((0.27, 0.42), 0.1), ((0.075, 0.075), 0.06)):
            for x in ((0.0, 0.02), (0.2, 0.22)):
                volute(model, centre, radius, x)
        fluting = _s_curve(steps)[1:-2]
        for at in (0.055, 0.1, 0.145):
            ribbon(model, fluting, (at - 0.012, at + 0.012), 0.012)
    return model.asset(name)


def _s_curve(steps: int) -> Points:
    """z and y of a console's side: from the wall's foot around both volutes to the abacus."""
    lower = arc((0.075, 0.075), 0.075, -90, 60, steps // 2)
    upper = arc((0.27, 0.42), 0.12, -60, 90, steps // 2)
    share = np.linspace(0, 1, 5)[1:-1, None]
    bridge = (
        (1 - share) ** 2 * lower[-1] + 2 * (1 - share) * share * [0.1, 0.24] + share**2 * upper[0]
    )
    return np.concatenate([[(0.0, 0.0)], lower, bridge, upper, [(0.0, 0.54)]])


def volute(model: Model, centre: Span, radius: float, x: Span) -> None:
    """The spiral on a console's cheek: a flat band that winds into an eye."""
    outer = spiral(centre, (0.22 * radius, radius), (-420, 90), 16)
    inner = spiral(centre, (0.12 * radius, 0.72 * radius), (-420, 90), 16)
    band = np.concatenate([outer, inner[::-1]])
    k = len(outer)
    points = [(end, y, z) for end in x for z, y in band.tolist()]
    n = len(band)
    faces = [[j, (j + 1) % n, n + (j + 1) % n, n + j] for j in range(n)]
    strips = [[j, j + 1, n - 2 - j, n - 1 - j] for j in range(k - 1)]
    faces += [strip[::-1] for strip in strips] + [[n + p for p in strip] for strip in strips]
    model.solid(points, faces, "stone")


def ribbon(model: Model, track: Points, x: Span, thick: float) -> None:
    """A rib that follows a console's front."""
    along = np.gradient(track, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    out = np.column_stack([along[:, 1], -along[:, 0]])
    band = np.concatenate([track, (track + thick * out)[::-1]])
    n, k = len(band), len(track)
    points = [(end, y, z) for end in x for z, y in band.tolist()]
    faces = [[j, (j + 1) % n, n + (j + 1) % n, n + j] for j in range(n)]
    strips = [[j, j + 1, n - 2 - j, n - 1 - j] for j in range(k - 1)]
    faces += [strip[::-1] for strip in strips] + [[n + p for p in strip] for strip in strips]
    model.solid(points, faces, "stone")


def modillion(name: str, level: int) -> Asset:
    """A small bracket under a cornice, 0.16 m wide, 0.18 m high, 0.34 m out."""
    model = Model(STONE)
    model.box((0.0, 0.13, 0.0), (0.16, 0.18, 0.34), "stone", without="back")
    if level == 2:
        model.prism(
            [(0.0, 0.0), (0.28, 0.06), (0.28, 0.13), (0.0, 0.13)], (0.02, 0.14), "stone", axis="x"
        )
        return model.asset(name)
    steps = (8, 4)[level]
    nose = arc((0.26, 0.085), 0.045, -100, 90, steps)
    throat = arc((0.13, -0.01), 0.06, 150, 60, steps // 2)
    side = np.concatenate([[(0.0, 0.0), (0.05, 0.0)], throat, nose, [(0.0, 0.13)]])
    model.prism(side, (0.02, 0.14), "stone", axis="x")
    if level == 0:
        for x in ((0.008, 0.02), (0.14, 0.152)):
            model.prism(arc((0.26, 0.085), 0.03, 0, 320, 8), x, "stone", axis="x")
    return model.asset(name)


def quoin(name: str, level: int) -> Asset:
    """A corner stone with bevelled edges, 0.6 m by 0.32 m."""
    model = Model(STONE)
    edge = (0.02, 0.015, 0.0)[level]
    low = [(0.0, 0.0), (0.6, 0.0), (0.6, 0.32), (0.0, 0.32)]
    high = [(edge, edge), (0.6 - edge, edge), (0.6 - edge, 0.32 - edge), (edge, 0.32 - edge)]
    rings = [(low, 0.0), (low, 0.03), (high, 0.03 + edge)] if edge else [(low, 0.0), (low, 0.04)]
    points = [(*corner, z) for ring, z in rings for corner in ring]
    faces = [
        [4 * ring + k, 4 * ring + (k + 1) % 4, 4 * ring + 4 + (k + 1) % 4, 4 * ring + 4 + k]
        for ring in range(len(rings) - 1)
        for k in range(4)
    ]
    top = 4 * (len(rings) - 1)
    for face in [*faces, [top, top + 1, top + 2, top + 3]]:
        model.facet([points[corner] for corner in face], "stone")
    return model.asset(name)


def keystone(name: str, level: int) -> Asset:
    """The wedge over an opening, 0.36 m by 0.45 m, 0.12 m out."""
    model = Model(STONE)
    wedge = [(0.06, 0.0), (0.3, 0.0), (0.36, 0.4), (0.0, 0.4)]
    model.prism(wedge, (0.0, 0.08), "stone", caps="high")
    model.box((-0.02, 0.4, 0.0), (0.38, 0.45, 0.12), "stone", without="back")
    if level == 0:
        inner = [(0.11, 0.05), (0.25, 0.05), (0.29, 0.35), (0.07, 0.35)]
        model.prism(inner, (0.08, 0.1), "stone", caps="high")
    return model.asset(name)


def hood(name: str, level: int) -> Asset:
    """A window's head: a pediment on two consoles, 1.6 m by 0.75 m, 0.3 m out."""
    model = Model(STONE)
    section = [
        (0.0, 0.0),
        (0.06, 0.0),
        (0.1, 0.04),
        (0.22, 0.05),
        (0.26, 0.09),
        (0.28, 0.14),
        (0.0, 0.14),
    ]
    outline = (
        section if level == 0 else [section[0], section[1], section[4], section[5], section[6]]
    )
    model.prism([(z, y + 0.25) for z, y in outline], (0.0, 1.6), "stone", axis="x")
    slope = [(0.0, 0.39), (1.6, 0.39), (0.8, 0.75)]
    model.prism(slope, (0.0, 0.12), "stone", caps="high")
    rake = np.array([(1.62, 0.37), (0.8, 0.74), (-0.02, 0.37)])
    model.sweep([(-0.07, 0.0), (-0.07, 0.29), (0.0, 0.26), (0.0, 0.0)], rake, "stone")
    for x in (0.06, 1.36):
        foot = [(0.0, 0.0), (0.06, 0.0), (0.09, 0.08), (0.18, 0.16), (0.2, 0.25), (0.0, 0.25)]
        model.prism(foot, (x, x + 0.18), "stone", axis="x")
    return model.asset(name)


def block(name: str, level: int) -> Asset:
    """A plain block, for ledges, jambs and boards of any measure, 1 m long."""
    model = Model(STONE)
    model.box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), "stone")
    return model.asset(name)
