"""A built facade as a part of a place."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Material, Texture
from veduta.place.part import NO_PARENT, Features, Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.synthetic.build import BuiltFacade, Feature
from veduta.synthetic.looks import Look


def to_part(
    built: BuiltFacade, part_id: str, *, as_other: bool = False, screens: bool = False
) -> Part:
    """The part with one feature per row of the feature table; everything about it is known.

    `as_other` makes all classes "other" (a house that the photo is not about); `screens` takes
    the gapless outlines of the balconies instead of the visible mesh.
    """
    mesh = built.screens if screens else built.mesh
    faces = len(mesh.feature)
    return Part(
        id=part_id,
        positions_m=mesh.positions.astype(np.float32),
        uv=mesh.uv.astype(np.float32),
        ring_offsets=mesh.start,
        polygon_offsets=np.arange(faces + 1, dtype=np.int64),
        polygon_feature=mesh.feature,
        polygon_material=mesh.material,
        features=_table(built.features, part_id, as_other),
        materials=tuple(_material(f"{part_id} {n}", built.looks[n]) for n in built.materials),
        notes=("synthetic",),
    )


def mirrors(built: BuiltFacade, part_id: str) -> dict[str, NDArray[np.uint8]]:
    """How much of each texel mirrors, for the materials that have glass in them."""
    return {
        f"{part_id} {name}": look.mirror
        for name, look in built.looks.items()
        if look.mirror is not None
    }


def _material(name: str, look: Look) -> Material:
    known = np.zeros(look.texture.shape[:2], np.bool_)
    smooth = look.mirror is not None and float(look.mirror.mean()) > 100
    return Material(name, roughness=0.3 if smooth else 0.9, texture=Texture(look.texture, known))


def _table(features: tuple[Feature, ...], part_id: str, as_other: bool) -> Features:
    count = len(features)
    size = np.full((count, 2), np.nan)
    classes = [SemanticClass.OTHER if as_other else SemanticClass(f.class_) for f in features]
    for row, feature in enumerate(features):
        if feature.rect is not None:
            size[row] = (feature.rect.width_m, feature.rect.height_m)
    return Features(
        id=tuple(f"{part_id}/{c.value}-{row}" for row, c in enumerate(classes)),
        name=tuple(f.name for f in features),
        class_code=np.array([c.code for c in classes], np.uint8),
        provenance_code=np.full(count, Provenance.MEASURED.code, np.uint8),
        parent=np.array(
            [0 if f.class_ in ("window", "door", "shop") else NO_PARENT for f in features], np.int32
        ),
        shell=np.zeros(count, np.int32),
        width_m=size[:, 0],
        height_m=size[:, 1],
        photo_px=np.full((count, 4), np.nan),
        seen_height_m=np.full(count, np.nan),
        score=np.full(count, np.nan),
    )
