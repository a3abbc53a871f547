"""The facades of a city model as columns: upright rectangles that walls can be matched with."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from veduta.photos.city.model import CityBuilding, CityModel
from veduta.place.semantics import SemanticClass

GAP_M = 0.1
"""Pieces of one plane of a building that lie nearer together are one facade."""
SHORTEST_M = 0.5
UPRIGHT = 0.2
"""z of a wall's unit normal, beyond which it is no facade."""
ROOF = 0.3
"""z of the unit normal of a roof, at least."""
STEP_M = 1.0
"""Between samples of the facades along the ground."""
_HIDDEN_M, _HIDDEN_SHARE = 0.4, 0.9
"""Party walls: the wall of another building so near behind the back, over this share."""


@dataclass(frozen=True)
class Facades:
    """f facades about the origin of their model (m).

    names: the building and its surface. building: (f,) row in the model. start, end: (f, 2), seen
    from outside `start` is at the left. bottom, top: (f,). hidden: (f,) another building stands
    against it. roofs: (t, 3, 3) triangles of what looks up, of all buildings; None: not known.
    """

    names: tuple[str, ...]
    building: NDArray[np.int64]
    start: NDArray[np.float64]
    end: NDArray[np.float64]
    bottom: NDArray[np.float64]
    top: NDArray[np.float64]
    hidden: NDArray[np.bool_]
    roofs: NDArray[np.float64] | None = None

    def __len__(self) -> int:
        return len(self.names)

    @cached_property
    def middle(self) -> NDArray[np.float64]:
        """(f, 2)."""
        return (self.start + self.end) / 2.0

    @cached_property
    def width(self) -> NDArray[np.float64]:
        """(f,)."""
        found: NDArray[np.float64] = np.linalg.norm(self.end - self.start, axis=1)
        return found

    @cached_property
    def along(self) -> NDArray[np.float64]:
        """(f, 2) unit, from start to end."""
        return (self.end - self.start) / self.width[:, None]

    @cached_property
    def outward(self) -> NDArray[np.float64]:
        """(f, 2) unit normals."""
        along = self.along
        return np.column_stack([along[:, 1], -along[:, 0]])

    def samples(self, step_m: float = STEP_M) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """(n, 2) places along all facades, at most a step apart, and the facade of each."""
        counts = np.maximum(1, np.ceil(self.width / step_m)).astype(np.int64)
        row = np.repeat(np.arange(len(self)), counts)
        first = np.repeat(np.cumsum(counts) - counts, counts)
        share = (np.arange(len(row)) - first + 0.5) / counts[row]
        return self.start[row] + share[:, None] * (self.end - self.start)[row], row


def facades_of(model: CityModel) -> Facades:
    """All facades of a model."""
    found = [
        (f"{building.id}: {name}", row, start, end, bottom, top)
        for row, building in enumerate(model.buildings)
        for name, start, end, bottom, top in _of_building(building)
    ]
    names = tuple(one[0] for one in found)
    facades = Facades(
        names,
        np.array([one[1] for one in found], dtype=np.int64),
        np.array([one[2] for one in found]).reshape(-1, 2),
        np.array([one[3] for one in found]).reshape(-1, 2),
        np.array([one[4] for one in found], dtype=np.float64),
        np.array([one[5] for one in found], dtype=np.float64),
        np.zeros(len(found), dtype=bool),
    )
    if not found:
        return facades
    hidden = _hidden(facades)
    return Facades(
        names,
        facades.building,
        facades.start,
        facades.end,
        facades.bottom,
        facades.top,
        hidden,
        np.concatenate([_roofs(building) for building in model.buildings]),
    )


def _roofs(building: CityBuilding) -> NDArray[np.float64]:
    """(t, 3, 3) the triangles that look up."""
    part = building.part
    triangles = part.triangles
    up = triangles.polygon_normal[triangles.polygon][:, 2] > ROOF
    corners = part.positions_m.astype(np.float64)[triangles.indices[up]]
    found: NDArray[np.float64] = corners + building.offset_m
    return found


_Piece = tuple[str, NDArray[np.float64], NDArray[np.float64], float, float]


def _of_building(building: CityBuilding) -> Iterator[_Piece]:
    """Name, start, end, bottom and top of each facade of a building."""
    part = building.part
    first = part.ring_offsets[part.polygon_offsets[:-1]]
    after = part.ring_offsets[part.polygon_offsets[:-1] + 1]
    points = part.positions_m.astype(np.float64) + building.offset_m
    wall = part.features.class_code == SemanticClass.WALL.code
    normals = part.triangles.polygon_normal
    areas = part.triangles.polygon_area_m2
    for feature in np.flatnonzero(wall).tolist():
        polygons = np.flatnonzero(part.polygon_feature == feature)
        if len(polygons) == 0:
            continue
        normal = (areas[polygons, None] * normals[polygons]).sum(axis=0)
        normal /= max(float(np.linalg.norm(normal)), 1e-12)
        if abs(normal[2]) > UPRIGHT or not normal.any():
            continue
        outward = normal[:2] / np.linalg.norm(normal[:2])
        along = np.array([-outward[1], outward[0]])
        spans = []
        offsets = []
        for polygon in polygons.tolist():
            ring = points[first[polygon] : after[polygon]]
            places = ring[:, :2] @ along
            spans.append((places.min(), places.max(), ring[:, 2].min(), ring[:, 2].max()))
            offsets.append(float((ring[:, :2] @ outward).mean()))
        offset = float(np.mean(offsets))
        name = part.features.name[feature]
        for low, high, bottom, top in _joined(np.array(spans)):
            if high - low >= SHORTEST_M and top - bottom >= SHORTEST_M:
                base = offset * outward
                yield name, base + low * along, base + high * along, bottom, top


def _joined(spans: NDArray[np.float64]) -> Iterator[tuple[float, float, float, float]]:
    """Spans (low, high, bottom, top) that touch, as one."""
    rows = spans[np.argsort(spans[:, 0], kind="stable")].tolist()
    low, high, bottom, top = rows[0]
    for row in rows[1:]:
        if row[0] <= high + GAP_M:
            high, bottom, top = max(high, row[1]), min(bottom, row[2]), max(top, row[3])
        else:
            yield low, high, bottom, top
            low, high, bottom, top = row
    yield low, high, bottom, top


def _hidden(facades: Facades) -> NDArray[np.bool_]:
    """Which facades have the back of another building's against them, nearly all along."""
    places, row = facades.samples(0.5)
    tree = KDTree(np.column_stack([places, -3.0 * facades.outward[row]]))
    asked = np.column_stack([places, 3.0 * facades.outward[row]])
    near = KDTree(asked).query_ball_tree(tree, _HIDDEN_M)
    counts = np.array([len(one) for one in near])
    asking = np.repeat(np.arange(len(places)), counts)
    answers = np.array([one for found in near for one in found], dtype=np.int64)
    other, own = row[answers], row[asking]
    covers = (facades.building[other] != facades.building[own]) & (
        facades.top[other] > facades.top[own] - 1.5
    )
    covered = np.zeros(len(places), dtype=bool)
    covered[asking[covers]] = True
    share = np.bincount(row, weights=covered, minlength=len(facades)) / np.bincount(
        row, minlength=len(facades)
    )
    return share >= _HIDDEN_SHARE
