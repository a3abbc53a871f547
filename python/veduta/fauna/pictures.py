"""The figures of the report: the axis and its angles (11), new motion (12), and the body."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.angles import Floats, axis_of
from veduta.fauna.motion.gaits import Gait

_WHITE = (255, 255, 255)
_INK = (60, 60, 64)
_GRID = (226, 226, 230)
Picture = NDArray[np.uint8]


def axes_picture(axes: Floats, width: int = 900) -> Picture:
    """Axes (t, n, 2) one over the other, early ones blue, late ones red, a dot at the head."""
    low, high = axes.min(axis=(0, 1)), axes.max(axis=(0, 1))
    span = np.maximum(high - low, 1e-9)
    scale = min((width - 60) / span[0], 520 / max(span[1], 1e-9))
    height = int(span[1] * scale) + 60
    pixels = np.full((height, width, 3), _WHITE, dtype=np.uint8)
    chosen = np.linspace(0, len(axes) - 1, min(len(axes), 24)).round().astype(int)
    for row, colour in zip(chosen, _times(len(chosen)), strict=True):
        line = (axes[row] - low) * scale
        line[:, 1] = height - 60 - line[:, 1]
        points = np.round((line + 30) * 8).astype(np.int32)
        cv2.polylines(pixels, [points], False, colour, 2, cv2.LINE_AA, shift=3)
        head = (int(points[0, 0]), int(points[0, 1]))
        cv2.circle(pixels, head, 5 * 8, colour, -1, cv2.LINE_AA, shift=3)
    return pixels


def gait_picture(gait: Gait, width: int = 900) -> Picture:
    """A gait's axes along its course (figure 12)."""
    return axes_picture(axis_of(gait.angles) + gait.middle[:, None], width)


def angles_picture(angles: Floats, again: Floats, width: int = 900, height: int = 300) -> Picture:
    """A(s) of a frame, and what the state keeps of it (figure 11). angles, again: (n,) rad."""
    pixels = np.full((height, width, 3), _WHITE, dtype=np.uint8)
    low = float(min(angles.min(), again.min())) - 0.2
    high = float(max(angles.max(), again.max())) + 0.2
    for level in np.arange(np.ceil(low / 0.5) * 0.5, high, 0.5):
        row = int(height - (level - low) / (high - low) * height)
        cv2.line(pixels, (0, row), (width, row), _GRID, 1)
        _say(pixels, f"{level:+.1f} rad", (8, row - 4))
    for values, colour, thick in ((angles, (90, 140, 200), 5), (again, (30, 30, 30), 1)):
        x = np.linspace(0, width - 1, len(values))
        y = height - (values - low) / (high - low) * height
        points = np.round(np.stack([x, y], axis=1) * 8).astype(np.int32)
        cv2.polylines(pixels, [points], False, colour, thick, cv2.LINE_AA, shift=3)
    _say(pixels, "head", (8, height - 8))
    _say(pixels, "tail", (width - 40, height - 8))
    return pixels


def angles_over_time(angles: Floats, width: int = 900, height: int = 260) -> Picture:
    """A(s, t) as colours: time to the right, the head at the top; blue left, red right."""
    bends = angles - angles.mean(axis=1, keepdims=True)
    most = float(np.abs(bends).max()) or 1.0
    share = (bends.T / most + 1.0) / 2.0
    levels = np.round(share * 255).astype(np.uint8)
    coloured = cv2.applyColorMap(levels, cv2.COLORMAP_TWILIGHT_SHIFTED)
    wide = cv2.resize(coloured, (width, height), interpolation=cv2.INTER_LINEAR)
    return np.ascontiguousarray(wide[..., ::-1])


def _times(count: int) -> list[tuple[int, int, int]]:
    share = np.linspace(0.0, 1.0, max(count, 2))[:count]
    first, last = np.array([40, 90, 190.0]), np.array([205, 60, 40.0])
    mixed = first + (last - first) * share[:, None]
    return [(int(r), int(g), int(b)) for r, g, b in mixed]


def _say(pixels: Picture, text: str, at: tuple[int, int]) -> None:
    cv2.putText(pixels, text, at, cv2.FONT_HERSHEY_SIMPLEX, 0.42, _INK, 1, cv2.LINE_AA)
