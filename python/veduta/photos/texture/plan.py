"""Which faces of the model views may show, and in which lots they are worked on.

A city has many buildings, and photos show few of them: what rays through their pixels meet first is
all that can be seen. The rest of the model is only met as what stands in the way.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from veduta.photos.city.model import CityModel
from veduta.photos.texture.cells import LEAST_DENSITY_PX_M2, MOST_VIEWS, SAMPLES, grid_of
from veduta.photos.texture.faces import Face, faces_of
from veduta.photos.texture.store import PictureStore
from veduta.photos.texture.views import Blockers, View, plane_view
from veduta.run.progress import StepProgress, no_progress

LOT_BYTES = 256 * 1024**2
"""Of what views show of the faces of a lot by cells, at most; but a lot has at least one face."""
_CELL_BYTES = SAMPLES * SAMPLES * 4 + 8
_LEVELS = 16
"""Halvings of the model's extent in the order in which buildings are worked on."""


@dataclass(frozen=True)
class Plan:
    """faces: of the buildings that views may show, neighbours beside each other, building by
    building. views: of each face, the rows (n,) of the views that may show it.
    """

    faces: tuple[Face, ...]
    views: tuple[NDArray[np.int64], ...]


def plan_of(
    views: Sequence[View],
    city: CityModel,
    blockers: Blockers,
    store: PictureStore,
    progress: StepProgress = no_progress,
) -> Plan:
    """What the views may show of the model, by the rays that `blockers` casts for each."""
    met = []
    for row in range(len(views)):
        progress("texture: what stands where", row / len(views))
        met.append(store.nearness(row).triangles)
    every = np.unique(np.concatenate([np.zeros(0, np.int64), *met]))
    buildings = np.unique(np.searchsorted(blockers.first, every, side="right") - 1)
    faces = faces_of(city, _beside_each_other(city, buildings))
    face_of = _faces_of_triangles(city, blockers, faces)
    shown_in: list[list[int]] = [[] for _ in faces]
    for row, triangles in enumerate(met):
        for number in np.unique(face_of[triangles]).tolist():
            if number >= 0 and _is_worth_it(views[row], faces[number]):
                shown_in[number].append(row)
    return Plan(tuple(faces), tuple(np.array(rows, dtype=np.int64) for rows in shown_in))


def lots_of(plan: Plan) -> list[range]:
    """Faces (rows) that are worked on together, in their order."""
    lots, first, bytes_ = [], 0, 0
    for row, face in enumerate(plan.faces):
        grid = grid_of(face)
        views = min(len(plan.views[row]), 3 * MOST_VIEWS)
        own = grid.rows * grid.columns * views * _CELL_BYTES
        if row > first and bytes_ + own > LOT_BYTES:
            lots.append(range(first, row))
            first, bytes_ = row, 0
        bytes_ += own
    return [*lots, range(first, len(plan.faces))]


def _beside_each_other(city: CityModel, buildings: NDArray[np.int64]) -> list[int]:
    """Buildings along a Z-order curve: photos that show one are likely to show the next."""
    places = np.array([city.buildings[row].offset_m[:2] for row in buildings.tolist()])
    if not len(places):
        return []
    low, size = places.min(axis=0), max(float(np.ptp(places, axis=0).max()), 1e-9)
    steps = ((places - low) / size * ((1 << _LEVELS) - 1)).astype(np.int64)
    code = np.zeros(len(steps), dtype=np.int64)
    for bit in range(_LEVELS):
        code |= ((steps[:, 0] >> bit) & 1) << (2 * bit)
        code |= ((steps[:, 1] >> bit) & 1) << (2 * bit + 1)
    found: list[int] = buildings[np.argsort(code, kind="stable")].tolist()
    return found


def _faces_of_triangles(
    city: CityModel, blockers: Blockers, faces: Sequence[Face]
) -> NDArray[np.int64]:
    """(t,) the face (row) of each triangle of the model, -1 where it belongs to none of them."""
    found = np.full(int(blockers.first[-1]), -1, dtype=np.int64)
    for building, own in groupby(enumerate(faces), key=lambda one: one[1].building):
        part = city.buildings[building].part
        face_of = np.full(len(part.polygon_feature), -1, dtype=np.int64)
        for number, face in own:
            face_of[face.polygons] = number
        first, end = blockers.first[building : building + 2]
        found[first:end] = face_of[part.triangles.polygon]
    return found


def _is_worth_it(view: View, face: Face) -> bool:
    """Whether the view's pixels are fine enough anywhere on the face."""
    plane = plane_view(view, face)
    if plane is None:
        return False
    width, height = face.size_m
    corners = np.array([[0, 0, 1], [width, 0, 1], [width, height, 1], [0, height, 1.0]])
    nearest = max(float((corners @ plane.matrix[2]).min()), 1e-2)
    return bool(abs(np.linalg.det(plane.matrix)) / nearest**3 >= LEAST_DENSITY_PX_M2)
