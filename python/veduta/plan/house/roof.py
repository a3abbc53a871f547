"""The roof over the highest storey: by the straight skeleton, or flat.

Over a curved wall the eaves are a polygonal line, whose sides are tangents of the arc to within
some centimetres, so that its skeleton is that of AV3D's tangents ("3D generation", roofs).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import manifold3d
import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from veduta import _core
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.eaves import UNDER_M, clear_of, faces_within, solid_of_faces
from veduta.plan.house.frame import Sculptor, Surface, level
from veduta.plan.house.party import EVERYWHERE, Party, own_side, row_region
from veduta.plan.house.space import pieces_of
from veduta.plan.house.walls import extruded
from veduta.plan.options import HouseOptions, RoofKind

FLAT_M = 0.12
_JOG_M = 0.08
_LEAST_M2 = 1.0
SLOPE_DEG = 32.0
"""The roof's slope, if nobody gives it ..."""
_MANSARD_DEG, _MANSARD_OVERHANG_M = 68.0, 0.12
"""... and that of a mansard's lower part. So steep, it must not reach far: it would hang down."""


Solid = list[list[NDArray[np.float64]]]


@dataclass(frozen=True)
class Roof:
    """A roof over a piece of a region. faces: rings of a solid about its eaves; None: flat."""

    name: str
    shape: Polygon
    asked: RoofKind
    built: RoofKind
    faces: Solid | None
    parties: tuple[Party, ...] = ()
    """Sides beyond which it belongs to neighbours."""


def roofs_over(
    region: BaseGeometry, options: HouseOptions, parties: Sequence[Party] = ()
) -> list[Roof]:
    """A roof for each piece of a region, as asked, or else hipped, or else flat.

    parties: sides to neighbours, where the roof of the row is cut.
    """
    if options.roof == "none":
        return []
    kind: RoofKind = "hip" if options.roof == "auto" else options.roof
    row = row_region(region, parties)
    shapes = [(number, _smooth(piece)) for number, piece in enumerate(pieces_of(row), start=1)]
    roofs = [
        _roof(f"roof {number}", shape, kind, options)
        for number, shape in shapes
        if shape.area >= _LEAST_M2
    ]
    return [_cut(roof, parties) for roof in roofs] if parties else roofs


def _cut(roof: Roof, parties: Sequence[Party]) -> Roof:
    """What of a row's roof is over this house; flat where it is no solid that can be cut."""
    faces = None if roof.faces is None else faces_within(roof.faces, own_side(EVERYWHERE, parties))
    built = roof.built if faces is not None else "flat"
    return replace(roof, faces=faces, built=built, parties=tuple(parties))


def _roof(name: str, shape: Polygon, asked: RoofKind, options: HouseOptions) -> Roof:
    # A round house has no gables.
    tried: tuple[RoofKind, ...] = () if asked == "flat" else (asked, "hip")
    for kind in dict.fromkeys(tried):
        faces = _solid(shape, kind, options)
        if faces is not None:
            return Roof(name, shape, asked, kind, faces)
    return Roof(name, shape, asked, "flat", None)


def add_roof(
    region: BaseGeometry,
    height_m: float,
    sculptor: Sculptor,
    options: HouseOptions,
    parties: Sequence[Party] = (),
) -> list[str]:
    """A roof over each piece of a region; what could not be built as asked is noted."""
    notes: list[str] = []
    for roof in roofs_over(region, options, parties):
        if roof.built != roof.asked and roof.built == "hip":
            notes.append(f"{roof.name} is hipped: its outline allows no {roof.asked} roof")
        elif roof.built != roof.asked:
            notes.append(
                f"{roof.name} is flat: a {roof.asked} roof cannot be built over its outline"
            )
        feature = sculptor.builder.feature(
            SemanticClass.ROOF, Provenance.INVENTED, roof.name,
            shell=sculptor.builder.new_shell(),
        )  # fmt: skip
        if roof.faces is None:
            _add_flat(flat_region(roof, options.overhang), height_m, sculptor, feature)
        else:
            cleared = clear_of(roof.faces, region)
            if cleared is None:
                notes.append(f"{roof.name} is no closed solid: its eaves may hang into rooms")
            _add_solid(cleared or roof.faces, height_m, sculptor, feature)
    return notes


def roof_body(roof: Roof, height_m: float, options: HouseOptions) -> manifold3d.Manifold | None:
    """The roof with what hangs below the walls' top; None where it is no closed solid."""
    if roof.faces is None:
        region = flat_region(roof, options.overhang)
        return extruded(region, height_m, height_m + FLAT_M)
    body = solid_of_faces(roof.faces)
    return None if body is None else body.translate([0.0, 0.0, height_m + UNDER_M])


def flat_region(roof: Roof, overhang_m: float) -> BaseGeometry:
    """What a flat roof covers."""
    return own_side(roof.shape.buffer(min(overhang_m, 0.3), join_style="mitre"), roof.parties)


def _smooth(piece: Polygon) -> Polygon:
    """The outline without small jogs and holes: a roof has none of them."""
    outline = Polygon(piece.exterior)
    closed = outline.buffer(_JOG_M, join_style="mitre").buffer(-_JOG_M, join_style="mitre")
    largest = max(pieces_of(closed), key=lambda one: one.area, default=outline)
    simple = pieces_of(Polygon(largest.exterior).simplify(_JOG_M / 2.0))
    return orient(simple[0]) if simple else orient(outline)


def _solid(shape: Polygon, kind: str, options: HouseOptions) -> Solid | None:
    """The rings of each face of the roof, its eaves at 0; None where there is none."""
    points = np.array(shape.exterior.coords)[:-1]
    steep = kind == "mansard"
    slope_deg = options.roof_slope or (_MANSARD_DEG if steep else SLOPE_DEG)
    overhang_m = min(options.overhang, _MANSARD_OVERHANG_M) if steep else options.overhang
    try:
        places, rings, faces, corners = _core.roof_solid(
            kind,
            points,
            np.array([0, len(points)], dtype=np.int64),
            math.tan(math.radians(slope_deg)),
            overhang_m=overhang_m,
            gable_overhang_m=overhang_m / 2.0,
        )
    except _core.RoofFault:
        return None
    return [
        [places[corners[rings[ring] : rings[ring + 1]]] for ring in range(first, last)]
        for first, last in zip(faces[:-1].tolist(), faces[1:].tolist(), strict=True)
    ]


def _add_solid(faces: Solid, height_m: float, sculptor: Sculptor, feature: int) -> None:
    frame = level(height_m + UNDER_M)
    for rings in faces:
        normal = np.cross(rings[0], np.roll(rings[0], -1, axis=0)).sum(axis=0)
        look = "roof" if normal[2] > 1e-9 else "soffit"
        sculptor.face(rings, frame, Surface(feature, look))


def _add_flat(region: BaseGeometry, height_m: float, sculptor: Sculptor, feature: int) -> None:
    sculptor.prism(
        region, height_m, height_m + FLAT_M, level(0.0), Surface(feature, "soffit"),
        high=Surface(feature, "flat roof"),
    )  # fmt: skip
