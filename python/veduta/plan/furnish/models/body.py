"""The tools that objects are made with: boxes, cushions, turned legs, rods, drawn-out outlines.

Frame of an object: metres, x to the right as one looks at its front, y to its back, z up; the
origin is the middle of its base, its front looks to -y. The faces go into an asset, whose frame is
that of `grammar.assets` (y up, z to the front).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
from numpy.typing import ArrayLike, NDArray

from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.assets.modelling import Model

Points = NDArray[np.float64]
Span = tuple[float, float]
ASSET_FROM_OBJECT = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
_WARP_M = 1e-3
_BOX = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
_BOX_SIDES = ("bottom", "top", "front", "back", "left", "right")


class Body:
    """An object as it grows, of a width, depth and height (m).

    coarse: what is seen from afar: fewer sides, no small pieces.
    """

    def __init__(self, slots: Sequence[Slot], size_m: ArrayLike, *, coarse: bool = False) -> None:
        self._model = Model(*slots)
        self._names = {slot.name for slot in slots}
        self._turn, self._move = np.eye(3), np.zeros(3)
        self.width, self.depth, self.height = (float(side) for side in np.asarray(size_m))
        self.coarse = coarse

    @property
    def left(self) -> float:
        """The least x."""
        return -self.width / 2.0

    @property
    def right(self) -> float:
        """The largest x."""
        return self.width / 2.0

    @property
    def front(self) -> float:
        """The least y."""
        return -self.depth / 2.0

    @property
    def back(self) -> float:
        """The largest y."""
        return self.depth / 2.0

    @property
    def sides(self) -> int:
        """Of what is turned."""
        return 8 if self.coarse else 20

    @contextmanager
    def placed(
        self, at: Sequence[float] = (0.0, 0.0, 0.0), *, tilt: float = 0.0, turn: float = 0.0
    ) -> Iterator[None]:
        """Pieces are turned about z, then tilted about x (top to the back), then moved (rad, m)."""
        before = self._turn, self._move
        c, s = np.cos(turn), np.sin(turn)
        about_z = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        c, s = np.cos(-tilt), np.sin(-tilt)
        about_x = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        self._move = self._turn @ np.asarray(at, dtype=np.float64) + self._move
        self._turn = self._turn @ about_x @ about_z
        yield
        self._turn, self._move = before

    def solid(self, points: ArrayLike, faces: list[list[int]], slot: str) -> None:
        """A closed piece; its faces are turned to look outwards."""
        own = np.asarray(points, dtype=np.float64)
        kept = faces if _volume(own, faces) >= 0.0 else [face[::-1] for face in faces]
        placed = own @ self._turn.T + self._move
        self._model.add(placed @ ASSET_FROM_OBJECT.T, kept, slot)

    def box(self, x: Span, y: Span, z: Span, slot: str, *, without: str = "") -> None:
        """An upright box; `without` names sides that nobody sees (`back bottom`)."""
        points = [[x[k & 1], y[k >> 1 & 1], z[k >> 2]] for k in range(8)]
        hidden = set(without.split())
        faces = [face for face, side in zip(_BOX, _BOX_SIDES, strict=True) if side not in hidden]
        own = np.asarray(points) @ self._turn.T + self._move
        self._model.add(own @ ASSET_FROM_OBJECT.T, faces, slot)

    def rings(self, rings: Sequence[Points], slot: str) -> None:
        """A skin over closed rings of as many points each, with flat ends. rings: (n, 3) each."""
        n, count = len(rings[0]), len(rings)
        faces = [
            [i * n + j, i * n + (j + 1) % n, (i + 1) * n + (j + 1) % n, (i + 1) * n + j]
            for i in range(count - 1)
            for j in range(n)
        ]
        ends = [list(range(n))[::-1], list(range((count - 1) * n, count * n))]
        points = np.concatenate(rings)
        if _warp(points[np.array(faces)]) > _WARP_M:
            faces = [[face[k] for k in half] for face in faces for half in ((0, 1, 2), (0, 2, 3))]
        self.solid(points, [*faces, *ends], slot)

    def cushion(
        self, x: Span, y: Span, z: Span, slot: str, *, radius: float = 0.04, along: str = "z",
        crown: float = 0.0,
    ) -> None:  # fmt: skip
        """A box with round edges and corners; its flat ends look along an axis.

        crown: how far the end at the axis' upper side bulges beyond the box.
        """
        order = {"z": (0, 1, 2), "y": (0, 2, 1), "x": (1, 2, 0)}[along]
        spans = np.array([x, y, z], dtype=np.float64)[list(order)]
        middle, half = spans.mean(axis=1), np.ptp(spans, axis=1) / 2.0
        radius = float(min(radius, 0.98 * half.min()))
        steps = 2 if self.coarse else 4
        angle = np.radians(np.linspace(0.0, 72.0, steps))
        inset, rise = radius * (1.0 - np.cos(angle)), radius * np.sin(angle)
        levels = [(a, -half[2] + radius - b) for a, b in zip(inset, rise, strict=True)][::-1]
        levels += [(a, half[2] - radius + b) for a, b in zip(inset, rise, strict=True)]
        flat = [
            np.column_stack([rounded(half[:2] - a, radius - a, steps), np.full(4 * steps, b)])
            for a, b in levels
        ]
        flat[0][:, 2], flat[-1][:, 2] = -half[2], half[2]
        if crown > 0.0 and not self.coarse:
            for share, up in ((0.72, 0.65), (0.38, 1.0)):
                inner = flat[2 * steps - 1] * np.array([share, share, 1.0])
                inner[:, 2] = half[2] + up * crown
                flat.append(inner)
        shaped = []
        for ring in flat:
            moved = np.empty_like(ring)
            moved[:, list(order)] = ring + middle
            shaped.append(moved)
        self.rings(shaped, slot)

    def turned(
        self, profile: ArrayLike, slot: str, at: tuple[float, float] = (0.0, 0.0),
        *, stretch: tuple[float, float] = (1.0, 1.0), sides: int | None = None,
    ) -> None:  # fmt: skip
        """A body turned about an upright axis. profile: (k, 2), radius and height from below."""
        n = sides or self.sides
        angle = 2.0 * np.pi * (np.arange(n) + 0.5) / n
        circle = np.column_stack([np.cos(angle), np.sin(angle)]) * stretch
        self.rings(
            [
                np.column_stack([at + radius * circle, np.full(n, height)])
                for radius, height in np.asarray(profile, dtype=np.float64)
            ],
            slot,
        )

    def rod(self, start: ArrayLike, end: ArrayLike, radius: float | Span, slot: str) -> None:
        """A round bar between two points; two radii make it taper."""
        self.bent(np.array([start, end]), radius, slot)

    def bent(self, path: ArrayLike, radius: float | Span, slot: str) -> None:
        """A round bar along a line of points (n, 3)."""
        track = np.asarray(path, dtype=np.float64)
        first, last = (radius, radius) if isinstance(radius, int | float) else radius
        radii = np.linspace(first, last, len(track))
        n = 5 if self.coarse else 10
        angle = 2.0 * np.pi * np.arange(n) / n
        along = np.gradient(track, axis=0)
        along /= np.linalg.norm(along, axis=1, keepdims=True)
        side = np.cross(along[0], [0.0, 0.0, 1.0] if abs(along[0, 2]) < 0.9 else [1.0, 0.0, 0.0])
        rings = []
        for point, way, size in zip(track, along, radii, strict=True):
            side = side - way * (side @ way)
            side /= np.linalg.norm(side)
            other = np.cross(way, side)
            ring = np.outer(np.cos(angle), side) + np.outer(np.sin(angle), other)
            rings.append(point + size * ring)
        self.rings(rings, slot)

    def drawn(self, outline: ArrayLike, span: Span, slot: str, *, axis: str = "z") -> None:
        """An outline drawn out along an axis: in x, y for z; in x, z for y; in y, z for x."""
        flat = np.asarray(outline, dtype=np.float64)
        rest = {"z": (0, 1, 2), "y": (0, 2, 1), "x": (1, 2, 0)}[axis]
        rings = []
        for end in span:
            ring = np.empty((len(flat), 3))
            ring[:, rest[0]], ring[:, rest[1]], ring[:, rest[2]] = flat[:, 0], flat[:, 1], end
            rings.append(ring)
        self.rings(rings, slot)

    def board(self, x: Span, y: Span, z: Span, slot: str, *, edge: float = 0.004) -> None:
        """A board whose edges catch the light: slightly bevelled, plain where coarse."""
        if self.coarse:
            self.box(x, y, z, slot)
            return
        edge = min(edge, 0.3 * min(abs(x[1] - x[0]), abs(y[1] - y[0]), abs(z[1] - z[0])))
        rings = []
        for inset, height in ((edge, z[0]), (0.0, z[0] + edge), (0.0, z[1] - edge), (edge, z[1])):
            corners = [
                (x[0] + inset, y[0] + inset), (x[1] - inset, y[0] + inset),
                (x[1] - inset, y[1] - inset), (x[0] + inset, y[1] - inset),
            ]  # fmt: skip
            rings.append(np.column_stack([corners, np.full(4, height)]))
        self.rings(rings, slot)

    def asset(self, name: str) -> Asset:
        """All that was added."""
        return self._model.asset(name)


def _volume(points: Points, faces: list[list[int]]) -> float:
    """Six times the volume within closed faces."""
    fans = [(f[0], f[k], f[k + 1]) for f in faces for k in range(1, len(f) - 1)]
    a, b, c = (points - points.mean(axis=0))[np.array(fans)].transpose(1, 0, 2)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum())


def _warp(quads: NDArray[np.float64]) -> float:
    """How far the last corners of (n, 4, 3) quads are from the planes of the others, at most."""
    sides = quads[:, 1:] - quads[:, :1]
    normal = np.cross(sides[:, 0], sides[:, 1])
    length = np.maximum(np.linalg.norm(normal, axis=1), 1e-12)
    return float(np.abs(np.einsum("ij,ij->i", normal, sides[:, 2]) / length).max())


def rounded(half: Points, radius: float, steps: int) -> Points:
    """(4 steps, 2) a rectangle with round corners about the origin, counter-clockwise."""
    points = []
    for corner, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        angle = np.radians(90.0 * corner + np.linspace(0.0, 90.0, steps))
        centre = (half - radius) * (sx, sy)
        points.append(centre + radius * np.column_stack([np.cos(angle), np.sin(angle)]))
    return np.concatenate(points)


def oval(width: float, depth: float, sides: int) -> Points:
    """(sides, 2) an ellipse about the origin, counter-clockwise."""
    angle = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
    return np.column_stack([width / 2.0 * np.cos(angle), depth / 2.0 * np.sin(angle)])
