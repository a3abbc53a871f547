"""The rule files of a building, and what derives them alone: their lot, and the textures they name.

A texture has a mask beside it, `NAME.invented.png`: what is white there is no pixel of the photo.
"""

from __future__ import annotations

import json
from pathlib import Path

from veduta.facade.model import Model
from veduta.facade.rule_head import CELLS, LOT, RULES
from veduta.grammar.picture_sources import mask_name
from veduta.imaging.encode import jpeg_bytes, mask_bytes
from veduta.place.material import Texture

JPEG_QUALITY = 90


def write_rule_files(model: Model, folder: Path) -> None:
    """Write the rules of a building, its lot and its textures."""
    (folder / CELLS).write_text(model.rules, encoding="utf-8")
    (folder / RULES).write_text(model.repeating, encoding="utf-8")
    (folder / LOT).write_text(_lot(model), encoding="utf-8")
    for name, texture in model.textures.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(_jpeg(texture))
        path.with_name(mask_name(path.name)).write_bytes(_mask(texture))


def _lot(model: Model) -> str:
    """GeoJSON in metres of the facade's frame: the first edge lies along the street."""
    width, depth = model.size_m
    ring = [[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth], [0.0, 0.0]]
    feature = {
        "type": "Feature",
        "properties": {"name": model.part.id},
        "geometry": {"type": "Polygon", "coordinates": [ring]},
    }
    return json.dumps({"type": "FeatureCollection", "features": [feature]}, indent=1) + "\n"


def _jpeg(texture: Texture) -> bytes:
    return jpeg_bytes(texture.pixels, JPEG_QUALITY, optimize=True)


def _mask(texture: Texture) -> bytes:
    return mask_bytes(texture.invented)
