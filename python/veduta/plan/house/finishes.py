"""What photos of rooms say of their surfaces: paint on walls, tiles on walls and floors.

A wall between two rooms has a face in each: each face has the finish of its own room.
"""

from __future__ import annotations

from typing import Literal

from veduta.plan.document import PlanDocument, Room, Tiling, WallColour


def paint_name(colour: WallColour) -> str:
    """The name of the material: rooms of one colour share it."""
    return f"paint {hex_of(colour)}"


def hex_of(colour: WallColour) -> str:
    """`rrggbb`."""
    return "".join(f"{channel:02x}" for channel in colour.srgb)


def tiles_name(tiling: Tiling) -> str:
    """The name of the material."""
    width, height = tiling.size_m
    return f"{tiling.picture.removesuffix('.png')} {width:g} x {height:g}"


def laid_tiling(room: Room, surface: Literal["floor", "wall"]) -> Tiling | None:
    """The tiles that the whole surface has."""
    return next((one for one in room.tilings if one.laid and one.surface == surface), None)


def rooms_of(document: PlanDocument) -> list[Room]:
    """Of all storeys."""
    return [room for storey in document.storeys for room in storey.rooms]
