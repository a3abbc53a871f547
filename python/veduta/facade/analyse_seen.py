"""From the rectified photo to the facade document by the learned eyes: the recipe."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from veduta.facade.above_eaves import Surfaces
from veduta.facade.balustrades import with_balustrades
from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.compose import Parse, compose
from veduta.facade.document import FacadeDocument, Source
from veduta.facade.evidence import Evidence, Float, gather
from veduta.facade.extent import Skyline, find_skyline
from veduta.facade.eyes import Seen, SeenElement, believed, look, seen_elements
from veduta.facade.glass import Glass, find_glass, glass_note, with_panes
from veduta.facade.heads import with_heads
from veduta.facade.hidden_windows import hidden_windows
from veduta.facade.house_folders import HOUSES_DOUBTED
from veduta.facade.houses import HouseParameters, find_party_walls, house_spans, storey_of
from veduta.facade.margins import width_doubt, without_margins
from veduta.facade.options import FacadeOptions, ScaleOptions
from veduta.facade.passages import NOT_A_PASSAGE, with_passages
from veduta.facade.presence import REMEDY, require_building
from veduta.facade.railing_boxes import on_railings
from veduta.facade.rectify import Rectified
from veduta.facade.scale import scale_notes
from veduta.facade.seen_boxes import (
    boxes_of,
    columns_of,
    in_crop,
    on_their_floors,
    with_panes_of_shops,
)
from veduta.facade.seen_front import (
    BEFORE,
    WALL,
    FrontParameters,
    hidden_notes,
    require_front,
    sides_of,
)
from veduta.facade.seen_storeys import Storeys, storeys_of
from veduta.facade.sides import Sides, crop, find_sides, whole
from veduta.run.errors import NotFoundError
from veduta.run.progress import StepProgress, no_progress
from veduta.run.report import StepRecord, timed_step


@dataclass(frozen=True)
class _Front:
    """What all houses of a picture are read from; `elements` are in pixels of what was seen."""

    rectified: Rectified
    source: Source
    seen: Seen
    evidence: Evidence
    sky: Skyline
    sides: Sides
    elements: list[SeenElement]
    glass: Glass | None = None

    @cached_property
    def wall(self) -> Float:
        """(h, w) the chance of wall, at the size of the evidence."""
        return self.seen.chance_at((self.evidence.width, self.evidence.height), *WALL)

    @cached_property
    def shop(self) -> Float:
        """(h, w) the chance of shop, at the same size."""
        return self.seen.chance_at((self.evidence.width, self.evidence.height), "shop")

    @cached_property
    def no_passage(self) -> Float:
        """(h, w) the chance of what is dark in places and no way through, at the same size."""
        size = self.evidence.width, self.evidence.height
        return self.seen.chance_at(size, *NOT_A_PASSAGE)

    @cached_property
    def hidden(self) -> Float:
        """(h, w) the chance that something stands before the front, at the same size."""
        return self.seen.chance_at((self.evidence.width, self.evidence.height), *BEFORE)

    def surfaces(self, left: int, right: int, bottom: int) -> Surfaces:
        """Wall, roof and windows between two columns, down to a row of the evidence."""
        size, inside = (self.evidence.width, self.evidence.height), np.s_[:bottom, left:right]
        roof, window = (self.seen.chance_at(size, kind)[inside] for kind in ("roof", "window"))
        return Surfaces(self.wall[inside], roof, window)

    def is_pane(self, box: Box, left: int) -> bool:
        """Whether a box that counts from a column is a pane of glass, which has no arched head."""
        x, y = left + box.x + 0.5 * box.width, box.y + 0.5 * box.height
        return self.glass is not None and self.glass.has(box.kind, x, y)

    def between(self, left: int, right: int) -> list[SeenElement]:
        """The elements between two columns of the evidence, from the left one on."""
        size = right - left, min(self.evidence.height, self.sides.bottom)
        return in_crop(self.elements, self.evidence.px_per_rectified, left, size)


def analyse_seen(
    rectified: Rectified,
    source: Source,
    options: FacadeOptions,
    progress: StepProgress = no_progress,
    seen: Seen | None = None,
) -> tuple[FacadeDocument, list[StepRecord]]:
    """Read a rectified facade with the learned eyes; NotFoundError where the image shows none.

    All that stands between its sides is one house. seen: what the eyes see in it, of a caller that
    has looked already.
    """
    steps: list[StepRecord] = []
    front = _look_at(rectified, source, seen, steps, progress)
    document = _read(front, front.sides, options, steps, progress)
    progress("document", 1.0)
    return document, steps


def analyse_houses(
    rectified: Rectified,
    source: Source,
    options: FacadeOptions,
    progress: StepProgress = no_progress,
    seen: Seen | None = None,
) -> tuple[list[FacadeDocument], list[StepRecord], list[list[StepRecord]]]:
    """The same for each house of the picture, from left to right; all in one scale.

    Beside the steps of the picture and its widest house, those of each other one by itself.
    """
    steps: list[StepRecord] = []
    front = _look_at(rectified, source, seen, steps, progress)
    with timed_step(steps, "houses") as step:
        spans, doubt = _houses(front)
        step.counts["houses"] = len(spans)
    try:
        documents, own = _read_each(front, spans, options, steps, progress)
    except NotFoundError as error:
        if len(spans) == 1:
            raise
        steps[-1].rejected.append(f"houses: one of {len(spans)} is no front ({error})")
        documents, own = [_read(front, front.sides, options, steps, progress)], [[]]
    if doubt:
        documents = [one.model_copy(update={"notes": [*one.notes, doubt]}) for one in documents]
    progress("document", 1.0)
    return documents, steps, own


def _houses(front: _Front) -> tuple[list[Sides], str]:
    """Where each house stands, from left to right; and a doubt whether these are all.

    Borders are looked for in the whole picture: what the sides cut off may be a house.
    """
    own, sides = HouseParameters(), front.sides
    elements = front.between(0, front.evidence.width)
    found = find_party_walls(front.evidence, front.seen, elements, own)
    if front.glass is not None:
        found = found.without(front.glass.goes_on)
    windows = [e for e in elements if e.kind == "window"]
    if found.walls:
        storey = storey_of(windows)
        borders = 0, front.evidence.width
        houses = house_spans(found.walls, windows, borders, storey, own)
        spans = [_clipped(sides, a, b, own.narrowest * storey) for a, b in houses]
    else:
        spans = [sides]
    unsure = found.doubtful
    if unsure is None or len(spans) > 1 or not sides.left < unsure.x < sides.right:
        return spans, ""
    share = 100 * unsure.x / front.evidence.width
    return spans, (
        f"{HOUSES_DOUBTED}; what is left and right of {share:.0f} % of its width"
        " differs. --corners, or a crop of each, parts them"
    )


def _clipped(sides: Sides, left: int, right: int, least: float) -> Sides:
    """The sides of a house; where the picture's own sides cut through it, it ends there."""
    if left < sides.left < right - least:
        left = sides.left
    if left + least < sides.right < right:
        right = sides.right
    kept = tuple(r for r in sides.reasons if not r.startswith("sides:"))
    return replace(sides, left=left, right=right, reasons=kept)


def _read_each(
    front: _Front,
    spans: list[Sides],
    options: FacadeOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> tuple[list[FacadeDocument], list[list[StepRecord]]]:
    """The widest house has the scale; the others have widths in it, and steps of their own."""
    widest = max(spans, key=lambda span: span.right - span.left)
    main = _read(front, widest, options, steps, progress)
    found = []
    own_steps: list[list[StepRecord]] = [[] for _ in spans]
    for span, others in zip(spans, own_steps, strict=True):
        if span is widest:
            found.append(main)
            continue
        wide_px = (span.right - span.left) / front.evidence.px_per_rectified
        scale = ScaleOptions(width_m=max(0.5, wide_px * main.scale.metres_per_px))
        own = options.model_copy(update={"scale": scale})
        document = _read(front, span, own, others, progress)
        found.append(_scaled_as(main, document, options.scale))
    return found, own_steps


def _scaled_as(
    main: FacadeDocument, document: FacadeDocument, options: ScaleOptions
) -> FacadeDocument:
    """The document, which says of its scale what that of the main house says."""
    scale = document.scale.model_copy(update={"basis": main.scale.basis})
    notes = [*document.notes, *scale_notes(main.scale, options)]
    return document.model_copy(update={"scale": scale, "notes": list(dict.fromkeys(notes))})


def _look_at(
    rectified: Rectified,
    source: Source,
    seen: Seen | None,
    steps: list[StepRecord],
    progress: StepProgress,
) -> _Front:
    front = FrontParameters()
    with timed_step(steps, "eyes") as step:
        progress("eyes", 0.0)
        seen = seen or look(rectified.pixels)
        elements = believed(found := seen_elements(seen), seen)
        step.counts["not believed"] = len(found) - len(elements)
        for kind in seen.kinds:
            step.counts[kind] = sum(e.kind == kind for e in elements)
        require_front(seen, found, elements, front)
    with timed_step(steps, "extent") as step:
        progress("extent", 0.3)
        evidence = gather(rectified.pixels, rectified.valid)
        require_building(evidence)
        size = evidence.width, evidence.height
        elements = on_railings(elements, seen, evidence)
        sky = find_skyline(evidence, seen.chance_at(size, "sky"))
        named = rectified.record.method == "corners"
        sides = whole(evidence) if named else _sides(evidence, sky, seen, elements, front)
        glass = find_glass(evidence, seen)
        elements = with_panes(elements, glass, evidence.px_per_rectified)
        _, skyline = crop(evidence, sky, sides)
        step.counts |= {"skyline_row": skyline.level, "left": sides.left, "right": sides.right}
        if skyline.reason:
            step.rejected.append(f"sky: {skyline.reason}")
        if glass is not None:
            step.counts["panes"] = len(glass.panes)
    return _Front(rectified, source, seen, evidence, sky, sides, elements, glass)


def _read(
    front: _Front,
    sides: Sides,
    options: FacadeOptions,
    steps: list[StepRecord],
    progress: StepProgress,
) -> FacadeDocument:
    """The document of what stands between the sides."""
    inner, skyline = crop(front.evidence, front.sky, sides)
    with timed_step(steps, "floors") as step:
        progress("floors", 0.5)
        storeys, elements = _floors(front, sides, inner, skyline, options)
        step.counts["floors_above_ground"] = len(storeys.floors.boundaries) - 1
        step.rejected.extend(
            f"{one.kind}: between even storeys, or in a strip: a relief or a sign"
            for one in storeys.none
        )
    with timed_step(steps, "openings") as step:
        columns, boxes = _openings(front, sides, inner, storeys, elements)
        hidden = sum(box.is_inferred for box in boxes)
        step.counts["hidden"] = hidden
        step.counts["arched"] = sum(bool(box.outline) for box in boxes)
        step.counts["passages"] = sum(box.is_passage for box in boxes)
        for kind in front.seen.kinds:
            step.counts[kind] = sum(box.kind == kind for box in boxes)
    with timed_step(steps, "document"):
        parse = Parse(
            inner, front.sky, skyline, sides, storeys.floors, columns, boxes, [*storeys.doubts],
            storeys.gable, storeys.roof,
        )  # fmt: skip
        document = compose(parse, front.rectified, front.source, options)
        return document.model_copy(update={"notes": _notes(front, document, hidden)})


def _floors(
    front: _Front, sides: Sides, inner: Evidence, skyline: Skyline, options: FacadeOptions
) -> tuple[Storeys, list[SeenElement]]:
    """The storeys between the sides, and the elements there; NotFoundError where there is none."""
    elements = front.between(sides.left, sides.right)
    if not elements:
        reason = "between the left and the right end of the building is no window or door"
        raise NotFoundError("a facade", reason, REMEDY)
    surfaces = front.surfaces(sides.left, sides.right, inner.height)
    storeys = storeys_of(inner, skyline, elements, surfaces, options)
    return storeys, [e for e in elements if e not in storeys.none]


def _openings(
    front: _Front, sides: Sides, inner: Evidence, storeys: Storeys, elements: list[SeenElement]
) -> tuple[Columns, list[Box]]:
    """The boxes of the elements in their shapes, and of hidden windows; balconies are last."""
    boundaries = storeys.floors.boundaries
    part = np.s_[: inner.height, sides.left : sides.right]
    elements = on_their_floors(elements, boundaries)
    elements = with_panes_of_shops(elements, boundaries, front.shop[part])
    columns = columns_of(elements)
    boxes = boxes_of(elements, boundaries, columns)
    if front.glass is None:
        other = front.no_passage[part]
        boxes = with_passages(boxes, inner.lab[..., 0], front.wall[part], other, boundaries[-1])
    boxes = with_balustrades(boxes, boundaries[0])
    panes = [box for box in boxes if front.is_pane(box, sides.left)]
    others = [box for box in boxes if not front.is_pane(box, sides.left)]
    boxes = [*with_heads(others, inner.lab), *panes]
    hidden = hidden_windows(boxes, columns, len(boundaries) - 1, front.hidden[part])
    return columns, sorted([*boxes, *hidden], key=lambda box: box.kind == "balcony")


def _notes(front: _Front, document: FacadeDocument, hidden: int) -> list[str]:
    """Those of the document, and what stands before the front, is of glass, unsure or hidden."""
    metres_per_px = document.scale.metres_per_px / front.evidence.px_per_rectified
    notes = [*document.notes, *hidden_notes(front.seen, FrontParameters())]
    notes += filter(None, [glass_note(front.glass, metres_per_px), width_doubt(document)])
    through = sum(e.passage for e in document.elements)
    if through:
        notes.append(f"passages: {through} on the ground floor; how deep they are is invented")
    if hidden:
        notes.append(f"windows: {hidden} are hidden, and taken to be as those beside them")
    return notes


def _sides(
    evidence: Evidence,
    skyline: Skyline,
    seen: Seen,
    elements: list[SeenElement],
    parameters: FrontParameters,
) -> Sides:
    """NotFoundError of the plain sides is theirs alone: then all of the picture is read."""
    try:
        plain = find_sides(evidence, skyline)
    except NotFoundError:
        plain = whole(evidence)
    size = evidence.width, evidence.height
    moved = in_crop(elements, evidence.px_per_rectified, 0, size)
    sides = sides_of(plain, evidence, seen, moved, parameters)
    return without_margins(sides, evidence, seen, moved)
