"""From the drawings of a house to its document: read, clean, find, measure, name, compose."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon

from veduta.plan.compose import Named, compose_storey
from veduta.plan.document import PlanDocument, Scale, Sheet, Storey, Text
from veduta.plan.doubts import position_notes
from veduta.plan.drawn import Cleaned, Drawn, DrawnRoom
from veduta.plan.fittings.find import find_fittings, fitting_rooms
from veduta.plan.garage import with_garage_doors
from veduta.plan.load import LARGEST_M, size_of
from veduta.plan.names.guess import RoomFacts
from veduta.plan.names.name import name_rooms
from veduta.plan.names.storeys import StoreyName, named_apart, out_of_order, storey_name
from veduta.plan.names.strays import stray_names
from veduta.plan.no_house import check_house
from veduta.plan.openings.way_in import with_ways_in
from veduta.plan.options import PlanOptions
from veduta.plan.pages import Drawing, Scan, read_drawing
from veduta.plan.reading import cleaned_sheet, read_cleaned
from veduta.plan.registering import registered
from veduta.plan.remarks import false_flights, remarks
from veduta.plan.rooms.labels import window_notes
from veduta.plan.scale.estimate import (
    DrawnSizes,
    estimate_scale,
    judged_by,
    scale_notes,
)
from veduta.plan.scale.plausible import USUAL
from veduta.plan.scale.same_pixels import of_same_pixels
from veduta.plan.several_plans import StoreyDrawing, order_note, storeys_drawn
from veduta.plan.sheets import Pixels
from veduta.plan.stairs.find import true_flights
from veduta.plan.text.engine import prepare
from veduta.plan.text.sheet_text import read_sheet, sheet_of_file
from veduta.plan.vector.open_dxf import is_dxf
from veduta.run.errors import InputError, NotFoundError
from veduta.run.limits import limited
from veduta.run.progress import StepProgress
from veduta.run.report import Count, StepRecord, timed_step

if TYPE_CHECKING:
    from veduta.plan.vector.read import VectorPlan


@dataclass(frozen=True)
class ReadPlan:
    """The document of all drawings, and their (h, w, 3) cleaned pixels."""

    document: PlanDocument
    sheets: list[Pixels]


@dataclass(frozen=True)
class _Read:
    """A storey that a drawing shows, before its scale is known. `doubts` are said at the terminal.

    sheet_px: height and width of a sheet whose edges may cut the plan off; None of vectors.
    scale: finds the scale of a pixel of `drawn`, by what it shows and what others beside it show,
    with what is to be said of it. sizes: what it shows, None of vectors. of_file: leads the frame
    of the cleaned sheet back to the file's own.
    """

    drawn: Drawn
    sha256: str
    notes: Sequence[str]
    sheet_px: tuple[int, int] | None
    scale: Callable[[Sequence[DrawnSizes]], tuple[Scale, list[str]]]
    sizes: DrawnSizes | None
    of_file: Callable[[Sheet], Sheet]
    doubts: Sequence[str] = ()


def read_drawings(
    drawings: Sequence[Drawing],
    options: PlanOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> ReadPlan:
    """The storeys of each drawing, the lowest first; NotFoundError where one shows no plan."""
    storeys: list[Storey] = []
    titles: list[StoreyName | None] = []
    sheets: list[Pixels] = []
    every: list[Sequence[_Read]] = []
    for drawing in drawings:
        read = _read_vectors if is_dxf(drawing.path) else _read_pictures
        every.append(read(drawing, options, steps, progress))
    for drawing, shown in zip(drawings, every, strict=True):
        progress("scale and names", 0.0)
        with timed_step(steps, "scale and names") as step:
            others = _of_one_size(shown, every)
            found = _storeys_of(drawing, shown, len(storeys), options, others)
            step.counts["evidence"] = sum(len(one.scale.evidence) for one, _ in found)
        storeys += [storey for storey, _ in found]
        titles += [storey_name(one.drawn.texts) for _, one in found]
        sheets += [one.drawn.cleaned.pixels for _, one in found]
    return ReadPlan(PlanDocument(storeys=registered(_named(storeys, titles))), sheets)


def _of_one_size(shown: Sequence[_Read], every: Sequence[Sequence[_Read]]) -> list[DrawnSizes]:
    """What other files show whose pixels are as large as those of this one; a storey in each."""
    alone = [some[0] for some in every if len(some) == 1]
    if len(shown) != 1 or shown[0].sizes is None:
        return []
    finer = _finer(shown[0].drawn)
    alike = [
        one.sizes
        for one in alone
        if one.sizes is not None and math.isclose(_finer(one.drawn), finer, rel_tol=1e-3)
    ]
    own = next(index for index, one in enumerate(alike) if one is shown[0].sizes)
    return of_same_pixels(own, alike)


def _storeys_of(
    drawing: Drawing,
    shown: Sequence[_Read],
    below: int,
    options: PlanOptions,
    others: Sequence[DrawnSizes],
) -> list[tuple[Storey, _Read]]:
    """The storeys of a drawing, above so many others, with what each was read from.

    What stands beside plans and is none (an elevation, a section) is left out, and that is a doubt.
    """
    found: list[tuple[Storey, _Read]] = []
    faults: list[NotFoundError] = []
    for read in shown:
        try:
            storey = _storey(below + len(found), drawing, read, options, others)
            found.append((storey, read))
        except NotFoundError as fault:
            faults.append(fault)
    if not found:
        raise faults[0]
    if faults:
        left = f"{len(faults)} of {len(shown)} drawings on {drawing.label} left out: {faults[0]}"
        last, read = found[-1]
        found[-1] = (last.model_copy(update={"doubts": [*last.doubts, left]}), read)
    return found


def _named(storeys: Sequence[Storey], titles: Sequence[StoreyName | None]) -> list[Storey]:
    """The storeys with the names that their sheets have; the last one says a wrong order."""
    names = named_apart(titles)
    named = [
        one.model_copy(update={"name": name}) for one, name in zip(storeys, names, strict=True)
    ]
    named[-1] = named[-1].model_copy(update={"notes": [*named[-1].notes, *out_of_order(titles)]})
    return named


def _storey(
    index: int, drawing: Drawing, read: _Read, options: PlanOptions, others: Sequence[DrawnSizes]
) -> Storey:
    """The storey of a drawing, the index-th from below; InputError where it is no house's."""
    scale, said = read.scale(others)
    metres_per_px = scale.metres_per_px
    drawn = replace(read.drawn, stairs=true_flights(read.drawn, metres_per_px))
    drawn, ways_in = with_ways_in(drawn, metres_per_px)
    drawn = replace(drawn, fittings=find_fittings(drawn, metres_per_px))
    named = _names(drawn, metres_per_px)
    written = {room: one.use for room, one in named.items() if one.origin == "measured"}
    drawn = replace(drawn, fittings=fitting_rooms(drawn.fittings, written))
    drawn = with_garage_doors(drawn, written, metres_per_px)
    storey = compose_storey(
        drawn,
        scale,
        file=drawing.path.name,
        sha256=read.sha256,
        page=drawing.page,
        elevation_m=index * options.house.storey_height,
        height_m=options.house.storey_height,
        named=named,
        notes=[
            *read.notes,
            *remarks(drawn, read.sheet_px, metres_per_px),
            *ways_in,
            *false_flights(read.drawn.stairs, drawn.stairs),
            *said,
            *_strays(drawn),
            *window_notes(drawn.texts),
        ],
    )
    walls_alone = check_house(storey, drawing.label)
    if size_of(storey) > LARGEST_M:
        fault = f"is {size_of(storey):.0f} m from end to end; {LARGEST_M:.0f} m are the most"
        raise InputError(drawing.label, fault, "Give another scale with --scale.")
    sheet = read.of_file(storey.sheet)
    notes = [*position_notes(sheet), *storey.notes]
    return storey.model_copy(
        update={"sheet": sheet, "notes": notes, "doubts": [*walls_alone, *read.doubts]}
    )


def _read_pictures(
    drawing: Drawing, options: PlanOptions, steps: list[StepRecord], progress: StepProgress
) -> list[_Read]:
    """The storeys that a picture shows; their pixels are as large as each other."""
    progress(f"read {drawing.label}", 0.0)
    with timed_step(steps, f"read {drawing.label}") as step:
        prepare()
        scan = read_drawing(drawing)
        step.counts |= {"width_px": scan.pixels.shape[1], "height_px": scan.pixels.shape[0]}
    progress("text", 0.0)
    with timed_step(steps, "text") as step:
        sheet = read_sheet(scan.pixels)
        step.counts["texts"] = len(sheet.texts)
    progress("walls, openings, rooms", 0.0)
    with timed_step(steps, "walls, openings, rooms") as step:
        cleaned, texts = cleaned_sheet(sheet.pixels, sheet.texts, drawing.label)
        plans, drawn = _drawn_storeys(cleaned, texts, drawing)
        step.counts |= _counts(*drawn)
    height, width = sheet.pixels.shape[:2]
    sizes = [_drawn_sizes(one, scan) for one in drawn]

    def scale(index: int, beside: Sequence[DrawnSizes]) -> tuple[Scale, list[str]]:
        others = [*sizes[:index], *sizes[index + 1 :], *beside]
        return _picture_scale(drawn[index], sizes[index], others, options)

    said = order_note(plans) if len(drawn) > 1 else []
    return [
        _Read(
            one,
            scan.sha256,
            scan.notes,
            (height, width),
            partial(scale, index),
            sizes[index],
            lambda own: sheet_of_file(own, sheet),
            said if index == 0 else (),
        )
        for index, one in enumerate(drawn)
    ]


def _drawn_storeys(
    cleaned: Cleaned, texts: Sequence[Text], drawing: Drawing
) -> tuple[list[StoreyDrawing], list[Drawn]]:
    """The storeys of a sheet, and what was found in each.

    What no title parts and closes no room anywhere is one plan: walls alone, as of a structure,
    leave blank strips between them, too.
    """
    plans = storeys_drawn(cleaned, texts)
    drawn = _drawn_plans(plans, drawing)
    titled = any(plan.title is not None for plan in plans)
    if len(drawn) > 1 and not titled and not any(one.rooms for one in drawn):
        plans = [StoreyDrawing(cleaned, tuple(texts), None)]
        drawn = _drawn_plans(plans, drawing)
    return plans, drawn


def _drawn_plans(plans: Sequence[StoreyDrawing], drawing: Drawing) -> list[Drawn]:
    """What was found in each plan on a sheet; NotFoundError where there is no wall in any."""
    found: list[Drawn] = []
    fault = NotFoundError("a floor plan", f"{drawing.label} shows no walls", _remedy(drawing))
    for plan in plans:
        try:
            drawn = read_cleaned(plan.cleaned, plan.texts)
        except NotFoundError as none:
            fault = none
            continue
        if drawn.walls:
            found.append(drawn)
    if not found:
        raise fault
    return found


def _read_vectors(
    drawing: Drawing, options: PlanOptions, steps: list[StepRecord], progress: StepProgress
) -> list[_Read]:
    """As `_read_pictures`, of a DXF file: its sheet is in the frame of drawing units already."""
    # Not at the top: pictures need none of it.
    from veduta.plan.vector.read import DXF_LIMITS, DXF_REMEDY, read_given

    given = options.scale.scale
    progress(f"read {drawing.label}", 0.0)
    with timed_step(steps, f"read {drawing.label}") as step:
        asked = (drawing.path, None if given is None else given / 1000.0)
        plan = limited(read_given, asked, drawing.path, DXF_REMEDY, DXF_LIMITS)
        step.counts |= plan.counts | _counts(plan.drawn)
    return [
        _Read(
            plan.drawn,
            plan.sha256,
            plan.notes,
            None,
            lambda _: _vector_scale(plan),
            None,
            lambda own: own,
        )
    ]


def _counts(*drawn: Drawn) -> dict[str, Count]:
    return {
        "walls": sum(len(one.walls) for one in drawn),
        "openings": sum(len(one.openings) for one in drawn),
        "rooms": sum(len(one.rooms) for one in drawn),
    }


def _vector_scale(plan: VectorPlan) -> tuple[Scale, list[str]]:
    """Of a pixel: the unit's, with what the texts say beside it; and notes where they differ."""
    from veduta.plan.vector.units import text_notes

    drawn, unit = plan.drawn, plan.unit
    metres_per_px = unit.metres_per_px / plan.px_per_unit
    sizes = DrawnSizes(
        rooms=[room.outline_px for room in drawn.rooms],
        doors=[],
        walls=[wall.thickness_px for wall in drawn.walls],
        ink=drawn.cleaned.ink,
        texts=drawn.texts,
    )
    own = [
        one.model_copy(update={"metres_per_px": one.metres_per_px / plan.px_per_unit})
        for one in unit.evidence
    ]
    said = estimate_scale(sizes)
    written = [one for one in said.evidence if one.kind not in {"door", "assumed"}]
    told = judged_by(metres_per_px, written)
    scale = unit.model_copy(update={"metres_per_px": metres_per_px, "evidence": [*own, *told]})
    return scale, text_notes(scale, said)


def _remedy(drawing: Drawing) -> str:
    if drawing.page:
        return "Name the pages that are plans with --pages."
    return "Give the picture of a drawn plan."


def _picture_scale(
    drawn: Drawn, sizes: DrawnSizes, others: Sequence[DrawnSizes], options: PlanOptions
) -> tuple[Scale, list[str]]:
    """Of a pixel of the cleaned drawing, with notes; the option is of a pixel of the file."""
    given = options.scale.scale
    scale = estimate_scale(
        sizes, None if given is None else given / 1000.0 / _finer(drawn), beside=others
    )
    return scale, scale_notes(scale)


def _finer(drawn: Drawn) -> float:
    """How many pixels of the cleaned drawing one of the file is long."""
    return math.sqrt(abs(float(np.linalg.det(drawn.cleaned.clean_from_scan[:2, :2]))))


def _drawn_sizes(drawn: Drawn, scan: Scan) -> DrawnSizes:
    """What a drawing shows of its scale."""
    finer = _finer(drawn)
    return DrawnSizes(
        rooms=[room.outline_px for room in drawn.rooms],
        doors=_door_widths(drawn),
        walls=[wall.thickness_px for wall in drawn.walls],
        ink=drawn.cleaned.ink,
        dpi=None if scan.dpi is None else scan.dpi * finer,
        on_paper=scan.on_paper,
        texts=drawn.texts,
    )


def _door_widths(drawn: Drawn) -> list[float]:
    """Of doors; where few are drawn, of plain gaps between two rooms, too, as these are doors."""
    doors = [one.width_px for one in drawn.openings if one.kind == "door"]
    if len(doors) >= USUAL.few:
        return doors
    rooms = Counter(name for room in drawn.rooms for name in room.openings)
    gaps = [one.width_px for one in drawn.openings if one.kind == "gap" and rooms[one.id] == 2]
    return [*doors, *gaps] if len(gaps) >= USUAL.few else doors


def _names(drawn: Drawn, metres_per_px: float) -> dict[str, Named]:
    """What rooms are for, by their ids."""
    kinds = {opening.id: opening.kind for opening in drawn.openings}
    index_of = {room.id: index for index, room in enumerate(drawn.rooms)}
    rooms_of: dict[str, list[int]] = {}
    for room in drawn.rooms:
        for opening in room.openings:
            rooms_of.setdefault(opening, []).append(index_of[room.id])
    pairs = [
        (found[0], found[1])
        for opening, found in rooms_of.items()
        if len(found) == 2 and kinds[opening] != "window"
    ]
    out_m = {
        one.id: one.width_px * metres_per_px
        for one in drawn.openings
        if one.kind != "window" and len(rooms_of.get(one.id, ())) == 1
    }
    facts = [_facts(room, drawn, kinds, out_m, metres_per_px) for room in drawn.rooms]
    outlines = [room.outline_px for room in drawn.rooms]
    named = name_rooms(outlines, drawn.texts, facts, pairs)
    return {
        room.id: Named(one.use, one.score, one.name, one.origin)
        for room, one in zip(drawn.rooms, named, strict=True)
    }


def _strays(drawn: Drawn) -> list[str]:
    """What names on the sheet tell of rooms that were not found."""
    outlines = [room.outline_px for room in drawn.rooms]
    return stray_names(outlines, [one.at_px for one in drawn.junctions], drawn.texts)


def _facts(
    room: DrawnRoom,
    drawn: Drawn,
    kinds: Mapping[str, str],
    out_m: Mapping[str, float],
    metres_per_px: float,
) -> RoomFacts:
    """What is known of a room. out_m: how wide doors and gaps are that lead into no other room."""
    shape = Polygon(room.outline_px)
    around = Counter("window" if kinds[name] == "window" else "door" for name in room.openings)
    stairs = any(shape.contains(Polygon(one.outline_px).centroid) for one in drawn.stairs)
    return RoomFacts(
        area_m2=room.area_px2 * metres_per_px**2,
        elongation=_elongation(shape),
        doors=around["door"],
        windows=around["window"],
        outdoors=room.outdoors,
        stairs=stairs,
        way_out_m=max((out_m.get(name, 0.0) for name in room.openings), default=0.0),
        fittings=frozenset(one.kind for one in drawn.fittings if one.room == room.id),
    )


def _elongation(shape: Polygon) -> float:
    """Long side over short side of the least rectangle around it."""
    around = shape.minimum_rotated_rectangle
    if not isinstance(around, Polygon):
        return 1.0
    corners: NDArray[np.float64] = np.array(around.exterior.coords)
    first, second = np.linalg.norm(np.diff(corners[:3], axis=0), axis=1)
    return float(max(first, second) / max(min(first, second), 1e-9))
