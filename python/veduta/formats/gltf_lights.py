"""Lamps in glTF: KHR_lights_punctual, a node for each lamp.

The node's extras name the room: `veduta.light` has `kind`, `room` and `lumen`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from veduta.formats.gltf_bin import y_up
from veduta.imaging.srgb import linear_of_srgb
from veduta.place.lamp import Lamp
from veduta.place.part import Part

LIGHTS = "KHR_lights_punctual"


def add_lights(root: dict[str, Any], part: Part) -> None:
    """Adds the lights and their nodes; nothing where the part has no lamps."""
    if not part.lamps:
        return
    root.setdefault("extensionsUsed", []).append(LIGHTS)
    told = [_light(lamp) for lamp in part.lamps]
    kinds = [entry for number, entry in enumerate(told) if entry not in told[:number]]
    root.setdefault("extensions", {})[LIGHTS] = {"lights": kinds}
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
