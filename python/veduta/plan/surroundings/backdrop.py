"""The panorama as a part of the place: a cylinder around the garden that closes to a dome.

AV3D, Surrounding Environment Creation: as if one placed a cylinder around the building, with the
picture in its inside. Below the picture's horizon lies the ground between the garden and the
cylinder, with what the picture shows of it. All surfaces are invented; of the pixels, those that no
picture shows. It is turned by north, and nobody bumps into it.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient
from shapely.ops import unary_union

from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Colour, Material, Texture
from veduta.place.part import Part
from veduta.place.place import UNMOVED, ModelFile, Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.plan.house.space import pieces_of
from veduta.plan.surroundings.sky_picture import LOWEST_DEG, SkyPicture
from veduta.plan.surroundings.terrain import Terrain

Floats = NDArray[np.float64]
PANORAMA = "panorama"
EYE_M = 1.6
"""The height at which the picture is taken to have been made, in the middle of the garden."""
LEAST_RADIUS_M, RADIUS_SHARE = 80.0, 3.0
"""The cylinder's radius: at least this, and so many times the way to the garden's corners."""
SHOULDER_DEG = 45.0
"""Up to here it is a cylinder, from here on a dome."""
_WALL_STEP_DEG, _DOME_STEP_DEG, _BEARING_STEP_DEG = 7.5, 5.0, 5.0
_GROUND_RINGS = 8
_PLOT_RINGS = 6
_LEAST_M2 = 1e-6
_EDGE_DEG = 0.5
"""The picture's last rows would be mixed with its first where a viewer repeats it."""


def build_backdrop(
    sky: SkyPicture,
    terrain: Terrain,
    turn_deg: float,
    shown: Colour = (1.0, 1.0, 1.0),
    *,
    garden: bool = True,
) -> Part:
    """The part in the frame of the place.

    turn_deg: where north is, clockwise from +y. shown: by what the picture is multiplied.
    garden: whether there is one; else the picture's ground goes on over the plot up to the house.
    """
    builder = PartBuilder(PANORAMA)
    texture = Texture(sky.pixels, sky.invented)
    material = builder.material(Material(PANORAMA, shown, 1.0, texture=texture, unlit=True))
    shape = _Shape(sky, terrain, turn_deg)
    feature = builder.feature(SemanticClass.OTHER, Provenance.INVENTED, PANORAMA)
    for corners, uv in [*shape.wall(), *shape.dome()]:
        builder.polygon([corners], feature, material, _given(uv))
    feature = builder.feature(SemanticClass.OTHER, Provenance.INVENTED, f"{PANORAMA} foreground")
    for corners, uv in [*shape.ground(), *([] if garden else shape.plot())]:
        builder.polygon([corners], feature, material, _given(uv))
    return builder.build()


def add_backdrop(place: Place, part: Part, model: str) -> None:
    """Put it around all that is in the place. model: its file."""
    standing = Standing("Panorama", UNMOVED, arrangement="invented", backdrop=True)
    place.add(part, standing, ModelFile(model))


class _Shape:
    """Faces as corners (n, 3) and texture coordinates (n, 2), counter-clockwise from inside."""

    def __init__(self, sky: SkyPicture, terrain: Terrain, turn_deg: float) -> None:
        self.sky, self.terrain, self.turn_deg = sky, terrain, turn_deg
        left, bottom, right, top = terrain.plot.bounds
        self.half = np.array([right - left, top - bottom]) / 2.0
        self.middle = np.array([left + right, bottom + top]) / 2.0
        self.radius = max(LEAST_RADIUS_M, RADIUS_SHARE * float(np.hypot(*self.half)))
        self.bearings = self._bearings()

    def _bearings(self) -> Floats:
        """Even steps from south to south, and the garden's corners: they are met exactly."""
        x, y = self.half
        corners = [math.degrees(math.atan2(a * x, b * y)) for a in (-1, 1) for b in (-1, 1)]
        turned = [(corner - self.turn_deg + 180.0) % 360.0 - 180.0 for corner in corners]
        steps = np.arange(-180.0, 180.0 + _BEARING_STEP_DEG / 2.0, _BEARING_STEP_DEG)
        every = np.unique(np.concatenate([steps, turned]).round(6))
        apart: Floats = every[np.concatenate([[True], np.diff(every) > 1e-3])]
        return apart

    def wall(self) -> list[tuple[Floats, Floats]]:
        """From the ground up to the shoulder."""
        foot = -math.degrees(math.atan2(EYE_M, self.radius))
        rows = [foot, *np.arange(0.0, SHOULDER_DEG + 0.1, _WALL_STEP_DEG).tolist()]
        return self._rows([(e, self.radius, self.radius * _tan(e)) for e in rows])

    def dome(self) -> list[tuple[Floats, Floats]]:
        """From the shoulder to the zenith."""
        out = self.radius / math.cos(math.radians(SHOULDER_DEG))
        rows = np.radians(np.arange(SHOULDER_DEG, 90.0 + 0.1, _DOME_STEP_DEG)).tolist()
        return self._rows([(math.degrees(e), out * math.cos(e), out * math.sin(e)) for e in rows])

    def ground(self) -> list[tuple[Floats, Floats]]:
        """Between the garden's edge and the wall."""
        way = self._ways(self.bearings)
        with np.errstate(divide="ignore"):
            inner = np.min(self.half / np.abs(way), axis=1)
        edge_m = self.terrain.height(self.middle + inner[:, None] * way)
        shares = np.linspace(0.0, 1.0, _GROUND_RINGS + 1) ** 2
        rings = []
        for share in shares.tolist():
            reach = inner + share * (self.radius - inner)
            at = self.middle + reach[:, None] * way
            seen = self.sky.uv(self.bearings, -np.degrees(np.arctan2(EYE_M, reach)))
            rings.append((np.column_stack([at, (1.0 - share) * edge_m]), seen))
        found = []
        for (near, near_uv), (far, far_uv) in zip(rings, rings[1:], strict=False):
            for i in range(len(self.bearings) - 1):
                corners = np.stack([near[i], near[i + 1], far[i + 1], far[i]])
                uv = np.stack([near_uv[i], near_uv[i + 1], far_uv[i + 1], far_uv[i]])
                found += [(corners[[0, 1, 2]], uv[[0, 1, 2]]), (corners[[0, 2, 3]], uv[[0, 2, 3]])]
        return found

    def plot(self) -> list[tuple[Floats, Floats]]:
        """The level plot, but for the house, as if the picture had been taken over it.

        What lies steeper below the eye than the picture reaches has its lowest row.
        """
        free = unary_union([area for _, area in self.terrain.areas])
        way = self._ways(self.bearings)
        inner = np.min(self.half / np.maximum(np.abs(way), 1e-12), axis=1)
        found = []
        for near, far in pairwise(np.linspace(0.0, 1.0, _PLOT_RINGS + 1).tolist()):
            for i in range(len(way) - 1):
                ends = [(near, i), (near, i + 1), (far, i + 1), (far, i)]
                sector = Polygon([self.middle + share * inner[k] * way[k] for share, k in ends])
                for piece in _triangles(orient(sector).intersection(free)):
                    level = np.column_stack([piece, np.zeros(3)])
                    found.append((level, self._seen_below(piece, i)))
        return found

    def _seen_below(self, at: Floats, sector: int) -> Floats:
        """(n, 2) where points of the level ground between two bearings are in the picture."""
        low, high = self.bearings[sector], self.bearings[sector + 1]
        off = at - self.middle
        reach = np.hypot(off[:, 0], off[:, 1])
        bearing = np.degrees(np.arctan2(off[:, 0], off[:, 1])) - self.turn_deg
        # Of all turns that one beside the sector: south is at both ends of the picture.
        around = (bearing - (low + high) / 2.0 + 180.0) % 360.0 - 180.0 + (low + high) / 2.0
        bearing = np.where(reach < 1e-6, (low + high) / 2.0, np.clip(around, low, high))
        elevation = -np.degrees(np.arctan2(EYE_M, reach))
        return self.sky.uv(bearing, np.maximum(elevation, LOWEST_DEG + _EDGE_DEG))

    def _rows(self, rows: list[tuple[float, float, float]]) -> list[tuple[Floats, Floats]]:
        """Faces between circles. rows: elevation (deg), radius, height over the eye."""
        way = self._ways(self.bearings)
        circles = []
        for elevation, radius, height in rows:
            at = np.column_stack([self.middle + radius * way, np.full(len(way), height + EYE_M)])
            uv = self.sky.uv(self.bearings, np.full(len(way), elevation))
            circles.append((at, uv))
        found = []
        for (low, low_uv), (high, high_uv) in zip(circles, circles[1:], strict=False):
            at_top = float(np.ptp(high[:, :2], axis=0).max()) < 1e-6
            for i in range(len(way) - 1):
                corners = np.stack([low[i], low[i + 1], high[i + 1], high[i]])
                seen = np.stack([low_uv[i], low_uv[i + 1], high_uv[i + 1], high_uv[i]])
                count = 3 if at_top else 4
                found.append((corners[:count], seen[:count]))
        return found

    def _ways(self, bearing_deg: Floats) -> Floats:
        """(n, 2) unit vectors on the page."""
        angle = np.radians(bearing_deg + self.turn_deg)
        return np.stack([np.sin(angle), np.cos(angle)], axis=1)


def _triangles(shape: BaseGeometry) -> list[Floats]:
    """A region in triangles (3, 2), counter-clockwise."""
    return [
        np.array(orient(one).exterior.coords)[:3]
        for piece in pieces_of(shape)
        for one in shapely.constrained_delaunay_triangles(piece).geoms
        if isinstance(one, Polygon) and one.area > _LEAST_M2
    ]


def _given(uv: Floats) -> UvMap:
    return lambda _: uv


def _tan(angle_deg: float) -> float:
    return math.tan(math.radians(angle_deg))
