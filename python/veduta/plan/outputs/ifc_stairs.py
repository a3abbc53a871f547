"""Stairs in IFC4: an IfcStair of flights and railings, and railings around openings in floors.

Shapes are those of the part, as triangles. No plan shows a height: risers follow from the storeys'.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.place.part import Part
from veduta.plan.house.build import House
from veduta.plan.house.stair_pieces import StairPieces, guard_rails, stair_pieces
from veduta.plan.outputs.ifc_model import Entity, Model


def add_stairs(model: Model, house: House, storeys: Sequence[Entity]) -> None:
    """The stairs of a house in the storeys in which they begin, rails of wells where one stands."""
    entity = {space.storey.name: own for space, own in zip(house.spaces, storeys, strict=True)}
    stairs: dict[str, list[Entity]] = {}
    rails: dict[str, list[Entity]] = {}
    for one in stair_pieces(house):
        name = one.space.storey.name
        stairs.setdefault(name, []).append(_stair(model, house, one, entity[name]))
    for space, name, feature in guard_rails(house):
        storey = entity[space.storey.name]
        rail = _railing(model, house, name, feature, storey.ObjectPlacement, "GUARDRAIL")
        rails.setdefault(space.storey.name, []).append(rail)
    for name, found in stairs.items():
        model.contain(entity[name], found, "stairs")
    for name, found in rails.items():
        model.contain(entity[name], found, "guard rails")


def _stair(model: Model, house: House, one: StairPieces, storey: Entity) -> Entity:
    stair = model.product("IfcStair", one.name, storey.ObjectPlacement, PredefinedType=_kind(one))
    place = stair.ObjectPlacement
    risers = one.stairs.treads + 1
    flight = model.product(
        "IfcStairFlight", f"{one.name} flight", place, PredefinedType="NOTDEFINED",
        NumberOfRisers=risers, NumberOfTreads=one.stairs.treads,
        RiserHeight=float(one.rise_m / risers),
    )  # fmt: skip
    features = [*one.body, *one.columns.values()]
    flight.Representation = _shape(model, house, features, place)
    rails = [
        _railing(model, house, name, feature, place, "HANDRAIL")
        for name, feature in one.rails.items()
    ]
    model.aggregate(stair, [flight, *rails], "parts")
    return stair


def _kind(one: StairPieces) -> str:
    """IfcStairTypeEnum: stairs that turn or have landings are not told apart."""
    return "NOTDEFINED" if one.stairs.steps_m else "STRAIGHT_RUN_STAIR"


def _railing(
    model: Model, house: House, name: str, feature: int, place: Entity, kind: str
) -> Entity:
    railing = model.product("IfcRailing", name, place, PredefinedType=kind)
    railing.Representation = _shape(model, house, [feature], place)
    return railing


def _shape(model: Model, house: House, features: Sequence[int], place: Entity) -> Entity:
    """Triangles about a placement, which lies straight above the part's origin."""
    points, corners = triangles_of(house.part, features)
    return model.mesh(points - np.array([0.0, 0.0, _up_m(place)]), corners)


def _up_m(place: Entity) -> float:
    """How high a placement lies, with all that it lies in."""
    height = 0.0
    while place is not None:
        height += float(place.RelativePlacement.Location.Coordinates[2])
        place = place.PlacementRelTo
    return height


def triangles_of(
    part: Part, features: Sequence[int]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """(n, 3) points and (m, 3) triangles of some features of a part."""
    chosen = np.isin(part.polygon_feature, features)[part.triangles.polygon]
    used, corners = np.unique(part.triangles.indices[chosen], return_inverse=True)
    points: NDArray[np.float64] = part.positions_m[used].astype(np.float64)
    return points, corners.reshape(-1, 3).astype(np.int64)
