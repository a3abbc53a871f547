"""Reading a facade document that somebody may have edited, and the photo beside it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.facade.document import (
    CLASSES,
    Element,
    Extent,
    FacadeBox,
    FacadeDocument,
    RuleParameters,
)
from veduta.facade.reconcile import contradictions, reconciled
from veduta.facade.scale import LARGEST_SIDE_M, SMALLEST_SIDE_M, is_possible
from veduta.imaging.read import read_image
from veduta.run.edited import SHOWN_FAULTS, numbers_of, read_edited
from veduta.run.errors import InputError

DOCUMENT = "facade.json"
PHOTO = "rectified.jpg"
MAX_BYTES = 20_000_000
MAX_ELEMENTS = 20_000
MAX_STRIPS = 4_000
"""Shutters, and mouldings: each costs a look at the whole picture."""
MAX_EXTENTS = 64
MAX_POINTS = 20_000
"""Of the polygons of all extents together, and of the outlines of all elements."""
MAX_FLOORS = 200
MAX_PAINTED = 200
"""How often all elements together may cover the picture, each by what of it lies there."""
MAX_COORDINATE = 1e6
"""No number of a document (px or m) is larger than this, by amount."""

_ROOF_OF_FACADE = 10
"""A roof is at most this many times as high as the facade below it."""
_REMEDY = "Mend it there; docs/facade.md says what each field means."


def load_document(path: Path) -> FacadeDocument:
    """The document in `path`; InputError names each place in the file and its fault.

    What an edit contradicts elsewhere in the document is made anew: see `reconcile`.
    """
    document = read_edited(path, FacadeDocument, MAX_BYTES, _REMEDY)
    faults = _faults(document) or contradictions(document)
    if faults:
        raise InputError(path, "; ".join(faults[:SHOWN_FAULTS]), _REMEDY)
    return reconciled(document)


def load_photo(document_path: Path, document: FacadeDocument) -> NDArray[np.uint8]:
    """(h, w, 3) sRGB of the rectified photo beside the document."""
    path = document_path.with_name(PHOTO)
    if not path.is_file():
        raise InputError(
            path, "does not exist", f"It must lie beside {document_path.name} as it was written."
        )
    pixels = read_image(path).pixels
    size = (document.rectification.width_px, document.rectification.height_px)
    if pixels.shape[1::-1] != size:
        raise InputError(
            path,
            f"is {pixels.shape[1]} x {pixels.shape[0]} px, but {document_path.name} describes"
            f" {size[0]} x {size[1]} px",
            f"Use the {PHOTO} that was written with it.",
        )
    return pixels


def _faults(document: FacadeDocument) -> list[str]:
    """What the schema cannot say."""
    found = [
        f"{place}: {value} is out of range"
        for place, value in numbers_of(document)
        if not (math.isfinite(value) and abs(value) <= MAX_COORDINATE)
        and not place.startswith("wall.")  # in a CRS: `Wall` has its own bounds
    ]
    if document.classes != list(CLASSES):
        # labels.png, the docs and whoever reads it know each class by its place in the list.
        found.append(f"classes: must be {', '.join(CLASSES)}, in this order")
    if len(document.elements) > MAX_ELEMENTS:
        found.append(f"elements: more than {MAX_ELEMENTS}")
    for name, strips in (("mouldings", document.mouldings), ("shutters", document.shutters)):
        if len(strips) > MAX_STRIPS:
            found.append(f"{name}: {len(strips)}, more than {MAX_STRIPS}")
    if document.storeys < 1:
        found.append(f"storeys: {document.storeys}, must be 1 or more")
    if document.scale.metres_per_px <= 0:
        found.append("scale.metres_per_px: must be above zero")
    for name, sized in _sized(document):
        for side in ("width_px", "height_px"):
            if getattr(sized, side) <= 0:
                found.append(f"{name}.{side}: must be above zero")
    found += _extent_faults(document.extents)
    found += _outline_faults(document.elements)
    found += _painting_faults(document)
    found += _size_faults(document)
    return found + _rule_faults(document.rules)


def _outline_faults(elements: list[Element]) -> list[str]:
    rings = {f"elements[{at}].outline_px": one.outline_px for at, one in enumerate(elements)}
    return _ring_faults(rings, "outlines")


def _extent_faults(extents: list[Extent]) -> list[str]:
    if len(extents) > MAX_EXTENTS:
        return [f"extents: {len(extents)}, more than {MAX_EXTENTS}"]
    rings = {f"extents[{at}].polygon_px": one.polygon_px for at, one in enumerate(extents)}
    return _ring_faults(rings, "extents")


def _ring_faults(rings: Mapping[str, Sequence[object] | None], others: str) -> list[str]:
    """Rings of too few points, or of too many together; None is no ring."""
    sizes = {name: len(ring or ()) for name, ring in rings.items()}
    found = [
        f"{name}: needs at least three points"
        for name, ring in rings.items()
        if ring is not None and sizes[name] < 3
    ]
    total = sum(sizes.values())
    if total > MAX_POINTS:
        largest = max(sizes, key=sizes.__getitem__)
        found.append(
            f"{largest}: {sizes[largest]} points, {total} with the other {others}, more than"
            f" {MAX_POINTS}"
        )
    return found


def _painting_faults(document: FacadeDocument) -> list[str]:
    """Of elements that would take for ever to paint."""
    width, height = document.rectification.width_px, document.rectification.height_px
    painted = 0.0
    for item in document.elements:
        across = min(item.x_px + item.width_px, width) - max(item.x_px, 0.0)
        down = min(item.y_px + item.height_px, height) - max(item.y_px, 0.0)
        painted += max(across, 0.0) * max(down, 0.0)
    if painted <= MAX_PAINTED * width * height:
        return []
    return [
        f"elements: together they cover the picture {painted / (width * height):.0f} times,"
        f" more than {MAX_PAINTED}"
    ]


def _rule_faults(rules: RuleParameters) -> list[str]:
    found = []
    if rules.building_height_m <= 0:
        found.append("rules.building_height_m: must be above zero")
    if not 1 <= len(rules.facade.sizes_m) <= MAX_FLOORS:
        found.append(f"rules.facade.sizes_m: needs 1 to {MAX_FLOORS} floors")
    floors = [(f"rules.floors[{index}]", split) for index, split in enumerate(rules.floors)]
    for place, split in [("rules.facade", rules.facade), *floors]:
        if len(split.symbols) != len(split.sizes_m):
            found.append(
                f"{place}: has {len(split.symbols)} symbols and {len(split.sizes_m)} sizes_m;"
                " each symbol needs a size"
            )
        found += [
            f"{place}.sizes_m[{index}]: must not be negative"
            for index, size in enumerate(split.sizes_m)
            if size < 0
        ]
    if len(rules.floors) < len(rules.facade.sizes_m) - 1:
        found.append(
            f"rules.floors: has {len(rules.floors)} floors, and rules.facade has"
            f" {len(rules.facade.sizes_m)} with the base"
        )
    return found


def _size_faults(document: FacadeDocument) -> list[str]:
    """Of the facade and the roof, in metres as the pixels and the scale say."""
    m, roof_m = document.scale.metres_per_px, document.rules.roof_height_m
    bounds = f"not between {SMALLEST_SIDE_M:g} and {LARGEST_SIDE_M:g} m"
    found = [
        f"facade.{side}: {size:g} px of {m:g} m (scale.metres_per_px) are {size * m:g} m, {bounds}"
        for side, size in (
            ("width_px", document.facade.width_px),
            ("height_px", document.facade.height_px),
        )
        if size > 0 and m > 0 and not is_possible(size * m)
    ]
    highest_m = min(LARGEST_SIDE_M, _ROOF_OF_FACADE * document.facade.height_px * m)
    if not 0.0 <= roof_m <= highest_m:
        found.append(
            f"rules.roof_height_m: {roof_m:g} m, not between 0 and {highest_m:g} m, which is"
            f" {_ROOF_OF_FACADE} times the facade or {LARGEST_SIDE_M:g} m"
        )
    return found


def _sized(document: FacadeDocument) -> list[tuple[str, Element | FacadeBox]]:
    elements = [(f"elements[{index}]", item) for index, item in enumerate(document.elements)]
    return [("facade", document.facade), *elements]
