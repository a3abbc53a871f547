"""Stairs, railings, lamps and the roof in IFC4, each with its colours, materials, type, properties
and where it comes from.

Colours and materials are those of the house's model: invented, as no plan says them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import SemanticClass
from veduta.plan.house.build import House
from veduta.plan.house.space import Space
from veduta.plan.house.stair_pieces import StairPieces
from veduta.plan.outputs.ifc_finish import mean_colour
from veduta.plan.outputs.ifc_looks import Describer
from veduta.plan.outputs.ifc_model import Entity, Model

Piece = tuple[Material, NDArray[np.float64], NDArray[np.int64]]
"""What has one material: (n, 3) points and (m, 3) triangles."""


def pieces_of_part(part: Part, features: Sequence[int], up_m: float) -> list[Piece]:
    """Some features of a part, a piece for each material, from so high above its origin on."""
    chosen = np.isin(part.polygon_feature, features)[part.triangles.polygon]
    triangles = part.triangles.indices[chosen]
    material = part.polygon_material[part.triangles.polygon[chosen]]
    found = []
    for number in np.unique(material).tolist():
        used, corners = np.unique(triangles[material == number], return_inverse=True)
        points = part.positions_m[used].astype(np.float64) - np.array([0.0, 0.0, up_m])
        found.append((part.materials[number], points, corners.reshape(-1, 3).astype(np.int64)))
    return found


def coloured(model: Model, describer: Describer, pieces: Sequence[Piece]) -> Entity:
    """The shape of one element, of pieces each in its material's colour."""
    shape = tessellation(model, describer, pieces)
    return model.make("IfcProductDefinitionShape", Representations=[shape])


def tessellation(model: Model, describer: Describer, pieces: Sequence[Piece]) -> Entity:
    """A representation of pieces, each in its material's colour."""
    items = []
    for material, points, triangles in pieces:
        corners = model.make("IfcCartesianPointList3D", points.round(5).tolist())
        item = model.make(
            "IfcTriangulatedFaceSet", Coordinates=corners, CoordIndex=(triangles + 1).tolist()
        )
        describer.finished(item, material.name, mean_colour(material), 1.0 - material.opacity)
        items.append(item)
    return model.make("IfcShapeRepresentation", model.body, "Body", "Tessellation", items)


def names_of(pieces: Sequence[Piece]) -> tuple[str, ...]:
    """Of the materials, each once."""
    return tuple(dict.fromkeys(material.name for material, _, _ in pieces))


def describe_stair(
    describer: Describer, stair: Entity, flight: Entity, one: StairPieces, names: tuple[str, ...]
) -> None:
    """A stair and its flight: risers, treads, and the plan that it stands in."""
    risers = one.stairs.treads + 1
    steps: Mapping[str, object] = {
        "NumberOfRiser": risers,
        "NumberOfTreads": one.stairs.treads,
        "RiserHeight": float(one.rise_m / risers),
    }
    called = f"stair of {one.stairs.treads} treads"
    for entity, word, kind in ((stair, "Stair", "stair"), (flight, "StairFlight", "flight")):
        describer.made_of_all(entity, names)
        said = {"Reference": called, **steps} if kind == "stair" else steps
        describer.typed(
            entity, f"Ifc{word}Type", f"{called} {kind} {entity.PredefinedType}",
            PredefinedType=entity.PredefinedType,
        )  # fmt: skip
        describer.properties(entity, f"Pset_{word}Common", said)
        describer.provenance(entity, one.stairs.origin, one.stairs.score)


def describe_railing(describer: Describer, railing: Entity, names: tuple[str, ...]) -> None:
    """A railing: no plan draws them."""
    kind = railing.PredefinedType
    describer.made_of_all(railing, names)
    describer.typed(railing, "IfcRailingType", kind.lower(), PredefinedType=kind)
    said = {"Reference": kind.lower(), "IsExternal": False}
    describer.properties(railing, "Pset_RailingCommon", said)
    describer.provenance(railing, "invented")


def lamps_of(
    model: Model, describer: Describer, house: House, space: Space, storey: Entity
) -> list[Entity]:
    """A light fixture for each lamp that has a body of its own, as it is in the part."""
    names = {f"{space.storey.name} light {light.id}": light for light in space.storey.lights or []}
    found = []
    for feature, name in enumerate(house.part.features.name):
        light = names.get(name)
        if light is None:
            continue
        fixture = model.product(
            "IfcLightFixture", name, storey.ObjectPlacement,
            ObjectType=light.kind, PredefinedType="POINTSOURCE",
        )  # fmt: skip
        pieces = pieces_of_part(house.part, [feature], space.storey.elevation_m)
        fixture.Representation = coloured(model, describer, pieces)
        describer.made_of_all(fixture, names_of(pieces))
        called = f"{light.kind} lamp"
        describer.typed(fixture, "IfcLightFixtureType", called, PredefinedType="POINTSOURCE")
        said = {"Reference": called, "NumberOfSources": 1}
        describer.properties(fixture, "Pset_LightFixtureTypeCommon", said)
        describer.properties(fixture, "Veduta_Lamp", {"Lumen": float(light.lumen)})
        describer.provenance(fixture, light.origin)
        found.append(fixture)
    return found


def roof_of(model: Model, describer: Describer, house: House) -> Entity | None:
    """The roof as it is in the part, its triangles about the building's origin."""
    is_roof = house.part.features.class_code == SemanticClass.ROOF.code
    pieces = pieces_of_part(house.part, np.flatnonzero(is_roof).tolist(), 0.0)
    if not pieces:
        return None
    roof = model.product("IfcRoof", "Roof", model.building.ObjectPlacement)
    roof.PredefinedType = "NOTDEFINED"
    roof.Representation = coloured(model, describer, pieces)
    describer.made_of_all(roof, names_of(pieces))
    describer.typed(roof, "IfcRoofType", "roof", PredefinedType="NOTDEFINED")
    describer.properties(roof, "Pset_RoofCommon", {"Reference": "roof", "IsExternal": True})
    describer.provenance(roof, "invented")
    return roof
