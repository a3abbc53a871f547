"""What people's files call the attributes of a lot: given by the call, or usual in open data."""

from __future__ import annotations

import functools
import re
import unicodedata
from collections.abc import Mapping, Sequence

from veduta.grammar.outline import Attribute
from veduta.run.errors import InputError

USUAL: dict[str, tuple[str, ...]] = {
    "height": (
        "building:height", "est_height", "heightAboveGround", "measuredHeight", "HEIGHT",
        "hauteur", "hoehe", "altezza", "altura", "hoogte", "building_height", "gebaeudehoehe",
        "geb_hoehe",
    ),
    "eaveHeight": ("eaves_height", "EAVE_HEIGHT"),
    "levels": (
        "building:levels", "numberOfFloorsAboveGround", "storeysAboveGround", "num_floors",
        "nb_etages", "etages", "floors", "storeys", "stories", "geschosse", "anzahl_geschosse",
        "geschosszahl", "plantas", "piani", "bouwlagen",
    ),
    "roofHeight": ("roof:height",),
    "roofShape": ("roof:shape",),
    "roofLevels": ("roof:levels",),
    "minHeight": ("min_height",),
    "buildingColour": ("building:colour", "building:color"),
    "roofColour": ("roof:colour", "roof:color"),
    "year": ("start_date", "year_built", "YEAR", "dateOfConstruction"),
}  # fmt: skip
"""By a name that rule files often have: keys of OpenStreetMap, INSPIRE and national data. They are
known in any case, with umlauts, and with or without `_` and `-` (`Höhe`, `NumFloors`). Names that
American cities use for heights in feet (`heightroof`, `bldg_height`) are not: a bare number is one
of metres, but where the call says its unit."""
_SAME = (("levels", "floors", "nFloors", "storeys", "stories", "numFloors"), ("height", "Height"))
"""Names of rule files that mean the same."""
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue"})
_UNITS_M = {
    "": 1.0, "m": 1.0, "metre": 1.0, "meter": 1.0, "cm": 0.01, "km": 1000.0, "ft": 0.3048,
    "feet": 0.3048, "foot": 0.3048, "'": 0.3048, '"': 0.0254,
}  # fmt: skip
_MEASURE = re.compile(r"([-+]?\d+(?:[.,]\d+)?)\s*(metres?|meters?|feet|foot|cm|km|ft|m|'|\")?\s*$")
_FEET_INCHES = re.compile(r"(\d+)\s*'\s*(\d+(?:\.\d+)?)\s*\"\s*$")
_BARE = re.compile(r"[-+]?\d+(?:[.,]\d+)?$")
_IN_UNIT = re.compile(r"(.+?)\s*\[([^\[\]]*)\]$")
"""A property and the unit of its bare numbers: `heightroof[ft]`."""


def read_names(words: Sequence[str]) -> dict[str, str]:
    """`height=hauteur,levels=building:levels` as a property for each attribute.

    A unit may stand behind a property, in which its bare numbers are: `height=heightroof[ft]`.
    """
    names: dict[str, str] = {}
    for word in (part for text in words for part in text.split(",")):
        attribute, equals, given = (part.strip() for part in word.partition("="))
        if not equals or not attribute or not given:
            raise InputError(f"--map {word}", "is not ATTRIBUTE=PROPERTY", "Write height=hauteur.")
        unit = _IN_UNIT.match(given)
        if unit is not None and _metres_of(unit[2]) is None:
            known = ", ".join(name for name in _UNITS_M if name.isalpha())
            fault = f"names no known unit, {unit[2]!r}"
            raise InputError(f"--map {word}", fault, f"Name one: {known}.")
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
        return _given_property(given[name], properties)
    if name in properties:
        return properties[name]
    alike = next((group for group in _SAME if name in group), (name,))
    for other in alike:
        for usual in (other, *USUAL.get(other, ())):
            if usual in properties:
                return properties[usual]
    usual_names = {_folded(usual) for other in alike for usual in USUAL.get(other, ())}
    found = (
        value
        for key, value in properties.items()
        if value is not None and _folded(key) in usual_names
    )
    return next(found, None) if usual_names else None


def _given_property(given: str, properties: Mapping[str, Attribute]) -> Attribute | None:
    """The property that a call names, in metres where the call says the unit of its numbers."""
    unit = _IN_UNIT.match(given)
    if given in properties or unit is None:
        return properties.get(given)
    value, metres = properties.get(unit[1]), _metres_of(unit[2])
    if isinstance(value, str) and _BARE.match(value.strip()):
        value = float(value.replace(",", "."))
    if metres is None or isinstance(value, (bool, str)) or value is None:
        return value
    return value * metres


def _metres_of(unit: str) -> float | None:
    """How many metres a unit is, in any case and number; None where it is none."""
    name = unit.strip().casefold()
    return _UNITS_M.get(name, _UNITS_M.get(name.rstrip("s"))) if name else None


@functools.lru_cache(maxsize=4096)
def _folded(name: str) -> str:
    """A name in lower case without accents, and without what stands between its words."""
    plain = unicodedata.normalize("NFC", name).casefold().translate(_UMLAUTS)
    parted = unicodedata.normalize("NFKD", plain)
    return "".join(sign for sign in parted if sign.isalnum() or sign == ":")


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
