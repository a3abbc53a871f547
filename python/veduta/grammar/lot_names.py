"""What people's files call the attributes of a lot: given by the call, or usual in open data."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from veduta.grammar.outline import Attribute
from veduta.run.errors import InputError

USUAL: dict[str, tuple[str, ...]] = {
    "height": (
        "building:height", "est_height", "heightAboveGround", "measuredHeight", "HEIGHT",
        "HAUTEUR", "hauteur", "hoehe", "HOEHE", "Hoehe", "altezza", "altura", "hoogte",
    ),
    "eaveHeight": ("eaves_height", "EAVE_HEIGHT"),
    "levels": (
        "building:levels", "numberOfFloorsAboveGround", "storeysAboveGround", "num_floors",
        "NB_ETAGES", "nb_etages", "etages", "floors", "storeys", "stories", "geschosse",
    ),
    "roofHeight": ("roof:height",),
    "roofShape": ("roof:shape",),
    "roofLevels": ("roof:levels",),
    "minHeight": ("min_height",),
    "buildingColour": ("building:colour", "building:color"),
    "roofColour": ("roof:colour", "roof:color"),
    "year": ("start_date", "year_built", "YEAR", "dateOfConstruction"),
}  # fmt: skip
"""By a name that rule files often have: keys of OpenStreetMap, INSPIRE and national data."""
_SAME = (("levels", "floors", "nFloors", "storeys", "stories", "numFloors"), ("height", "Height"))
"""Names of rule files that mean the same."""
_UNITS_M = {
    "": 1.0, "m": 1.0, "metre": 1.0, "meter": 1.0, "cm": 0.01, "km": 1000.0, "ft": 0.3048,
    "feet": 0.3048, "foot": 0.3048, "'": 0.3048, '"': 0.0254,
}  # fmt: skip
_MEASURE = re.compile(r"([-+]?\d+(?:[.,]\d+)?)\s*(metres?|meters?|feet|foot|cm|km|ft|m|'|\")?\s*$")
_FEET_INCHES = re.compile(r"(\d+)\s*'\s*(\d+(?:\.\d+)?)\s*\"\s*$")


def read_names(words: Sequence[str]) -> dict[str, str]:
    """`height=hauteur,levels=building:levels` as a property for each attribute."""
    names: dict[str, str] = {}
    for word in (part for text in words for part in text.split(",")):
        attribute, equals, given = (part.strip() for part in word.partition("="))
        if not equals or not attribute or not given:
            raise InputError(f"--map {word}", "is not ATTRIBUTE=PROPERTY", "Write height=hauteur.")
        names[attribute] = given
    return names


def property_of(
    name: str, properties: Mapping[str, Attribute], given: Mapping[str, str]
) -> Attribute | None:
    """The property of a lot that an attribute of the rules takes; None where it has none.

    One that the call names counts before one of the attribute's own name, and that before those
    that are usual in open data.
    """
    if name in given:
        return properties.get(given[name])
    if name in properties:
        return properties[name]
    alike = next((group for group in _SAME if name in group), (name,))
    for other in alike:
        for usual in (other, *USUAL.get(other, ())):
            if usual in properties:
                return properties[usual]
    return None


def measured(text: str) -> float | None:
    """A length in metres, with or without a unit (`12 m`, `40'`, `12,5`); None of other texts."""
    inches = _FEET_INCHES.match(text.strip())
    if inches is not None:
        return float(inches[1]) * _UNITS_M["'"] + float(inches[2]) * _UNITS_M['"']
    found = _MEASURE.match(text.strip())
    if found is None:
        return None
    unit = (found[2] or "").rstrip("s")
    return float(found[1].replace(",", ".")) * _UNITS_M[unit]
