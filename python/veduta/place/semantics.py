"""What a surface is, and how far it can be trusted: the closed sets of the whole project."""

from __future__ import annotations

from enum import StrEnum
from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray

Label = Literal["window", "wall", "balcony", "door", "roof", "chimney", "sky", "shop", "other"]
"""What a pixel of a facade's photo shows: the surfaces that are told apart there, and sky."""
LABELS: tuple[Label, ...] = get_args(Label)
"""In the order of label images: a pixel's value is its place here."""


class SemanticClass(StrEnum):
    """The class of a surface. A column stores its place in this list (`code`)."""

    WALL = "wall"
    ROOF = "roof"
    GROUND = "ground"
    WINDOW = "window"
    DOOR = "door"
    BALCONY = "balcony"
    SHOP = "shop"
    CHIMNEY = "chimney"
    CORNICE = "cornice"
    FLOOR = "floor"
    CEILING = "ceiling"
    FURNITURE = "furniture"
    SHADOW = "shadow"
    # The last: to the engine it stands for all names that it does not know.
    OTHER = "other"

    @property
    def code(self) -> int:
        """Place in the list, for an uint8 column."""
        return _CLASSES.index(self)

    @staticmethod
    def of_code(code: int) -> SemanticClass:
        """Return the class at this place in the list."""
        return _CLASSES[code]


class Provenance(StrEnum):
    """Where a surface comes from."""

    MEASURED = "measured"  # its outline was found in a record
    INFERRED = "inferred"  # it follows from measured surfaces and a stated rule
    INVENTED = "invented"  # no record shows it

    @property
    def code(self) -> int:
        """Place in the list, for an uint8 column."""
        return _PROVENANCES.index(self)

    @staticmethod
    def of_code(code: int) -> Provenance:
        """Return the provenance at this place in the list."""
        return _PROVENANCES[code]


_CLASSES: tuple[SemanticClass, ...] = tuple(SemanticClass)
_PROVENANCES: tuple[Provenance, ...] = tuple(Provenance)

# CityJSON 2.0, section 3.3: the semantic surfaces that a Building may carry. A shop front has no
# class of its own there; it is glass that people look through, an opening of its wall (Window).
# What is an installation takes the surface that its direction says (formats/cityjson.py).
CITYJSON_SURFACE: dict[SemanticClass, str] = {
    SemanticClass.WALL: "WallSurface",
    SemanticClass.ROOF: "RoofSurface",
    SemanticClass.GROUND: "GroundSurface",
    SemanticClass.WINDOW: "Window",
    SemanticClass.DOOR: "Door",
    SemanticClass.SHOP: "Window",
    SemanticClass.BALCONY: "OuterFloorSurface",
    SemanticClass.CHIMNEY: "WallSurface",
    SemanticClass.CORNICE: "OuterCeilingSurface",
    SemanticClass.FLOOR: "FloorSurface",
    SemanticClass.CEILING: "CeilingSurface",
    SemanticClass.FURNITURE: "WallSurface",
    SemanticClass.SHADOW: "WallSurface",
    SemanticClass.OTHER: "WallSurface",
}
# Classes that CityJSON models as openings: they name the surface that they open as parent.
OPENINGS: frozenset[SemanticClass] = frozenset(
    {SemanticClass.WINDOW, SemanticClass.DOOR, SemanticClass.SHOP}
)
# What is there to be looked at alone: it has no body and no area, and nobody points at it. Formats
# that measure or classify leave it out, and those that know no transparency.
DRAWN_ONLY: frozenset[SemanticClass] = frozenset({SemanticClass.SHADOW})
CLASS_NAMED: dict[str, SemanticClass] = {
    one.value: one for one in SemanticClass if one not in DRAWN_ONLY
}
"""Classes by what others may call a surface: a shadow of theirs is one, and has an area."""


def is_drawn_only(codes: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Whether a class, by its code, is there to be looked at alone; any shape."""
    return np.isin(codes, [one.code for one in DRAWN_ONLY])
