"""What an architect looks for in `house.ifc`, besides shapes: materials, colours, types, property
sets and quantities, each on the element it is of.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from veduta.place.material import Colour
from veduta.plan.flat_walls import external_walls
from veduta.plan.house.build import House
from veduta.plan.house.hole import Hole
from veduta.plan.house.space import Space
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.ifc_model import Entity, Model

_LOOKS: dict[str, tuple[str, tuple[float, float, float], float]] = {
    "outer wall": ("Masonry", (0.86, 0.82, 0.76), 0.0),
    "inner wall": ("Lightweight partition", (0.93, 0.92, 0.90), 0.0),
    "door": ("Wood", (0.55, 0.38, 0.24), 0.0),
    "window": ("Glass", (0.62, 0.78, 0.86), 0.6),
    "slab": ("Concrete", (0.70, 0.70, 0.70), 0.0),
}
"""Kind of element: its material, its colour (sRGB, 0 to 1) and its transparency. All are invented:
no plan says them."""


class Describer:
    """Gives elements of a model materials, colours, types, properties and quantities."""

    def __init__(self, model: Model) -> None:
        self.model = model
        self._materials = {
            kind: model.make("IfcMaterial", Name=name, Category=kind)
            for kind, (name, _, _) in _LOOKS.items()
        }
        self._styles = {kind: self._style(kind) for kind in _LOOKS}
        self._members: dict[str, list[Entity]] = {}
        self._types: dict[str, tuple[Entity, list[Entity]]] = {}
        self._layers: dict[tuple[str, float], tuple[Entity, list[Entity]]] = {}
        self._finishes: dict[tuple[str, Colour, float], Entity] = {}
        self._plain: dict[str, Entity] = {}
        self._sets: dict[tuple[str, ...], list[Entity]] = {}

    def made_of(self, element: Entity, kind: str) -> None:
        """An element of one material, and of its colour."""
        self._members.setdefault(kind, []).append(element)
        self._coloured(element, kind)

    def layered(self, wall: Entity, kind: str, thickness_m: float) -> None:
        """A wall of one layer of its thickness, and of its colour."""
        key = (kind, round(thickness_m, 3))
        if key not in self._layers:
            layer = self.model.make(
                "IfcMaterialLayer", Material=self._materials[kind], LayerThickness=key[1]
            )
            layers = self.model.make(
                "IfcMaterialLayerSet", MaterialLayers=[layer], LayerSetName=_wall_name(*key)
            )
            self._layers[key] = (layers, [])
        self._layers[key][1].append(wall)
        self._coloured(wall, kind)

    def finished(self, item: Entity, name: str, colour: Colour, transparency: float) -> None:
        """A piece of a shape in its own colour (sRGB, 0 to 1)."""
        key = (name, colour, transparency)
        if key not in self._finishes:
            shade = self.model.make("IfcColourRgb", None, *colour)
            shading = self.model.make("IfcSurfaceStyleShading", shade, transparency)
            self._finishes[key] = self.model.make(
                "IfcSurfaceStyle", Name=name, Side="BOTH", Styles=[shading]
            )
        self.model.make("IfcStyledItem", Item=item, Styles=[self._finishes[key]])

    def made_of_all(self, element: Entity, names: tuple[str, ...]) -> None:
        """An element of these materials, each of a part of it; its pieces have their colours."""
        self._sets.setdefault(names, []).append(element)

    def typed(self, element: Entity, kind: str, name: str, **named: Any) -> None:
        """An element as one of a type, which is made once."""
        if name not in self._types:
            self._types[name] = (self.model.rooted(kind, name, **named), [])
        self._types[name][1].append(element)

    def properties(self, element: Entity, name: str, values: Mapping[str, object]) -> None:
        """A property set of an element: truth values, numbers, and words."""
        made = [
            self.model.make(
                "IfcPropertySingleValue", Name=key, NominalValue=self._value(key, value)
            )
            for key, value in values.items()
        ]
        own = self.model.rooted("IfcPropertySet", f"{element.Name} {name}", HasProperties=made)
        own.Name = name
        self._defines(element, own, name)

    def quantities(self, element: Entity, name: str, values: Mapping[str, float]) -> None:
        """Base quantities of an element: lengths, areas (`...Area`) and volumes (`...Volume`)."""
        made = []
        for key, value in values.items():
            kind = next((one for one in ("Area", "Volume") if key.endswith(one)), "Length")
            made.append(
                self.model.make(
                    f"IfcQuantity{kind}", Name=key, **{f"{kind}Value": round(float(value), 5)}
                )
            )
        own = self.model.rooted(
            "IfcElementQuantity",
            f"{element.Name} {name}",
            MethodOfMeasurement="BaseQuantities",
            Quantities=made,
        )
        own.Name = name
        self._defines(element, own, name)

    def provenance(self, element: Entity, origin: str, score: float | None = None) -> None:
        """Where an element comes from, and how sure it is."""
        values: dict[str, object] = {"Origin": origin}
        if score is not None:
            values["Score"] = float(score)
        self.properties(element, "Veduta_Provenance", values)

    def finish(self) -> None:
        """The relations to materials and types, one for all that share one."""
        for kind, members in self._members.items():
            self._associated(f"{kind} material", members, self._materials[kind])
        for (kind, thickness_m), (layers, walls) in self._layers.items():
            self._associated(f"{_wall_name(kind, thickness_m)} layers", walls, layers)
        for names, members in self._sets.items():
            self._associated(f"{', '.join(names)} materials", members, self._constituents(names))
        for name, (kind, members) in self._types.items():
            self.model.rooted(
                "IfcRelDefinesByType", f"{name} members",
                RelatedObjects=members, RelatingType=kind,
            )  # fmt: skip

    def _associated(self, name: str, members: list[Entity], material: Entity) -> None:
        self.model.rooted(
            "IfcRelAssociatesMaterial", name, RelatedObjects=members, RelatingMaterial=material
        )

    def _defines(self, element: Entity, definition: Entity, name: str) -> None:
        self.model.rooted(
            "IfcRelDefinesByProperties", f"{element.Name} has {name}",
            RelatedObjects=[element], RelatingPropertyDefinition=definition,
        )  # fmt: skip

    def _constituents(self, names: tuple[str, ...]) -> Entity:
        for name in names:
            if name not in self._plain:
                self._plain[name] = self.model.make("IfcMaterial", Name=name)
        if len(names) == 1:
            return self._plain[names[0]]
        parts = [
            self.model.make("IfcMaterialConstituent", Name=name, Material=self._plain[name])
            for name in names
        ]
        return self.model.make(
            "IfcMaterialConstituentSet", Name=", ".join(names), MaterialConstituents=parts
        )

    def _value(self, key: str, value: object) -> Entity:
        if isinstance(value, bool):
            return self.model.make("IfcBoolean", value)
        if isinstance(value, int):
            return self.model.make("IfcCountMeasure", value)
        if isinstance(value, float):
            kind = "IfcPositiveLengthMeasure" if key.endswith("Height") else "IfcReal"
            return self.model.make(kind, value)
        return self.model.make("IfcIdentifier" if key == "Reference" else "IfcLabel", str(value))

    def _style(self, kind: str) -> Entity:
        _, (red, green, blue), transparency = _LOOKS[kind]
        colour = self.model.make("IfcColourRgb", None, red, green, blue)
        shading = self.model.make("IfcSurfaceStyleShading", colour, transparency)
        return self.model.make("IfcSurfaceStyle", Name=kind, Side="BOTH", Styles=[shading])

    def _coloured(self, element: Entity, kind: str) -> None:
        if element.Representation is None:
            return
        for shape in element.Representation.Representations:
            for item in shape.Items:
                self.model.make("IfcStyledItem", Item=item, Styles=[self._styles[kind]])


def describe(
    describer: Describer, house: House, named: Mapping[str, Entity], options: HouseOptions
) -> None:
    """All elements of a house: named are those of the file, by the names that they have there."""
    for space in house.spaces:
        height = space.storey.height_m - options.slab
        external = external_walls(space.storey, flat=options.flat)
        for name in space.lines:
            wall = named.get(f"{space.storey.name} wall {name}")
            if wall is not None:
                _wall(describer, space, name, wall, height, is_external=name in external)
        for hole in space.holes:
            filling = named.get(f"{space.storey.name} {hole.opening.id}")
            if filling is not None:
                _filling(describer, hole, filling, is_external=hole.line.wall.id in external)
        for room in space.storey.rooms:
            own = named.get(f"{space.storey.name} {room.id}")
            if own is not None:
                said = {"Reference": room.use, "IsExternal": room.outdoors}
                describer.properties(own, "Pset_SpaceCommon", said)
                describer.provenance(own, room.use_origin, room.score)
    for entity in named.values():
        if entity.is_a("IfcSlab"):
            _slab(describer, entity)
    describer.finish()


def _wall(
    describer: Describer,
    space: Space,
    name: str,
    entity: Entity,
    height: float,
    *,
    is_external: bool,
) -> None:
    line = space.lines[name]
    wall = line.wall
    kind = "outer wall" if wall.outer else "inner wall"
    holes = [one for one in space.holes if one.line.wall.id == name]
    length, width = line.line.length, wall.thickness_m
    cut = sum(one.width_m * (one.high_m - one.low_m) for one in holes)
    side = length * height
    called = _wall_name(kind, width)
    describer.layered(entity, kind, width)
    use = "SOLIDWALL" if wall.outer else "PARTITIONING"
    describer.typed(entity, "IfcWallType", called, PredefinedType=use)
    describer.properties(
        entity, "Pset_WallCommon", {"Reference": called, "IsExternal": is_external}
    )
    describer.quantities(
        entity,
        "Qto_WallBaseQuantities",
        {
            "Length": length, "Width": width, "Height": height,
            "GrossFootprintArea": length * width, "GrossSideArea": side,
            "NetSideArea": max(side - cut, 0.0), "GrossVolume": side * width,
            "NetVolume": max(side - cut, 0.0) * width,
        },
    )  # fmt: skip
    describer.provenance(entity, wall.origin, wall.score)


def _filling(describer: Describer, hole: Hole, entity: Entity, *, is_external: bool) -> None:
    is_door = entity.is_a("IfcDoor")
    kind = "door" if is_door else "window"
    high, wide = hole.high_m - hole.low_m, hole.width_m
    called = f"{hole.type} {kind} {100 * wide:.0f} x {100 * high:.0f} cm"
    describer.made_of(entity, kind)
    if is_door:
        way = entity.OperationType or "NOTDEFINED"
        describer.typed(
            entity, "IfcDoorType", f"{called} {way}",
            PredefinedType=entity.PredefinedType, OperationType=way,
        )  # fmt: skip
    else:
        describer.typed(
            entity, "IfcWindowType", called,
            PredefinedType="WINDOW", PartitioningType="NOTDEFINED",
        )  # fmt: skip
    word = kind.capitalize()
    describer.properties(
        entity, f"Pset_{word}Common", {"Reference": called, "IsExternal": is_external}
    )
    describer.quantities(
        entity, f"Qto_{word}BaseQuantities", {"Width": wide, "Height": high, "Area": wide * high}
    )
    describer.provenance(entity, hole.opening.origin, hole.opening.score)


def _slab(describer: Describer, entity: Entity) -> None:
    describer.made_of(entity, "slab")
    on_ground = entity.PredefinedType == "BASESLAB"
    name = "ground slab" if on_ground else "floor slab"
    describer.typed(entity, "IfcSlabType", name, PredefinedType=entity.PredefinedType)
    describer.properties(entity, "Pset_SlabCommon", {"Reference": name, "IsExternal": on_ground})
    describer.provenance(entity, "invented")


def _wall_name(kind: str, thickness_m: float) -> str:
    return f"{kind} {1000 * thickness_m:.0f} mm"


def by_name(entities: Iterable[Entity]) -> dict[str, Entity]:
    """Elements by their names."""
    return {entity.Name: entity for entity in entities}
