"""Names on the sheet that no room answers to: what they tell of rooms that were not found."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Point, Polygon

from veduta.plan.document import RoomUse, Text
from veduta.plan.names.vocabulary import meanings

_SURE = 0.9
"""Score of a text from which on it is taken for a room's name."""
_OPEN_AIR: tuple[RoomUse, ...] = ("balcony", "terrace", "other", "unknown")
"""Uses that may be written where no walls are."""
_ALONE: tuple[RoomUse, ...] = ("bedroom", "bathroom", "toilet", "garage")
"""Rooms that have a door: two names of such in one space say that what parts them was not found."""
_AREA = re.compile(
    r"(?P<number>\d{1,3}(?:[.,]\d{1,2})?)\s*(?:m\s?[2²]|sqm|sq\.?\s?m|qm|kvm)(?!\w)", re.IGNORECASE
)
_APART = 4.0
"""Heights of text from which on two names are not the lines of one label."""


def stray_names(
    rooms_px: Sequence[NDArray[np.float64]],
    junctions_px: Sequence[tuple[float, float]],
    texts: Sequence[Text],
    closed_m2: float | None = None,
) -> list[str]:
    """What is to be told of names that lie in no room, and of names that share one.

    closed_m2: the area of the rooms that were found: what is printed beside such names adds to it.

    rooms_px: outlines (n, 2); junctions_px: of all walls; what is written around them (titles,
    legends) counts for nothing. All in the pixels of `texts`.
    """
    if not len(junctions_px):
        return []
    polygons = [Polygon(outline).buffer(0) for outline in rooms_px]
    low, high = np.min(junctions_px, axis=0), np.max(junctions_px, axis=0)
    outside: list[Text] = []
    inside: list[list[Text]] = [[] for _ in polygons]
    for text in texts:
        middle = np.mean(text.box_px, axis=0)
        use = _use(text)
        if use is None or not ((middle > low) & (middle < high)).all():
            continue
        at = next((i for i, shape in enumerate(polygons) if shape.contains(Point(middle))), None)
        if at is not None:
            inside[at].append(text)
        elif use not in _OPEN_AIR and not _touches(text, polygons):
            outside.append(text)
    notes = []
    if outside:
        areas = [_printed_m2(one, texts) for one in outside]
        named = ", ".join(
            repr(one.text) + (f" ({area:g} m²)" if area else "")
            for one, area in zip(outside, areas, strict=True)
        )
        missing = sum(area for area in areas if area)
        with_it = f"; {closed_m2 + missing:.1f} m² with it" if closed_m2 and missing else ""
        notes.append(f"{named}: written where no closed room was found{with_it}")
    for found in inside:
        alone = _apart([text for text in found if _use(text) in _ALONE])
        if len(alone) > 1:
            named = " and ".join(repr(one.text) for one in alone)
            notes.append(f"{named} are written in one room: a wall or a door was not found")
    return notes


def _use(text: Text) -> RoomUse | None:
    """What a text names for sure; None where it is not the name of a room."""
    found = meanings(text.text)
    return found[0].use if found and found[0].score * text.score >= _SURE else None


def _printed_m2(name: Text, texts: Sequence[Text]) -> float | None:
    """The area that is printed in a name's own line, or in the nearest one of its label."""
    corners = np.array(name.box_px)
    reach = _APART * float(np.linalg.norm(corners[3] - corners[0]))
    away = [
        (float(np.linalg.norm(np.mean(one.box_px, axis=0) - corners.mean(axis=0))), found)
        for one in texts
        if (found := _AREA.search(one.text)) is not None
    ]
    near = [found for distance, found in sorted(away, key=lambda one: one[0]) if distance <= reach]
    return float(near[0]["number"].replace(",", ".")) if near else None


def _touches(text: Text, polygons: Sequence[Polygon]) -> bool:
    """Whether a label reaches into a room that is too small for it."""
    label = Polygon(text.box_px).buffer(0)
    return any(label.intersects(shape) for shape in polygons)


def _apart(texts: Sequence[Text]) -> list[Text]:
    """Without those that are lines of a label before them."""
    kept: list[Text] = []
    for text in texts:
        corners = np.array(text.box_px)
        reach = _APART * float(np.linalg.norm(corners[3] - corners[0]))
        middles = [np.mean(one.box_px, axis=0) for one in kept]
        if all(float(np.linalg.norm(corners.mean(axis=0) - one)) > reach for one in middles):
            kept.append(text)
    return kept
