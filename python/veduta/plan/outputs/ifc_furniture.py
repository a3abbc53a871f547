"""Furniture in IFC4: an element for each thing, an object's shape once for all of its kind."""

from __future__ import annotations

import numpy as np

from veduta.place.material import Material
from veduta.plan.document import Furniture, Storey
from veduta.plan.furnish.catalogue.entry import Entry, Finish, ObjectClass, Size
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.shapes import asset_of, finishes_of
from veduta.plan.house.floors import FINISH_M
from veduta.plan.house.furniture import material_of
from veduta.plan.outputs.ifc_looks import Describer
from veduta.plan.outputs.ifc_model import Entity, Model
from veduta.plan.outputs.ifc_parts import Piece, names_of, tessellation

CLASSES: dict[ObjectClass, str] = {
    "sanitary": "IfcSanitaryTerminal",
    "appliance": "IfcElectricAppliance",
    "lamp": "IfcLightFixture",
    "vehicle": "IfcBuildingElementProxy",
    "works": "IfcBuildingElementProxy",
    "plant": "IfcBuildingElementProxy",
}
"""Others are IfcFurniture."""
COMMON: dict[str, str] = {
    "IfcFurniture": "Pset_FurnitureTypeCommon",
    "IfcSanitaryTerminal": "Pset_SanitaryTerminalTypeCommon",
    "IfcElectricAppliance": "Pset_ElectricApplianceTypeCommon",
    "IfcLightFixture": "Pset_LightFixtureTypeCommon",
    "IfcBuildingElementProxy": "Pset_BuildingElementProxyCommon",
}
"""The property set of each class."""
PREDEFINED: dict[str, str] = {
    "chair": "CHAIR", "armchair": "CHAIR", "office-chair": "CHAIR", "garden-chair": "CHAIR",
    "sofa": "SOFA", "corner-sofa": "SOFA", "desk": "DESK", "bookcase": "SHELF",
    "shelf-rack": "SHELF", "wall-shelf": "SHELF", "bookcase-low": "SHELF",
    "dining-table": "TABLE", "round-table": "TABLE", "coffee-table": "TABLE",
    "side-table": "TABLE", "garden-table": "TABLE", "console": "TABLE",
    "bed-double": "BED", "bed-single": "BED", "bunk-bed": "BED",
    "toilet": "TOILETPAN", "bidet": "BIDET", "bathtub": "BATH", "bathtub-free": "BATH",
    "shower": "SHOWER", "basin": "WASHHANDBASIN", "handbasin": "WASHHANDBASIN",
    "basin-double": "WASHHANDBASIN", "utility-sink": "SINK",
    "fridge": "FRIDGE_FREEZER", "fridge-small": "REFRIGERATOR", "fridge-double": "FRIDGE_FREEZER",
    "washer": "WASHINGMACHINE", "dryer": "TUMBLEDRYER", "dishwasher": "DISHWASHER",
    "microwave": "MICROWAVE", "oven-tower": "ELECTRICCOOKER",
}  # fmt: skip
"""By the type of an object; others are not defined further."""


class FurnitureMaker:
    """Makes the elements of things; shapes are coarse ones, each once in the file."""

    def __init__(self, model: Model, catalogue: Catalogue, describer: Describer) -> None:
        self._model, self._catalogue, self._describer = model, catalogue, describer
        self._maps: dict[tuple[str, Size], tuple[Entity, tuple[str, ...]]] = {}
        self._materials: dict[Finish, Material] = {}

    def of_storey(self, storey: Storey, place: Entity) -> list[Entity]:
        """The things of a storey, in its placement."""
        return [self._element(thing, storey.name, place) for thing in storey.furniture or ()]

    def _element(self, thing: Furniture, storey: str, place: Entity) -> Entity:
        entry = self._catalogue.entries[thing.object]
        element = self._model.product(
            CLASSES.get(entry.kind, "IfcFurniture"), f"{storey} {thing.object} {thing.id}", place,
            ObjectType=thing.object,
        )  # fmt: skip
        if hasattr(element, "PredefinedType"):
            try:
                element.PredefinedType = PREDEFINED.get(entry.type, "NOTDEFINED")
            except RuntimeError:  # a catalogue of the user's may have the type in another class
                element.PredefinedType = "NOTDEFINED"
        element.ObjectPlacement.RelativePlacement = self._axes(
            (*thing.at_m, thing.above_m + FINISH_M), thing.turn_rad
        )
        element.Representation = self._shape(entry, thing.size_m)
        self._describe(element, entry, thing)
        return element

    def _describe(self, element: Entity, entry: Entry, thing: Furniture) -> None:
        """Its type and materials, and whether the plan draws it."""
        describer, kind = self._describer, element.is_a()
        described = {"PredefinedType": element.PredefinedType or "NOTDEFINED"}
        if kind == "IfcFurniture":
            described["AssemblyPlace"] = "NOTDEFINED"
        describer.typed(element, f"{kind}Type", f"{entry.name} {_size(thing.size_m)}", **described)
        describer.made_of_all(element, self._maps[entry.name, thing.size_m][1])
        if kind in COMMON:
            describer.properties(element, COMMON[kind], {"Reference": entry.name})
        describer.provenance(element, thing.origin)

    def _shape(self, entry: Entry, size_m: Size) -> Entity:
        make = self._model.make
        key = (entry.name, size_m)
        if key not in self._maps:
            pieces = self._pieces(entry, size_m)
            own = tessellation(self._model, self._describer, pieces)
            mapped = make("IfcRepresentationMap", self._axes((0.0, 0.0, 0.0), 0.0), own)
            self._maps[key] = (mapped, names_of(pieces))
        origin = make("IfcCartesianPoint", (0.0, 0.0, 0.0))
        as_it_is = make("IfcCartesianTransformationOperator3D", LocalOrigin=origin)
        item = make("IfcMappedItem", self._maps[key][0], as_it_is)
        shown = make(
            "IfcShapeRepresentation", self._model.body, "Body", "MappedRepresentation", [item]
        )
        return make("IfcProductDefinitionShape", Representations=[shown])

    def _pieces(self, entry: Entry, size_m: Size) -> list[Piece]:
        """The shape of an object, a piece for each finish."""
        asset = asset_of(entry, size_m, self._catalogue, coarse=True)
        indices, face, _ = asset.triangles
        points = asset.points_m @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
        corners, slot = asset.corners[indices].astype(np.int64), asset.face_slot[face]
        found = []
        for number, look in enumerate(finishes_of(asset, entry, self._catalogue)):
            if (slot == number).any():
                used, own = np.unique(corners[slot == number], return_inverse=True)
                found.append((self._material(look), points[used], own.reshape(-1, 3)))
        return found

    def _material(self, look: Finish) -> Material:
        if look not in self._materials:
            self._materials[look] = material_of(look)
        return self._materials[look]

    def _axes(self, at: tuple[float, float, float], turn_rad: float) -> Entity:
        make = self._model.make
        ahead = (float(np.cos(turn_rad)), float(np.sin(turn_rad)), 0.0)
        return make(
            "IfcAxis2Placement3D", make("IfcCartesianPoint", tuple(float(v) for v in at)),
            make("IfcDirection", (0.0, 0.0, 1.0)), make("IfcDirection", ahead),
        )  # fmt: skip


def _size(size_m: Size) -> str:
    return " x ".join(f"{100.0 * side:.0f}" for side in size_m) + " cm"
