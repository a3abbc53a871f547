"""Lamps and the sun in glTF: KHR_lights_punctual, a node for each lamp, one for the sun.

A lamp's extras name the room: `veduta.light` has `kind`, `room` and `lumen`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from veduta.formats.gltf_bin import y_up
from veduta.imaging.srgb import linear_of_srgb
from veduta.place.lamp import Lamp
from veduta.place.part import Part
from veduta.place.sunlight import Sunlight

LIGHTS = "KHR_lights_punctual"
SUN = "sun"
DAYLIGHT_LUX = 3.0
"""Of a sun of strength 1. The true one has 100,000 lx; most viewers do not adapt to that as an eye
does, and show all white."""


def add_lights(root: dict[str, Any], part: Part) -> None:
    """Adds the lights and their nodes; nothing where the part has no lamps."""
    if not part.lamps:
        return
    _use(root)
    told = [_light(lamp) for lamp in part.lamps]
    kinds = [entry for number, entry in enumerate(told) if entry not in told[:number]]
    root["extensions"][LIGHTS]["lights"] = kinds
    places = y_up(np.array([lamp.at_m for lamp in part.lamps], dtype=np.float32))
    for lamp, entry, place in zip(part.lamps, told, places, strict=True):
        root["scenes"][0]["nodes"].append(len(root["nodes"]))
        root["nodes"].append(
            {
                "name": lamp.name,
                "translation": place.tolist(),
                "extensions": {LIGHTS: {"light": kinds.index(entry)}},
                "extras": {
                    "veduta": {"light": {"kind": lamp.kind, "room": lamp.room, "lumen": lamp.lumen}}
                },
            }
        )


def add_sun(root: dict[str, Any], sun: Sunlight) -> None:
    """Adds the sun as a directional light; its node is turned so that -z is where it shines to."""
    lights = _use(root)
    root["scenes"][0]["nodes"].append(len(root["nodes"]))
    root["nodes"].append(
        {
            "name": SUN,
            "rotation": _onto(y_up(np.array([sun.toward], dtype=np.float32))[0]),
            "extensions": {LIGHTS: {"light": len(lights)}},
        }
    )
    lights.append(
        {
            "type": "directional",
            "name": SUN,
            "color": linear_of_srgb(np.array(sun.colour)).round(6).tolist(),
            "intensity": round(DAYLIGHT_LUX * sun.strength, 4),
        }
    )


def _onto(toward: NDArray[np.float32]) -> list[float]:
    """The shortest turn (a quaternion, w last) that takes +z, whence light comes, to a vector."""
    x, y, z = toward.astype(np.float64).tolist()
    if z < -1.0 + 1e-9:
        return [0.0, 1.0, 0.0, 0.0]
    turn = np.array([-y, x, 0.0, 1.0 + z])
    turn /= np.linalg.norm(turn)
    return [round(value, 7) + 0.0 for value in turn.tolist()]


def _use(root: dict[str, Any]) -> list[dict[str, Any]]:
    """The lights of the file, which may have none yet."""
    used = root.setdefault("extensionsUsed", [])
    if LIGHTS not in used:
        used.append(LIGHTS)
    lights: list[dict[str, Any]] = (
        root.setdefault("extensions", {}).setdefault(LIGHTS, {}).setdefault("lights", [])
    )
    return lights


def _light(lamp: Lamp) -> dict[str, Any]:
    """Lamps of one brightness share an entry. Intensity: candela, all around alike."""
    entry: dict[str, Any] = {
        "type": "point",
        "color": linear_of_srgb(np.array(lamp.colour)).round(6).tolist(),
        "intensity": round(lamp.lumen / (4.0 * math.pi), 4),
    }
    if lamp.range_m > 0.0:
        entry["range"] = lamp.range_m
    return entry
