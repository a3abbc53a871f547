"""A place as CityGML 2.0 (OGC 12-019) or 3.0 (OGC 20-010, 21-006), level of detail 3.

A part is a Building, bounded by surfaces of its classes; windows and doors are in the wall that
they open; balconies, chimneys and the like are installations. Each surface says where it comes from
(`provenance`, a generic attribute). Coordinates are the place's CRS, z up; of a place in none,
metres from its origin.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from lxml import etree
from numpy.typing import NDArray

from veduta.formats.city_objects import CitySurface, CityThing, XmlIds, city_things
from veduta.formats.place_dae import clean
from veduta.place.place import Place
from veduta.run.atomic import atomic_write

_GML2, _GML3 = "http://www.opengis.net/gml", "http://www.opengis.net/gml/3.2"
_V2 = {
    "core": "http://www.opengis.net/citygml/2.0",
    "bldg": "http://www.opengis.net/citygml/building/2.0",
    "gen": "http://www.opengis.net/citygml/generics/2.0",
    "gml": _GML2,
}
_V3 = {
    "core": "http://www.opengis.net/citygml/3.0",
    "con": "http://www.opengis.net/citygml/construction/3.0",
    "bldg": "http://www.opengis.net/citygml/building/3.0",
    "gen": "http://www.opengis.net/citygml/generics/3.0",
    "gml": _GML3,
}
_OPENINGS = ("Window", "Door")


def write_citygml2(place: Place, path: Path) -> None:
    """Write CityGML 2.0."""
    _write(place, path, _Writer(_V2, third=False, shift_m=_shift(place), ids=XmlIds()))


def write_citygml3(place: Place, path: Path) -> None:
    """Write CityGML 3.0."""
    _write(place, path, _Writer(_V3, third=True, shift_m=_shift(place), ids=XmlIds()))


def _shift(place: Place) -> NDArray[np.float64]:
    return np.array(place.origin_m if place.crs else (0.0, 0.0, 0.0))


def _write(place: Place, path: Path, writer: _Writer) -> None:
    """Write building by building: the whole is never in memory."""
    told = {}
    if place.crs:
        authority, _, code = place.crs.partition(":")
        told["srsName"] = f"http://www.opengis.net/def/crs/{authority}/0/{code}"
        told["srsDimension"] = "3"
    with (
        atomic_write(path) as temporary,
        etree.xmlfile(str(temporary), encoding="UTF-8") as file,
    ):
        file.write_declaration()
        with file.element(writer.tag("core:CityModel"), nsmap=writer.names):
            if place.title:
                name = etree.Element(writer.tag("gml:name"), nsmap=writer.names)
                name.text = clean(place.title)
                file.write(name)
            corners = place.bounds_m() if place.crs else None
            if corners is not None:
                file.write(writer.envelope(corners, told))
            for thing in city_things(place):
                member = etree.Element(writer.tag("core:cityObjectMember"), nsmap=writer.names)
                if thing.is_building:
                    writer.building(member, thing)
                else:
                    writer.generic(member, thing)
                file.write(member)


@dataclass
class _Writer:
    """Makes elements of one version. shift_m: (3,) from the place's frame to that of the file."""

    names: dict[str, str]
    third: bool
    shift_m: NDArray[np.float64]
    ids: XmlIds

    def tag(self, name: str) -> str:
        """A name such as `gml:id` with its namespace written out."""
        prefix, _, own = name.partition(":")
        return f"{{{self.names[prefix]}}}{own}"

    def child(self, parent: Any, kind: str, text: str | None = None, /, **told: str) -> Any:
        made = etree.SubElement(parent, self.tag(kind), told)
        if text is not None:
            made.text = clean(text)
        return made

    def identified(self, parent: Any, name: str, own: str) -> Any:
        made = self.child(parent, name)
        made.set(self.tag("gml:id"), self.ids.unique(own))
        return made

    def envelope(
        self, corners: tuple[NDArray[np.float64], NDArray[np.float64]], told: dict[str, str]
    ) -> Any:
        made = etree.Element(self.tag("gml:boundedBy"), nsmap=self.names)
        box = self.child(made, "gml:Envelope", **told)
        for name, corner in zip(("lowerCorner", "upperCorner"), corners, strict=True):
            self.child(box, f"gml:{name}", _numbers((corner + self.shift_m)[None]))
        return made

    def building(self, member: Any, thing: CityThing) -> None:
        building = self.identified(member, "bldg:Building", thing.id)
        self.child(building, "gml:name", thing.name)
        attributes = dict(thing.attributes)
        height = attributes.pop("measuredHeight", None)
        storeys = attributes.pop("storeysAboveGround", None)
        roof = attributes.pop("roofType", None)
        self.attributes(building, attributes)
        if self.third:
            self.surfaces(building, thing.surfaces)
            if isinstance(height, (int, float)):
                self.height(building, float(height))
        if roof is not None:
            self.child(building, "bldg:roofType", str(roof))
        if height is not None and not self.third:
            self.child(building, "bldg:measuredHeight", str(height), uom="m")
        if storeys is not None:
            self.child(building, "bldg:storeysAboveGround", str(storeys))
        for one in thing.installations:
            self.installation(building, one)
        if not self.third:
            self.surfaces(building, thing.surfaces)

    def generic(self, member: Any, thing: CityThing) -> None:
        """What is no building: a tree, a car, a piece of ground."""
        kind = "gen:GenericOccupiedSpace" if self.third else "gen:GenericCityObject"
        own = self.identified(member, kind, thing.id)
        self.child(own, "gml:name", thing.name)
        self.attributes(own, thing.attributes)
        lod = "core:lod3MultiSurface" if self.third else "gen:lod3Geometry"
        faces = [face for one in thing.surfaces for face in one.faces]
        self.multi_surface(self.child(own, lod), faces, thing.id)

    def height(self, building: Any, height_m: float) -> None:
        """CityGML 3.0 says between what a height is measured."""
        told = self.child(self.child(building, "con:height"), "con:Height")
        self.child(told, "con:highReference", "highestRoofEdge")
        self.child(told, "con:lowReference", "lowestGroundPoint")
        self.child(told, "con:status", "measured")
        self.child(told, "con:value", str(height_m), uom="m")

    def attributes(self, parent: Any, attributes: dict[str, str | int | float]) -> None:
        """Generic attributes."""
        for name, value in attributes.items():
            kind = "string" if isinstance(value, str) else "double"
            kind = "int" if isinstance(value, int) else kind
            if self.third:
                kind = kind.capitalize()
                above = self.child(parent, "core:genericAttribute")
                made = self.child(above, f"gen:{kind}Attribute")
                self.child(made, "gen:name", name)
            else:
                made = self.child(parent, f"gen:{kind}Attribute", name=clean(name))
            self.child(made, "gen:value", str(value))

    def installation(self, building: Any, thing: CityThing) -> None:
        above = "bldg:buildingInstallation" if self.third else "bldg:outerBuildingInstallation"
        own = self.identified(self.child(building, above), "bldg:BuildingInstallation", thing.id)
        self.child(own, "gml:name", thing.name)
        provenance = thing.surfaces[0].provenance if thing.surfaces else "invented"
        self.attributes(own, {"class": str(thing.attributes["class"]), "provenance": provenance})
        if self.third:
            self.surfaces(own, thing.surfaces)
        else:
            faces = [face for one in thing.surfaces for face in one.faces]
            self.multi_surface(self.child(own, "bldg:lod3Geometry"), faces, thing.id)

    def surfaces(self, parent: Any, surfaces: tuple[CitySurface, ...]) -> None:
        """Walls and the like, with their openings; what opens nothing is in a wall without area."""
        elements: dict[int, Any] = {}
        for row, one in enumerate(surfaces):
            if one.kind in _OPENINGS and one.parent is not None:
                continue
            kind = one.kind if one.kind not in _OPENINGS else "WallSurface"
            elements[row] = self.surface(parent, one, kind)
        for row, one in enumerate(surfaces):
            if one.kind not in _OPENINGS:
                continue
            wall = elements.get(one.parent if one.parent is not None else row)
            if wall is not None:
                self.opening(wall, one)

    def surface(self, parent: Any, one: CitySurface, kind: str) -> Any:
        module = "con" if self.third else "bldg"
        above = self.child(parent, "core:boundary" if self.third else "bldg:boundedBy")
        stands_in = kind != one.kind
        own = self.identified(above, f"{module}:{kind}", one.id + ("-wall" if stands_in else ""))
        self.told(own, one)
        if not stands_in:
            lod = "core" if self.third else "bldg"
            self.multi_surface(self.child(own, f"{lod}:lod3MultiSurface"), one.faces, one.id)
        return own

    def told(self, own: Any, one: CitySurface) -> None:
        self.child(own, "gml:name", one.name)
        self.attributes(own, {"class": one.semantic, "provenance": one.provenance})

    def opening(self, wall: Any, one: CitySurface) -> None:
        if self.third:
            above = self.child(wall, "con:fillingSurface")
            own = self.identified(above, f"con:{one.kind}Surface", one.id)
        else:
            own = self.identified(self.child(wall, "bldg:opening"), f"bldg:{one.kind}", one.id)
        self.told(own, one)
        lod = "core" if self.third else "bldg"
        self.multi_surface(self.child(own, f"{lod}:lod3MultiSurface"), one.faces, one.id)

    def multi_surface(self, parent: Any, faces: Any, own: str) -> None:
        surface = self.identified(parent, "gml:MultiSurface", f"{own}-surface")
        for face in faces:
            polygon = self.identified(
                self.child(surface, "gml:surfaceMember"), "gml:Polygon", f"{own}-polygon"
            )
            for number, ring in enumerate(face.rings):
                side = self.child(polygon, "gml:interior" if number else "gml:exterior")
                closed = np.concatenate([ring, ring[:1]]) + self.shift_m
                line = self.child(side, "gml:LinearRing")
                self.child(line, "gml:posList", _numbers(closed), srsDimension="3")


def _numbers(points: NDArray[np.float64]) -> str:
    return ("%.4f " * points.size % tuple(points.reshape(-1).tolist())).rstrip()
