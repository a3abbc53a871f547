"""The mesh of an animal without limbs: elliptic slices along its axis, joined to one smooth skin."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.build.coat import painted_coat
from veduta.fauna.build.skeleton import axis_height_m, skin_of, spine_of
from veduta.fauna.document.schema import Animal
from veduta.fauna.motion.angles import Floats
from veduta.place.features import feature_table
from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.semantics import Provenance, SemanticClass
from veduta.place.skin import Clip

_SLICES = 120
_AROUND = 28
"""Vertices around a slice; the first stands again at the end, for the texture's seam."""
_ROUND = 1.2
"""The head is rounded over so many times its half width."""


def slices_along(animal: Animal) -> tuple[Floats, Floats, Floats]:
    """Places (m,), half widths and half heights (m,) in metres, close together at both ends.

    Head and tail end in a point: the head's slices shrink as those of an ellipsoid.
    """
    length = animal.length.metres
    pieces = animal.body.slices
    at, wide, high = (
        np.array([getattr(piece, name) for piece in pieces])
        for name in ("at", "half_width", "half_height")
    )
    even = np.linspace(0.0, 1.0, _SLICES)
    ends = 0.5 - 0.5 * np.cos(np.pi * even)
    places = 0.35 * even + 0.65 * (0.4 * even + 0.6 * ends)
    front = float(np.interp(0.02, at, wide)) * _ROUND
    tip = front * (1.0 - np.cos(np.linspace(0.0, 0.5 * np.pi, 8)))
    places = np.unique(np.concatenate([tip, places[places > front], [1.0]]))
    inside = np.clip(1.0 - places / front, 0.0, 1.0)
    rounding = np.sqrt(np.clip(1.0 - inside**2, 0.0, 1.0))
    return places, *(np.interp(places, at, half) * rounding * length for half in (wide, high))


def body_mesh(animal: Animal, clips: tuple[Clip, ...], coat: Texture | None = None) -> Mesh:
    """The skinned mesh with its texture (None: a painted one) and clips.

    The frame is that of `build.skeleton`. UV: u along the body from the head, v around it from the
    belly over its left, the back (0.5) and its right.
    """
    places, wide, high = slices_along(animal)
    turn = 2.0 * np.pi * np.arange(_AROUND + 1) / _AROUND
    along = (0.5 - places) * animal.length.metres
    middle = axis_height_m(animal, places)
    shape = (len(places), _AROUND + 1)
    positions = np.empty((*shape, 3))
    positions[..., 0] = along[:, None]
    positions[..., 1] = wide[:, None] * np.sin(turn)
    positions[..., 2] = middle[:, None] - high[:, None] * np.cos(turn)
    uv = np.empty((*shape, 2))
    uv[..., 0], uv[..., 1] = places[:, None], turn / (2.0 * np.pi)
    triangles = _between(*shape)
    flat = positions.reshape(-1, 3)
    spine = spine_of(animal)
    is_measured = "measured" in (animal.body.widths, animal.body.heights)
    provenance = Provenance.MEASURED if is_measured else Provenance.INVENTED
    name = animal.name
    return Mesh(
        id=name,
        positions_m=flat.astype(np.float32),
        triangles=triangles,
        features=feature_table(name, [(SemanticClass.OTHER, provenance, "body")]),
        materials=(Material("coat", roughness=0.55, texture=coat or painted_coat(animal.kind)),),
        triangle_feature=np.zeros(len(triangles), dtype=np.int32),
        triangle_material=np.zeros(len(triangles), dtype=np.int32),
        normals=_normals(positions).reshape(-1, 3).astype(np.float32),
        uv=uv.reshape(-1, 2).astype(np.float32),
        skin=skin_of(spine, np.repeat(places, _AROUND + 1)),
        clips=clips,
        notes=tuple(animal.doubts),
    )


def _between(rows: int, columns: int) -> NDArray[np.uint32]:
    """(m, 3) two triangles for each cell of a grid of vertices, counter-clockwise from outside."""
    row, column = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    corner = (row * columns + column).reshape(-1)
    first = np.stack([corner, corner + columns, corner + 1], axis=1)
    second = np.stack([corner + 1, corner + columns, corner + columns + 1], axis=1)
    every = np.stack([first, second], axis=1).reshape(-1, 3)
    # At the tip of the head a row is one point: its cells are triangles.
    at_tip = (every < columns).sum(axis=1) == 2
    return np.ascontiguousarray(every[~at_tip], dtype=np.uint32)


def _normals(positions: Floats) -> Floats:
    """(r, c, 3) unit normals of the grid, the same on both sides of the seam."""
    around = np.roll(positions[:, :-1], -1, axis=1) - np.roll(positions[:, :-1], 1, axis=1)
    around = np.concatenate([around, around[:, :1]], axis=1)
    along = np.gradient(positions, axis=0)
    across = np.cross(along, around)
    across[0] = (1.0, 0.0, 0.0)
    size = np.linalg.norm(across, axis=-1, keepdims=True)
    fallback = np.array([-1.0, 0.0, 0.0])
    return np.where(size > 1e-15, across / np.maximum(size, 1e-15), fallback)
