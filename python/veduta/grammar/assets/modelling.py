"""The tools that assets are made with: boxes, prisms, sweeps of profiles, lathes.

Each tool adds closed pieces whose faces look outwards; pieces may touch and stand in each other.
Faces that nobody can see (a back against the wall) may be left open.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from veduta.grammar.assets.asset import Asset, Slot

Points = NDArray[np.float64]
Faces = list[list[int]]
SIDES = {"left": 0, "right": 1, "bottom": 2, "top": 3, "back": 4, "front": 5}
_BOX: Faces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]


class Model:
    """Grows the faces of an asset."""

    def __init__(self, *slots: Slot) -> None:
        self._slots = slots
        self._number = {slot.name: number for number, slot in enumerate(slots)}
        self._points: list[Points] = []
        self._faces: list[Faces] = []
        self._face_slot: list[int] = []
        self._count = 0

    def add(self, points: ArrayLike, faces: Faces, slot: str) -> None:
        """Faces over points of their own."""
        own = np.asarray(points, dtype=np.float64)
        self._points.append(own)
        self._faces.append([[corner + self._count for corner in face] for face in faces])
        self._face_slot += [self._number[slot]] * len(faces)
        self._count += len(own)

    def solid(self, points: ArrayLike, faces: Faces, slot: str, hidden: Iterable[int] = ()) -> None:
        """A closed piece, turned inside out where its volume is negative; without some faces."""
        own = np.asarray(points, dtype=np.float64)
        kept = [face for number, face in enumerate(faces) if number not in set(hidden)]
        if _volume(own, faces) < 0.0:
            kept = [face[::-1] for face in kept]
        self.add(own, kept, slot)

    def box(
        self, low: Sequence[float], high: Sequence[float], slot: str, *, without: str = ""
    ) -> None:
        """An upright box; `without` names faces that nobody sees (`back left`)."""
        ends = np.array([low, high], dtype=np.float64)
        points = [[ends[k & 1, 0], ends[k >> 1 & 1, 1], ends[k >> 2, 2]] for k in range(8)]
        self.solid(points, _BOX, slot, [SIDES[name] for name in without.split()])

    def pane(self, x: tuple[float, float], y: tuple[float, float], z: float, slot: str) -> None:
        """A rectangle that looks towards the viewer."""
        self.sheet([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])], z, slot)

    def sheet(self, outline: ArrayLike, z: float, slot: str) -> None:
        """A flat face with an outline in x and y, counter-clockwise, that looks to the viewer."""
        flat = np.asarray(outline, dtype=np.float64)
        self.add(_at(flat, z), [list(range(len(flat)))], slot)

    def facet(self, corners: ArrayLike, slot: str) -> None:
        """One flat face whose edges stay sharp, however little it turns from the next."""
        self.add(corners, [list(range(len(np.asarray(corners))))], slot)

    def prism(
        self,
        outline: ArrayLike,
        ends: tuple[float, float],
        slot: str,
        *,
        axis: str = "z",
        caps: str = "both",
    ) -> None:
        """An outline drawn out along an axis.

        The outline is in x and y for the axis z, in z and y for x, in x and z for y. `caps`: both,
        low, high or none are closed.
        """
        flat = np.asarray(outline, dtype=np.float64)
        n = len(flat)
        planes = [_across(flat, end, axis) for end in ends]
        sides = [[k, (k + 1) % n, n + (k + 1) % n, n + k] for k in range(n)]
        faces = [*sides, list(range(n))[::-1], list(range(n, 2 * n))]
        hidden = {"both": [], "low": [n + 1], "high": [n], "none": [n, n + 1]}[caps]
        self.solid(np.concatenate(planes), faces, slot, hidden)

    def sweep(
        self,
        profile: ArrayLike,
        path: ArrayLike,
        slot: str,
        *,
        closed: bool = False,
        z: float = 0.0,
    ) -> None:
        """A closed profile along a path in x and y, with mitred corners.

        profile: (k, 2), how far to the left of the path, and z. path: (n, 2).
        """
        section = np.asarray(profile, dtype=np.float64)
        track = np.asarray(path, dtype=np.float64)
        left = _mitres(track, closed=closed)
        rings = [
            np.column_stack([point + out * section[:, :1], section[:, 1] + z])
            for point, out in zip(track, left, strict=True)
        ]
        k, n = len(section), len(track)
        spans = n if closed else n - 1
        faces = [
            [i * k + j, i * k + (j + 1) % k, (i + 1) % n * k + (j + 1) % k, (i + 1) % n * k + j]
            for i in range(spans)
            for j in range(k)
        ]
        if not closed:
            faces += [list(range(k))[::-1], list(range((n - 1) * k, n * k))]
        self.solid(np.concatenate(rings), faces, slot)

    def lathe(
        self, profile: ArrayLike, centre: tuple[float, float], slot: str, *, sides: int
    ) -> None:
        """A body turned about an upright axis. profile: (k, 2) radius and height from below."""
        outline = np.asarray(profile, dtype=np.float64)
        turn = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
        rings = [
            np.column_stack(
                [
                    centre[0] + radius * np.sin(turn),
                    np.full(sides, height),
                    centre[1] + radius * np.cos(turn),
                ]
            )
            for radius, height in outline
        ]
        k = len(outline)
        faces = [
            [
                i * sides + j,
                i * sides + (j + 1) % sides,
                (i + 1) * sides + (j + 1) % sides,
                (i + 1) * sides + j,
            ]
            for i in range(k - 1)
            for j in range(sides)
        ]
        caps = [list(range(sides))[::-1], list(range((k - 1) * sides, k * sides))]
        self.solid(np.concatenate(rings), faces + caps, slot)

    def tube(
        self, path: ArrayLike, radius: float, slot: str, *, sides: int, z: float = 0.0
    ) -> None:
        """A bar of round section along a path in x and y."""
        turn = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
        self.sweep(radius * np.column_stack([np.cos(turn), np.sin(turn)]), path, slot, z=z)

    def insert(self, other: Model, at: Sequence[float]) -> None:
        """All of another model, moved; its slots must be known here by the same names."""
        before = 0
        slots = iter(other._face_slot)
        for points, faces in zip(other._points, other._faces, strict=True):
            for face in faces:
                number = next(slots)
                corners = [corner - before for corner in face]
                own = points[corners] + np.asarray(at, dtype=np.float64)
                self.add(own, [list(range(len(own)))], other._slots[number].name)
            before += len(points)

    def asset(self, name: str) -> Asset:
        """All that was added."""
        faces = [face for piece in self._faces for face in piece]
        sizes = [len(face) for face in faces]
        return Asset(
            name=name,
            points_m=np.concatenate(self._points),
            corners=np.array([corner for face in faces for corner in face], dtype=np.uint32),
            offsets=np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
            face_slot=np.array(self._face_slot, dtype=np.int32),
            slots=self._slots,
        )


def arc(
    centre: tuple[float, float], radius: float, start_deg: float, end_deg: float, steps: int
) -> Points:
    """(steps + 1, 2) points on a circle."""
    turn = np.radians(np.linspace(start_deg, end_deg, steps + 1))
    return np.column_stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)])


def rectangle(low: tuple[float, float], high: tuple[float, float]) -> Points:
    """(4, 2) the corners, counter-clockwise from the lower left."""
    return np.array([low, (high[0], low[1]), high, (low[0], high[1])], dtype=np.float64)


def spiral(
    centre: tuple[float, float],
    radii: tuple[float, float],
    angles_deg: tuple[float, float],
    steps: int,
) -> Points:
    """(steps + 1, 2) points on a spiral whose radius changes evenly with the angle."""
    turn = np.radians(np.linspace(*angles_deg, steps + 1))
    radius = np.linspace(*radii, steps + 1)
    return np.column_stack([centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)])


def _at(flat: Points, z: float) -> Points:
    return np.column_stack([flat, np.full(len(flat), z)])


def _across(flat: Points, end: float, axis: str) -> Points:
    level = np.full(len(flat), end)
    columns = {
        "x": [level, flat[:, 1], flat[:, 0]],
        "y": [flat[:, 0], level, flat[:, 1]],
        "z": [flat[:, 0], flat[:, 1], level],
    }[axis]
    return np.column_stack(columns)


def _mitres(track: Points, *, closed: bool) -> Points:
    """(n, 2) for each point of a path, how a step to the left of it moves it."""
    along = np.roll(track, -1, axis=0) - track
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    before = np.roll(along, 1, axis=0)
    if not closed:
        before[0], along[-1] = along[0], along[-2]
    left = np.column_stack([-along[:, 1] - before[:, 1], along[:, 0] + before[:, 0]]) / 2.0
    cosine_squared = np.maximum((left**2).sum(axis=1, keepdims=True), 0.1)
    result: Points = left / cosine_squared
    return result


def _volume(points: Points, faces: Faces) -> float:
    """Six times the volume within closed faces."""
    fans = [(face[0], *pair) for face in faces for pair in zip(face[1:-1], face[2:], strict=True)]
    a, b, c = np.moveaxis((points - points.mean(axis=0))[fans], 1, 0)
    one, other = b - a, c - a
    crossed = one[:, [1, 2, 0]] * other[:, [2, 0, 1]] - one[:, [2, 0, 1]] * other[:, [1, 2, 0]]
    return float((a * crossed).sum())
