"""Stairs in IFC4: an IfcStair of flights and railings, and railings around openings in floors.

Shapes are those of the part, as triangles. No plan shows a height: risers follow from the storeys'.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from veduta.plan.house.build import House
from veduta.plan.house.stair_pieces import StairPieces, guard_rails, stair_pieces
from veduta.plan.outputs.ifc_looks import Describer
from veduta.plan.outputs.ifc_model import Entity, Model
from veduta.plan.outputs.ifc_parts import (
    coloured,
    describe_railing,
    describe_stair,
    names_of,
    pieces_of_part,
)


def add_stairs(model: Model, describer: Describer, house: House, storeys: Sequence[Entity]) -> None:
    """The stairs of a house in the storeys in which they begin, rails of wells where one stands."""
    entity = {space.storey.name: own for space, own in zip(house.spaces, storeys, strict=True)}
    stairs: dict[str, list[Entity]] = {}
    rails: dict[str, list[Entity]] = {}
    for one in stair_pieces(house):
        name = one.space.storey.name
        stairs.setdefault(name, []).append(_stair(model, describer, house, one, entity[name]))
    for space, name, feature in guard_rails(house):
        storey = entity[space.storey.name]
        place = storey.ObjectPlacement
        rail = _railing(model, describer, house, name, feature, place, "GUARDRAIL")
        rails.setdefault(space.storey.name, []).append(rail)
    for name, found in stairs.items():
        model.contain(entity[name], found, "stairs")
    for name, found in rails.items():
        model.contain(entity[name], found, "guard rails")


def _stair(
    model: Model, describer: Describer, house: House, one: StairPieces, storey: Entity
) -> Entity:
    stair = model.product("IfcStair", one.name, storey.ObjectPlacement, PredefinedType=_kind(one))
    place = stair.ObjectPlacement
    risers = one.stairs.treads + 1
    flight = model.product(
        "IfcStairFlight", f"{one.name} flight", place, PredefinedType="NOTDEFINED",
        NumberOfRisers=risers, NumberOfTreads=one.stairs.treads,
        RiserHeight=float(one.rise_m / risers),
    )  # fmt: skip
    features = [*one.body, *one.columns.values()]
    pieces = pieces_of_part(house.part, features, _up_m(place))
    flight.Representation = coloured(model, describer, pieces)
    describe_stair(describer, stair, flight, one, names_of(pieces))
    rails = [
        _railing(model, describer, house, name, feature, place, "HANDRAIL")
        for name, feature in one.rails.items()
    ]
    model.aggregate(stair, [flight, *rails], "parts")
    return stair


def _kind(one: StairPieces) -> str:
    """IfcStairTypeEnum: stairs that turn or have landings are not told apart."""
    return "NOTDEFINED" if one.stairs.steps_m else "STRAIGHT_RUN_STAIR"


def _railing(
    model: Model,
    describer: Describer,
    house: House,
    name: str,
    feature: int,
    place: Entity,
    kind: Literal["HANDRAIL", "GUARDRAIL"],
) -> Entity:
    railing = model.product("IfcRailing", name, place, PredefinedType=kind)
    pieces = pieces_of_part(house.part, [feature], _up_m(place))
    railing.Representation = coloured(model, describer, pieces)
    describe_railing(describer, railing, names_of(pieces))
    return railing


def _up_m(place: Entity) -> float:
    """How high a placement lies, with all that it lies in."""
    height = 0.0
    while place is not None:
        height += float(place.RelativePlacement.Location.Coordinates[2])
        place = place.PlacementRelTo
    return height
