"""Roofs over the footprint: mansard with dormers, pitched with chimneys, flat with a parapet."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from veduta.synthetic.layout import Chimney, Layout, Rect
from veduta.synthetic.mesh import MeshBuilder

FeatureOf = Callable[[str, int], int]
DORMER_FRONT_M = 0.12


def add_roof(builder: MeshBuilder, layout: Layout, feature: FeatureOf) -> None:
    """The roof of a layout; `feature(class, number)` names the feature of each surface."""
    if layout.roof.kind == "mansard":
        _mansard(builder, layout, feature("roof", 0))
        for number, rect in enumerate(layout.roof.dormers):
            _dormer(builder, layout, rect, feature("dormer", number), feature("roof", 0), number)
    elif layout.roof.kind == "pitched":
        _pitched(builder, layout, feature("roof", 0))
    else:
        _flat(builder, layout, feature("roof", 0), feature("wall", 0))
    for number, chimney in enumerate(layout.roof.chimneys):
        _chimney(builder, chimney, feature("chimney", number))


def _profile(
    builder: MeshBuilder,
    layout: Layout,
    profile: list[tuple[float, float]],
    gable: list[tuple[float, float]],
    overhang: float,
    feature: int,
) -> None:
    """Sweep a profile of (y, z) points along the width, front to back, and close both gables."""
    x0, x1 = -overhang * 0.4, layout.width_m + overhang * 0.4
    for (ya, za), (yb, zb) in pairwise(profile):
        builder.quad((x0, ya, za), (x1 - x0, 0, 0), (0, yb - ya, zb - za), "roof", feature)
    left = [gable[-1], *gable[:-1]]
    right = [gable[0], *gable[:0:-1]]
    for x, outline in ((0.0, left), (layout.width_m, right)):
        builder.face([np.array([x, y, z]) for y, z in outline], "side", feature)


def _mansard(builder: MeshBuilder, layout: Layout, feature: int) -> None:
    eaves, rise, run, depth = (
        layout.height_m,
        layout.roof.rise_m,
        layout.roof.run_m,
        layout.depth_m,
    )
    knee = eaves + 0.82 * rise
    profile = [
        (0.05, eaves),
        (run, knee),
        (depth / 2, eaves + rise * 1.12),
        (depth - run, knee),
        (depth, eaves),
    ]
    _profile(builder, layout, profile, profile, 0.0, feature)
    low = (0.0, run - 0.08, knee - 0.05)
    builder.box(low, (layout.width_m, run + 0.06, knee + 0.05), "lead", feature, "flrtd")


def _dormer(
    builder: MeshBuilder, layout: Layout, rect: Rect, pane: int, roof: int, number: int
) -> None:
    """A box in the slope with a window at its front; `rect` is the pane."""
    y0, y1 = DORMER_FRONT_M, layout.roof.run_m + 1.2
    jamb, head = 0.14, 0.16
    x0, x1 = rect.x_m - jamb, rect.right_m + jamb
    z0, z1 = rect.y_m - 0.12, rect.top_m + head
    builder.box((x0, y0, z0), (rect.x_m, y1, z1), "lead", roof, "flrt")
    builder.box((rect.right_m, y0, z0), (x1, y1, z1), "lead", roof, "flrt")
    builder.box((rect.x_m, y0, rect.top_m), (rect.right_m, y1, z1), "lead", roof, "ftd")
    builder.box((rect.x_m, y0, z0), (rect.right_m, y1, rect.y_m), "lead", roof, "ft")
    builder.box((x0 - 0.09, y0 - 0.12, z1), (x1 + 0.09, y1, z1 + 0.09), "lead", roof, "flrtd")
    builder.quad(
        (rect.x_m, y0 + 0.1, rect.y_m),
        (rect.width_m, 0, 0),
        (0, 0, rect.height_m),
        f"window {number % 8}",
        pane,
        (0.0, 0.0, 1.0, 1.0),
    )


def _pitched(builder: MeshBuilder, layout: Layout, feature: int) -> None:
    eaves, roof, depth = layout.height_m, layout.roof, layout.depth_m
    over, run = roof.overhang_m, roof.run_m
    slope = roof.rise_m / run
    lip = eaves + 0.04 - over * slope
    profile = [(-over, lip), (run, lip + (run + over) * slope), (depth + over, lip)]
    gable = [(0.0, eaves), (run, profile[1][1]), (depth, eaves)]
    _profile(builder, layout, profile, gable, over, feature)
    width = layout.width_m + over * 0.8
    x0 = -over * 0.4
    builder.quad((x0, 0.0, lip - 0.02), (width, 0, 0), (0, -over, 0), "trim", feature)
    builder.box(
        (x0, -over - 0.11, lip - 0.05),
        (x0 + width, -over + 0.01, lip + 0.07),
        "lead",
        feature,
        "flrtd",
    )


def _flat(builder: MeshBuilder, layout: Layout, roof: int, wall: int) -> None:
    eaves = layout.height_m
    builder.quad(
        (0, 0.3, eaves - 0.4), (layout.width_m, 0, 0), (0, layout.depth_m - 0.3, 0), "roof", roof
    )
    builder.box((0, 0, eaves - 0.5), (layout.width_m, 0.3, eaves), "trim", wall, "bt")


def _chimney(builder: MeshBuilder, chimney: Chimney, feature: int) -> None:
    x0, x1 = chimney.x_m, chimney.x_m + chimney.width_m
    y0, y1 = chimney.back_m, chimney.back_m + chimney.depth_m
    top = chimney.y_m + chimney.height_m
    builder.box((x0, y0, chimney.y_m - 2.0), (x1, y1, top), "stack", feature, "fblrt")
    builder.box(
        (x0 - 0.06, y0 - 0.06, top - 0.22), (x1 + 0.06, y1 + 0.06, top - 0.06), "trim", feature
    )
    along_x = chimney.width_m >= chimney.depth_m
    for i in range(chimney.pots):
        at = (i + 0.5) / chimney.pots
        x = x0 + at * (x1 - x0) if along_x else (x0 + x1) / 2
        y = (y0 + y1) / 2 if along_x else y0 + at * (y1 - y0)
        builder.box((x - 0.11, y - 0.11, top), (x + 0.11, y + 0.11, top + 0.42), "pot", feature)
