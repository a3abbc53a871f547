"""A segment as it was scanned and as it was made, seen from the street at a slant: for a vote."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.drive.build.frame import ColumnFrame
from veduta.drive.build.raw import UNSEEN
from veduta.drive.build.segment import Textured
from veduta.place.mesh import Mesh

Floats = NDArray[np.float64]
_EMPTY = (226, 229, 231)
_WIDEST_PX, _MOST_PX_M = 1500, 28.0
_SLANT = (0.30, 0.22)
"""Metres that one metre of depth moves to the side and up in the picture."""
_LIGHT = np.array([0.35, -0.55, 0.75]) / np.linalg.norm([0.35, -0.55, 0.75])
"""Along, outward and up; the sun stands behind whoever looks."""
_FINEST = 192


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
    height, width = atlas.seen.shape
    uv = np.asarray(atlas.uv(surface.pixel), dtype=np.float64)
    at = np.clip((uv * [width, height]).astype(np.int64), 0, [width - 1, height - 1])
    colours = textured.pixels[at[:, 1], at[:, 0]]
    unseen = (textured.plain & atlas.surface)[at[:, 1], at[:, 0]]
    colours = np.where(unseen[:, None], np.array(UNSEEN, dtype=np.uint8), colours)
    made = (surface.vertices, surface.triangles, colours)
    after = _drawn(screen, [made], uv, textured)
    pieces = [
        (mesh.positions_m.astype(np.float64) + middle, mesh.triangles.astype(np.int64), mesh.colours)
        for mesh in raw if mesh.colours is not None
    ]  # fmt: skip
    return _drawn(screen, pieces, None, textured), after


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
    pieces: list[tuple[Floats, NDArray[np.int64], NDArray[np.uint8]]],
    uv: Floats | None,
    textured: Textured,
) -> NDArray[np.uint8]:
    """Dots close enough to cover each triangle, the nearest on top."""
    picture = np.full((*screen.shape, 3), _EMPTY, dtype=np.uint8)
    nearest = np.full(screen.shape, np.inf)
    for vertices, triangles, colours in pieces:
        local = screen.local(vertices)
        corners = screen.flat(local)[triangles] * screen.px_m
        edges = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
        fine = np.clip(np.ceil(1.5 * edges), 1, _FINEST).astype(np.int64)
        for level in np.unique(fine).tolist():
            own = triangles[fine == level]
            weights = _weights(level)
            places = np.einsum("kc,tcx->tkx", weights, local[own]).reshape(-1, 3)
            shade = _shades(local, own)
            if uv is None:
                shown = np.einsum("kc,tcx->tkx", weights, colours[own].astype(np.float64))
            else:
                shown = _texels(np.einsum("kc,tcx->tkx", weights, uv[own]), textured)
            grey = (np.abs(shown - np.array(UNSEEN)).max(axis=2, keepdims=True) < 3.0)
            shown = np.where(grey, shown * shade[:, None, None], shown)
            _dots(screen, picture, nearest, places, shown.reshape(-1, 3))
    return picture


def _weights(level: int) -> Floats:
    """(k, 3) places in a triangle."""
    one, two = np.meshgrid(np.arange(level), np.arange(level), indexing="ij")
    kept = (one + two) < level
    first, second = (one[kept] + 1 / 3) / level, (two[kept] + 1 / 3) / level
    return np.stack([first, second, 1.0 - first - second], axis=1)


def _shades(local: Floats, triangles: NDArray[np.int64]) -> Floats:
    """(t,) how light each triangle is; it has no backs."""
    a, b, c = (local[triangles[:, corner]] for corner in range(3))
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return np.asarray(0.55 + 0.6 * np.abs(normal @ _LIGHT), dtype=np.float64)


def _texels(uv: Floats, textured: Textured) -> Floats:
    """(t, k, 3) what the atlas shows there."""
    height, width = textured.atlas.seen.shape
    at = np.clip((uv * [width, height]).astype(np.int64), 0, [width - 1, height - 1])
    x, y = at[..., 0], at[..., 1]
    plain = textured.plain[y, x]
    return np.where(plain[..., None], np.array(UNSEEN), textured.pixels[y, x]).astype(np.float64)


def _dots(
    screen: _Screen,
    picture: NDArray[np.uint8],
    nearest: NDArray[np.float64],
    places: Floats,
    colours: Floats,
) -> None:
    flat = (screen.flat(places) - screen.low) * screen.px_m
    x, y = flat[:, 0].astype(np.int64), screen.shape[0] - 1 - flat[:, 1].astype(np.int64)
    inside = (flat >= 0).all(axis=1) & (x < screen.shape[1]) & (y >= 0) & (y < screen.shape[0])
    cell, depth = (y * screen.shape[1] + x)[inside], places[inside, 1]
    order = np.lexsort((depth, cell))
    cell, first = np.unique(cell[order], return_index=True)
    row = order[first]
    better = depth[row] < nearest.ravel()[cell]
    nearest.ravel()[cell[better]] = depth[row[better]]
    shown = np.clip(colours[inside][row[better]], 0, 255).astype(np.uint8)
    picture.reshape(-1, 3)[cell[better]] = shown
