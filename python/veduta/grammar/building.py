"""What the rules made of a lot, as a part of a place.

A rule file is no record of what stands there, so that all is invented but for what the rules
themselves say: `set(provenance, "measured")`. They also name surfaces and closed solids (`surface`,
`solid`). Leaves that have no such name and got their class from one application of a rule are one
feature (a window with its frames and panes).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.grammar.assets.asset import Asset
from veduta.grammar.dissolving import dissolved
from veduta.grammar.instancing import instances_of
from veduta.grammar.left_out import LeftOut, left_out_by_rule
from veduta.place.material import Material, Texture
from veduta.place.part import NO_PARENT, PLANE_TOLERANCE_M, Features, Part
from veduta.place.semantics import CLASS_NAMED, Provenance, SemanticClass

_ROUGHNESS = {
    SemanticClass.WINDOW: 0.25,
    SemanticClass.SHOP: 0.2,
    SemanticClass.ROOF: 0.7,
    SemanticClass.BALCONY: 0.6,
}
_SAID = {said.value: said for said in Provenance}
Look = tuple[float, float, float, float, str | None, str]


class NothingBuiltError(ValueError):
    """The rules left no surface on the lot."""


@dataclass(frozen=True)
class Building:
    """A part, and what it does not show of what the rules made.

    said: notes without those on `left_out`. The notes of the part are both.
    """

    part: Part
    said: tuple[str, ...]
    left_out: tuple[LeftOut, ...]


def build_part(
    derived: _core.DerivedLot,
    part_id: str,
    assets: Sequence[Asset] = (),
    textures: Mapping[str, Texture] = MappingProxyType({}),
) -> Part:
    """The part of `build`; NothingBuiltError where there is no surface."""
    return build(derived, part_id, assets, textures).part


def build(
    derived: _core.DerivedLot,
    part_id: str,
    assets: Sequence[Asset] = (),
    textures: Mapping[str, Texture] = MappingProxyType({}),
) -> Building:
    """The part, about the lot's anchor; NothingBuiltError where there is no surface.

    `assets` are those that stand in the lot, by name; `textures` by the names that the rules have
    for them, of which those that are missing are left out and noted. Surfaces that are none in
    single precision (slivers, lines that cross) are left out and noted, too.
    """
    every = np.ones(len(derived.polygon_feature), dtype=np.bool_)
    has_assets = len(derived.instance_feature) > 0
    if not every.any() and not has_assets:
        raise NothingBuiltError("the rules leave nothing on it")
    said = _said(derived, textures)
    whole = _part(derived, part_id, every, assets, textures, said)
    part = _joined(whole, derived)
    if _has_triangles(part):
        return Building(part, said, ())
    kept = _sound(whole)
    if not kept.any() and not has_assets:
        raise NothingBuiltError("the rules leave no surface on it")
    dropped = derived.polygon_feature[~kept]
    left_out = left_out_by_rule(derived.feature_name[row] for row in dropped.tolist())
    notes = (*said, *(one.told() for one in left_out))
    return Building(_part(derived, part_id, kept, assets, textures, notes), said, left_out)


def _part(
    derived: _core.DerivedLot,
    part_id: str,
    kept: NDArray[np.bool_],
    assets: Sequence[Asset],
    textures: Mapping[str, Texture],
    notes: tuple[str, ...],
) -> Part:
    """The part of the (p,) polygons that are kept, and of all instances."""
    vertices, rings, polygons = _select(derived.ring_offsets, derived.polygon_offsets, kept)
    of_polygon = derived.polygon_feature[kept]
    used = np.unique(np.concatenate([of_polygon, derived.instance_feature]))
    number_of, material_of_look = _materials(derived.looks, textures)
    instances = instances_of(derived, used, assets, number_of, textures)
    with np.errstate(over="ignore"):  # what is too far away is found not to be finite
        positions = derived.positions_m[vertices].astype(np.float32)
    return Part(
        id=part_id,
        positions_m=positions,
        uv=_from_the_top(derived.uv[vertices]),
        ring_offsets=rings,
        polygon_offsets=polygons,
        polygon_feature=np.searchsorted(used, of_polygon).astype(np.int32),
        polygon_material=material_of_look[derived.polygon_look[kept]],
        features=_features(derived, used, part_id),
        materials=tuple(number_of),
        notes=notes,
        instances=instances,
    )


def _joined(part: Part, derived: _core.DerivedLot) -> Part:
    """With the cells of surfaces that the rules name as the faces that they were cut from."""
    if not any(derived.feature_surface) or len(part.polygon_feature) == 0:
        return part
    try:
        return dissolved(part, derived.positions_m)
    except _core.PolygonFault:  # a sliver: the polygons are looked at one by one
        return part


def _has_triangles(part: Part) -> bool:
    """Whether all polygons can be triangulated; the part keeps the triangles."""
    try:
        return len(part.triangles.indices) > 0 or len(part.polygon_feature) == 0
    except _core.PolygonFault:
        return False


def _sound(part: Part) -> NDArray[np.bool_]:
    """(p,) which polygons can be triangulated, one by one."""
    points = part.positions_m.astype(np.float64)
    return _core.sound_polygons(points, part.ring_offsets, part.polygon_offsets, PLANE_TOLERANCE_M)


def _select(
    rings: NDArray[np.int64], polygons: NDArray[np.int64], kept: NDArray[np.bool_]
) -> tuple[NDArray[np.bool_], NDArray[np.int64], NDArray[np.int64]]:
    """(v,) which vertices stay, and the offsets of rings and polygons among what stays."""
    ring_counts, point_counts = np.diff(polygons), np.diff(rings)
    ring_kept = np.repeat(kept, ring_counts)
    vertices = np.repeat(ring_kept, point_counts)
    ring_offsets = np.concatenate([[0], np.cumsum(point_counts[ring_kept])])
    polygon_offsets = np.concatenate([[0], np.cumsum(ring_counts[kept])])
    return vertices, ring_offsets.astype(np.int64), polygon_offsets.astype(np.int64)


def _from_the_top(uv: NDArray[np.float32]) -> NDArray[np.float32]:
    """Texture coordinates of rule files begin at the lower left, those of parts at the upper."""
    return np.stack([uv[:, 0], np.float32(1.0) - uv[:, 1]], axis=1)


def _features(derived: _core.DerivedLot, used: NDArray[np.int32], part_id: str) -> Features:
    """The table; what the rules do not name is called by their rule, and counted within it."""
    counts: Counter[str] = Counter()
    taken = {derived.feature_surface[row] for row in used.tolist()} - {""}
    names, codes = [], []
    for row in used.tolist():
        name, rule = derived.feature_surface[row], derived.feature_name[row]
        while not name or (name in taken and not derived.feature_surface[row]):
            counts[rule] += 1
            name = f"{rule} {counts[rule]}"
        names.append(name)
        codes.append(CLASS_NAMED.get(derived.feature_class[row], SemanticClass.OTHER).code)
    total = len(names)
    row_of = {name: row for row, name in enumerate(names)}
    said = [_SAID.get(derived.feature_provenance[row], Provenance.INVENTED) for row in used]
    within = [row_of.get(derived.feature_within[row], NO_PARENT) for row in used]
    solids = {"": 0}
    shells = [solids.setdefault(derived.feature_solid[row], len(solids)) for row in used]
    return Features(
        id=tuple(f"{part_id}/{name.replace(' ', '-')}" for name in names),
        name=tuple(names),
        class_code=np.array(codes, dtype=np.uint8),
        provenance_code=np.array([one.code for one in said], dtype=np.uint8),
        parent=np.array(within, dtype=np.int32),
        shell=np.array(shells, dtype=np.int32),
        width_m=derived.feature_size_m[used, 0],
        height_m=derived.feature_size_m[used, 1],
        photo_px=np.full((total, 4), np.nan),
        seen_height_m=np.full(total, np.nan),
        score=np.full(total, np.nan),
    )


def _materials(
    looks: list[Look], textures: Mapping[str, Texture]
) -> tuple[dict[Material, int], NDArray[np.int32]]:
    """The materials with their numbers, and (looks,) the material of each look."""
    number_of: dict[Material, int] = {}
    rows = []
    for red, green, blue, seen, image, name in looks:
        semantic = CLASS_NAMED.get(name, SemanticClass.OTHER)
        colour = (round(red, 4), round(green, 4), round(blue, 4))
        texture = None if image is None else textures.get(image)
        opacity = round(seen, 4)
        roughness = _ROUGHNESS.get(semantic, 0.9)
        if texture is None:
            material = Material(semantic.value, colour, roughness, opacity=opacity)
        elif semantic is SemanticClass.WINDOW:
            # A picture that a wall and its panes share: glass is no wall.
            material = Material(semantic.value, colour, roughness, texture=texture, opacity=opacity)
        else:
            name_told = PurePath(str(image)).stem
            material = Material(name_told, colour, texture=texture, opacity=opacity)
        rows.append(number_of.setdefault(material, len(number_of)))
    return number_of, np.array(rows, dtype=np.int32)


def _said(derived: _core.DerivedLot, textures: Mapping[str, Texture]) -> tuple[str, ...]:
    """What the rules said, and what of it is shown otherwise."""
    notes = list(dict.fromkeys(derived.messages))[:20]
    unknown = sorted({name for name in derived.feature_class if name and name not in CLASS_NAMED})
    if unknown:
        notes.append(f"material.name is no class that is known, so `other`: {', '.join(unknown)}")
    missing = sorted({look[4] for look in derived.looks if look[4] and look[4] not in textures})
    if missing:
        notes.append(f"textures that are not there, or that no text names: {', '.join(missing)}")
    return tuple(notes)
