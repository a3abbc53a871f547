"""Which view sees which triangle, how well, and in what colour."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene
from numpy.typing import NDArray

from veduta.cameras import Camera
from veduta.surfaces.texturing.options import SurfaceView, TextureParameters

NO_VIEW = -1
_INSET = np.array([[1, 1, 1], [8, 1, 1], [1, 8, 1], [1, 1, 8]]) / np.array([[3], [10], [10], [10]])
"""Where a triangle is looked at: its middle, and near its corners (barycentric)."""
_AT_ONCE = 200_000
Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Sights:
    """For each triangle its best views, the best first.

    views: (m, k) int32, -1 for none. areas: (m, k) how large each shows it (px2). colours:
    (m, k, 3) its mean colour there.
    """

    views: NDArray[np.int32]
    areas: Floats
    colours: Floats


def see(
    positions: NDArray[np.float64],
    triangles: NDArray[np.int64],
    views: Sequence[SurfaceView],
    parameters: TextureParameters,
    progress: Callable[[float], None] = lambda fraction: None,
) -> Sights:
    """Look at all triangles from all views, one photo in memory at a time."""
    count, kept = len(triangles), min(parameters.candidates, max(1, len(views)))
    found = Sights(
        np.full((count, kept), NO_VIEW, dtype=np.int32),
        np.zeros((count, kept), dtype=np.float32),
        np.zeros((count, kept, 3), dtype=np.float32),
    )
    middle = positions.mean(axis=0)
    scene = EmbreeScene(robust=True)
    TriangleMesh(scene, (positions - middle).astype(np.float32), triangles.astype(np.int32))
    for number, view in enumerate(views):
        progress(number / len(views))
        areas, places = _areas(positions, triangles, view, parameters)
        rows = np.flatnonzero(areas > 0.0)
        for part in np.array_split(rows, max(1, len(rows) // _AT_ONCE + 1)):
            free = _unhidden(scene, middle, positions[triangles[part]], view.camera, parameters)
            areas[part[~free]] = 0.0
        rows = np.flatnonzero(areas > 0.0)
        if len(rows):
            colours = _colours(view.read(), places[rows], areas[rows])
            _keep(found, rows, number, areas[rows].astype(np.float32), colours)
    return found


def _areas(
    positions: NDArray[np.float64],
    triangles: NDArray[np.int64],
    view: SurfaceView,
    parameters: TextureParameters,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """(m,) px2 of each triangle in the photo, 0 where it is outside, turned away or masked.

    And (m, 2) where its middle is.
    """
    camera, margin = view.camera, parameters.margin_px
    px, depth = camera.project(positions)
    inside = (depth > 0.0) & (px >= margin).all(axis=1)
    inside &= (px[:, 0] <= camera.width_px - margin) & (px[:, 1] <= camera.height_px - margin)
    corners = px[triangles]
    areas = np.zeros(len(triangles))
    rows = np.flatnonzero(inside[triangles].all(axis=1))
    a, b, c = corners[rows, 0], corners[rows, 1], corners[rows, 2]
    # Counter-clockwise seen from outside, with y down: a surface that faces the camera is negative.
    cross = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    areas[rows] = np.maximum(-0.5 * cross, 0.0)
    corners3 = positions[triangles[rows]]
    normal = np.cross(corners3[:, 1] - corners3[:, 0], corners3[:, 2] - corners3[:, 0])
    ray = camera.centre() - corners3.mean(axis=1)
    lengths = np.linalg.norm(normal, axis=1) * np.linalg.norm(ray, axis=1)
    cosine = (normal * ray).sum(axis=1) / np.maximum(lengths, 1e-300)
    areas[rows[cosine < parameters.steepest]] = 0.0
    places = corners.mean(axis=1)
    hidden = view.hidden()
    if hidden is not None:
        rows = np.flatnonzero(areas > 0.0)
        for spot in (places[rows], *(corners[rows, k] for k in range(3))):
            x = np.clip(spot[:, 0].astype(np.int64), 0, camera.width_px - 1)
            y = np.clip(spot[:, 1].astype(np.int64), 0, camera.height_px - 1)
            areas[rows[hidden[y, x]]] = 0.0
    return areas, places


def _unhidden(
    scene: EmbreeScene,
    middle: NDArray[np.float64],
    corners: NDArray[np.float64],
    camera: Camera,
    parameters: TextureParameters,
) -> NDArray[np.bool_]:
    """(k,) whether nothing stands before (k, 3, 3) triangles, seen from a camera."""
    eye = camera.centre()
    free = np.ones(len(corners), dtype=np.bool_)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    for weights in _INSET:
        target = np.einsum("c,kcd->kd", weights, corners)
        ray = target - eye
        distance = np.linalg.norm(ray, axis=1)
        start = np.broadcast_to((eye - middle).astype(np.float32), ray.shape)
        directions = (ray / np.maximum(distance, 1e-300)[:, None]).astype(np.float32)
        hit = scene.run(np.ascontiguousarray(start), directions, query="DISTANCE")
        free &= hit >= distance - parameters.hidden * distance - 0.25 * longest
    return free


def _colours(
    pixels: NDArray[np.uint8], places: NDArray[np.float64], areas: NDArray[np.float64]
) -> Floats:
    """(k, 3) mean colours about places: of the photo, made softer by the triangles' usual size."""
    sigma = float(np.clip(0.3 * np.sqrt(np.median(areas)), 0.8, 12.0))
    soft = np.asarray(cv2.GaussianBlur(pixels, (0, 0), sigma), dtype=np.uint8)
    return colours_at(soft, places)


def colours_at(pixels: NDArray[np.uint8], places: NDArray[np.float64]) -> Floats:
    """(k, 3) float32 colours of (h, w, 3) pixels at (k, 2) px, linear in between."""
    height, width = pixels.shape[:2]
    x = np.clip(places[:, 0] - 0.5, 0.0, width - 1.0)
    y = np.clip(places[:, 1] - 0.5, 0.0, height - 1.0)
    left, top = x.astype(np.int64), y.astype(np.int64)
    right, bottom = np.minimum(left + 1, width - 1), np.minimum(top + 1, height - 1)
    across, down = (x - left)[:, None], (y - top)[:, None]
    upper = pixels[top, left] * (1.0 - across) + pixels[top, right] * across
    lower = pixels[bottom, left] * (1.0 - across) + pixels[bottom, right] * across
    return np.asarray(upper * (1.0 - down) + lower * down, dtype=np.float32)


def _keep(found: Sights, rows: NDArray[np.intp], view: int, areas: Floats, colours: Floats) -> None:
    """A view takes its place among the best of each row, before all that show it smaller."""
    kept = found.views.shape[1]
    place = (found.areas[rows] >= areas[:, None]).sum(axis=1)
    for rank in range(kept - 1, -1, -1):
        later = rows[place < rank]
        if rank:
            for column in (found.views, found.areas, found.colours):
                column[later, rank] = column[later, rank - 1]
        own = place == rank
        found.views[rows[own], rank] = view
        found.areas[rows[own], rank] = areas[own]
        found.colours[rows[own], rank] = colours[own]
