"""An asset: ready-made geometry that `i` puts into shapes.

Frame of assets: metres, right-handed, x right, y up, z towards the viewer (rule files' own). Where
a shape is flat, the plane z = 0 of the asset lies in it.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.grammar.surfaces.catalogue import PREFIX, sizes_m
from veduta.place.instances import SharedMesh
from veduta.place.material import Colour

CREASE_RAD = np.radians(48.0)
"""Faces that turn less than this at an edge are shaded as one curved surface."""
PLANE_TOLERANCE_M = 5e-3
"""Faces of swept curves are a little warped."""


@dataclass(frozen=True)
class Slot:
    """A semantic part of an asset (frame, pane, iron) and its look.

    colour: sRGB, 0..1; None for that of the shape that the asset is put into. fallback: the colour
    where a shape has none of its own (white). texture: a built-in one, by its plain name; it
    multiplies with the colour. picture: one that lies by the asset's own `uv`, and multiplies, too;
    mean: its mean colour (sRGB).
    """

    name: str
    colour: Colour | None = None
    roughness: float = 0.9
    metalness: float = 0.0
    fallback: Colour = (1.0, 1.0, 1.0)
    texture: str | None = None
    picture: str | None = None
    mean: Colour = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Asset:
    """Faces over points.

    points_m: (v, 3) float64. corners: (c,) uint32, point numbers face by face, counter-clockwise
    seen from outside. offsets: (f + 1,) int64, first corner of each face. face_slot: (f,) int32.
    given_box_m: the box that fills a scope where it is not that around the points: all levels of
    detail have the finest one's, so that they stand in the same place. face_group: (f,) place in
    `groups`, the names that the asset's file has; empty where it has none. in_plane: whether its
    plane z = 0 lies in that of a flat shape that it is put into, as a window's in a wall. panel:
    whether it is thin there.
    uv: (c, 2) float32, where each corner lies on the picture of its slot, from the lower left; None
    where no slot has one. notes: what of its file is not shown.
    """

    name: str
    points_m: NDArray[np.float64]
    corners: NDArray[np.uint32]
    offsets: NDArray[np.int64]
    face_slot: NDArray[np.int32]
    slots: tuple[Slot, ...]
    given_box_m: NDArray[np.float64] | None = None
    face_group: NDArray[np.int32] = field(default_factory=lambda: np.zeros(0, np.int32))
    groups: tuple[str, ...] = ()
    in_plane: bool = False
    panel: bool = False
    uv: NDArray[np.float32] | None = None
    notes: tuple[str, ...] = ()

    @cached_property
    def box_m(self) -> NDArray[np.float64]:
        """(2, 3) the corners of the box that fills a scope."""
        if self.given_box_m is not None:
            return self.given_box_m
        return np.stack([self.points_m.min(axis=0), self.points_m.max(axis=0)])

    def part(self, name: str, slots: Collection[str]) -> Asset:
        """The faces of these slots alone, which fill a scope as the whole does: the box stays."""
        chosen = [number for number, slot in enumerate(self.slots) if slot.name in slots]
        faces = np.flatnonzero(np.isin(self.face_slot, chosen))
        sizes = np.diff(self.offsets)[faces]
        own = [self.corners[a:b] for a, b in zip(self.offsets, self.offsets[1:], strict=False)]
        chosen_corners = np.concatenate([own[face] for face in faces.tolist()])
        used, corners = np.unique(chosen_corners, return_inverse=True)
        is_chosen = np.repeat(np.isin(self.face_slot, chosen), np.diff(self.offsets))
        return Asset(
            name=name,
            points_m=self.points_m[used],
            corners=corners.reshape(-1).astype(np.uint32),
            offsets=np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64),
            face_slot=np.searchsorted(chosen, self.face_slot[faces]).astype(np.int32),
            slots=tuple(self.slots[number] for number in chosen),
            given_box_m=self.box_m,
            in_plane=self.in_plane,
            panel=self.panel,
            uv=None if self.uv is None else self.uv[is_chosen],
            notes=self.notes,
        )

    def seen(self, mirrored: bool, inside_out: bool) -> Asset:
        """Its mirror image about x = 0, its faces seen from behind, or both."""
        if not (mirrored or inside_out):
            return self
        told = [("mirrored", mirrored), ("inside out", inside_out)]
        side = np.array([-1.0, 1.0, 1.0]) if mirrored else np.ones(3)
        box = np.sort(self.box_m * side, axis=0)
        order = np.arange(len(self.corners))
        if mirrored != inside_out:
            order = np.concatenate([ring[::-1] for ring in np.split(order, self.offsets[1:-1])])
        return replace(
            self,
            name=" ".join([self.name, *(word for word, is_so in told if is_so)]),
            points_m=self.points_m * side,
            corners=self.corners[order],
            given_box_m=box,
            uv=None if self.uv is None else self.uv[order],
        )

    @cached_property
    def triangles(self) -> tuple[NDArray[np.uint32], NDArray[np.int64], NDArray[np.float64]]:
        """(m, 3) places in `corners`, (m,) the face of each, (f, 3) unit normals of the faces."""
        indices, face, normal, _ = _core.triangulate_polygons(
            self.points_m[self.corners],
            self.offsets,
            np.arange(len(self.offsets), dtype=np.int64),
            PLANE_TOLERANCE_M,
        )
        return indices, face.astype(np.int64), normal

    @cached_property
    def shared_mesh(self) -> SharedMesh:
        """The asset in the frame of parts (z up), shaded smoothly where it is round."""
        indices, face, normal = self.triangles
        used = np.unique(indices)
        shading = corner_normals(self.corners, self.offsets, normal)
        side, uv = boxed(self, normal)
        is_own = self._has_picture
        if self.uv is not None:
            uv[is_own, 0], uv[is_own, 1] = self.uv[is_own, 0], 1.0 - self.uv[is_own, 1]
        key = np.concatenate(
            [
                self.corners[used, None],
                np.round(shading[used] * 1000.0).astype(np.int64),
                side[used, None],
                np.where(is_own[:, None], uv, np.float32(0.0))[used].view(np.int32),
            ],
            axis=1,
        )
        _, first, vertex = np.unique(key, axis=0, return_index=True, return_inverse=True)
        vertex_of = np.zeros(len(self.corners), dtype=np.uint32)
        vertex_of[used] = vertex.reshape(-1)
        chosen = used[first]
        slot = self.face_slot[face]
        order = np.argsort(slot, kind="stable")
        return SharedMesh(
            name=self.name,
            positions_m=_z_up(self.points_m[self.corners[chosen]]),
            normals=_z_up(shading[chosen]),
            indices=vertex_of[indices[order]],
            slot=slot[order],
            slots=tuple(slot.name for slot in self.slots),
            uv=uv[chosen] if side.any() or is_own.any() else None,
        )

    @property
    def _has_picture(self) -> NDArray[np.bool_]:
        """(c,) whether a corner lies on a picture by its own place."""
        slots = np.array([slot.picture is not None for slot in self.slots])
        return np.repeat(slots[self.face_slot], np.diff(self.offsets))


def boxed(
    asset: Asset, normal: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.float32]]:
    """Where textures lie on an asset: in metres, from the side of a box that a face looks to most.

    normal: (f, 3) of the faces. (c,) a number for each slot and side, 0 where there is no texture;
    (c, 2) texture coordinates from the upper left.
    """
    sizes = sizes_m()
    size = np.array([sizes.get(f"{PREFIX}{slot.texture}", (0.0, 0.0)) for slot in asset.slots])
    face = np.repeat(np.arange(len(asset.offsets) - 1), np.diff(asset.offsets))
    axis = np.abs(normal).argmax(axis=1)
    sign = np.where(np.take_along_axis(normal, axis[:, None], axis=1)[:, 0] < 0.0, -1.0, 1.0)
    x, y, z = asset.points_m[asset.corners].T
    to_right = np.choose(axis[face], [-z * sign[face], x, x * sign[face]])
    upward = np.choose(axis[face], [y, -z * sign[face], y])
    own = size[asset.face_slot[face]]
    is_textured = own[:, 0] > 0.0
    metres = np.stack([to_right, upward], axis=1)
    shares = np.divide(metres, own, out=np.zeros_like(metres), where=is_textured[:, None])
    shares[:, 1] = 1.0 - shares[:, 1]
    number = 1 + 6 * asset.face_slot[face] + 2 * axis[face] + (sign[face] > 0.0)
    return np.where(is_textured, number, 0), shares.astype(np.float32)


def corner_normals(
    corners: NDArray[np.uint32], offsets: NDArray[np.int64], normal: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(c, 3) the mean normal of the faces that meet smoothly at each corner."""
    face = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    own = normal[face]
    order = np.argsort(corners, kind="stable")
    counts = np.bincount(corners)
    counts = counts[counts > 0]
    starts = np.cumsum(counts) - counts
    # All pairs of corners at one point: each corner of a group beside each of the group.
    group = np.repeat(np.arange(len(counts)), counts)
    left = np.repeat(np.arange(len(corners)), counts[group])
    within = np.arange(len(left)) - np.repeat(
        np.cumsum(counts[group]) - counts[group], counts[group]
    )
    right = starts[group[left]] + within
    a, b = order[left], order[right]
    smooth = np.einsum("ij,ij->i", own[a], own[b]) >= np.cos(CREASE_RAD)
    summed = np.zeros_like(own)
    np.add.at(summed, a[smooth], own[b[smooth]])
    length = np.linalg.norm(summed, axis=1, keepdims=True)
    result: NDArray[np.float64] = summed / np.maximum(length, 1e-12)
    return result


def _z_up(vectors: NDArray[np.float64]) -> NDArray[np.float32]:
    """Rule files' (x, y, z) to the part's (x, -z, y)."""
    turned = np.stack([vectors[:, 0], -vectors[:, 2], vectors[:, 1]], axis=1)
    return turned.astype(np.float32) + np.float32(0.0)
