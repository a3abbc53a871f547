"""What a place has, and what of it a format has no word for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from veduta.place.mesh import Mesh
from veduta.run.errors import InputError

if TYPE_CHECKING:
    from veduta.place.part import Part
    from veduta.place.place import Place
    from veduta.place.registry import PlaceFormat

SURFACES = "all of a part but its outline and attributes"
CLASSES = "classes"
COLOURS = "colours"
COLOURED_CORNERS = "colours of corners"
TEXTURES = "textures"
LEAVES = "what opens (doors)"
LAMPS = "lamps"
MOTION = "skeletons and shapes that change"
POINTS = "points"
CAMERAS = "cameras"
TOURS = "tours"
WALKS = "walks"
ANIMALS = "paths of animals"


def require_held(place: Place, format_: PlaceFormat, target: Path) -> None:
    """InputError where a file of this format could hold nothing of what the place has.

    A place that has nothing is no error: there is nothing to lose.
    """
    if place.parts or place.tileset is not None:
        return
    around = _around(place)
    lost = left_out_of(place, format_)
    if not around or any(kind not in lost for kind in around):
        return
    fault = f"would be empty: the place has no parts, only {' and '.join(around)}"
    remedy = "Write a .ply, which has the points." if place.clouds else "Write it with --web DIR."
    raise InputError(target, fault, remedy)


def left_out_of(place: Place, format_: PlaceFormat) -> list[str]:
    """What the place has and a file of this format does not; parts are read for it."""
    lacking = set(format_.left_out)
    if format_.points_alone and not place.parts:
        lacking.discard(POINTS)
    found = set(_around(place))
    if place.parts:
        found |= {SURFACES, CLASSES, COLOURS}
    if SURFACES in lacking:
        lacking -= {CLASSES, COLOURS, COLOURED_CORNERS, TEXTURES, LEAVES, LAMPS, MOTION}
    if lacking & {COLOURED_CORNERS, TEXTURES, LEAVES, LAMPS, MOTION}:
        for placed in place.parts.values():
            found |= _inside(placed.passing())
    return [kind for kind in format_.left_out if kind in lacking & found]


def _around(place: Place) -> list[str]:
    """What the place has besides its parts."""
    kinds = {
        POINTS: place.clouds, CAMERAS: place.cameras, TOURS: place.tours,
        WALKS: place.walks, ANIMALS: place.animals,
    }  # fmt: skip
    return [kind for kind, rows in kinds.items() if rows]


def _inside(content: Part | Mesh) -> set[str]:
    """What a part has besides plain surfaces."""
    found = set()
    if any(material.texture is not None for material in content.materials):
        found.add(TEXTURES)
    if isinstance(content, Mesh):
        if content.colours is not None:
            found.add(COLOURED_CORNERS)
        if content.morphs or content.skin is not None:
            found.add(MOTION)
        return found
    if content.movers:
        found.add(LEAVES)
    if content.lamps:
        found.add(LAMPS)
    return found
