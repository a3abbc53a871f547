"""Arched heads: whether the upper corners of windows and doors are wall, as under a round arch.

A box of an element is drawn around it. Under an arch the corners of the box look as the wall beside
it does, and the middle as the opening. Elements of a floor are mostly alike, so that each is judged
by what its own pixels and those of its neighbours say.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.facade.boxes import Box

Float = NDArray[np.float32]
Point = tuple[float, float]


@dataclass(frozen=True)
class HeadParameters:
    """When a head is arched.

    `rises`: heights of an arch that are tried, in widths of the opening (0.5 is a half circle).
    `drops`: by how much the opening may begin below its box, in widths. `side_px`: the width to
    which an opening is brought before it is looked at. `ring`: how far the wall is looked at beside
    and above the box, in widths. `own`: the weight of an opening's own pixels beside those of its
    floor. `most`: the log odds of one pixel count this much at most. `unlike`: a pixel whose colour
    (OpenCV's Lab) is further than this from the wall's is none. `sure`: the mean log odds, in the
    corners, that they are wall (and in the middle that it is not), from which on the head is an
    arch. `gain`: how much better an arch must explain the upper part than a level head, per pixel.
    `narrow_px`: openings narrower than this are not looked at.
    Seen on CMP's pictures b0003 to b0120, every third.
    """

    rises: tuple[float, ...] = (0.0, 0.12, 0.2, 0.3, 0.4, 0.5)
    drops: tuple[float, ...] = (-0.1, -0.05, 0.0, 0.05, 0.1, 0.15)
    side_px: int = 28
    ring: float = 0.25
    own: float = 0.5
    most: float = 2.0
    unlike: float = 22.0
    sure: float = 0.35
    gain: float = 0.05
    narrow_px: float = 9.0


def with_heads(
    boxes: Sequence[Box], lab: Float, parameters: HeadParameters | None = None
) -> list[Box]:
    """The boxes, those under an arch with its outline.

    boxes: in pixels of `lab` (h, w, 3), CIE Lab in OpenCV's 0..255 scaling.
    """
    p = parameters or HeadParameters()
    looked = [place for place, box in enumerate(boxes) if _is_looked_at(box, p)]
    maps = {place: _wall_odds(lab, boxes[place], p) for place in looked}
    found = list(boxes)
    for place in looked:
        box, own = boxes[place], maps[place]
        alike = [maps[k] for k in looked if _are_alike(boxes[k], box)]
        odds = p.own * own + (1.0 - p.own) * np.mean(alike, axis=0)
        rise, drop = _best_head(odds, p)
        if rise > 0.0:
            found[place] = _under_arch(box, rise, drop)
    return found


def _under_arch(box: Box, rise: float, drop: float) -> Box:
    """The box, moved to where its head is, with its outline."""
    top = max(0, box.y + round(drop * box.width))
    moved = replace(box, y=top, height=max(1, box.y + box.height - top))
    return replace(moved, outline=arched(moved, min(rise * box.width, 0.9 * moved.height)))


def arched(box: Box, rise: float, steps: int = 8) -> tuple[Point, ...]:
    """The outline of an opening under an arch that rises by `rise`: from its lower left, clockwise.

    A rise of half the width is a half circle, a lower one the segment of a larger one.
    """
    left, right, foot = float(box.x), float(box.x + box.width), float(box.y + box.height)
    head = float(box.y)
    half = 0.5 * (right - left)
    radius = (half * half + rise * rise) / (2.0 * rise)
    middle = head + radius
    reach = np.arcsin(min(1.0, half / radius))
    turns = np.linspace(-reach, reach, steps + 1)
    x = 0.5 * (left + right) + radius * np.sin(turns)
    y = middle - radius * np.cos(turns)
    arc = [(float(a), float(b)) for a, b in zip(x, y, strict=True)]
    return ((left, foot), *arc, (right, foot))


def _is_looked_at(box: Box, p: HeadParameters) -> bool:
    upright = box.height > 0.7 * box.width
    return box.kind in ("window", "door") and upright and box.width >= p.narrow_px


def _are_alike(one: Box, other: Box) -> bool:
    """Whether two stand on one floor at about one height, and are about as wide."""
    apart = abs(one.y - other.y)
    wider = max(one.width, other.width) / max(1, min(one.width, other.width))
    alike = one.kind == other.kind and one.floor == other.floor
    return alike and apart < 0.3 * one.width and wider < 1.3


def _wall_odds(lab: Float, box: Box, p: HeadParameters) -> Float:
    """(rows, columns) log odds that a pixel is wall, around the box's upper part.

    The box is brought to `side_px` columns, with a ring around it, and reaches one width down.
    """
    side, ring = p.side_px, round(p.ring * p.side_px)
    scale = box.width / side
    across = (np.arange(-ring, side + ring) + 0.5) * scale + box.x - 0.5
    tall = max(side, 2)
    down = (np.arange(-ring, tall) + 0.5) * scale + box.y - 0.5
    x, y = np.meshgrid(across.astype(np.float32), down.astype(np.float32))
    looked = cv2.remap(lab, x, y, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    seen = np.asarray(looked, np.float32)
    inside = np.zeros(seen.shape[:2], dtype=np.bool_)
    inside[ring + side // 2 :, ring + 2 : -ring - 2] = True
    inside[ring + side // 8 :, ring + 3 * side // 8 : -ring - 3 * side // 8] = True
    beside = np.zeros_like(inside)
    gap = max(1, ring // 3)
    beside[: ring - gap] = True
    beside[:, : ring - gap] = beside[:, -ring + gap :] = True
    return _odds(seen, inside, beside, p)


def _odds(
    seen: Float, inside: NDArray[np.bool_], beside: NDArray[np.bool_], p: HeadParameters
) -> Float:
    """Log odds of two sets of pixels, each by how near the nearest of a few of its colours is."""
    distance = []
    for mask in (inside, beside):
        colours = _few_colours(seen[mask])
        apart = seen[..., None, :] - colours
        distance.append(np.sqrt((apart**2).sum(-1)).min(-1))
    odds = (distance[0] - distance[1]) / (0.25 * (distance[0] + distance[1]) + 4.0)
    # What is unlike both, as a white frame is, is no wall.
    odds = np.minimum(odds, (p.unlike - distance[1]) / (0.3 * p.unlike))
    return np.asarray(np.clip(odds, -p.most, p.most), np.float32)


def _few_colours(pixels: Float, count: int = 5) -> Float:
    """(count, 3): means of the pixels (n, 3) between quantiles of their lightness."""
    order = np.argsort(pixels[:, 0], kind="stable")
    parts = np.array_split(order, count)
    return np.stack([np.median(pixels[part], axis=0) for part in parts]).astype(np.float32)


def _best_head(odds: Float, p: HeadParameters) -> tuple[float, float]:
    """Rise and drop (in widths) of the head that parts wall from opening; 0 for a level one."""
    side, ring = p.side_px, round(p.ring * p.side_px)
    x = (np.arange(-ring, side + ring) + 0.5) / side - 0.5
    y = (np.arange(-ring, len(odds) - ring) + 0.5) / side
    inner = np.abs(x) < 0.5
    part = odds[: ring + round(0.75 * side), inner]
    rows, columns = y[: len(part), None], x[None, inner]
    best = {}
    for rise in p.rises:
        for drop in p.drops:
            wall = rows < drop + _below_apex(columns, rise)
            best[rise, drop] = float(np.where(wall, part, -part).mean())
    level = max(value for (rise, _), value in best.items() if rise == 0.0)
    (rise, drop), value = max(best.items(), key=lambda item: item[1])
    if rise == 0.0 or value - level < p.gain:
        return 0.0, 0.0
    corner = (rows >= drop) & (rows < drop + _below_apex(columns, rise))
    apex = (np.abs(columns) < 0.25) & (rows >= drop + rise * 0.35) & (rows < drop + rise)
    if float(part[corner].mean()) < p.sure or float(part[apex].mean()) > -p.sure:
        return 0.0, 0.0
    return rise, drop


def _below_apex(x: NDArray[np.float64], rise: float) -> NDArray[np.float64]:
    """How far an arch lies below its highest point, at x from its middle (all in widths)."""
    if rise <= 0.0:
        return np.zeros_like(x)
    radius = (0.25 + rise * rise) / (2.0 * rise)
    return np.asarray(radius - np.sqrt(np.maximum(radius * radius - x * x, 0.0)))
