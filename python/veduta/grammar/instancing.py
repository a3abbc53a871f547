"""The assets that stand in a lot, as columns of its part: each mesh once, in each look."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from veduta import _core
from veduta.grammar.assets.asset import Asset, Slot
from veduta.grammar.surfaces.catalogue import PREFIX
from veduta.place.instances import InstanceGroup, Instances
from veduta.place.material import Colour, Material, Texture

WHITE: Colour = (1.0, 1.0, 1.0)
"""The colour of a shape that none was given to."""


def instances_of(
    derived: _core.DerivedLot,
    used: NDArray[np.int32],
    assets: Sequence[Asset],
    number_of: dict[Material, int],
    textures: Mapping[str, Texture],
) -> Instances | None:
    """The instances; None without any.

    used: (f,) the surfaces that are rows of the feature table, in order. assets: as the columns
    count them. number_of: the part's
    materials with their numbers; those of the assets are added. textures: by the names of rule
    files; a built-in one that is not among them is left out.
    """
    if len(derived.instance_feature) == 0:
        return None
    looks = np.stack([derived.instance_asset, derived.instance_look], axis=1)
    pairs, pair_of = np.unique(looks, axis=0, return_inverse=True)
    groups: dict[tuple[int, tuple[int, ...]], list[NDArray[np.intp]]] = {}
    for number, (mesh, look) in enumerate(pairs.tolist()):
        colour = derived.looks[look][:3]
        materials = [_material(slot, colour, textures) for slot in assets[mesh].slots]
        rows = tuple(number_of.setdefault(found, len(number_of)) for found in materials)
        groups.setdefault((mesh, rows), []).append(np.flatnonzero(pair_of.reshape(-1) == number))
    feature = np.searchsorted(used, derived.instance_feature).astype(np.int32)
    places = derived.instance_transform.reshape(-1, 3, 4)
    return Instances(
        meshes=tuple(asset.shared_mesh for asset in assets),
        groups=tuple(
            InstanceGroup(mesh, rows, places[own], feature[own])
            for (mesh, rows), own in (
                (key, np.sort(np.concatenate(g))) for key, g in groups.items()
            )
        ),
    )


def _material(slot: Slot, shape: Colour, textures: Mapping[str, Texture]) -> Material:
    """A slot without a colour of its own takes that of the shape, where it has one.

    A picture that is not among the textures is seen as its mean colour.
    """
    colour = slot.colour or (slot.fallback if shape == WHITE else shape)
    named = slot.picture or (slot.texture and f"{PREFIX}{slot.texture}")
    texture = textures.get(named) if named else None
    if slot.picture is not None and texture is None:
        red, green, blue = colour
        colour = (red * slot.mean[0], green * slot.mean[1], blue * slot.mean[2])
    red, green, blue = (round(channel, 4) for channel in colour)
    told = (slot.name, (red, green, blue), slot.roughness, slot.metalness, texture)
    return Material(*told, two_sided=texture is not None and texture.cut)
