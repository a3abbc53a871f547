"""Plain bodies as CityEngine brings them along (`builtin:cube`); what a missing asset leaves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.assets.asset import Asset, Slot

PREFIX = "builtin:"
_SIDES = 24
MISSING = Slot("missing", colour=(0.85, 0.15, 0.65))
"""The colour by which an asset that is not there is told from what was meant."""

Faces = list[list[int]]


def primitive(name: str) -> Asset | None:
    """The body of `builtin:cube`, `builtin:cylinder:notex` and the like; None for other names."""
    if not name.startswith(PREFIX):
        return None
    plain = name.removeprefix(PREFIX).split(":")[0].rsplit(".", 1)[0].lower()
    build = _BODIES.get(plain.rstrip("0123456789"))
    return None if build is None else _asset(name, *build(), Slot("surface"))


def missing_box(name: str) -> Asset:
    """The box that fills the scope of an asset that is not there, in a colour of its own; a panel
    where that is flat.
    """
    return replace(_asset(name, *_cube(), MISSING), panel=True)


def _asset(name: str, points: NDArray[np.float64], faces: Faces, slot: Slot) -> Asset:
    return Asset(
        name=name,
        points_m=points,
        corners=np.concatenate([np.array(face) for face in faces]).astype(np.uint32),
        offsets=np.concatenate([[0], np.cumsum([len(face) for face in faces])]).astype(np.int64),
        face_slot=np.zeros(len(faces), dtype=np.int32),
        slots=(slot,),
    )


def _cube() -> tuple[NDArray[np.float64], Faces]:
    points = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    return points, [
        [0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3],
    ]  # fmt: skip


def _quad() -> tuple[NDArray[np.float64], Faces]:
    return np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), [[0, 1, 2, 3]]


def _ring(radius: float, y: float) -> NDArray[np.float64]:
    """(n, 3) points about the middle of a unit box, counter-clockwise seen from above."""
    angle = 2.0 * np.pi * np.arange(_SIDES) / _SIDES
    return np.stack(
        [0.5 + radius * np.cos(angle), np.full(_SIDES, y), 0.5 - radius * np.sin(angle)], axis=1
    )


def _disk() -> tuple[NDArray[np.float64], Faces]:
    points = _ring(0.5, 0.0)
    flat = np.stack([points[:, 0], 1.0 - points[:, 2], np.zeros(_SIDES)], axis=1)
    return flat, [list(range(_SIDES))]


def _cylinder() -> tuple[NDArray[np.float64], Faces]:
    points = np.concatenate([_ring(0.5, 0.0), _ring(0.5, 1.0)])
    sides = [[k, (k + 1) % _SIDES, (k + 1) % _SIDES + _SIDES, k + _SIDES] for k in range(_SIDES)]
    ends = [list(range(_SIDES))[::-1], list(range(_SIDES, 2 * _SIDES))]
    return points, [*sides, *ends]


def _cone() -> tuple[NDArray[np.float64], Faces]:
    points = np.concatenate([_ring(0.5, 0.0), [[0.5, 1.0, 0.5]]])
    sides = [[k, (k + 1) % _SIDES, _SIDES] for k in range(_SIDES)]
    return points, [*sides, list(range(_SIDES))[::-1]]


def _sphere() -> tuple[NDArray[np.float64], Faces]:
    rings = _SIDES // 2
    angles = np.pi * np.arange(1, rings) / rings
    levels = [_ring(0.5 * np.sin(angle), 0.5 - 0.5 * np.cos(angle)) for angle in angles]
    points = np.concatenate([*levels, [[0.5, 0.0, 0.5], [0.5, 1.0, 0.5]]])
    low, high = len(points) - 2, len(points) - 1
    faces: Faces = []
    for k in range(_SIDES):
        after = (k + 1) % _SIDES
        faces.append([low, after, k])
        for level in range(rings - 2):
            under, over = level * _SIDES, (level + 1) * _SIDES
            faces.append([under + k, under + after, over + after, over + k])
        last = (rings - 2) * _SIDES
        faces.append([last + k, last + after, high])
    return points, faces


_BODIES = {
    "cube": _cube, "quad": _quad, "disk": _disk, "cylinder": _cylinder, "cone": _cone,
    "sphere": _sphere,
}  # fmt: skip
