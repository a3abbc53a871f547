"""What a file of a city model says of its buildings, whatever its format."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from veduta.place.material import Colour
from veduta.place.semantics import SemanticClass

MOST_CORNERS = 20_000_000
"""Of all rings of a file together."""
Rings = tuple[NDArray[np.float64], ...]
"""A polygon: its outline, counter-clockwise seen from outside, and its holes; (n, 3) each."""


@dataclass(frozen=True)
class SurfaceTold:
    """What a file says of a semantic surface. name: of its rule; colour: sRGB, 0 to 1."""

    semantic: SemanticClass | None
    name: str = ""
    colour: Colour | None = None


@dataclass(frozen=True)
class FaceLook:
    """What a file says of the look of a polygon.

    colour: sRGB, 0 to 1, None where it has a picture alone. picture: its path as the file writes
    it. corners: of each ring (n, 2) where its corners lie on the picture, from the lower left, in
    widths and heights of it; empty without a picture.
    """

    colour: Colour | None
    opacity: float = 1.0
    picture: str | None = None
    corners: tuple[NDArray[np.float64], ...] = ()


@dataclass(frozen=True)
class BuildingFaces:
    """The polygons of one building in the coordinates of its file.

    classes: one for each polygon, None where the file does not say it. solid: whether the file
    says that the polygons close a body. surfaces: what the file says of the semantic surfaces, and
    surface: which of them each polygon is of, -1 where it does not say it; empty where formats have
    no such surfaces. looks: of each polygon, None where it has none; empty where formats have none.
    """

    id: str
    polygons: tuple[Rings, ...]
    classes: tuple[SemanticClass | None, ...]
    attributes: Mapping[str, str | int | float] = field(default_factory=dict)
    lod: str = ""
    solid: bool = False
    surfaces: tuple[SurfaceTold, ...] = ()
    surface: tuple[int, ...] = ()
    looks: tuple[FaceLook | None, ...] = ()


@dataclass(frozen=True)
class CityFile:
    """The buildings of a file. epsg: None where it names no reference system.

    left: buildings and installations that cannot be used, as (name, reason).
    """

    buildings: tuple[BuildingFaces, ...]
    epsg: int | None
    notes: tuple[str, ...] = ()
    left: tuple[tuple[str, str], ...] = ()
