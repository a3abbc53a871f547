"""How walls run and meet in `house.ifc`, and what bounds each room."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from itertools import combinations

from veduta.plan.flat_walls import external_walls
from veduta.plan.house.build import House
from veduta.plan.house.space import Space
from veduta.plan.outputs.ifc_model import Entity, Model


def add_paths(model: Model, house: House, named: Mapping[str, Entity], *, flat: bool) -> None:
    """Axes of walls, their connections at junctions, and the boundaries of rooms.

    named: the file's elements by their names. flat: whether it is one in a larger house.
    """
    axis = model.make(
        "IfcGeometricRepresentationSubContext",
        ContextIdentifier="Axis",
        ContextType="Model",
        ParentContext=model.body.ParentContext,
        TargetView="GRAPH_VIEW",
    )
    for space in house.spaces:
        for name, line in space.lines.items():
            wall = named.get(f"{space.storey.name} wall {name}")
            if wall is not None and wall.Representation is not None:
                points = [
                    model.make("IfcCartesianPoint", (round(float(x), 5), round(float(y), 5)))
                    for x, y in line.points_m
                ]
                curve = model.make("IfcPolyline", points)
                shape = model.make("IfcShapeRepresentation", axis, "Axis", "Curve2D", [curve])
                whole = wall.Representation
                whole.Representations = [shape, *whole.Representations]
        _connections(model, space, named)
        _boundaries(model, space, named, external_walls(space.storey, flat=flat))


def _connections(model: Model, space: Space, named: Mapping[str, Entity]) -> None:
    """Each two walls that share a junction, and at which of their ends."""
    at: dict[str, list[tuple[str, str]]] = defaultdict(list)
    for name, line in space.lines.items():
        at[line.wall.start].append((name, "ATSTART"))
        at[line.wall.end].append((name, "ATEND"))
    for junction, ends in at.items():
        for (one, its), (other, others) in combinations(ends, 2):
            first, second = (named.get(f"{space.storey.name} wall {name}") for name in (one, other))
            if first is None or second is None or one == other:
                continue
            model.rooted(
                "IfcRelConnectsPathElements", f"{space.storey.name} {one} {other} at {junction}",
                RelatingElement=first, RelatedElement=second,
                RelatingPriorities=[], RelatedPriorities=[],
                RelatedConnectionType=others, RelatingConnectionType=its,
            )  # fmt: skip


def _boundaries(
    model: Model, space: Space, named: Mapping[str, Entity], external: set[str]
) -> None:
    """The walls around each room and the doors and windows in them."""
    on = {one.opening.id: one.line.wall.id in external for one in space.holes}
    for room in space.storey.rooms:
        own = named.get(f"{space.storey.name} {room.id}")
        if own is None:
            continue
        beside = [(f"{space.storey.name} wall {name}", name in external) for name in room.walls]
        beside += [(f"{space.storey.name} {name}", on.get(name, False)) for name in room.openings]
        for name, outer in beside:
            element = named.get(name)
            if element is not None:
                model.rooted(
                    "IfcRelSpaceBoundary", f"{own.Name} by {name}",
                    RelatingSpace=own, RelatedBuildingElement=element,
                    PhysicalOrVirtualBoundary="PHYSICAL",
                    InternalOrExternalBoundary="EXTERNAL" if outer else "INTERNAL",
                )  # fmt: skip
