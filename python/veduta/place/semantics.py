"""What a surface is, and how far it can be trusted: the closed sets of the whole project."""

from __future__ import annotations

from enum import StrEnum


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
    OTHER = "other"

    @property
    def code(self) -> int:
        """Place in the list, for an uint8 column."""
        return _CLASSES.index(self)

    @staticmethod
    def of_code(code: int) -> SemanticClass:
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
        return _PROVENANCES[code]


_CLASSES: tuple[SemanticClass, ...] = tuple(SemanticClass)
_PROVENANCES: tuple[Provenance, ...] = tuple(Provenance)

# CityJSON 2.0, section 3.3: the semantic surfaces that a Building may carry. A shop front and a
# chimney have no class of their own there: the one is filled by a door-like opening that people
# look through (Window), the other is a BuildingInstallation, whose faces take the roof's class.
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
    SemanticClass.OTHER: "WallSurface",
}
# Classes that CityJSON models as openings: they name the surface that they open as parent.
OPENINGS: frozenset[SemanticClass] = frozenset(
    {SemanticClass.WINDOW, SemanticClass.DOOR, SemanticClass.SHOP}
)
# Classes that CityJSON models as objects of their own beside the building's shell.
INSTALLATIONS: frozenset[SemanticClass] = frozenset(
    {SemanticClass.BALCONY, SemanticClass.CHIMNEY, SemanticClass.CORNICE}
)
