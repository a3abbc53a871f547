"""Where the photographer stands: a camera in the street that has the whole facade in its frame."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.camera import FILM_DIAGONAL_MM, Camera, look_at
from veduta.synthetic.layout import Layout
from veduta.synthetic.options import SyntheticOptions
from veduta.synthetic.seeds import stream

EYE_M = 1.65
# How far to the side the camera stands, as a share of its distance from the wall; roll (rad).
_ASIDE = {"frontal": (0.0, 0.0), "mild": (0.08, 0.22), "strong": (0.35, 0.6)}
# What the camera looks at, as a share of the building's height: the best framing wins.
_AIMS = tuple(0.2 + 0.04 * i for i in range(12))
_ROLL = {"frontal": 0.0, "mild": 0.008, "strong": 0.02}


def street_view(layout: Layout, seed: int, options: SyntheticOptions) -> Camera:
    """A camera at eye height with a focal length of whole millimetres (35 mm equivalent)."""
    rng = stream(seed, "view")
    size = _picture_size(layout, options.long_side_px)
    focal_mm = float(rng.integers(26, 34))
    focal_px = focal_mm * float(np.hypot(*size)) / FILM_DIAGONAL_MM
    low, high = _ASIDE[options.perspective]
    aside = float(rng.uniform(low, high)) * (1.0 if rng.random() < 0.5 else -1.0)
    roll = float(rng.uniform(-1.0, 1.0)) * _ROLL[options.perspective]
    views = [_closest(layout, aim, aside, size, focal_px, roll) for aim in _AIMS]
    return min(views, key=lambda camera: _framing_cost(layout, camera))


def _framing_cost(layout: Layout, camera: Camera) -> float:
    """Distance from the wall, made worse where much more is left free above than below."""
    middle, top = layout.width_m / 2, layout.height_m + layout.roof.rise_m
    ends = np.array([[middle, 0.0, 0.0], [middle, layout.roof.run_m, top]])
    rows = camera.project(ends)[0][:, 1]
    uneven = abs(float(rows.sum()) / camera.height_px - 1.0)
    return abs(float(camera.position_m[1])) * (1.0 + uneven)


def _picture_size(layout: Layout, long_side_px: int) -> tuple[int, int]:
    """Upright 3:4 for a tall facade, level 4:3 for a wide one, square between."""
    top = layout.height_m + layout.roof.rise_m
    ratio = layout.width_m / top
    short = round(long_side_px * 0.75)
    if ratio < 0.85:
        return (short, long_side_px)
    return (long_side_px, short) if ratio > 1.2 else (long_side_px, long_side_px)


def _closest(
    layout: Layout,
    aim: float,
    aside: float,
    size_px: tuple[int, int],
    focal_px: float,
    roll_rad: float,
) -> Camera:
    """The camera nearest to the wall that still has all of it in the frame (bisection)."""
    near, far = 1.0, 400.0
    for _ in range(40):
        distance = 0.5 * (near + far)
        camera = _camera_at(layout, distance, aim, aside, size_px, focal_px, roll_rad)
        near, far = (near, distance) if _in_frame(layout, camera) else (distance, far)
    return _camera_at(layout, far, aim, aside, size_px, focal_px, roll_rad)


def _camera_at(
    layout: Layout,
    distance_m: float,
    aim: float,
    aside: float,
    size_px: tuple[int, int],
    focal_px: float,
    roll_rad: float,
) -> Camera:
    top = layout.height_m + layout.roof.rise_m
    eye = (layout.width_m / 2 + aside * distance_m, -distance_m, EYE_M)
    return look_at(eye, (layout.width_m / 2, 0.0, aim * top), size_px, focal_px, roll_rad)


def _in_frame(layout: Layout, camera: Camera) -> bool:
    """Whether ground, eaves, ridge and chimneys lie within the frame, with a margin of 3 %."""
    top, run = layout.height_m + layout.roof.rise_m, layout.roof.run_m
    corners = [
        (x, y, z)
        for x in (0.0, layout.width_m)
        for y, z in ((0.0, -0.3), (0.0, layout.height_m), (run, top))
    ]
    corners += [(c.x_m, c.back_m, c.y_m + c.height_m + 0.4) for c in layout.roof.chimneys]
    pixels, depth = camera.project(np.array(corners))
    margin = 0.03 * min(camera.width_px, camera.height_px)
    inside = (pixels > margin) & (pixels < np.array([camera.width_px, camera.height_px]) - margin)
    return bool(np.all(depth > 0.5) and np.all(inside))
