"""Lamps in X3D: those of a room go on when somebody comes in, and on or off when one is touched.

A lamp lights what is in the group of its room alone: X3D's lights throw no shadows, and would shine
through walls.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta.formats.x3d import Element, X3dScene, place_of, turn_of
from veduta.place.part import Part
from veduta.plan.house.space import Space

BRIGHT = 0.38
"""How bright the lamp of a room with one lamp is: X3D knows no units. The lamps of a room share
what grows with the root of their number: each is nearer to what it lights."""
_ATTENUATION = (1.0, 0.0, 0.04)
_AMBIENT = 0.12
"""What the walls of a room throw back, from all its lamps together."""


class RoomLamps:
    """The lamps of one room; `glass` are the polygons that glow, which `add` writes itself."""

    def __init__(self, scene: X3dScene, part: Part, room: str) -> None:
        self._scene, self._part, self._room = scene, part, room
        self._lamps = [lamp for lamp in part.lamps if lamp.room == room]
        glows = [material.glow > 0.0 and bool(self._lamps) for material in part.materials]
        self.glass: NDArray[np.bool_] = np.array(glows, dtype=np.bool_)[part.polygon_material]

    def add(
        self,
        group: Element,
        region: BaseGeometry,
        space: Space,
        height_m: float,
        chosen: NDArray[np.bool_],
    ) -> None:
        """The lamps of the room, their glass, and what switches them.

        region: the room's floor, the box around which turns them on; it may be in pieces, with one
        box around all. chosen: the polygons of the room.
        """
        if not self._lamps:
            return
        scene, name = self._scene, self._room
        switch = scene.node(group, "BooleanToggle", f"{name} switch", toggle=False)
        sensor = self._sensor(group, region, space.storey.elevation_m, height_m)
        scene.route(sensor, "isActive", switch, "set_toggle")
        whole = sum(lamp.lumen for lamp in self._lamps)
        strength = BRIGHT * math.sqrt(len(self._lamps))
        for lamp in self._lamps:
            share = lamp.lumen / whole
            light = scene.node(
                group, "PointLight", lamp.name, on=False, global_=False,
                location=place_of(lamp.at_m), color=lamp.colour,
                intensity=strength * share, ambientIntensity=_AMBIENT * share,
                attenuation=_ATTENUATION, radius=lamp.range_m or 12.0,
            )  # fmt: skip
            scene.route(switch, "toggle_changed", light, "set_on")
        self._add_glass(group, switch, chosen & self.glass)

    def _sensor(
        self, group: Element, region: BaseGeometry, floor_m: float, height_m: float
    ) -> Element:
        """Around the room: the smallest box, however it is turned."""
        box = region.minimum_rotated_rectangle
        corners = np.array(box.boundary.coords)
        along, across = corners[1] - corners[0], corners[2] - corners[1]
        middle = corners[:4].mean(axis=0)
        turned = self._scene.node(
            group, "Transform", translation=place_of((*middle, floor_m + height_m / 2.0)),
            rotation=turn_of((0.0, 0.0, 1.0), math.atan2(along[1], along[0])),
        )  # fmt: skip
        size = (float(np.hypot(*along)), height_m, float(np.hypot(*across)))
        return self._scene.node(turned, "ProximitySensor", f"{self._room} inside", size=size)

    def _add_glass(self, group: Element, switch: Element, glass: NDArray[np.bool_]) -> None:
        """What glows twice, of which one is seen: as it is when it is on, and when it is off."""
        if not glass.any():
            return
        scene, part = self._scene, self._part
        touched = scene.node(group, "Group", f"{self._room} lamps")
        touch = scene.node(
            touched, "TouchSensor", f"{self._room} touch", description="Light on or off"
        )
        scene.route(touch, "isActive", switch, "set_boolean")
        on = scene.node(touched, "Group", f"{self._room} on", visible=False)
        off = scene.node(touched, "Group", f"{self._room} off")
        scene.shapes(on, part, glass)
        scene.shapes(off, part, glass, glows=False)
        negate = scene.node(group, "BooleanFilter", f"{self._room} not")
        scene.route(switch, "toggle_changed", on, "set_visible")
        scene.route(switch, "toggle_changed", negate, "set_boolean")
        scene.route(negate, "inputNegate", off, "set_visible")
