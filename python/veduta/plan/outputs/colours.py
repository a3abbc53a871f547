"""Colours of uses and layers in drawings and overlays (sRGB, `#rrggbb`)."""

from __future__ import annotations

from veduta.plan.document import RoomUse
from veduta.plan.drawing import Layer

Rgb = tuple[int, int, int]

LAYER_COLOURS: dict[Layer, str] = {
    "rooms": "#8a8f98",
    "furniture": "#7c6f64",
    "walls": "#1f2a37",
    "windows": "#1f7fd1",
    "doors": "#c2571a",
    "stairs": "#6b7280",
    "names": "#1f2a37",
}
USE_COLOURS: dict[RoomUse, str] = {
    "living": "#f3d9a4",
    "dining": "#f2c7a0",
    "kitchen": "#f4b8a2",
    "bedroom": "#bcd5ee",
    "bathroom": "#a9dbe0",
    "toilet": "#b9e3dd",
    "utility": "#cfd8c0",
    "storage": "#d8d2c4",
    "wardrobe": "#ddcfe0",
    "hall": "#e9e2cf",
    "corridor": "#e9e2cf",
    "stairs": "#d5d0c8",
    "study": "#c9d6c2",
    "sauna": "#e2bfa0",
    "garage": "#cfd2d6",
    "balcony": "#cfe6c0",
    "terrace": "#cfe6c0",
    "technical": "#cccfd4",
    "other": "#dfdfdf",
    "unknown": "#e6e6e6",
}


def rgb(colour: str) -> Rgb:
    """The three numbers of `#rrggbb`."""
    return (int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16))
