"""Outlines with heights (GeoJSON, GeoPackage) as prisms: a city model of LoD1."""

from __future__ import annotations

import contextlib
import re
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.formats.building_faces import BuildingFaces, CityFile, Rings
from veduta.grammar.lots import Lots, read_lots
from veduta.grammar.options import LotOptions
from veduta.grammar.outline import Attribute
from veduta.photos.options import ModelOptions
from veduta.place.semantics import SemanticClass
from veduta.run.errors import InputError

HEIGHTS = ("height", "measuredheight", "building:height", "hoehe", "höhe", "hoogte", "hauteur")
"""Names of attributes in metres, in small letters, in the order in which they are looked for."""
LEVELS = ("building:levels", "levels", "storeys", "storeysaboveground", "geschosse", "numfloors")
GROUNDS = ("ground_elevation", "ground_height", "base_elevation", "base_height", "h_maaiveld")
"""Of the ground above the sea (m), where the outlines themselves have no heights."""
LEVEL_M = 3.0
"""Height of a storey, where only their number is known."""
LOWEST_M, HIGHEST_M = 1.0, 1000.0
_NUMBER = re.compile(r"\s*([0-9]+(?:[.,][0-9]+)?)\s*(m|metres|meters)?\s*")


def read_outlines(path: Path, options: ModelOptions) -> CityFile:
    """The buildings of a file of outlines; those without a height are left out and named."""
    lots = _lots(path, options)
    origin = np.array(lots.origin_m)
    buildings: list[BuildingFaces] = []
    left: list[tuple[str, str]] = []
    sources: Counter[str] = Counter()
    with contextlib.closing(lots):
        for lot in lots.lots:
            found = _height(lot.attributes, options.height_attribute)
            if found is None:
                left.append((lot.name, "has no height"))
                continue
            height, source = found
            sources[source] += 1
            foot = np.array(lot.anchor_m) + origin
            if foot[2] == 0.0:
                foot[2] = _ground(lot.attributes)
            base = [np.column_stack([ring, np.zeros(len(ring))]) + foot for ring in lot.rings_m]
            polygons, classes = prism(base, height)
            kept = {
                name: value for name, value in lot.attributes.items() if not isinstance(value, bool)
            }
            buildings.append(BuildingFaces(lot.id, polygons, classes, kept, lod="1", solid=True))
    if not buildings:
        raise InputError(
            path,
            f"none of its {len(left)} outlines has a height",
            "Name the attribute in metres with --height-attribute.",
        )
    told = ", ".join(f"{count} from {source!r}" for source, count in sorted(sources.items()))
    notes = [*lots.notes, f"heights of the outlines: {told}"]
    if any(source.lower() in LEVELS for source in sources):
        notes.append(f"where only storeys are told, each was taken for {LEVEL_M:g} m")
    epsg = None if lots.crs is None else int(lots.crs.partition(":")[2])
    return CityFile(tuple(buildings), epsg, tuple(notes), tuple(left))


def _lots(path: Path, options: ModelOptions) -> Lots:
    """The outlines; a CRS that the file names and nobody knows is settled by `--crs`."""
    try:
        return read_lots(path, LotOptions(layer=options.layer))
    except InputError as error:
        if options.crs is None or "crs that is not read" not in error.fault:
            raise
    return read_lots(path, LotOptions(layer=options.layer, crs=options.crs))


def prism(
    base: list[NDArray[np.float64]], height_m: float
) -> tuple[tuple[Rings, ...], tuple[SemanticClass, ...]]:
    """Ground, roof and walls over (n, 3) rings: the outline counter-clockwise, holes clockwise."""
    lifted = [ring + np.array([0.0, 0.0, height_m]) for ring in base]
    polygons: list[Rings] = [tuple(ring[::-1] for ring in base), tuple(lifted)]
    classes = [SemanticClass.GROUND, SemanticClass.ROOF]
    for low, high in zip(base, lifted, strict=True):
        quads = np.stack([low, np.roll(low, -1, 0), np.roll(high, -1, 0), high], axis=1)
        polygons += [(quad,) for quad in quads]
        classes += [SemanticClass.WALL] * len(quads)
    return tuple(polygons), tuple(classes)


def _height(attributes: Mapping[str, Attribute], wanted: str | None) -> tuple[float, str] | None:
    """The height (m) and the attribute that says it."""
    if wanted is not None:
        number = _number(attributes.get(wanted))
        return None if number is None else (number, wanted)
    by_name = {name.lower(): name for name in attributes}
    for names, unit in ((HEIGHTS, 1.0), (LEVELS, LEVEL_M)):
        for name in names:
            if name in by_name:
                number = _number(attributes[by_name[name]], unit)
                if number is not None:
                    return number, by_name[name]
    return None


def _ground(attributes: Mapping[str, Attribute]) -> float:
    for name, value in attributes.items():
        if name.lower() in GROUNDS and isinstance(value, float) and abs(value) < 10_000.0:
            return value
    return 0.0


def _number(value: Attribute | None, unit: float = 1.0) -> float | None:
    if isinstance(value, str):
        match = _NUMBER.fullmatch(value)
        value = float(match[1].replace(",", ".")) if match else None
    if value is None or isinstance(value, bool):
        return None
    return unit * value if LOWEST_M <= unit * value <= HIGHEST_M else None
