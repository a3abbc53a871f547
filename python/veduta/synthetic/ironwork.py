"""Balconies: slabs on consoles, and railings as real bars and ornaments in front of the wall."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.layout import Balcony, RailPattern
from veduta.synthetic.mesh import MeshBuilder

SLAB_M = 0.14
BAR_M = 0.022


def add_balcony(builder: MeshBuilder, balcony: Balcony, feature: int) -> None:
    """A slab (where the balcony is deep enough to stand on) and its railing."""
    rect, depth = balcony.rect, balcony.depth_m
    base = rect.y_m
    if depth >= 0.5:
        builder.box(
            (rect.x_m, -depth, base), (rect.right_m, 0.0, base + SLAB_M), "trim", feature, "flrtd"
        )
        _consoles(builder, balcony, feature)
        base += SLAB_M
    front = -depth + 0.04
    _railing(
        builder,
        (rect.x_m, front),
        (rect.right_m, front),
        base,
        rect.top_m,
        balcony.pattern,
        feature,
    )
    for x in (rect.x_m, rect.right_m):
        _railing(builder, (x, 0.0), (x, front), base, rect.top_m, "bars", feature)


def add_screen(builder: MeshBuilder, balcony: Balcony, feature: int) -> None:
    """The area that a balcony covers, without gaps: for label images, never for pictures."""
    rect = balcony.rect
    low = (rect.x_m, -balcony.depth_m + 0.02, rect.y_m)
    builder.box(low, (rect.right_m, 0.0, rect.top_m), "iron", feature, "flr")


def _consoles(builder: MeshBuilder, balcony: Balcony, feature: int) -> None:
    rect = balcony.rect
    count = max(2, round(rect.width_m / 1.1))
    for x in np.linspace(rect.x_m + 0.2, rect.right_m - 0.2, count):
        reach = 0.75 * balcony.depth_m
        low = (float(x) - 0.09, -reach, rect.y_m - 0.16)
        builder.box(low, (float(x) + 0.09, 0.0, rect.y_m), "trim", feature, "flrd")
        low = (float(x) - 0.09, -0.45 * reach, rect.y_m - 0.36)
        builder.box(low, (float(x) + 0.09, 0.0, rect.y_m - 0.16), "trim", feature, "flrd")


def _railing(
    builder: MeshBuilder,
    start: tuple[float, float],
    end: tuple[float, float],
    low_m: float,
    high_m: float,
    pattern: RailPattern,
    feature: int,
) -> None:
    """Posts and ornaments between two points of the plan (x, y)."""
    run = np.array([end[0] - start[0], end[1] - start[1]])
    length = float(np.hypot(*run))
    if length < 0.1:
        return
    direction = run / length
    line = _Line(builder, start, direction, feature)
    line.bar((0.0, high_m - 0.022), (length, high_m - 0.022), 0.045)
    line.bar((0.0, low_m + 0.05), (length, low_m + 0.05), 0.025)
    if pattern != "bars":
        line.bar((0.0, high_m - 0.19), (length, high_m - 0.19), 0.02)
        line.bar((0.0, low_m + 0.17), (length, low_m + 0.17), 0.02)
    for at in np.arange(BAR_M, length, 0.11 if pattern == "bars" else 0.14):
        line.bar((float(at), low_m), (float(at), high_m), BAR_M)
    _ornaments(line, length, (low_m + 0.18, high_m - 0.20), pattern)


@dataclass(frozen=True)
class _Line:
    """A vertical plane through `start` along `direction` (plan), in which irons lie flat."""

    builder: MeshBuilder
    start: tuple[float, float]
    direction: NDArray[np.float64]
    feature: int

    def bar(self, a: tuple[float, float], b: tuple[float, float], thickness_m: float) -> None:
        """A flat iron between two points (along, up) of the plane."""
        p, q = np.asarray(a), np.asarray(b)
        along = q - p
        across = np.array([-along[1], along[0]]) * (thickness_m / float(np.hypot(*along)))
        self.builder.quad(
            self._lift(p - across / 2, self.start),
            self._lift(along),
            self._lift(across),
            "iron",
            self.feature,
            (0.0, 0.0, 1.0, 1.0),
        )

    def _lift(
        self, point: NDArray[np.float64], base: tuple[float, float] = (0.0, 0.0)
    ) -> tuple[float, float, float]:
        x = base[0] + float(self.direction[0] * point[0])
        return (x, base[1] + float(self.direction[1] * point[0]), float(point[1]))


def _ornaments(
    line: _Line, length: float, band_m: tuple[float, float], pattern: RailPattern
) -> None:
    """Rings, crosses or scrolls in the field between the rails."""
    if pattern == "bars":
        return
    low, high = band_m
    size = min(0.44, high - low)
    count = max(1, int(length / (size + 0.02)))
    pitch = length / count
    for i in range(count):
        middle, level = (i + 0.5) * pitch, (low + high) / 2
        if pattern == "crosses":
            line.bar((middle - pitch / 2, low), (middle + pitch / 2, high), 0.024)
            line.bar((middle - pitch / 2, high), (middle + pitch / 2, low), 0.024)
            continue
        angle = np.linspace(0, 2 * np.pi * (1.0 if pattern == "rings" else 1.45), 11)
        radius = 0.5 * size * np.linspace(1.0, 1.0 if pattern == "rings" else 0.25, angle.size)
        side = 1.0 if i % 2 == 0 else -1.0
        x, y = middle + side * radius * np.cos(angle), level + radius * np.sin(angle)
        for k in range(angle.size - 1):
            line.bar((float(x[k]), float(y[k])), (float(x[k + 1]), float(y[k + 1])), 0.024)
