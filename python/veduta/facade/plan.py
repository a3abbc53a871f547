"""What is built of a document, before any rule is written: places and sizes of all that stands.

All in metres of the facade frame, on whole millimetres, as the rule file has it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from veduta.facade.adjusted import left_out
from veduta.facade.cells import DECIMALS, Cell, parted, snapped
from veduta.facade.chimneys import Chimney, plan_chimneys
from veduta.facade.document import FacadeDocument
from veduta.facade.dormers import Dormer, plan_dormers, reach_m
from veduta.facade.layout import Layout, Opening, lay_out
from veduta.facade.ledges import PlannedLedge, plan_ledges
from veduta.facade.measured_depths import MeasuredDepths
from veduta.facade.mouldings import PlannedMoulding, plan_mouldings
from veduta.facade.planned_gable import PlannedGable, plan_gable
from veduta.facade.rectangles import Rectangle
from veduta.facade.roof import Mansard, plan_mansard
from veduta.facade.shutters import PlannedShutter, plan_shutters

# Recesses may take this share of the building's depth.
DEEPEST_SHARE = 0.4
# The line between two floors may move this far, so that it cuts no opening (m).
LINE_REACH_M = 1.0
# Least height of a floor's band (m).
LEAST_BAND_M = 0.3
_NOT_PARTED = "no cut of the wall parts it from the openings around it"


@dataclass(frozen=True)
class Band:
    """A floor of the front, from `foot_m` to `top_m`; the ground floor is 0."""

    floor: int
    foot_m: float
    top_m: float
    openings: tuple[Opening, ...]


@dataclass(frozen=True)
class Plan:
    """The building of a document.

    library: whether things of the asset library stand on it, or the photo on plain boxes.
    eaves_m: height of the front wall. top_m: the highest point that the photo has to show.
    """

    width_m: float
    depth_m: float
    eaves_m: float
    top_m: float
    setback_m: float
    bands: tuple[Band, ...]
    balconies: tuple[Opening, ...]
    mansard: Mansard | None
    gable: PlannedGable | None
    dormers: tuple[Dormer, ...]
    chimneys: tuple[Chimney, ...]
    mouldings: tuple[PlannedMoulding, ...]
    shutters: tuple[PlannedShutter, ...]
    library: bool
    notes: tuple[str, ...]
    depths: MeasuredDepths | None = None
    ledges: tuple[PlannedLedge, ...] = ()


def plan_building(document: FacadeDocument) -> Plan:
    """Lay out the front, its floors and the roof; the notes name what has no room."""
    notes: list[str] = []
    width, eaves = _rounded(document.facade.width_m), _rounded(document.facade.height_m)
    depth, wall = _rounded(document.model.depth_m), Rectangle(0.0, 0.0, width, eaves)
    layout = lay_out(document)
    notes.extend(layout.notes)
    openings = _separable(_snapped(layout.openings), wall, notes)
    roof_m = _rounded(document.rules.roof_height_m)
    mansard = gable = None
    if document.roof in ("gable", "hip"):
        gable = plan_gable(document.roof, (width, eaves, roof_m), layout.dormers, notes)
    elif document.roof != "flat":
        reach = _rounded(reach_m(layout.dormers, eaves))
        mansard = plan_mansard(width, depth, eaves, roof_m, reach)
    above = layout.dormers if gable is None else ()
    dormers = _on_the_slope(plan_dormers(above, mansard, notes), mansard, notes)
    if gable is not None:
        gable = _with_separable(gable, notes)
    chimneys = plan_chimneys(layout.chimneys, (width, depth, eaves), mansard, notes)
    balconies = _snapped(layout.balconies)
    ledges = plan_ledges(document, [opening.rectangle for opening in openings], eaves, notes)
    library = document.model.detail == "library"
    # Without the library no shutter is built: then none of them is worth a note.
    shutters = plan_shutters(document, wall, openings, notes if library else [])
    return Plan(
        width_m=width,
        depth_m=depth,
        eaves_m=eaves,
        top_m=_top_m(layout, mansard, eaves if gable is None else gable.top_m),
        setback_m=_rounded(min(_setback_m(document), DEEPEST_SHARE * depth)),
        bands=_bands(document.rules.facade.sizes_m, eaves, openings),
        balconies=balconies,
        mansard=mansard,
        gable=gable,
        dormers=dormers,
        chimneys=chimneys,
        mouldings=plan_mouldings(document, width, ledges),
        shutters=shutters,
        library=library,
        notes=tuple(notes),
        depths=document.depths,
        ledges=ledges,
    )


def _setback_m(document: FacadeDocument) -> float:
    """How far openings lie back that have no depth of their own: as windows do, where measured."""
    measured = None if document.depths is None else document.depths.median_m("window")
    return document.model.setback_m if measured is None else max(0.0, -measured)


def _rounded(value_m: float) -> float:
    return round(value_m, DECIMALS)


def _snapped(openings: Sequence[Opening]) -> tuple[Opening, ...]:
    return tuple(
        Opening(snapped(o.rectangle), o.element, o.number, _snapped(o.children)) for o in openings
    )


def _separable(
    openings: Sequence[Opening], region: Rectangle, notes: list[str]
) -> tuple[Opening, ...]:
    """The openings that splits can part; what cannot be is named."""
    kept = []
    names = {str(place): opening for place, opening in enumerate(openings)}
    cells, dropped = parted([Cell(o.rectangle, name) for name, o in names.items()], region)
    notes.extend(
        left_out(names[cell.content].element, names[cell.content].number, _NOT_PARTED)
        for cell in dropped
    )
    for cell in cells:
        opening = names[cell.content]
        children = _separable(opening.children, opening.rectangle, notes)
        kept.append(Opening(opening.rectangle, opening.element, opening.number, children))
    return tuple(kept)


def _with_separable(gable: PlannedGable, notes: list[str]) -> PlannedGable:
    region = Rectangle(0.0, gable.eaves_m, gable.width_m, gable.top_m)
    return replace(gable, openings=_separable(_snapped(gable.openings), region, notes))


def _on_the_slope(
    dormers: Sequence[Dormer], mansard: Mansard | None, notes: list[str]
) -> tuple[Dormer, ...]:
    if mansard is None:
        return ()
    slope = Rectangle(0.0, mansard.eaves_m, mansard.width_m, mansard.break_m)
    names = {str(place): dormer for place, dormer in enumerate(dormers)}
    cells, dropped = parted([Cell(d.front, name) for name, d in names.items()], slope)
    notes.extend(
        left_out(names[cell.content].window.element, names[cell.content].window.number, _NOT_PARTED)
        for cell in dropped
    )
    return tuple(names[cell.content] for cell in cells)


def _top_m(layout: Layout, mansard: Mansard | None, eaves_m: float) -> float:
    """The highest point that the photo has to show."""
    tops = [piece.rectangle.z1 for piece in (*layout.chimneys, *layout.balconies)]
    return _rounded(max(eaves_m if mansard is None else mansard.top_m, *tops, eaves_m))


def _bands(
    sizes_m: Sequence[float], eaves_m: float, openings: Sequence[Opening]
) -> tuple[Band, ...]:
    """The floors, with the lines between them where they cut no opening."""
    lines: list[tuple[int, float]] = [(0, 0.0)]
    at = 0.0
    for floor, size in enumerate(sizes_m[:-1], start=1):
        at += size
        line = _free_line(at, openings)
        if line is None or not lines[-1][1] + LEAST_BAND_M <= line <= eaves_m - LEAST_BAND_M:
            continue
        lines.append((floor, line))
    lines.append((len(sizes_m), eaves_m))
    return tuple(
        Band(floor, foot, top, tuple(o for o in openings if foot <= _middle(o) < top))
        for (floor, foot), (_, top) in pairwise(lines)
    )


def _middle(opening: Opening) -> float:
    return 0.5 * (opening.rectangle.z0 + opening.rectangle.z1)


def _free_line(wanted_m: float, openings: Sequence[Opening]) -> float | None:
    """The height next to the wanted one that is within no opening; None where that is far."""
    spans = sorted((o.rectangle.z0, o.rectangle.z1) for o in openings)
    low = high = wanted_m
    for foot, top in spans:
        if foot < high and top > high:
            high = top
    for foot, top in sorted(spans, key=lambda span: span[1], reverse=True):
        if foot < low and top > low:
            low = foot
    near = low if wanted_m - low < high - wanted_m else high
    return _rounded(near) if abs(near - wanted_m) <= LINE_REACH_M else None
