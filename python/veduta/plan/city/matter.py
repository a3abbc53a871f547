"""What a house is made of as one solid: walls, slabs, panels in openings, and the roof.

Walls are those of `house.walls`, the roof is that of the part; regions are those of `house.space`.
Openings are shut: a panel stands in the middle of the wall, as thick as a window's frame.
"""

from __future__ import annotations

from collections.abc import Sequence

import manifold3d
import numpy as np
from numpy.typing import NDArray

from veduta.place.part import Part
from veduta.place.semantics import SemanticClass
from veduta.plan.city.marked import Mark, Marks, joined, one_mark
from veduta.plan.house.build import GROUND_SLAB_M
from veduta.plan.house.floors import FINISH_M, slab_over
from veduta.plan.house.hole import Hole
from veduta.plan.house.roof import UNDER_M
from veduta.plan.house.space import Space
from veduta.plan.house.walls import WallNames, wall_solid

PANEL_M = 0.07
_THIN = 0.8
"""A panel is thinner than its wall."""
INTO_M = 0.002
"""How far what fills an opening reaches into the wall around it."""
_JOINT_M = 0.001
_EDGE_M = 0.005


def is_shut(hole: Hole) -> bool:
    """Whether something hangs or stands in an opening: in gaps nothing does."""
    return hole.opening.kind == "window" or (
        hole.opening.kind == "door" and hole.opening.type != "plain"
    )


def panel_half_m(hole: Hole) -> float:
    """Half of the thickness of what shuts an opening."""
    return min(PANEL_M / 2.0, _THIN * hole.line.half_m)


def matter_of(
    spaces: Sequence[Space], part: Part, slab_m: float, marks: Marks
) -> tuple[manifold3d.Manifold, list[str]]:
    """The solid of the whole house (the part's frame, m), and what could not be made part of it."""
    first, last = spaces[0], spaces[-1]
    base = first.storey.elevation_m
    ground = Mark("slab", "ground slab")
    solids = [
        marks.prism(
            first.slab, base - GROUND_SLAB_M, base, Mark("ground", "ground slab"), ground, ground
        )
    ]
    for index, space in enumerate(spaces):
        above = spaces[index + 1] if index + 1 < len(spaces) else None
        solids += _storey(space, above, slab_m, marks)
    notes = []
    for name, roof in _roofs(part).items():
        if roof is None:
            notes.append(f"{name} is no closed solid: house.city.json has no roof there")
        else:
            solids.append(marks.marked(roof, one_mark(Mark("roof", name))))
            solids += _joints(last, roof, marks)
    return joined(solids), notes


def _storey(
    space: Space, above: Space | None, slab_m: float, marks: Marks
) -> list[manifold3d.Manifold]:
    storey = space.storey
    floor, top = storey.elevation_m, storey.elevation_m + storey.height_m
    solids = []
    if not space.walls.is_empty:
        names = WallNames(space)

        def wall_mark(middle: NDArray[np.float64], normal: NDArray[np.float64]) -> Mark:
            return Mark("wall", names.of(middle, normal)[0])

        walls = marks.marked(wall_solid(space, storey.height_m - slab_m), wall_mark)
        solids.append(walls.translate([0.0, 0.0, floor]))
    for hole in space.holes:
        if is_shut(hole):
            solids.append(_panel(hole, space, marks))
    for room, region in space.floors:
        if room is not None and room.outdoors:
            mark = Mark("outer floor", f"{storey.name} {room.id} floor")
            solids.append(marks.prism(region, floor, floor + FINISH_M, mark, mark, mark))
    slab = Mark("slab", f"{storey.name} slab")
    over = slab_over(space, above)
    if not over.is_empty:
        solids.append(marks.prism(over, top - slab_m, top, slab, slab, slab))
    return solids


def _panel(hole: Hole, space: Space, marks: Marks) -> manifold3d.Manifold:
    kind = hole.opening.kind
    mark = Mark(
        "window" if kind == "window" else "door", f"{space.storey.name} {kind} {hole.opening.id}"
    )
    region = hole.line.piece(hole.start_m - INTO_M, hole.end_m + INTO_M, panel_half_m(hole))
    floor = space.storey.elevation_m
    return marks.prism(
        region, floor + hole.low_m - INTO_M, floor + hole.high_m + INTO_M, mark, mark, mark
    )


def _roofs(part: Part) -> dict[str, manifold3d.Manifold | None]:
    """The roofs of the part by their features; None where one is not closed."""
    found: dict[str, manifold3d.Manifold | None] = {}
    for feature in np.flatnonzero(part.features.class_code == SemanticClass.ROOF.code).tolist():
        found[part.features.name[feature]] = solid_of(part, [feature])
    return found


def solid_of(part: Part, features: Sequence[int]) -> manifold3d.Manifold | None:
    """The solid that the polygons of features close; None where they close none.

    Bodies that reach into each other become one.
    """
    chosen = np.isin(part.polygon_feature, features)[part.triangles.polygon]
    corners = part.positions_m[part.triangles.indices[chosen].reshape(-1)].astype(np.float64)
    if not len(corners):
        return None
    points, number = np.unique(corners, axis=0, return_inverse=True)
    mesh = manifold3d.Mesh64(points, number.reshape(-1, 3).astype(np.uint64))
    mesh.merge()
    solid = manifold3d.Manifold(mesh)
    if solid.status() != manifold3d.Error.NoError or solid.is_empty():
        return None
    return joined(solid.decompose())


def _joints(last: Space, roof: manifold3d.Manifold, marks: Marks) -> list[manifold3d.Manifold]:
    """What fills the joints between a roof and what it lies on, in single precision, and beside."""
    slab = Mark("slab", f"{last.storey.name} slab")
    top = last.storey.elevation_m + last.storey.height_m
    eaves = roof.bounding_box()[2]
    inner = last.covered.buffer(-_JOINT_M, join_style="mitre")
    edge = last.covered.buffer(_JOINT_M / 2.0, join_style="mitre").difference(
        last.covered.buffer(-_EDGE_M, join_style="mitre")
    )
    ends = [(inner, top - _EDGE_M), (edge, eaves)] if eaves < top else [(inner, top - _EDGE_M)]
    return [
        marks.prism(region, low, top + UNDER_M - _JOINT_M, slab, slab, slab)
        for region, low in ends
        if not region.is_empty
    ]
