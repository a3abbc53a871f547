"""Materials of a house by name, registered in the part when they are first used.

No plan shows a material: all of them are invented, and their textures are painted by code, but for
those that photos of rooms show (`finishes`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from veduta.grammar.surfaces.catalogue import PREFIX, SURFACES, painted
from veduta.place.builder import PartBuilder, UvMap
from veduta.place.material import Colour, Material, Texture
from veduta.plan.document import Room, RoomUse
from veduta.plan.house.finishes import laid_tiling, paint_name, tiles_name


@dataclass(frozen=True)
class Look:
    """A colour (sRGB), which multiplies the texture: a built-in one by its name, or a picture."""

    colour: Colour
    texture: str | None = None
    roughness: float = 0.9
    opacity: float = 1.0
    metalness: float = 0.0
    glow: float = 0.0
    picture: Texture | None = None
    picture_m: tuple[float, float] = (1.0, 1.0)
    """What the picture covers to the right and up."""


LOOKS: dict[str, Look] = {
    "facade": Look((0.95, 0.93, 0.88), "plaster"),
    "inner wall": Look((0.96, 0.95, 0.93)),
    "tiled wall": Look((0.93, 0.95, 0.96), roughness=0.4),
    "wall core": Look((0.80, 0.77, 0.72)),
    "ceiling": Look((0.98, 0.98, 0.97)),
    "wood floor": Look((0.86, 0.68, 0.47), "boards", roughness=0.55),
    "tile floor": Look((0.86, 0.86, 0.84), "paving", roughness=0.4),
    "concrete floor": Look((0.78, 0.78, 0.76), "concrete"),
    "terrace floor": Look((0.80, 0.76, 0.70), "paving"),
    "slab": Look((0.84, 0.83, 0.80)),
    "skirting": Look((0.93, 0.92, 0.90), roughness=0.5),
    "frame": Look((0.97, 0.97, 0.96), roughness=0.45),
    "glass": Look((0.70, 0.82, 0.86), roughness=0.05, opacity=0.28),
    "sill": Look((0.82, 0.81, 0.79), roughness=0.6),
    "leaf": Look((0.80, 0.66, 0.48), "wood", roughness=0.5),
    "entrance": Look((0.36, 0.27, 0.22), "wood", roughness=0.5),
    "garage door": Look((0.82, 0.83, 0.84), "siding", roughness=0.5),
    "handle": Look((0.62, 0.62, 0.60), roughness=0.3, metalness=0.8),
    "lamp glass": Look((1.0, 0.97, 0.91), roughness=0.4, glow=0.45),
    "lamp metal": Look((0.72, 0.70, 0.66), roughness=0.35, metalness=0.7),
    "roof": Look((0.66, 0.36, 0.27), "clay-tile", roughness=0.8),
    "flat roof": Look((0.70, 0.70, 0.70), "gravel"),
    "lawn": Look((0.42, 0.54, 0.27), "lawn"),
    "path": Look((0.78, 0.75, 0.70), "paving"),
    "drive": Look((0.66, 0.65, 0.63), "cobbles"),
    "bark": Look((0.38, 0.29, 0.21)),
    "leaves": Look((0.33, 0.48, 0.20)),
    "needles": Look((0.16, 0.33, 0.20)),
    "bush": Look((0.27, 0.42, 0.19)),
    "gravel": Look((0.74, 0.72, 0.69), "gravel"),
    "contact shadow": Look((0.05, 0.045, 0.04), roughness=1.0, opacity=0.095),
    "soffit": Look((0.93, 0.91, 0.87)),
}
_FLOORS: dict[RoomUse, str] = {
    **dict.fromkeys(("kitchen", "bathroom", "toilet", "utility", "sauna"), "tile floor"),
    **dict.fromkeys(("garage", "technical"), "concrete floor"),
    **dict.fromkeys(("balcony", "terrace"), "terrace floor"),
}
TILED: frozenset[RoomUse] = frozenset({"bathroom", "toilet", "sauna"})


def floor_look(room: Room | None) -> str:
    """What the floor of a room is made of."""
    if room is None:
        return "concrete floor"
    tiling = laid_tiling(room, "floor")
    if tiling is not None:
        return tiles_name(tiling)
    return "terrace floor" if room.outdoors else _FLOORS.get(room.use, "wood floor")


def wall_look(room: Room | None) -> str:
    """What the walls around a room look like; None and outdoors is the facade."""
    if room is None or room.outdoors:
        return "facade"
    tiling = laid_tiling(room, "wall")
    if tiling is not None:
        return tiles_name(tiling)
    if room.wall_colour is not None:
        return paint_name(room.wall_colour)
    return "tiled wall" if room.use in TILED else "inner wall"


def has_skirting(room: Room) -> bool:
    """Whether there is a board along its walls: not where they are tiled."""
    painted = room.wall_colour is not None or room.use not in TILED
    return not room.outdoors and painted and laid_tiling(room, "wall") is None


class Looks:
    """The materials of a part."""

    def __init__(self, builder: PartBuilder, finishes: Mapping[str, Look] | None = None) -> None:
        """finishes: looks of single rooms, by their names."""
        self._builder = builder
        self._looks = {**LOOKS, **(finishes or {})}
        self._numbers: dict[str, int] = {}

    def of(self, name: str, ring_m: NDArray[np.float64]) -> tuple[int, UvMap | None]:
        """The number of a material, and where a flat surface with this (n, 3) ring shows what."""
        look = self._looks[name]
        if name not in self._numbers:
            texture = look.picture if look.texture is None else _texture(look.texture)
            material = Material(
                name.replace(" ", "-"), look.colour, look.roughness, look.metalness,
                texture, look.opacity, look.glow,
            )  # fmt: skip
            self._numbers[name] = self._builder.material(material)
        if look.picture is not None:
            return self._numbers[name], flat_map(ring_m, look.picture_m)
        if look.texture is None:
            return self._numbers[name], None
        return self._numbers[name], flat_map(ring_m, SURFACES[look.texture].size_m)


def flat_map(ring_m: NDArray[np.float64], size_m: tuple[float, float]) -> UvMap:
    """Texture coordinates in a polygon's plane: to the right and up, or east and north if level."""
    normal = np.cross(ring_m, np.roll(ring_m, -1, axis=0)).sum(axis=0)
    normal = normal / max(float(np.linalg.norm(normal)), 1e-12)
    right = np.cross([0.0, 0.0, 1.0], normal)
    length = float(np.linalg.norm(right))
    right = np.array([1.0, 0.0, 0.0]) if length < 1e-3 else right / length
    up = np.cross(normal, right)

    def uv(points: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.stack([points @ right / size_m[0], 1.0 - points @ up / size_m[1]], axis=1)

    return uv


@lru_cache(maxsize=len(SURFACES))
def _texture(name: str) -> Texture:
    pixels = painted(PREFIX + name)
    return Texture(pixels, np.ones(pixels.shape[:2], dtype=np.bool_))
