"""What must be known before a house is trusted: it is said at the terminal, too."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from shapely.geometry import Polygon

from veduta.plan.document import PlanDocument, Sheet, Storey
from veduta.plan.house.flights import stairwells
from veduta.plan.house.lines import footprint, wall_lines
from veduta.plan.house.space import Space, filled
from veduta.plan.names.strays import stray_names
from veduta.plan.remarks import PLOT_NOTE, closed_in, plans_apart
from veduta.plan.scale.estimate import scale_notes
from veduta.plan.tour.find import Tour
from veduta.plan.upper_floor import upper_floor_doubts
from veduta.plan.whole import parts_only
from veduta.run.report import counted

_SHOWN = 5
DOUBTFUL = 0.5
"""Score of an opening below which it is doubtful."""
UNLIKE_STOREYS = 0.7
"""Storeys of which one covers less than this part of the other are told of."""


def doubts(document: PlanDocument, tour: Tour | None, spaces: Sequence[Space] = ()) -> list[str]:
    """One sentence each: whether it is a whole house, how the sheet lay, scale, rooms, storeys,
    stairs, and what the tour leaves out. `spaces` are the storeys as they are built, which know
    their stairs.
    """
    several = len(document.storeys) > 1
    said = parts_only(document, tour)
    for storey in document.storeys:
        of = f"{storey.name}: " if several else ""
        notes = (
            *position_notes(storey.sheet),
            *scale_notes(storey.scale),
            *_apart(storey),
            *_strays(storey),
            *_plot(storey),
            *_closed_in(storey),
            *_doubtful(storey),
            *storey.doubts,
        )
        said += [of + note for note in notes]
    said += [*upper_floor_doubts(document), *unlike_storeys(document.storeys), *_north(document)]
    # How thick the slab is matters for wells alone.
    said += [note for well in stairwells(spaces, 0.0) for note in well.notes]
    return [*said, *(() if tour is None else tour.notes)]


def position_notes(sheet: Sheet) -> list[str]:
    """That a scan was mirrored back or turned by quarters: a mistake there spoils all else."""
    turns = round(sheet.rotation_rad / (math.pi / 2.0)) % 4
    turned = f", and turned by {90 * turns} degrees" if turns else ""
    if sheet.mirrored:
        return [f"By its text the scan is a mirror image: it was mirrored back{turned}."]
    return (
        [f"By its text the scan lies on its side: turned by {90 * turns} degrees."] if turns else []
    )


def _north(document: PlanDocument) -> list[str]:
    """That an arrow to the north is drawn, by its letter, and which way it points is not read."""
    letters = (text.text.strip(" .") for storey in document.storeys for text in storey.texts)
    if document.north_deg is not None or "N" not in letters:
        return []
    return [
        "An N stands on the sheet, as beside an arrow to the north: which way that points is not"
        " read, and north is taken to be up. --north sets it."
    ]


def unlike_storeys(storeys: Sequence[Storey]) -> list[str]:
    """Neighbouring storeys whose outlines differ much: one of them may have another scale."""
    areas = [_covered(storey) for storey in storeys]
    notes = []
    for (lower, below), (upper, above) in zip(
        zip(storeys, areas, strict=True), list(zip(storeys, areas, strict=True))[1:], strict=False
    ):
        if min(below, above) < UNLIKE_STOREYS * max(below, above):
            notes.append(
                f"{lower.name} covers {below:.1f} m², {upper.name} {above:.1f} m²: storeys of one"
                " house seldom differ so much. See their scales in the report; --scale sets one."
            )
    return notes


def _covered(storey: Storey) -> float:
    return float(filled(footprint(wall_lines(storey).values())).area)


def _apart(storey: Storey) -> list[str]:
    bodies = [footprint([line]) for line in wall_lines(storey).values()]
    rooms = [Polygon(room.outline_m, room.holes_m).buffer(0.0) for room in storey.rooms]
    return plans_apart(rooms, bodies, 1.0)


def _strays(storey: Storey) -> list[str]:
    """Names in no room, or two of which each asks for a room of its own, by the document."""
    x, y = storey.sheet.origin_px
    size = storey.sheet.metres_per_px
    texts = [
        text.model_copy(
            update={"box_px": [((u - x) * size, (y - v) * size) for u, v in text.box_px]}
        )
        for text in storey.texts
    ]
    outlines = [np.array(room.outline_m, dtype=np.float64) for room in storey.rooms]
    points = [one.at_m for one in storey.junctions]
    closed = sum(room.area_m2 for room in storey.rooms if not room.outdoors)
    return [f"{note}." for note in stray_names(outlines, points, texts, closed)]


def _plot(storey: Storey) -> list[str]:
    """That walls were left out as those around the plot."""
    return [f"{PLOT_NOTE}." for _ in range(PLOT_NOTE in storey.notes)]


def _closed_in(storey: Storey) -> list[str]:
    closed = [room.id for room in closed_in(storey.rooms, storey.openings)]
    if not closed:
        return []
    more = f" and {len(closed) - _SHOWN} more" if len(closed) > _SHOWN else ""
    which = counted(len(closed), "room")
    return [f"no door was found into {which}: {', '.join(closed[:_SHOWN])}{more}."]


def _doubtful(storey: Storey) -> list[str]:
    """Which openings are doubtful, and where they are: a number of them helps nobody."""
    rooms: dict[str, list[str]] = {}
    for room in storey.rooms:
        for name in room.openings:
            rooms.setdefault(name, []).append(f"{room.name or room.use} ({room.id})")
    found = [
        f"{one.kind} {one.id} {_where(rooms.get(one.id, []))}"
        for one in storey.openings
        if one.score < DOUBTFUL
    ]
    if not found:
        return []
    more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
    return [f"doubtful: {', '.join(found[:_SHOWN])}{more}; overlay.png has a question mark there."]


def _where(rooms: Sequence[str]) -> str:
    if len(rooms) == 2:
        return f"between {rooms[0]} and {rooms[1]}"
    return f"of {rooms[0]}" if rooms else "of no room"
