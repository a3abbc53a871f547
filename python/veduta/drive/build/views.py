"""A segment as it was scanned and as it was made, seen from the street at a slant: for a vote."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta._core import walk_rasterise
from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.raw import UNSEEN
from veduta.drive.build.segment import Textured
from veduta.place.mesh import Mesh

Floats = NDArray[np.float64]
Carried = NDArray[np.float32]
_EMPTY = (226, 229, 231)
_WIDEST_PX, _MOST_PX_M = 1500, 28.0
_SLANT = (0.30, 0.22)
"""Metres that one metre of depth moves to the side and up in the picture."""
_LIGHT = np.array([0.35, -0.55, 0.75]) / np.linalg.norm([0.35, -0.55, 0.75])
"""Along, outward and up; the sun stands behind whoever looks."""
_EYE_M = 1000.0


@dataclass(frozen=True, eq=False)
class _Screen:
    """How a segment is looked at: before and after in the same way. low: (2,) m, shape: px."""

    frame: ColumnFrame
    low: Floats
    px_m: float
    shape: tuple[int, int]

    def local(self, points: Floats) -> Floats:
        """(n, 3) metres along the segment, outward, and over the road."""
        frame = self.frame
        start, middle = frame.origins[0, :2], len(frame.origins) // 2
        along = frame.origins[-1, :2] - start
        along = along / max(float(np.linalg.norm(along)), 1e-9)
        out = frame.outward[middle]
        sign = 1.0 if frame.side == "left" else -1.0  # as one sees them from the street
        flat = points[:, :2] - start
        upward = points[:, 2] - frame.road_m[middle]
        local = np.stack([sign * (flat @ along), flat @ out, upward], axis=1)
        return np.asarray(local, dtype=np.float64)

    def flat(self, local: Floats) -> Floats:
        """(n, 2) metres to the right and up in the picture."""
        return np.asarray(local[:, [0, 2]] + local[:, [1]] * np.array(_SLANT), dtype=np.float64)


def before_after(
    textured: Textured, raw: list[Mesh], middle: Floats
) -> tuple[NDArray[np.uint8], NDArray[np.uint8]] | None:
    """Two pictures (h, w, 3) of one size; None where nothing was made. middle: (3,) of the meshes
    as they were scanned (m, world).
    """
    surface, atlas = textured.surface, textured.atlas
    if not len(surface.triangles):
        return None
    screen = _screen(textured)
    uv = np.asarray(atlas.uv(surface.pixel), dtype=np.float32)
    after = _drawn(screen, surface.vertices, surface.triangles, uv, partial(_texels, textured))
    before = _drawn(screen, *_joined(raw, middle), lambda colours: colours)
    return before, after


def _joined(meshes: Sequence[Mesh], middle: Floats) -> tuple[Floats, NDArray[np.int64], Carried]:
    """Vertices (v, 3) (m, world), triangles (t, 3) and colours (v, 3) of all that have colours."""
    vertices, triangles, colours = [np.zeros((0, 3))], [np.zeros((0, 3), np.int64)], []
    count = 0
    for mesh in meshes:
        if mesh.colours is not None:
            vertices.append(mesh.positions_m.astype(np.float64) + middle)
            triangles.append(mesh.triangles.astype(np.int64) + count)
            colours.append(mesh.colours.astype(np.float32))
            count += len(mesh.positions_m)
    told = np.concatenate(colours) if colours else np.zeros((0, 3), np.float32)
    return np.concatenate(vertices), np.concatenate(triangles), told


def _screen(textured: Textured) -> _Screen:
    frame = textured.geometry.frame
    first = _Screen(frame, np.zeros(2), 1.0, (1, 1))
    flat = first.flat(first.local(textured.surface.vertices))
    low, high = np.quantile(flat, [0.002, 0.998], axis=0) + [[-1.0, -1.0], [1.0, 1.0]]
    px_m = min(_WIDEST_PX / max(float(high[0] - low[0]), 1.0), _MOST_PX_M)
    size = np.ceil((high - low) * px_m).astype(int) + 1
    return _Screen(frame, low, px_m, (int(size[1]), int(size[0])))


def _drawn(
    screen: _Screen,
    vertices: Floats,
    triangles: NDArray[np.integer],
    carried: Carried,
    colour: Callable[[Carried], NDArray[Any]],
) -> NDArray[np.uint8]:
    """The nearest triangle of each pixel. carried: (v, k) what vertices have; colour: what pixels
    that have it (n, k) look like, (n, 3).
    """
    height, width = screen.shape
    picture = np.full((height, width, 3), _EMPTY, dtype=np.uint8)
    if not len(triangles):
        return picture
    local = screen.local(vertices)
    flat = (screen.flat(local) - screen.low) * screen.px_m
    # Seen from so far that lines of sight are parallel.
    away = local[:, 1] - local[:, 1].min() + _EYE_M
    at = np.column_stack([flat[:, 0], height - flat[:, 1], away]).astype(np.float32)
    _, values, which = walk_rasterise(
        at, carried, triangles.astype(np.uint32), width, height, near=0.0
    )
    there = which >= 0
    shown = colour(values[there.ravel()]).astype(np.float64)
    unseen = np.abs(shown - np.array(UNSEEN)).max(axis=1) < 3.0
    shown[unseen] *= _shades(local, triangles)[which[there]][unseen, None]
    picture[there] = np.clip(shown, 0, 255)
    return picture


def _shades(local: Floats, triangles: NDArray[np.integer]) -> Floats:
    """(t,) how light each triangle is; it has no backs."""
    a, b, c = (local[triangles[:, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return np.asarray(0.55 + 0.6 * np.abs(normal @ _LIGHT), dtype=np.float64)


def _texels(textured: Textured, uv: Carried) -> NDArray[np.uint8]:
    """(n, 3) what the atlas shows there."""
    height, width = textured.atlas.seen.shape
    at = np.clip((uv * [width, height]).astype(np.int64), 0, [width - 1, height - 1])
    plain = textured.plain[at[:, 1], at[:, 0], None]
    shown = np.where(plain, np.array(UNSEEN, np.uint8), textured.pixels[at[:, 1], at[:, 0]])
    return np.asarray(shown, dtype=np.uint8)
