"""Synthetic fronts with something before them, and the same fronts without it.

Balconies are built into one of two renders of a front and not into the other; what differs is the
hole, with the shadows. Trees, hedges, vehicles, fences and people are those that
`training/facade/sprites.py` draws, laid over the bare render. All pictures show the plane of the
facade.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "training" / "facade"))

from sprites import DRAWN  # type: ignore[import-not-found]

from veduta.synthetic.build import build
from veduta.synthetic.camera import Camera
from veduta.synthetic.layout import STYLES, Layout
from veduta.synthetic.light import daylight
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.part import mirrors, to_part
from veduta.synthetic.photo import Lens, develop
from veduta.synthetic.render import render
from veduta.synthetic.scene import RayScene
from veduta.synthetic.styles import design
from veduta.synthetic.truth import elements_of, facade_homography
from veduta.synthetic.view import street_view

Pixels = NDArray[np.uint8]
Mask = NDArray[np.bool_]
KINDS = ("balcony", "tree", "hedge", "vehicle", "fence", "person")
LONGEST_PX = 900
# What differs by more than this (of 255) between the two renders is hidden, and what is around it.
_DIFFERENT, _AROUND_PX = 14, 5
# Width and height (m) of what stands before a front, and how many stand beside each other.
_SIZE_M = {
    "tree": (5.0, 6.5, 1),
    "hedge": (2.0, 1.7, 4),
    "vehicle": (4.4, 4.4, 1),
    "fence": (1.8, 1.8, 4),
    "person": (2.0, 2.0, 3),
}


@dataclass(frozen=True)
class HiddenFront:
    """`seen` (h, w, 3) is the picture with what hides it, `bare` without; `hole` (h, w) the hidden.

    `windows` (n, 4): left, top, right, bottom (px) of the true windows and dormers.
    """

    name: str
    kind: str
    style: str
    seen: Pixels
    bare: Pixels
    hole: Mask
    windows: NDArray[np.float64]
    px_per_m: float

    @property
    def window_px(self) -> float:
        """The width of a window."""
        return float(np.median(self.windows[:, 2] - self.windows[:, 0]))

    @property
    def is_wide(self) -> bool:
        """Whether the widest part of the hole is wider than a window."""
        count, _, stats, _ = cv2.connectedComponentsWithStats(self.hole.astype(np.uint8))
        return count > 1 and bool(stats[1:, cv2.CC_STAT_WIDTH].max() > self.window_px)


def hidden_fronts(seed: int) -> Iterator[HiddenFront]:
    """One front by each kind of thing that the style can have before it."""
    options = SyntheticOptions(
        style=STYLES[seed % len(STYLES)],
        detached=True,
        long_side_px=LONGEST_PX,
        samples=1,
        weather="sunny" if seed % 3 else "cloudy",
    )
    layout = design(options.style, seed)
    camera = street_view(layout, seed, options)
    bare_layout = replace(layout, balconies=())
    bare = _photo(bare_layout, seed, options, camera)
    plane, scale = _plane(layout, camera)
    windows = _windows(bare_layout, camera, scale)
    flat = _rectified(bare, plane)
    if layout.balconies:
        seen = _rectified(_photo(layout, seed, options, camera), plane)
        hole = _differs(seen, flat)
        yield HiddenFront(
            f"{seed}-balcony", "balcony", options.style, seen, flat, hole, windows, scale
        )
    rng = np.random.default_rng(seed)
    for kind in KINDS[1:]:
        seen, hole = _behind(flat, kind, rng, scale)
        yield HiddenFront(f"{seed}-{kind}", kind, options.style, seen, flat, hole, windows, scale)


def _photo(layout: Layout, seed: int, options: SyntheticOptions, camera: Camera) -> Pixels:
    built = build(layout, seed)
    scene = RayScene([(to_part(built, "facade"), np.eye(4))], mirrors(built, "facade"))
    light = daylight(seed, options.weather == "sunny", -np.pi / 2 + 0.6, 0.7)
    lens = Lens(options.blur_px, options.vignetting, options.noise, options.jpeg_quality)
    return develop(render(scene, camera, light, options.samples, seed), lens, seed)


@dataclass(frozen=True)
class _Plane:
    photo_from_plane: NDArray[np.float64]
    size_px: tuple[int, int]


def _plane(layout: Layout, camera: Camera) -> tuple[_Plane, float]:
    """The front and its roof in its own plane, and pixels in a metre."""
    top = layout.height_m + 0.8 * layout.roof.rise_m
    scale = 0.85 * LONGEST_PX / max(layout.width_m, top)
    size = int(layout.width_m * scale), int(top * scale)
    facade = np.array([[1.0 / scale, 0, 0], [0, -1.0 / scale, top], [0, 0, 1.0]])
    return _Plane(facade_homography(camera) @ facade, size), scale


def _rectified(photo: Pixels, plane: _Plane) -> Pixels:
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    flat = cv2.warpPerspective(photo, plane.photo_from_plane, plane.size_px, flags=flags)
    return np.asarray(flat, dtype=np.uint8)


def _windows(layout: Layout, camera: Camera, scale: float) -> NDArray[np.float64]:
    top = layout.height_m + 0.8 * layout.roof.rise_m
    rects = [e.rect for e in elements_of(layout, camera) if e.label == "window"]
    rects = [rect for rect in rects if rect.top_m <= top]
    return (
        np.array(
            [[r.x_m, top - r.top_m, r.right_m, top - r.y_m] for r in rects], dtype=np.float64
        ).reshape(-1, 4)
        * scale
    )


def _differs(one: Pixels, other: Pixels) -> Mask:
    apart = np.abs(one.astype(np.int16) - other).max(axis=2) > _DIFFERENT
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (3, 3))
    clean = cv2.morphologyEx(apart.astype(np.uint8), cv2.MORPH_OPEN, kernel)
    return _grown(clean > 0)


def _grown(mask: Mask) -> Mask:
    side = 2 * _AROUND_PX + 1
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (side, side))
    return np.asarray(cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, kernel)) > 0


def _behind(bare: Pixels, kind: str, rng: np.random.Generator, scale: float) -> tuple[Pixels, Mask]:
    """The picture with sprites of one kind at its foot, and where they are."""
    draw = dict(DRAWN)[kind]
    width_m, height_m, count = _SIZE_M[kind]
    size = max(8, int(width_m * scale)), max(8, int(height_m * scale))
    seen, hole = bare.copy(), np.zeros(bare.shape[:2], dtype=np.bool_)
    height, width = bare.shape[:2]
    free = max(1, width - size[0] * count)
    left = int(rng.integers(free))
    for number in range(count):
        sprite = cv2.resize(draw(rng), size, interpolation=cv2.INTER_AREA)
        x, y = left + number * size[0], height - size[1]
        part = seen[max(y, 0) : height, x : x + size[0]]
        cut = sprite[max(-y, 0) :, : part.shape[1]]
        alpha = cut[..., 3:] / 255.0
        part[:] = np.rint(part * (1 - alpha) + cut[..., :3] * alpha).astype(np.uint8)
        hole[max(y, 0) : height, x : x + size[0]] |= alpha[..., 0] > 0.02
    grown = cv2.dilate(hole.astype(np.uint8), np.ones((5, 5), np.uint8))
    return seen, grown > 0
