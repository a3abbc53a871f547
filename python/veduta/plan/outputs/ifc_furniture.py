"""Furniture in IFC4: an element for each thing, an object's shape once for all of its kind."""

from __future__ import annotations

import numpy as np

from veduta.grammar.assets.asset import Asset
from veduta.plan.document import Furniture, Storey
from veduta.plan.furnish.catalogue.entry import Entry, ObjectClass, Size
from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.plan.furnish.shapes import asset_of
from veduta.plan.house.floors import FINISH_M
from veduta.plan.outputs.ifc_model import Entity, Model

CLASSES: dict[ObjectClass, str] = {
    "sanitary": "IfcSanitaryTerminal",
    "appliance": "IfcElectricAppliance",
    "lamp": "IfcLightFixture",
    "vehicle": "IfcBuildingElementProxy",
    "works": "IfcBuildingElementProxy",
    "plant": "IfcBuildingElementProxy",
}
"""Others are IfcFurniture."""
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

    def __init__(self, model: Model, catalogue: Catalogue) -> None:
        self._model, self._catalogue = model, catalogue
        self._maps: dict[tuple[str, Size], Entity] = {}

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
        return element

    def _shape(self, entry: Entry, size_m: Size) -> Entity:
        make = self._model.make
        key = (entry.name, size_m)
        if key not in self._maps:
            asset = asset_of(entry, size_m, self._catalogue, coarse=True)
            own = make(
                "IfcShapeRepresentation", self._model.body, "Body", "Tessellation",
                [self._mesh(asset)],
            )  # fmt: skip
            self._maps[key] = make("IfcRepresentationMap", self._axes((0.0, 0.0, 0.0), 0.0), own)
        origin = make("IfcCartesianPoint", (0.0, 0.0, 0.0))
        as_it_is = make("IfcCartesianTransformationOperator3D", LocalOrigin=origin)
        item = make("IfcMappedItem", self._maps[key], as_it_is)
        shown = make(
            "IfcShapeRepresentation", self._model.body, "Body", "MappedRepresentation", [item]
        )
        return make("IfcProductDefinitionShape", Representations=[shown])

    def _mesh(self, asset: Asset) -> Entity:
        indices, _, _ = asset.triangles
        points = asset.points_m @ np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
        corners = self._model.make("IfcCartesianPointList3D", points.round(4).tolist())
        faces = asset.corners[indices].astype(np.int64).reshape(-1, 3) + 1
        return self._model.make(
            "IfcTriangulatedFaceSet", Coordinates=corners, CoordIndex=faces.tolist()
        )

    def _axes(self, at: tuple[float, float, float], turn_rad: float) -> Entity:
        make = self._model.make
        ahead = (float(np.cos(turn_rad)), float(np.sin(turn_rad)), 0.0)
        return make(
            "IfcAxis2Placement3D", make("IfcCartesianPoint", tuple(float(v) for v in at)),
            make("IfcDirection", (0.0, 0.0, 1.0)), make("IfcDirection", ahead),
        )  # fmt: skip
