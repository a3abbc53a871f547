"""A place as formats for meshes want it: triangles in one frame, and what each surface looks like.

A part's polygons, the meshes that stand in it many times, and what moves as it stands in the place
come as one `Shape`; a mesh comes as it is. Each class of surface has a look of its own, named after
it: glass is `window` and not `wall`, also where one photo textures both.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.place.flatten import MOST_TRIANGLES, TooManyTrianglesError
from veduta.place.instances import InstanceGroup, Instances, placed, turn_and_stretch
from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.mover import Mover
from veduta.place.part import Features, Part
from veduta.place.place import Place, PlacedPart
from veduta.place.semantics import SemanticClass, is_drawn_only
from veduta.run.errors import InputError


@dataclass(frozen=True)
class Look:
    """A material on one class of surfaces. name: the only one of its kind in the file."""

    name: str
    semantic: SemanticClass
    material: Material


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles as columns.

    positions_m, normals: (v, 3) float64. uv: (v, 2) float64, glTF's. colours: (v, 3) uint8 sRGB, or
    None. corners: (m, 3) int64. feature, material: (m,) int32.
    """

    positions_m: NDArray[np.float64]
    normals: NDArray[np.float64]
    uv: NDArray[np.float64]
    colours: NDArray[np.uint8] | None
    corners: NDArray[np.int64]
    feature: NDArray[np.int32]
    material: NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Shape:
    """A part in the frame of the place (z up, metres). look: (m,) int32, row of `looks`."""

    placed: PlacedPart
    content: Part | Mesh
    triangles: Triangles
    look: NDArray[np.int32]
    looks: tuple[Look, ...]

    @property
    def features(self) -> Features:
        """The table that the triangles' features are rows of."""
        return self.content.features

    def by_look(self) -> Iterator[tuple[Look, NDArray[np.int64]]]:
        """Each look that is there, with the rows of its triangles."""
        for row, look in enumerate(self.looks):
            chosen = np.flatnonzero(self.look == row)
            if len(chosen):
                yield look, chosen

    def by_feature(self) -> Iterator[tuple[int, NDArray[np.int64]]]:
        """Each feature that is there, with the rows of its triangles."""
        order = np.argsort(self.triangles.feature, kind="stable")
        rows, starts = np.unique(self.triangles.feature[order], return_index=True)
        yield from zip(rows.tolist(), np.split(order, starts[1:]), strict=True)


def shapes(place: Place, *, drawn_only: bool = True) -> Iterator[Shape]:
    """The parts of a place one by one, in their order; on wish without what is drawn only."""
    names = LookNames()
    for one, content in contents(place):
        own = _moved(triangles_of(content), one.standing.transform)
        if not drawn_only:
            own = _of_bodies(own, content.features)
        looks, look = names.of_part(content, own)
        yield Shape(one, content, own, look, looks)


def contents(place: Place) -> Iterator[tuple[PlacedPart, Part | Mesh]]:
    """Each part and what is in it, read one after another.

    InputError where they are tiles, in which many buildings are one.
    """
    for one in place.parts.values():
        try:
            content = one.passing()
        except InputError as error:
            if place.tileset is None:
                raise
            raise InputError(
                place.folder or place.tileset,
                "is a town in tiles, whose buildings are not files of their own",
                "Derive it with --separate, and export that.",
            ) from error
        yield one, content


class LookNames:
    """Names of looks: the class's, with the material's where a class has several."""

    def __init__(self) -> None:
        self._known: dict[tuple[SemanticClass, Material], Look] = {}
        self._names: set[str] = set()
        self._textures: dict[bytes, Texture] = {}

    def look(self, semantic: SemanticClass, material: Material) -> Look:
        """The look of a material on a class; the same two give the same."""
        key = (semantic, material)
        if key not in self._known:
            self._known[key] = Look(self._free(semantic, material), semantic, material)
        return self._known[key]

    def of_part(
        self, content: Part | Mesh, triangles: Triangles
    ) -> tuple[tuple[Look, ...], NDArray[np.int32]]:
        """The looks of a part, and that of each triangle."""
        classes = content.features.class_code[triangles.feature].astype(np.int64)
        keys = classes * len(content.materials) + triangles.material
        found, look = np.unique(keys, return_inverse=True)
        materials = [self._known_texture(material) for material in content.materials]
        looks = tuple(
            self.look(SemanticClass.of_code(key // len(materials)), materials[key % len(materials)])
            for key in found.tolist()
        )
        return looks, look.reshape(-1).astype(np.int32)

    def _known_texture(self, material: Material) -> Material:
        """The material with the first texture of the same pixels: two parts that were read have
        two of what was one.
        """
        texture = material.texture
        if texture is None:
            return material
        digest = hashlib.sha256(texture.pixels.tobytes() + texture.invented.tobytes()).digest()
        return replace(material, texture=self._textures.setdefault(digest, texture))

    def _free(self, semantic: SemanticClass, material: Material) -> str:
        own = "".join(c if c.isalnum() or c in "-_" else "-" for c in material.name)
        several = f"{semantic.value}.{own}"
        name = semantic.value if semantic.value not in self._names else several
        number = 2
        while name in self._names:
            name, number = f"{several}.{number}", number + 1
        self._names.add(name)
        return name


def triangles_of(content: Part | Mesh) -> Triangles:
    """All triangles of a part or a mesh in its own frame.

    Raises TooManyTrianglesError where a part's instances are more than memory should hold.
    """
    if isinstance(content, Mesh):
        return _of_mesh(content)
    pieces = [_of_polygons(content)]
    instances = content.instances
    if instances is not None:
        if instances.triangle_count > MOST_TRIANGLES:
            raise TooManyTrianglesError(
                f"{content.id}: {instances.triangle_count} triangles of repeated assets; "
                f"{MOST_TRIANGLES} are the most that can be written one by one"
            )
        pieces += [_of_group(instances, group) for group in instances.groups]
    return _joined(pieces)


def _of_mesh(mesh: Mesh) -> Triangles:
    count = len(mesh.positions_m)
    uv = np.zeros((count, 2)) if mesh.uv is None else mesh.uv.astype(np.float64)
    return Triangles(
        mesh.positions_m.astype(np.float64),
        mesh.vertex_normals.astype(np.float64),
        uv,
        mesh.colours,
        mesh.triangles.astype(np.int64),
        mesh.triangle_feature,
        mesh.triangle_material,
    )


def _of_polygons(part: Part) -> Triangles:
    if len(part.polygon_feature) == 0:
        nothing, no_row = np.zeros((0, 3)), np.zeros(0, dtype=np.int32)
        corners = np.zeros((0, 3), dtype=np.int64)
        return Triangles(nothing, nothing, np.zeros((0, 2)), None, corners, no_row, no_row)
    positions = part.positions_m.astype(np.float64)
    corners, polygon, normal = _triangulated(part, positions)
    sizes = np.diff(part.ring_offsets[part.polygon_offsets])
    normals = np.repeat(normal, sizes, axis=0)
    for mover in part.movers:
        _open(mover, part, positions, normals)
    return Triangles(
        positions,
        normals,
        part.uv.astype(np.float64),
        None,
        corners,
        part.polygon_feature[polygon],
        part.polygon_material[polygon],
    )


def _triangulated(
    part: Part, positions: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Corners and polygon of each triangle, and the normal of each polygon.

    Polygons that are triangles already, as those of a model that was read, are taken as they are.
    """
    count = len(part.polygon_feature)
    if len(part.ring_offsets) == count + 1 and (np.diff(part.ring_offsets) == 3).all():
        corners = np.arange(3 * count, dtype=np.int64).reshape(-1, 3)
        first, second, third = (positions[corners[:, place]] for place in range(3))
        normal = np.cross(second - first, third - first)
        length = np.linalg.norm(normal, axis=1, keepdims=True)
        return corners, np.arange(count), normal / np.where(length > 0.0, length, 1.0)
    own = part.triangles
    return own.indices.astype(np.int64), own.polygon.astype(np.int64), own.polygon_normal


def _open(
    mover: Mover, part: Part, positions: NDArray[np.float64], normals: NDArray[np.float64]
) -> None:
    """Move the corners of what moves to where it stands in the place."""
    if mover.opened == 0.0:
        return
    from scipy.spatial.transform import Rotation  # here: most calls need none, and it is slow

    moves = np.zeros(len(part.polygon_feature), dtype=np.bool_)
    moves[mover.polygons] = True
    own = np.repeat(moves, np.diff(part.ring_offsets[part.polygon_offsets]))
    turn = Rotation.from_rotvec(mover.opened * mover.turn_rad * np.array(mover.axis))
    pivot = np.array(mover.pivot_m)
    shift = pivot + mover.opened * np.array(mover.shift_m)
    positions[own] = turn.apply(positions[own] - pivot) + shift
    normals[own] = turn.apply(normals[own])


def _of_group(instances: Instances, group: InstanceGroup) -> Triangles:
    """All instances of one mesh in one look."""
    mesh = instances.meshes[group.mesh]
    count, vertices = len(group.feature), len(mesh.positions_m)
    turn, stretch = turn_and_stretch(group.part_from_mesh)
    leaning = np.einsum("nij,nvj->nvi", turn, mesh.normals[None] / stretch[:, None, :])
    length = np.linalg.norm(leaning, axis=2, keepdims=True)
    uv = np.zeros((vertices, 2)) if mesh.uv is None else mesh.uv.astype(np.float64)
    corners = mesh.indices.astype(np.int64)[None] + vertices * np.arange(count)[:, None, None]
    material = np.array(group.materials, dtype=np.int32)[mesh.slot]
    return Triangles(
        placed(group.part_from_mesh, mesh.positions_m.astype(np.float64)).reshape(-1, 3),
        (leaning / np.where(length > 0.0, length, 1.0)).reshape(-1, 3),
        np.tile(uv, (count, 1)),
        None,
        corners.reshape(-1, 3),
        np.repeat(group.feature, len(mesh.indices)),
        np.tile(material, count),
    )


def _joined(pieces: list[Triangles]) -> Triangles:
    if len(pieces) == 1:
        return pieces[0]
    starts = np.cumsum([0, *(len(one.positions_m) for one in pieces)])
    return Triangles(
        np.concatenate([one.positions_m for one in pieces]),
        np.concatenate([one.normals for one in pieces]),
        np.concatenate([one.uv for one in pieces]),
        None,
        np.concatenate(
            [one.corners + start for one, start in zip(pieces, starts[:-1], strict=True)]
        ),
        np.concatenate([one.feature for one in pieces]),
        np.concatenate([one.material for one in pieces]),
    )


def _of_bodies(own: Triangles, features: Features) -> Triangles:
    """The triangles of what is more than drawn, and the corners that these need."""
    kept = ~is_drawn_only(features.class_code[own.feature])
    if kept.all():
        return own
    used, corners = np.unique(own.corners[kept], return_inverse=True)
    return Triangles(
        own.positions_m[used],
        own.normals[used],
        own.uv[used],
        None if own.colours is None else own.colours[used],
        corners.reshape(-1, 3),
        own.feature[kept],
        own.material[kept],
    )


def _moved(own: Triangles, matrix: NDArray[np.float64]) -> Triangles:
    """The triangles where a placement (4, 4) puts them."""
    linear = matrix[:3, :3]
    normals = own.normals @ np.linalg.inv(linear)
    length = np.linalg.norm(normals, axis=1, keepdims=True)
    return Triangles(
        own.positions_m @ linear.T + matrix[:3, 3],
        normals / np.where(length > 0.0, length, 1.0),
        own.uv,
        own.colours,
        own.corners,
        own.feature,
        own.material,
    )
