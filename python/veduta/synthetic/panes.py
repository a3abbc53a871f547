"""Textures of what fills an opening: sash, casement and plain windows, doors, shop fronts.

Each is (h, w, 4) uint8: sRGB colour, and in the fourth channel how much of the surface is a
mirror (glass 255, frame 0). Row 0 is the upper edge. Behind the glass there is a dark room, a
curtain or a blind.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.synthetic.noise import fractal_noise, value_noise
from veduta.synthetic.textures import Colour

Glazed = NDArray[np.uint8]
WindowKind = Literal["casement", "sash", "fixed", "tilt"]
Interior = Literal["dark", "sheer", "drapes", "blind"]
PANE_PX_PER_M = 110.0
SHOP_SIGNS = ("BOULANGERIE", "LIBRAIRIE", "PHARMACIE", "FLEURISTE", "EPICERIE", "TABAC")


@dataclass(frozen=True)
class WindowLook:
    """How a window is divided and what hangs behind it."""

    kind: WindowKind
    frame: Colour
    interior: Interior
    fabric: Colour
    panes_down: int = 3
    frame_m: float = 0.06
    bar_m: float = 0.03


def window(rng: np.random.Generator, width_m: float, height_m: float, look: WindowLook) -> Glazed:
    """One window seen from outside."""
    h, w = round(height_m * PANE_PX_PER_M), round(width_m * PANE_PX_PER_M)
    room = _room(rng, (h, w), look)
    glazed = np.dstack([room, np.ones((h, w), np.float32)])
    for x0, y0, x1, y1 in _bars(width_m, height_m, look):
        _bar(glazed, (x0, y0, x1, y1), look.frame)
    return np.asarray(np.clip(np.rint(glazed * 255.0), 0, 255), np.uint8)


def _room(
    rng: np.random.Generator, shape: tuple[int, int], look: WindowLook
) -> NDArray[np.float32]:
    h, w = shape
    y, x = np.indices(shape, dtype=np.float32)
    dark = 0.10 + 0.05 * fractal_noise(rng, shape, max(6.0, w / 3)) + 0.05 * (1.0 - y / h)
    room = np.stack([dark * 1.05, dark, dark * 0.95], axis=-1)
    fabric = np.asarray(look.fabric, np.float32)
    folds = 0.86 + 0.14 * value_noise(rng, shape, (h * 2.0, max(3.0, w / 14)))
    cloth = folds[..., None] * fabric
    if look.interior == "sheer":
        hang = float(rng.uniform(0.55, 0.8))
        room = room * (1.0 - hang) + cloth * hang
    elif look.interior == "drapes":
        reach = float(rng.uniform(0.16, 0.34)) * w
        edge = np.minimum(x, w - 1 - x) - reach * (0.8 + 0.35 * np.abs(y / h - 0.55))
        mask = np.clip(0.5 - edge / 3.0, 0.0, 1.0)[..., None]
        room = room * (1.0 - mask) + cloth * mask
    elif look.interior == "blind":
        down = float(rng.uniform(0.2, 0.75)) * h
        mask = np.clip(down - y, 0.0, 1.0)[..., None] * 0.92
        slats = 0.93 + 0.07 * np.cos(2 * np.pi * y / 5.0)
        room = room * (1.0 - mask) + slats[..., None] * fabric * mask
    return room.astype(np.float32)


def _bars(
    width_m: float, height_m: float, look: WindowLook
) -> list[tuple[float, float, float, float]]:
    """Frame members as (left, top, right, bottom) in metres, later ones over earlier ones."""
    w, h, f, b = width_m, height_m, look.frame_m, look.bar_m
    bars: list[tuple[float, float, float, float]] = []
    if look.kind == "casement":
        for i in range(1, look.panes_down):
            at = h * i / look.panes_down
            bars.append((0, at - b / 2, w, at + b / 2))
        bars.append((w / 2 - 0.05, 0, w / 2 + 0.05, h))
    elif look.kind == "sash":
        for i in range(1, look.panes_down):
            at = w * i / look.panes_down
            bars.append((at - b / 2, 0, at + b / 2, h))
        bars += [(0, h * q - b / 2, w, h * q + b / 2) for q in (0.25, 0.75)]
        bars.append((0, h / 2 - 0.03, w, h / 2 + 0.03))
    elif look.kind == "tilt":
        at = w * 0.36
        bars.append((at - 0.045, 0, at + 0.045, h))
    bars += [(0, 0, w, f), (0, h - f, w, h), (0, 0, f, h), (w - f, 0, w, h)]
    return bars


def _bar(
    glazed: NDArray[np.float32], rect_m: tuple[float, float, float, float], colour: Colour
) -> None:
    """Paint a frame member with a lit upper left and a shaded lower right edge."""
    x0, y0, x1, y1 = (round(v * PANE_PX_PER_M) for v in rect_m)
    x0, y0 = max(0, x0), max(0, y0)
    patch = glazed[y0 : max(y1, y0 + 1), x0 : max(x1, x0 + 1)]
    if patch.size == 0:
        return
    patch[..., :3] = colour
    patch[..., 3] = 0.0
    patch[-1, :, :3] *= 0.72
    patch[:, -1, :3] *= 0.80
    patch[0, :, :3] *= 1.04


def door(
    rng: np.random.Generator, width_m: float, height_m: float, colour: Colour, fanlight_m: float
) -> Glazed:
    """A panelled door of one or two leaves under a fanlight of the given height."""
    h, w = round(height_m * PANE_PX_PER_M), round(width_m * PANE_PX_PER_M)
    image = np.zeros((h, w, 4), np.float32)
    grainy = 1.0 + 0.06 * value_noise(rng, (h, w), (h / 2, 3.0))
    image[..., :3] = grainy[..., None] * np.asarray(colour, np.float32)
    leaves = 2 if width_m > 1.5 else 1
    top = round(fanlight_m * PANE_PX_PER_M)
    for leaf in range(leaves):
        left, right = leaf * w / leaves, (leaf + 1) * w / leaves
        margin = 0.12 * (right - left)
        for upper, lower in ((0.06, 0.42), (0.48, 0.62), (0.68, 0.94)):
            y0, y1 = top + upper * (h - top), top + lower * (h - top)
            _panel(image, (left + margin, y0, right - margin, y1))
        image[top:, round(left) : round(left) + 2, :3] *= 0.45
    image[:, :4, :3] *= 0.7
    image[:, -4:, :3] *= 0.7
    if top > 6:
        edge = 5
        image[edge : top - edge, edge : w - edge, :3] = 0.12
        image[edge : top - edge, edge : w - edge, 3] = 1.0
        for i in range(1, 4):
            at = round(w * i / 4)
            image[edge : top - edge, at - 1 : at + 2] = (*colour, 0.0)
    return np.asarray(np.clip(np.rint(image * 255.0), 0, 255), np.uint8)


def _panel(image: NDArray[np.float32], rect_px: tuple[float, float, float, float]) -> None:
    x0, y0, x1, y1 = (round(v) for v in rect_px)
    image[y0:y1, x0:x1, :3] *= 0.9
    image[y0 : y0 + 3, x0:x1, :3] *= 0.55
    image[y0:y1, x0 : x0 + 3, :3] *= 0.6
    image[y1 - 2 : y1, x0:x1, :3] *= 1.3
    image[y0:y1, x1 - 2 : x1, :3] *= 1.2


def shop_front(
    rng: np.random.Generator, width_m: float, height_m: float, colour: Colour, sign: Colour
) -> Glazed:
    """A timber shop front: a fascia with a sign, display windows with goods, a stall riser."""
    h, w = round(height_m * PANE_PX_PER_M), round(width_m * PANE_PX_PER_M)
    image = np.zeros((h, w, 4), np.float32)
    image[..., :3] = np.asarray(colour, np.float32) * (
        1.0 + 0.04 * value_noise(rng, (h, w), (h / 3, 4.0))[..., None]
    )
    fascia, riser = round(0.17 * h), round(0.14 * h)
    side = round(0.05 * w)
    _sign(rng, image[round(0.03 * h) : fascia - round(0.02 * h), side:-side], sign)
    bays = max(2, round(width_m / 1.1))
    entry = int(rng.integers(bays))
    post = round(0.07 * PANE_PX_PER_M)
    for bay in range(bays):
        x0, x1 = round(w * bay / bays) + post, round(w * (bay + 1) / bays) - post
        y1 = h - (4 if bay == entry else riser)
        display = image[fascia + post : y1, x0:x1]
        _goods(rng, display)
        if bay == entry:
            image[round(0.62 * h) : round(0.62 * h) + 6, x0:x1] = (*colour, 0.0)
    image[fascia : fascia + 4, :, :3] *= 0.5
    return np.asarray(np.clip(np.rint(image * 255.0), 0, 255), np.uint8)


def _goods(rng: np.random.Generator, display: NDArray[np.float32]) -> None:
    """A dim, warm room behind the glass, with two lines of small things on show."""
    h, w = display.shape[:2]
    glow = 0.09 + 0.12 * np.exp(-np.arange(h, dtype=np.float32) / (0.35 * h))
    display[..., :3] = glow[:, None, None] * np.array([1.15, 1.0, 0.8], np.float32)
    display[..., 3] = 1.0
    for shelf, tallest in ((0.72, 0.10), (0.99, 0.16)):
        base = round(shelf * h)
        display[base - 2 : base, :, :3] = (0.24, 0.20, 0.15)
        at = float(rng.uniform(0.0, 0.1)) * w
        while at < 0.92 * w:
            wide, high = (
                float(rng.uniform(0.05, 0.13)) * w,
                float(rng.uniform(0.4, 1)) * tallest * h,
            )
            grey = float(rng.uniform(0.12, 0.42))
            colour = np.clip(grey * (1 + 0.18 * rng.standard_normal(3)), 0.04, 0.7)
            display[round(base - 2 - high) : base - 2, round(at) : round(at + wide), :3] = colour
            at += wide * float(rng.uniform(1.1, 2.2))


def _sign(rng: np.random.Generator, board: NDArray[np.float32], colour: Colour) -> None:
    """A lettered board."""
    h, w = board.shape[:2]
    board[..., :3] *= 0.8
    word = SHOP_SIGNS[int(rng.integers(len(SHOP_SIGNS)))]
    font, thickness = cv2.FONT_HERSHEY_COMPLEX, 2
    (width, height), _ = cv2.getTextSize(word, font, 1.0, thickness)
    size = min(0.62 * h / height, 0.8 * w / width)
    canvas = np.zeros((h, w), np.uint8)
    corner = (round((w - size * width) / 2), round((h + size * height) / 2))
    cv2.putText(canvas, word, corner, font, size, 255, thickness, cv2.LINE_AA)
    ink = (canvas.astype(np.float32) / 255.0)[..., None]
    board[..., :3] = board[..., :3] * (1.0 - ink) + np.asarray(colour, np.float32) * ink


def shutter(rng: np.random.Generator, width_m: float, height_m: float, colour: Colour) -> Glazed:
    """A louvred shutter leaf."""
    h, w = round(height_m * PANE_PX_PER_M), round(width_m * PANE_PX_PER_M)
    y, _ = np.indices((h, w), dtype=np.float32)
    slats = 0.82 + 0.18 * np.cos(2 * np.pi * y / 6.0)
    image = np.zeros((h, w, 4), np.float32)
    image[..., :3] = (slats + 0.02 * value_noise(rng, (h, w), (9.0, 9.0)))[..., None] * colour
    for rect in (
        (0, 0, width_m, 0.06),
        (0, height_m - 0.08, width_m, height_m),
        (0, height_m / 2 - 0.04, width_m, height_m / 2 + 0.04),
        (0, 0, 0.06, height_m),
        (width_m - 0.06, 0, width_m, height_m),
    ):
        _bar(image, rect, colour)
    return np.asarray(np.clip(np.rint(image * 255.0), 0, 255), np.uint8)
