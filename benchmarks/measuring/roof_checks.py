"""Roofs over real outlines, checked without the code that made them.

The solids are judged by trimesh (closed, wound alike, volume), by manifold3d where it is installed,
and by counting how often each of some random places is covered from above and from below.
"""

from __future__ import annotations

import importlib.util
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray

from veduta import _core

FOOTPRINTS = Path("footprints") / "hard-footprints.geojson"
PLACES = 60
SLOPE = 0.9
AREA = 1e-6
TYPES = tuple(_core.roof_types())


@dataclass(frozen=True)
class Outline:
    """A polygon with holes: points (n, 2) in metres, the first point of each ring with the end."""

    name: str
    points_m: NDArray[np.float64]
    ring_offsets: NDArray[np.int64]

    @property
    def area_m2(self) -> float:
        """Without the holes; these run the other way round."""
        total = 0.0
        for first, end in zip(self.ring_offsets, self.ring_offsets[1:], strict=False):
            x, y = (self.points_m[first:end] - self.points_m[0]).T
            total += 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
        return total


def outline(name: str, rings: list[Any]) -> Outline:
    """Of rings without their closing points."""
    points = [np.asarray(ring, dtype=np.float64) for ring in rings]
    offsets = np.cumsum([0, *(len(ring) for ring in points)])
    return Outline(name, np.concatenate(points), offsets.astype(np.int64))


def read_outlines(path: Path) -> list[Outline]:
    """All polygons of a GeoJSON file in metres."""
    features = json.loads(path.read_text())["features"]
    return [
        outline(
            feature["properties"]["name"].removeprefix("test_"),
            [ring[1:] for ring in feature["geometry"]["coordinates"]],
        )
        for feature in features
    ]


def solid(
    kind: str, over: Outline, slope: float = SLOPE, numbers: dict[str, float] | None = None
) -> trimesh.Trimesh:
    """The roof as triangles over shared points; raises `_core.RoofFault` where there is none."""
    points, rings, faces, corners = _core.roof_solid(
        kind, over.points_m, over.ring_offsets, slope, numbers=numbers
    )
    found = _core.triangulate_polygons(points[corners], rings, faces, 1e-6)
    return trimesh.Trimesh(points, corners[found[0]], process=False)


def faults(made: trimesh.Trimesh, over: Outline, rng: np.random.Generator) -> list[str]:
    """What is wrong with a roof without an overhang; nothing, it is to be hoped."""
    found = []
    if not made.is_watertight:
        found.append("not closed")
    if not made.is_winding_consistent:
        found.append("faces are wound differently")
    if made.body_count != 1:
        found.append(f"{made.body_count} bodies")
    if not made.volume > 0:
        found.append(f"a volume of {made.volume} m3")
    edges = np.sort(made.edges, axis=1)
    counts = np.unique(edges, axis=0, return_counts=True)[1]
    if (counts != 2).any():
        found.append("an edge without exactly two faces")
    flat = made.vertices[made.faces][:, :, :2]
    a, b = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    seen = 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    steep = np.abs(made.face_normals[:, 2]) < 1e-7
    up = float(seen[(seen > 0) & ~steep].sum())
    if abs(up / over.area_m2 - 1) > AREA:
        found.append(f"{up} m2 look up from {over.area_m2} m2")
    low, high = over.points_m.min(axis=0), over.points_m.max(axis=0)
    places = rng.uniform(low, high, (PLACES, 2))
    above, below = (
        _covers(flat[(seen > 0) & ~steep], places),
        _covers(flat[(seen < 0) & ~steep], places),
    )
    inside = _inside(over, places)
    if (above != inside).any() or (below != inside).any():
        found.append("a place is not covered once from above and once from below")
    found += _judged_by_manifold(made)
    return found


def _covers(triangles: NDArray[np.float64], places: NDArray[np.float64]) -> NDArray[np.int64]:
    """How many triangles (m, 3, 2) each place (k, 2) lies in."""
    side = []
    for corner in range(3):
        start, end = triangles[:, corner], triangles[:, (corner + 1) % 3]
        along, to = end - start, places[:, None] - start
        side.append(along[:, 0] * to[..., 1] - along[:, 1] * to[..., 0])
    signs = np.sign(np.stack(side))
    counts: NDArray[np.int64] = ((signs == signs[0]).all(axis=0) & (signs[0] != 0)).sum(axis=1)
    return counts


def _inside(over: Outline, places: NDArray[np.float64]) -> NDArray[np.int64]:
    """1 for places in the outline and in no hole, else 0: crossings of a ray are odd."""
    odd = np.zeros(len(places), dtype=np.int64)
    x, y = places.T
    for first, end in zip(over.ring_offsets, over.ring_offsets[1:], strict=False):
        ring = over.points_m[first:end]
        for (x0, y0), (x1, y1) in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            if y0 != y1:
                crosses = ((y0 > y) != (y1 > y)) & (x < x0 + (y - y0) / (y1 - y0) * (x1 - x0))
                odd ^= crosses
    return odd


def _judged_by_manifold(made: trimesh.Trimesh) -> list[str]:
    if importlib.util.find_spec("manifold3d") is None:
        return []
    manifold3d: Any = importlib.import_module("manifold3d")
    mesh = manifold3d.Mesh64(
        vert_properties=np.asarray(made.vertices, dtype=np.float64),
        tri_verts=np.asarray(made.faces, dtype=np.uint64),
    )
    whole = manifold3d.Manifold(mesh)
    if whole.status() != manifold3d.Error.NoError:
        return [f"manifold3d: {whole.status()}"]
    if abs(whole.volume() / made.volume - 1) > 1e-6:
        return [f"manifold3d finds {whole.volume()} m3, not {made.volume}"]
    return []
