"""`house.ifc`: the house for BIM software, as IFC4 (ISO 16739-1:2018), in metres.

Project, site, building and storeys; walls with openings that doors and windows fill; slabs, the
roof, a space for each room, and lamps. Ids derive from what is named, so that a rebuild keeps them.
"""

from __future__ import annotations

import math
import uuid
from collections.abc import Sequence
from typing import Any, Literal

import ifcopenshell
import ifcopenshell.guid
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

import veduta
from veduta.plan.document import Opening
from veduta.plan.furnish.catalogue.read import catalogue_of
from veduta.plan.house.build import GROUND_SLAB_M, House
from veduta.plan.house.floors import slab_over
from veduta.plan.house.hole import Hole
from veduta.plan.house.sliding import SLIDING
from veduta.plan.house.space import Space, pieces_of
from veduta.plan.house.wall_regions import wall_regions
from veduta.plan.options import HouseOptions
from veduta.plan.outputs.ifc_cut import cut_pieces
from veduta.plan.outputs.ifc_finish import finishes_of
from veduta.plan.outputs.ifc_furniture import FurnitureMaker
from veduta.plan.outputs.ifc_looks import Describer, by_name, describe
from veduta.plan.outputs.ifc_parts import lamps_of, roof_of
from veduta.plan.outputs.ifc_paths import add_paths
from veduta.plan.outputs.ifc_stairs import add_stairs
from veduta.plan.surroundings.site import Site

Entity = Any
_NAMESPACE = uuid.UUID("5f0b7f0c-6a0e-4d3c-9d5e-2f4f0a5b7c11")
_PANEL_M = 0.05
VIEW = "ReferenceView_V1.2"
"""The model view definition of buildingSMART that the file keeps to."""
DoorOperation = Literal[
    "SINGLE_SWING_LEFT", "SINGLE_SWING_RIGHT", "DOUBLE_DOOR_SINGLE_SWING", "DOUBLE_DOOR_SLIDING",
    "SLIDING_TO_LEFT", "SLIDING_TO_RIGHT", "FOLDING_TO_LEFT", "FOLDING_TO_RIGHT",
    "DOUBLE_DOOR_FOLDING", "ROLLINGUP", "NOTDEFINED",
]  # fmt: skip


def house_ifc(house: House, options: HouseOptions, site: Site | None = None) -> bytes:
    """The file's content. site: north and the place on the earth, as far as they are known."""
    model = _Model(site or Site())
    describer = Describer(model)
    furniture = FurnitureMaker(model, catalogue_of(options.catalogue), describer)
    storeys = []
    for index, space in enumerate(house.spaces):
        above = house.spaces[index + 1] if index + 1 < len(house.spaces) else None
        storeys.append(_storey(model, space, above, options, is_lowest=index == 0))
        model.contain(storeys[-1], lamps_of(model, describer, house, space, storeys[-1]), "lamps")
        things = furniture.of_storey(space.storey, storeys[-1].ObjectPlacement)
        model.contain(storeys[-1], things, "furniture")
        rooms = [one for rel in storeys[-1].IsDecomposedBy for one in rel.RelatedObjects]
        place = storeys[-1].ObjectPlacement
        coverings = finishes_of(model, house.part, space, place, rooms)
        model.contain(storeys[-1], coverings, "finishes")
    model.aggregate(model.building, storeys, "storeys")
    add_stairs(model, describer, house, storeys)
    roof = roof_of(model, describer, house)
    if roof is not None:
        model.contain(storeys[-1], [roof], "roof")
    kinds = ("IfcWall", "IfcDoor", "IfcWindow", "IfcSlab", "IfcRoof", "IfcSpace")
    named = by_name(one for kind in kinds for one in model.file.by_type(kind))
    describe(describer, house, named, options)
    add_paths(model, house, named, flat=options.flat)
    return model.content()


class _Model:
    """The file as it grows, with what every model begins with."""

    def __init__(self, site: Site) -> None:
        self.file = ifcopenshell.file(schema="IFC4")
        self.body, project = self._project(site)
        self.site = self.product(
            "IfcSite", "Site", None, CompositionType="ELEMENT", **_on_earth(site)
        )
        self.building = self.product(
            "IfcBuilding", "House", self.site.ObjectPlacement, CompositionType="ELEMENT"
        )
        self.aggregate(project, [self.site], "site")
        self.aggregate(self.site, [self.building], "building")

    def make(self, kind: str, *values: Any, **named: Any) -> Entity:
        """An entity without an id of its own."""
        return self.file.create_entity(kind, *values, **named)

    def rooted(self, kind: str, name: str, **named: Any) -> Entity:
        """An entity with a stable id."""
        own = uuid.uuid5(_NAMESPACE, f"{kind} {name}")
        return self.make(kind, GlobalId=ifcopenshell.guid.compress(own.hex), Name=name, **named)

    def product(
        self, kind: str, name: str, within: Entity | None, up_m: float = 0.0, **named: Any
    ) -> Entity:
        """Something that stands somewhere; up_m: above the placement that it lies in."""
        placement = self.make("IfcLocalPlacement", within, self._axes((0.0, 0.0, up_m)))
        return self.rooted(kind, name, ObjectPlacement=placement, **named)

    def aggregate(self, whole: Entity, parts: Sequence[Entity], name: str) -> None:
        """Parts of a whole."""
        if parts:
            self.rooted(
                "IfcRelAggregates", f"{name} of {whole.Name}",
                RelatingObject=whole, RelatedObjects=list(parts),
            )  # fmt: skip

    def contain(self, storey: Entity, elements: Sequence[Entity], name: str) -> None:
        """Elements of a storey."""
        if elements:
            self.rooted(
                "IfcRelContainedInSpatialStructure", f"{name} of {storey.Name}",
                RelatingStructure=storey, RelatedElements=list(elements),
            )  # fmt: skip

    def solid(self, region: BaseGeometry, low_m: float, high_m: float) -> Entity:
        """A shape: a region drawn out between two heights."""
        return self.solids([(region, low_m, high_m)])

    def solids(
        self, pieces: Sequence[tuple[BaseGeometry, float, float]], identifier: str = "Body"
    ) -> Entity:
        """A shape of regions, each drawn out between two heights."""
        items = [
            self._extruded(piece, low_m, high_m)
            for region, low_m, high_m in pieces
            for piece in pieces_of(region)
        ]
        return self._shape("SweptSolid", items, identifier)

    def mesh(self, points: NDArray[np.float64], triangles: NDArray[np.int64]) -> Entity:
        """A shape: triangles. points: (n, 3). triangles: (m, 3)."""
        corners = self.make("IfcCartesianPointList3D", points.round(5).tolist())
        faces = self.make(
            "IfcTriangulatedFaceSet", Coordinates=corners, CoordIndex=(triangles + 1).tolist()
        )
        return self._shape("Tessellation", [faces])

    def content(self) -> bytes:
        """The file, the same for the same house."""
        header = self.file.header
        header.file_description.description = (f"ViewDefinition [{VIEW}]",)
        header.file_name.time_stamp = "1970-01-01T00:00:00"
        header.file_name.name = "house.ifc"
        header.file_name.originating_system = f"Veduta {veduta.__version__}"
        header.file_name.preprocessor_version = f"Veduta {veduta.__version__}"
        text: str = self.file.to_string()  # type: ignore[no-untyped-call]
        return text.encode()

    def _project(self, site: Site) -> tuple[Entity, Entity]:
        units = [
            self.make("IfcSIUnit", UnitType=kind, Name=name)
            for kind, name in (
                ("LENGTHUNIT", "METRE"),
                ("AREAUNIT", "SQUARE_METRE"),
                ("VOLUMEUNIT", "CUBIC_METRE"),
                ("PLANEANGLEUNIT", "RADIAN"),
            )
        ]
        context = self.make(
            "IfcGeometricRepresentationContext",
            ContextType="Model",
            CoordinateSpaceDimension=3,
            Precision=1e-5,
            WorldCoordinateSystem=self._axes((0.0, 0.0, 0.0)),
            **self._true_north(site),
        )
        body = self.make(
            "IfcGeometricRepresentationSubContext",
            ContextIdentifier="Body",
            ContextType="Model",
            ParentContext=context,
            TargetView="MODEL_VIEW",
        )
        project = self.rooted(
            "IfcProject", "House from a floor plan",
            RepresentationContexts=[context],
            UnitsInContext=self.make("IfcUnitAssignment", units),
        )  # fmt: skip
        return body, project

    def _true_north(self, site: Site) -> dict[str, Entity]:
        """Where north is on the page; nothing where it is not known."""
        if site.north_deg is None:
            return {}
        angle = math.radians(site.north_deg)
        way = (round(math.sin(angle), 9) + 0.0, round(math.cos(angle), 9) + 0.0)
        return {"TrueNorth": self.make("IfcDirection", way)}

    def _axes(self, at: tuple[float, float, float]) -> Entity:
        return self.make("IfcAxis2Placement3D", self.make("IfcCartesianPoint", at))

    def _shape(self, kind: str, items: list[Entity], identifier: str = "Body") -> Entity:
        shape = self.make("IfcShapeRepresentation", self.body, identifier, kind, items)
        return self.make("IfcProductDefinitionShape", Representations=[shape])

    def _extruded(self, piece: Polygon, low_m: float, high_m: float) -> Entity:
        shape = orient(piece)
        outer = self._curve(shape.exterior.coords)
        inner = [self._curve(ring.coords) for ring in shape.interiors]
        if inner:
            profile = self.make("IfcArbitraryProfileDefWithVoids", "AREA", None, outer, inner)
        else:
            profile = self.make("IfcArbitraryClosedProfileDef", "AREA", None, outer)
        up = self.make("IfcDirection", (0.0, 0.0, 1.0))
        return self.make(
            "IfcExtrudedAreaSolid", profile, self._axes((0.0, 0.0, low_m)), up, high_m - low_m
        )

    def _curve(self, ring: Any) -> Entity:
        points = [
            self.make("IfcCartesianPoint", (round(float(x), 6), round(float(y), 6)))
            for x, y in list(ring)[:-1]
        ]
        return self.make("IfcPolyline", [*points, points[0]])


def _on_earth(site: Site) -> dict[str, Any]:
    """Latitude and longitude of a place that is known (IfcCompoundPlaneAngleMeasure)."""
    if site.place_deg is None:
        return {}
    latitude, longitude = site.place_deg
    return {"RefLatitude": compound_angle(latitude), "RefLongitude": compound_angle(longitude)}


def compound_angle(angle_deg: float) -> tuple[int, int, int, int]:
    """Degrees, minutes, seconds and millionths of a second, all of the angle's sign."""
    sign = -1 if angle_deg < 0.0 else 1
    seconds, millionths = divmod(round(abs(angle_deg) * 3_600_000_000), 1_000_000)
    minutes, second = divmod(seconds, 60)
    degree, minute = divmod(minutes, 60)
    return sign * degree, sign * minute, sign * second, sign * millionths


def _storey(
    model: _Model, space: Space, above: Space | None, options: HouseOptions, *, is_lowest: bool
) -> Entity:
    """A storey with everything in it."""
    name, up = space.storey.name, space.storey.elevation_m
    storey = model.product(
        "IfcBuildingStorey", name, model.building.ObjectPlacement, up,
        CompositionType="ELEMENT", Elevation=up,
    )  # fmt: skip
    place = storey.ObjectPlacement
    height = space.storey.height_m - options.slab
    walls = _walls(model, space, height, place)
    fillings = [
        _opening(model, hole, walls[hole.line.wall.id], name, place) for hole in space.holes
    ]
    slabs = []
    if is_lowest:
        slabs.append(
            _slab(model, f"{name} floor", space.slab, (-GROUND_SLAB_M, 0.0), place, "BASESLAB")
        )
    over = slab_over(space, above)
    if not over.is_empty:
        ends = (height, height + options.slab)
        slabs.append(_slab(model, f"{name} ceiling", over, ends, place, "FLOOR"))
    elements = [*walls.values(), *(one for one in fillings if one is not None), *slabs]
    model.contain(storey, elements, "elements")
    spaces = _spaces(model, space, height, place)
    model.aggregate(storey, spaces, "rooms")
    return storey


def _walls(model: _Model, space: Space, height: float, place: Entity) -> dict[str, Entity]:
    found = {}
    for name, region in wall_regions(space).items():
        wall = space.lines[name].wall
        found[name] = model.product(
            "IfcWall", f"{space.storey.name} wall {name}", place,
            PredefinedType="SOLIDWALL" if wall.outer else "PARTITIONING",
        )  # fmt: skip
        if region.area > 1e-6:
            holes = [hole for hole in space.holes if hole.line.wall.id == name]
            found[name].Representation = model.solids(cut_pieces(region, holes, height))
    return found


def _opening(model: _Model, hole: Hole, wall: Entity, storey: str, place: Entity) -> Entity | None:
    """The void in the wall, and the door or window that fills it; None for a gap."""
    name = f"{storey} {hole.opening.id}"
    void = model.product("IfcOpeningElement", f"{name} opening", place, PredefinedType="OPENING")
    # The wall is cut already: this tells where, and is none of what is drawn.
    void.Representation = model.solids([(hole.outline, max(hole.low_m, 0.0), hole.high_m)],
        identifier="Reference")  # fmt: skip
    model.rooted(
        "IfcRelVoidsElement", f"{name} void",
        RelatingBuildingElement=wall, RelatedOpeningElement=void,
    )  # fmt: skip
    if hole.opening.kind == "gap":
        return None
    filling = _filling(model, hole, name, place)
    model.rooted(
        "IfcRelFillsElement", f"{name} filling",
        RelatingOpeningElement=void, RelatedBuildingElement=filling,
    )  # fmt: skip
    return filling


def _filling(model: _Model, hole: Hole, name: str, place: Entity) -> Entity:
    size = {"OverallHeight": hole.high_m - hole.low_m, "OverallWidth": hole.width_m}
    if hole.opening.kind == "window":
        filling = model.product("IfcWindow", name, place, PredefinedType="WINDOW", **size)
    else:
        filling = model.product(
            "IfcDoor", name, place,
            PredefinedType="GATE" if hole.type == "garage" else "DOOR",
            OperationType=door_operation(hole.opening),
            **size,
        )  # fmt: skip
    panel = hole.line.piece(hole.start_m, hole.end_m, _PANEL_M / 2.0)
    filling.Representation = model.solid(panel, hole.low_m, hole.high_m)
    return filling


def door_operation(opening: Opening) -> DoorOperation:
    """IFC's word for how a door opens (IfcDoorTypeOperationEnum).

    The hinges are at the left as seen by who looks in the direction in which the door opens.
    """
    at_left = (opening.hinge == "start") == (opening.swing == "left")
    if opening.type == "garage":
        return "ROLLINGUP"
    if opening.type in SLIDING and opening.hinge == "both":
        return "DOUBLE_DOOR_SLIDING"
    if opening.type == "folding" and opening.hinge == "both":
        return "DOUBLE_DOOR_FOLDING"
    if opening.type in {"double", "french"} or opening.hinge == "both":
        return "DOUBLE_DOOR_SINGLE_SWING"
    if opening.hinge == "none" or opening.swing == "none":
        return "NOTDEFINED"
    if opening.type in SLIDING:
        return "SLIDING_TO_LEFT" if at_left else "SLIDING_TO_RIGHT"
    if opening.type == "folding":
        return "FOLDING_TO_LEFT" if at_left else "FOLDING_TO_RIGHT"
    return "SINGLE_SWING_LEFT" if at_left else "SINGLE_SWING_RIGHT"


def _slab(
    model: _Model,
    name: str,
    region: BaseGeometry,
    ends_m: tuple[float, float],
    place: Entity,
    kind: Literal["FLOOR", "BASESLAB"],
) -> Entity:
    slab = model.product("IfcSlab", name, place, PredefinedType=kind)
    slab.Representation = model.solid(region, *ends_m)
    return slab


def _spaces(model: _Model, space: Space, height: float, place: Entity) -> list[Entity]:
    """A space for each room, with its floor area."""
    found = []
    for room, region in space.floors:
        if room is None:
            continue
        name = f"{space.storey.name} {room.id}"
        own = model.product(
            "IfcSpace", name, place, LongName=room.name or room.use, ObjectType=room.use,
            CompositionType="ELEMENT", PredefinedType="EXTERNAL" if room.outdoors else "INTERNAL",
        )  # fmt: skip
        own.Representation = model.solid(region, 0.0, height)
        area = model.make("IfcQuantityArea", Name="NetFloorArea", AreaValue=float(region.area))
        quantities = model.rooted(
            "IfcElementQuantity", f"{name} quantities", MethodOfMeasurement="BaseQuantities",
            Quantities=[area],
        )  # fmt: skip
        quantities.Name = "Qto_SpaceBaseQuantities"
        model.rooted(
            "IfcRelDefinesByProperties", f"{name} sizes",
            RelatedObjects=[own], RelatingPropertyDefinition=quantities,
        )  # fmt: skip
        found.append(own)
    return found
