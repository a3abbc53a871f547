"""Slabs, floors, ceilings and skirting of a storey."""

from __future__ import annotations

from dataclasses import replace

from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.document import Room
from veduta.plan.house.frame import Sculptor, Surface, level
from veduta.plan.house.looks import floor_look, has_skirting
from veduta.plan.house.space import Space, solid_region

FINISH_M = 0.01
SKIRTING_M = (0.012, 0.07)
"""How deep and how high it is."""


def add_slab(
    region: BaseGeometry, low_m: float, high_m: float, name: str, sculptor: Sculptor
) -> None:
    """A slab, whose edge is seen from outside."""
    if region.is_empty:
        return
    feature = sculptor.builder.feature(
        SemanticClass.OTHER, Provenance.INVENTED, name, shell=sculptor.builder.new_shell()
    )
    sculptor.prism(
        region, low_m, high_m, level(0.0), Surface(feature, "slab"), side=Surface(feature, "facade")
    )


def slab_over(space: Space, above: Space | None) -> BaseGeometry:
    """The slab over a storey, open where stairs come up."""
    over = space.covered
    if above is not None:
        over = over.union(above.slab).difference(above.well)
    return solid_region(over)


def add_floors(space: Space, sculptor: Sculptor) -> None:
    """What one walks on: a finish in each room, and a threshold in each opening to the floor."""
    frame = level(space.storey.elevation_m)
    names = _names(space)
    for (room, region), name in zip(space.floors, names, strict=True):
        feature = _surface(sculptor, SemanticClass.FLOOR, room, f"{name} floor")
        sculptor.prism(region, 0.0, FINISH_M, frame, Surface(feature, floor_look(room)))
    doors = [hole for hole in space.holes if hole.reaches_floor]
    for hole in doors:
        region = hole.outline.intersection(space.walls)
        name = f"{space.storey.name} threshold {hole.opening.id}"
        room = hole.left or hole.right
        feature = _surface(sculptor, SemanticClass.FLOOR, room, name)
        inner = room if hole.left and hole.right else None
        sculptor.prism(region, 0.0, FINISH_M, frame, Surface(feature, floor_look(inner)))


def add_ceilings(space: Space, height_m: float, opening: BaseGeometry, sculptor: Sculptor) -> None:
    """A coat below the slab above, in each room that is not outdoors, but for an opening in it."""
    frame = level(space.storey.elevation_m)
    # A ceiling goes on over the well in the floor.
    whole = replace(space, well=Polygon())
    for (room, floor), name in zip(whole.floors, _names(whole), strict=True):
        region = solid_region(floor.difference(opening))
        if (room is not None and room.outdoors) or region.is_empty:
            continue
        feature = _surface(sculptor, SemanticClass.CEILING, room, f"{name} ceiling")
        sculptor.prism(region, height_m - FINISH_M, height_m, frame, Surface(feature, "ceiling"))


def add_skirting(space: Space, sculptor: Sculptor) -> None:
    """A board along the walls of rooms that are not tiled, not before doors."""
    depth, height = SKIRTING_M
    frame = level(space.storey.elevation_m)
    openings = [hole.outline.buffer(0.06) for hole in space.holes if hole.low_m < height]
    openings.append(space.well.buffer(1e-3))
    walls = space.walls.buffer(depth, join_style="mitre")
    for room, region in space.floors:
        if room is None or not has_skirting(room):
            continue
        board = region.intersection(walls).difference(unary_union(openings))
        board = solid_region_of_boards(board)
        if board.is_empty:
            continue
        name = f"{space.storey.name} skirting {room.id}"
        feature = sculptor.builder.feature(
            SemanticClass.OTHER, Provenance.INVENTED, name,
            shell=sculptor.builder.new_shell(),
        )  # fmt: skip
        sculptor.prism(board, FINISH_M, height, frame, Surface(feature, "skirting"))


def solid_region_of_boards(board: BaseGeometry) -> BaseGeometry:
    """Boards as long as a hand at least."""
    return solid_region(board, least_m2=0.1 * SKIRTING_M[0])


def _names(space: Space) -> list[str]:
    return [space.name_of(room) for room, _ in space.floors]


def _surface(
    sculptor: Sculptor,
    semantic: SemanticClass,
    room: Room | None,
    name: str,
) -> int:
    measured = room is not None and room.origin == "measured" and semantic is SemanticClass.FLOOR
    return sculptor.builder.feature(
        semantic,
        Provenance.MEASURED if measured else Provenance.INFERRED,
        name,
        shell=sculptor.builder.new_shell(),
    )
