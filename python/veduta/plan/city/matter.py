"""What a house is made of as one solid: walls, slabs, panels in openings, and the roof.

It is built from the same regions (`house.space`), walls (`house.walls`) and roofs as the part, not
cut from the part's faces.
Openings are shut: a panel stands in the middle of the wall, as thick as a window's frame.
"""

from __future__ import annotations

from collections.abc import Sequence

import manifold3d
import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry
from shapely.ops import substring

from veduta.place.part import Part
from veduta.plan.city.marked import Mark, Marks, joined, one_mark
from veduta.plan.house.build import GROUND_SLAB_M
from veduta.plan.house.eaves import UNDER_M
from veduta.plan.house.floors import FINISH_M, slab_over
from veduta.plan.house.hole import Hole
from veduta.plan.house.roof import Roof, roof_body
from veduta.plan.house.space import Space
from veduta.plan.house.walls import WallNames, extruded, wall_solid
from veduta.plan.options import HouseOptions

PANEL_M = 0.07
_THIN = 0.8
"""A panel is thinner than its wall."""
INTO_M = 0.01
"""How far what fills an opening reaches into the wall around it."""
_RIM_M = 0.1
_DEEP_M = 100.0
_JOINT_M = 0.02
_INTO_ROOF_M = 0.001
"""Roofs are built a little above their slab: this joins the two, out of sight."""


def is_shut(hole: Hole) -> bool:
    """Whether something hangs or stands in an opening: in gaps nothing does."""
    return hole.opening.kind == "window" or (
        hole.opening.kind == "door" and hole.opening.type != "plain"
    )


def panel_half_m(hole: Hole) -> float:
    """Half of the thickness of what shuts an opening."""
    return min(PANEL_M / 2.0, _THIN * hole.line.half_m)


def matter_of(spaces: Sequence[Space], slab_m: float, marks: Marks) -> manifold3d.Manifold:
    """The solid of the whole house but for its roof (the part's frame, m)."""
    first = spaces[0]
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
    return joined(solids)


def roofs_of(
    roofs: Sequence[Roof], last: Space, options: HouseOptions, marks: Marks
) -> tuple[list[manifold3d.Manifold], list[str]]:
    """The roofs over the highest storey, and which of them are no solids.

    They reach a little into the walls and the slab below, and no further into the rooms.
    """
    top = last.storey.elevation_m + last.storey.height_m
    inner = last.covered.buffer(-_RIM_M, join_style="mitre")
    solids, notes = [], []
    for roof in roofs:
        body = roof_body(roof, top, options)
        if body is None:
            notes.append(f"{roof.name} is no closed solid: house.city.json has no roof there")
            continue
        if not inner.is_empty:
            body = body - extruded(inner, top - _DEEP_M, top - options.slab / 2.0)
        solids.append(marks.marked(body, one_mark(Mark("roof", roof.name))))
    under = last.covered.buffer(-_JOINT_M, join_style="mitre")
    if solids and not under.is_empty:
        slab = Mark("slab", f"{last.storey.name} slab")
        ends = (top - _JOINT_M, top + UNDER_M + _INTO_ROOF_M)
        solids.append(marks.prism(under, *ends, slab, slab, slab))
    return solids, notes


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
        solids += [_threshold(hole, side, space, marks) for side in _outdoor_sides(hole)]
    for room, region in space.floors:
        if room is not None and room.outdoors:
            mark = Mark("outer floor", f"{storey.name} {room.id} floor")
            solids.append(marks.prism(region, floor, floor + FINISH_M, mark, mark, mark))
    slab = Mark("slab", f"{storey.name} slab")
    over = slab_over(space, above)
    if not over.is_empty:
        solids.append(marks.prism(over, top - slab_m, top, slab, slab, slab))
    return solids


def _outdoor_sides(hole: Hole) -> list[float]:
    """The sides of an opening to the floor on which one steps out."""
    sides = ((1.0, hole.left), (-1.0, hole.right))
    out = [side for side, room in sides if room is None or room.outdoors]
    return out if hole.reaches_floor and len(out) == 1 else []


def _threshold(hole: Hole, side: float, space: Space, marks: Marks) -> manifold3d.Manifold:
    mark = Mark("outer floor", f"{space.storey.name} threshold {hole.opening.id}")
    floor = space.storey.elevation_m
    region = half_of(hole, side, 0.0)
    return marks.prism(region, floor - INTO_M, floor + FINISH_M, mark, mark, mark)


def half_of(hole: Hole, side: float, beyond_m: float) -> BaseGeometry:
    """An opening from the middle of the wall to beyond its face.

    side: +1 to the left of the wall, -1 to the right.
    """
    part = substring(hole.line.line, hole.start_m - INTO_M, hole.end_m + INTO_M)
    reach = side * (hole.line.half_m + beyond_m)
    return part.buffer(reach, single_sided=True, cap_style="flat", join_style="mitre")


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
