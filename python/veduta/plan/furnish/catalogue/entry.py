"""What the catalogue knows of an object."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from veduta.place.material import Colour

ObjectClass = Literal[
    "seat", "table", "bed", "storage", "kitchen", "appliance", "sanitary", "lamp", "plant",
    "textile", "decoration", "screen", "vehicle", "works",
]  # fmt: skip
Stands = Literal["floor", "wall", "things"]
Side = Literal["back", "left", "right"]
Size = tuple[float, float, float]


@dataclass(frozen=True)
class Finish:
    """What a part of an object is made of; texture: the plain name of a built-in one."""

    name: str
    colour: Colour
    roughness: float
    metalness: float
    opacity: float
    texture: str | None


@dataclass(frozen=True)
class SupportSurface:
    """Where things may stand on an object: shares of its box from its left, front and base.

    free_m: how high things on it may be. fragility: of the most fragile that may stand there.
    """

    left: float
    right: float
    front: float
    back: float
    height: float
    free_m: float
    fragility: int


@dataclass(frozen=True)
class Entry:
    """An object: what it is, how large, and where it may stand.

    size_m: width, depth, height as it usually comes; widths_m, depths_m: the least and the most.
    model: a builder of `furnish.models`, or file: a GLB file in `folder`.
    finishes: of each part of a model, the name of a finish.
    walls: sides that may stand against a wall. above_m: of its base, where it hangs on a wall.
    front_m, side_m: what stays free before and beside it. fragility: 0 to 2.
    """

    name: str
    type: str
    kind: ObjectClass
    model: str | None
    file: str | None
    folder: Path | None
    finishes: Mapping[str, str]
    size_m: Size
    widths_m: tuple[float, float]
    depths_m: tuple[float, float]
    walls: frozenset[Side]
    stands: Stands
    above_m: float
    front_m: float
    side_m: float
    fragility: int
    surfaces: tuple[SupportSurface, ...] = ()

    def sized(self, width_m: float | None = None, depth_m: float | None = None) -> Size:
        """Its size with another width or depth, as near to the asked ones as it comes."""
        width, depth, height = self.size_m
        if width_m is not None:
            width = min(max(width_m, self.widths_m[0]), self.widths_m[1])
        if depth_m is not None:
            depth = min(max(depth_m, self.depths_m[0]), self.depths_m[1])
        return (round(width, 3), round(depth, 3), height)


@dataclass(frozen=True)
class Wanted:
    """Things of a type that a room of a use has; `place` is their turn in it."""

    use: str
    type: str
    least: int
    most: int
    from_m2: float
    each_m2: float
    chance: float
    critical: bool
    place: int
