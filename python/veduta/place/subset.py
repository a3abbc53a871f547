"""Some of a part's polygons as a part of their own, with the whole table of features."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from veduta.place.instances import InstanceGroup, Instances
from veduta.place.part import Part


def with_polygons(part: Part, kept: NDArray[np.bool_]) -> Part:
    """The part with some of its polygons. kept: (p,).

    What moves keeps those of its polygons that stay, and goes where none does.
    """
    ring_counts, point_counts = np.diff(part.polygon_offsets), np.diff(part.ring_offsets)
    ring_kept = np.repeat(kept, ring_counts)
    vertices = np.repeat(ring_kept, point_counts)
    row_of = np.cumsum(kept) - 1
    movers = tuple(
        replace(mover, polygons=row_of[mover.polygons[kept[mover.polygons]]])
        for mover in part.movers
    )
    return replace(
        part,
        positions_m=part.positions_m[vertices],
        uv=part.uv[vertices],
        ring_offsets=np.concatenate([[0], np.cumsum(point_counts[ring_kept])]).astype(np.int64),
        polygon_offsets=np.concatenate([[0], np.cumsum(ring_counts[kept])]).astype(np.int64),
        polygon_feature=part.polygon_feature[kept],
        polygon_material=part.polygon_material[kept],
        movers=tuple(mover for mover in movers if len(mover.polygons)),
    )


def with_instances(part: Part, kept: NDArray[np.bool_]) -> Part:
    """The part with the instances of some of its features. kept: (f,)."""
    if part.instances is None:
        return part
    groups = []
    for group in part.instances.groups:
        own = kept[group.feature]
        if own.any():
            groups.append(
                InstanceGroup(
                    group.mesh, group.materials, group.part_from_mesh[own], group.feature[own]
                )
            )
    if not groups:
        return replace(part, instances=None)
    used = sorted({group.mesh for group in groups})
    renumbered = tuple(replace(group, mesh=used.index(group.mesh)) for group in groups)
    meshes = tuple(part.instances.meshes[number] for number in used)
    return replace(part, instances=Instances(meshes, renumbered))
