"""Heads over windows that are curved; the straight one is in `stonework`. The wall is z = 0."""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.grammar.assets.looks import STONE
from veduta.grammar.assets.modelling import Model, arc

RISE_M, WIDE_M = 0.34, 1.6
SECTION = [
    (0.0, 0.0), (0.06, 0.0), (0.1, 0.04), (0.22, 0.05), (0.26, 0.09), (0.28, 0.14), (0.0, 0.14),
]  # fmt: skip
"""z and y (m) of the ledge below the curve."""


def segmental(name: str, level: int) -> Asset:
    """A window's head: a segment of a circle on two consoles, 1.6 m by 0.75 m, 0.3 m out."""
    model = Model(STONE)
    outline = SECTION if level == 0 else [SECTION[0], SECTION[1], *SECTION[4:]]
    model.prism([(z, y + 0.25) for z, y in outline], (0.0, WIDE_M), "stone", axis="x")
    radius = (WIDE_M**2 / 4 + RISE_M**2) / (2 * RISE_M)
    half = float(np.degrees(np.arcsin(WIDE_M / 2 / radius)))
    steps = (12, 6, 3)[level]
    bow = arc((WIDE_M / 2, 0.39 + RISE_M - radius), radius, 90 - half, 90 + half, steps)
    model.prism(bow, (0.0, 0.12), "stone", caps="high")
    model.sweep([(-0.07, 0.0), (-0.07, 0.29), (0.0, 0.26), (0.0, 0.0)], bow, "stone")
    for x in (0.06, 1.36):
        foot = [(0.0, 0.0), (0.06, 0.0), (0.09, 0.08), (0.18, 0.16), (0.2, 0.25), (0.0, 0.25)]
        model.prism(foot, (x, x + 0.18), "stone", axis="x")
    return model.asset(name)
