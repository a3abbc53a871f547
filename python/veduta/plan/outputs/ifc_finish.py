"""Paint and tiles of rooms in IFC4: coverings of a room's walls and floor, each with its colour.

Those of rooms that have a finish of their own: by a photo, or by who edited the document. The faces
are those of the house's part, a little before the wall, which is a solid without finishes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from veduta.imaging.srgb import linear_of_srgb, srgb_of_linear
from veduta.place.material import Colour, Material
from veduta.place.part import Part
from veduta.plan.document import Room
from veduta.plan.house.finishes import hex_of, laid_tiling
from veduta.plan.house.space import Space
from veduta.plan.outputs.ifc_model import Entity, Model

Kind = Literal["CLADDING", "FLOORING"]
BEFORE_M = 0.001
"""A covering lies so far before the wall: at the same place, viewers show either."""


def finishes_of(
    model: Model, part: Part, space: Space, place: Entity, rooms: Sequence[Entity]
) -> list[Entity]:
    """The coverings of a storey. rooms: its spaces; each is told what covers it."""
    own = {entity.Name: entity for entity in rooms}
    found = []
    for room in space.storey.rooms:
        entity = own.get(f"{space.storey.name} {room.id}")
        told = _told(room)
        if entity is None or not told:
            continue
        coverings = _coverings(model, part, space, room, place)
        if coverings:
            model.rooted(
                "IfcRelCoversSpaces", f"{entity.Name} coverings",
                RelatingSpace=entity, RelatedCoverings=coverings,
            )  # fmt: skip
        _tell(model, entity, told)
        found += coverings
    return found


def _told(room: Room) -> dict[str, str]:
    """What covers the walls and the floor, by the names of Pset_SpaceCoveringRequirements."""
    found = {}
    if room.wall_colour is not None and not room.outdoors:
        found["WallCovering"] = f"paint #{hex_of(room.wall_colour)}"
    surfaces: tuple[tuple[Literal["floor", "wall"], str], ...] = (
        ("wall", "WallCovering"),
        ("floor", "FloorCovering"),
    )
    for surface, name in surfaces:
        tiling = laid_tiling(room, surface)
        if tiling is not None and not (surface == "wall" and room.outdoors):
            width, height = (100.0 * side for side in tiling.size_m)
            found[name] = f"tiles {width:g} x {height:g} cm"
    return found


def _tell(model: Model, entity: Entity, told: dict[str, str]) -> None:
    values = [
        model.make("IfcPropertySingleValue", Name=name, NominalValue=model.make("IfcLabel", text))
        for name, text in told.items()
    ]
    name = f"{entity.Name} coverings required"
    properties = model.rooted("IfcPropertySet", name, HasProperties=values)
    properties.Name = "Pset_SpaceCoveringRequirements"
    model.rooted(
        "IfcRelDefinesByProperties", f"{name} of space",
        RelatedObjects=[entity], RelatingPropertyDefinition=properties,
    )  # fmt: skip


def _coverings(model: Model, part: Part, space: Space, room: Room, place: Entity) -> list[Entity]:
    """What is on the walls and on the floor, as far as the room says it."""
    storey, told = space.storey.name, _told(room)
    names = np.array(part.features.name, dtype=object)
    walls = [
        str(name).startswith(f"{storey} wall ") and str(name).endswith(f" in {room.id}")
        for name in names
    ]
    asked: tuple[tuple[str, Kind, NDArray[np.bool_]], ...] = (
        ("WallCovering", "CLADDING", np.array(walls, dtype=np.bool_)),
        ("FloorCovering", "FLOORING", names == f"{storey} {room.id} floor"),
    )
    found = []
    for name, kind, features in asked:
        polygons = features[part.polygon_feature]
        if name not in told or not polygons.any():
            continue
        covering = model.product(
            "IfcCovering", f"{storey} {room.id} {name}", place,
            ObjectType=told[name], PredefinedType=kind,
        )  # fmt: skip
        points, triangles = _faces(part, polygons, space.storey.elevation_m)
        covering.Representation = model.mesh(points, triangles)
        (item,) = covering.Representation.Representations[0].Items
        material = part.materials[int(part.polygon_material[polygons][0])]
        _style(model, item, material)
        found.append(covering)
    return found


def _faces(
    part: Part, polygons: NDArray[np.bool_], elevation_m: float
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """(3 m, 3) points and (m, 3) triangles, a little before the faces, above the storey's floor."""
    chosen = polygons[part.triangles.polygon]
    normals = part.triangles.polygon_normal[part.triangles.polygon[chosen]]
    corners = part.positions_m[part.triangles.indices[chosen]].astype(np.float64)
    moved = corners + BEFORE_M * normals[:, None] - np.array([0.0, 0.0, elevation_m])
    triangles = np.arange(3 * len(moved), dtype=np.int64).reshape(-1, 3)
    return moved.reshape(-1, 3), triangles


def _style(model: Model, item: Entity, material: Material) -> None:
    red, green, blue = mean_colour(material)
    colour = model.make("IfcColourRgb", Red=red, Green=green, Blue=blue)
    shading = model.make(
        "IfcSurfaceStyleRendering", SurfaceColour=colour, ReflectanceMethod="NOTDEFINED"
    )
    style = model.make("IfcSurfaceStyle", Name=material.name, Side="BOTH", Styles=[shading])
    model.make("IfcStyledItem", Item=item, Styles=[style])


def mean_colour(material: Material) -> Colour:
    """The colour from afar (sRGB, 0 to 1): the mean of the light of its texture, if it has one."""
    light = linear_of_srgb(np.array(material.colour, dtype=np.float64))
    if material.texture is not None:
        pixels = material.texture.pixels.astype(np.float64) / 255.0
        light = light * linear_of_srgb(pixels).mean(axis=(0, 1))
    red, green, blue = (round(float(one), 5) for one in srgb_of_linear(light).clip(0.0, 1.0))
    return (red, green, blue)
