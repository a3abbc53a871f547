"""`tileset.json`: the house as 3D Tiles 1.1; what stands in it is added where one is near."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.part_tile import part_tile
from veduta.formats.tiles import Tile, write_tileset
from veduta.place.part import Part
from veduta.place.subset import with_instances, with_polygons
from veduta.plan.house.build import House
from veduta.plan.house.contact_shadows import shadows_of
from veduta.plan.house.space import Space
from veduta.run.atomic import write_bytes

TILESET, FOLDER = "tileset.json", "tiles"
NAME = "House"
UNFURNISHED_M = 1.0
"""How much a house without furniture differs from one with it."""


def write_tiles(house: House, world_from_part: NDArray[np.float64], folder: Path) -> None:
    """Write the tree and its tiles into a folder that is there.

    world_from_part: (4, 4) where the house stands in its place.
    """
    (folder / FOLDER).mkdir(exist_ok=True)
    children = []
    part = house.part
    in_rooms = np.zeros(len(part.features), dtype=np.bool_)
    for number, space in enumerate(house.spaces, start=1):
        own = _things(part, space)
        in_rooms |= own
        inside = with_instances(with_polygons(part, own[part.polygon_feature]), own)
        if len(inside.polygon_feature) or inside.instances is not None:
            path = f"{FOLDER}/storey-{number}.glb"
            write_bytes(folder / path, part_tile(inside, NAME))
            children.append(Tile(inside.bounds_m, 0.0, path))
    shell = replace(with_polygons(part, ~in_rooms[part.polygon_feature]), instances=None)
    path = f"{FOLDER}/house.glb"
    write_bytes(folder / path, part_tile(shell, NAME))
    x, y, z = world_from_part[:3, 3].tolist()
    root = Tile(
        part.bounds_m, UNFURNISHED_M if children else 0.0, path, tuple(children), world_from_part,
        (x, y, z), "ADD",
    )  # fmt: skip
    write_tileset(root, folder / TILESET)


def _things(part: Part, space: Space) -> NDArray[np.bool_]:
    """(f,) the features of a storey's furniture and lamps, and of the shadows under them."""
    storey = space.storey
    names = {f"{storey.name} {thing.object} {thing.id}" for thing in storey.furniture or ()}
    names |= {f"{storey.name} light {light.id}" for light in storey.lights or ()}
    names |= {shadows_of(space, room) for room, _ in space.rooms}
    return np.array([name in names for name in part.features.name], dtype=np.bool_)
