"""What the steps found, in pixels and metres: the facade document."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.facade.boxes import Box
from veduta.facade.columns import Columns
from veduta.facade.derive import derivation, rule_parameters
from veduta.facade.document import (
    SURE_SCORE,
    Element,
    EnergyTerm,
    Extent,
    FacadeBox,
    FacadeDocument,
    Rectification,
    RoofKind,
    Source,
)
from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.gable import Gable
from veduta.facade.measured.elevation import metres_per_px
from veduta.facade.options import FacadeOptions
from veduta.facade.rectify import Rectified
from veduta.facade.roof import LEAST_ROOF_M
from veduta.facade.scale import metres, require_possible, scale_notes
from veduta.facade.sides import Sides


@dataclass(frozen=True)
class Parse:
    """What the steps found, in analysis pixels; all but `sky` count from the left side.

    `doubts` are the reasons why the floors may be other ones.
    """

    evidence: Evidence
    sky: Skyline
    skyline: Skyline
    sides: Sides
    floors: Floors
    columns: Columns
    boxes: list[Box]
    doubts: list[str]
    gable: Gable | None = None
    roof: RoofKind = "mansard"


@dataclass(frozen=True)
class _Enlargement:
    """Rectified pixels per analysis pixel."""

    across: float
    down: float


def compose(
    parse: Parse, rectified: Rectified, source: Source, options: FacadeOptions
) -> FacadeDocument:
    """Bring everything to rectified pixels and metres, and derive rules and tree from it.

    InputError and NotFoundError where the facade would have a size that none has.
    """
    record = rectified.record
    k = _enlargement(parse, record)
    rows = [round(b * k.down, 2) for b in parse.floors.boundaries]
    left, right = (round(x * k.across, 2) for x in (parse.sides.left, parse.sides.right))
    bottom = round(parse.sides.bottom * k.down, 2)
    storey = parse.floors.storey_px * k.down
    known = metres_per_px(options.elevation, record)
    scale = metres(rows, bottom, options.scale, storey, right - left, known)
    m = scale.metres_per_px
    facade = FacadeBox(
        x_px=left,
        y_px=rows[0],
        width_px=right - left,
        height_px=bottom - rows[0],
        width_m=(right - left) * m,
        height_m=(bottom - rows[0]) * m,
    )
    require_possible(facade, record, scale.basis)
    elements = [_element(b, k, facade, m) for b in parse.boxes]
    ridge = parse.skyline.level if parse.gable is None else parse.gable.top
    rules = rule_parameters(rows, ridge * k.down, facade, elements, m)
    notes = [*rectified.notes, *parse.sides.reasons, *scale_notes(scale, options.scale)]
    if parse.skyline.reason:
        notes.append(f"no sky: {parse.skyline.reason}; the eaves and the roof are inferred")
    notes += parse.doubts
    return FacadeDocument(
        source=source,
        rectification=record,
        scale=scale,
        facade=facade,
        extents=_extents(parse, k, rows[0], facade, record),
        elements=elements,
        roof="flat" if rules.roof_height_m < LEAST_ROOF_M else parse.roof,
        storeys=len(parse.floors.boundaries),
        storeys_doubtful=bool(parse.doubts),
        rules=rules,
        derivation=derivation(rules, facade, elements),
        energy=_energies(parse),
        notes=notes,
    )


def _enlargement(parse: Parse, record: Rectification) -> _Enlargement:
    """From sizes in whole pixels: the analysis image's are rounded, so the axes differ a little."""
    height = round(record.height_px * parse.evidence.px_per_rectified)
    return _Enlargement(record.width_px / len(parse.sky.rows), record.height_px / height)


def _energies(parse: Parse) -> dict[str, EnergyTerm]:
    floors, columns = parse.floors, parse.columns
    return {
        "floors": EnergyTerm(
            total=floors.energy,
            terms=floors.terms,
            nodes=len(floors.boundaries) - 1,
            labels=floors.labels,
        ),
        "columns": EnergyTerm(
            total=columns.energy,
            terms=columns.terms,
            nodes=len(columns.stripes),
            labels=columns.labels,
        ),
    }


def _element(box: Box, k: _Enlargement, facade: FacadeBox, m: float) -> Element:
    x, width = round(facade.x_px + box.x * k.across, 2), round(box.width * k.across, 2)
    y, height = round(box.y * k.down, 2), round(box.height * k.down, 2)
    width = min(width, facade.x_px + facade.width_px - x)
    height = min(height, facade.y_px + facade.height_px - y)
    is_measured = box.score >= SURE_SCORE and not box.is_inferred
    return Element.model_validate(
        {
            "class": box.kind,
            "x_px": x,
            "y_px": y,
            "width_px": width,
            "height_px": height,
            "x_m": (x - facade.x_px) * m,
            "y_m": (facade.y_px + facade.height_px - y - height) * m,
            "width_m": width * m,
            "height_m": height * m,
            "score": box.score,
            "outline_px": _outline(box, k, facade) or None,
            "floor": box.floor,
            "column": box.column,
            "provenance": "measured" if is_measured else "inferred",
            "passage": box.is_passage,
            "balustrade": box.is_balustrade,
        }
    )


def _outline(box: Box, k: _Enlargement, facade: FacadeBox) -> list[tuple[float, float]]:
    """The outline in rectified pixels, within the element's rectangle."""
    left, right = facade.x_px + box.x * k.across, facade.x_px + facade.width_px
    right = min(right, left + box.width * k.across)
    top, foot = box.y * k.down, facade.y_px + facade.height_px
    foot = min(foot, top + box.height * k.down)
    return [
        (
            round(min(max(facade.x_px + x * k.across, left), right), 2),
            round(min(max(y * k.down, top), foot), 2),
        )
        for x, y in box.outline
    ]


def _extents(
    parse: Parse, k: _Enlargement, eaves: float, facade: FacadeBox, record: Rectification
) -> list[Extent]:
    """Surroundings, roof, wall and sky; each covers what was painted before it."""
    width, height = float(record.width_px), float(record.height_px)
    left, right = facade.x_px, facade.x_px + facade.width_px
    bottom = facade.y_px + facade.height_px
    regions = {}
    if left > 0 or right < width or bottom < height:
        regions["other"] = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    regions["roof"] = [(left, 0.0), (right, 0.0), (right, eaves), (left, eaves)]
    regions["wall"] = [(left, eaves), (right, eaves), (right, bottom), (left, bottom)]
    if parse.sky.rows.any():
        regions["sky"] = [(0.0, 0.0), *_skyline_outline(parse.sky, k), (width, 0.0)]
    # Without sky above it nothing tells how high the roof is, nor that there is one.
    inferred = {"roof"} if parse.skyline.reason else set()
    return [
        Extent.model_validate(
            {
                "class": name,
                "polygon_px": points,
                "provenance": "inferred" if name in inferred else "measured",
            }
        )
        for name, points in regions.items()
    ]


def _skyline_outline(skyline: Skyline, k: _Enlargement) -> list[tuple[float, float]]:
    """The skyline as steps, left to right, in rectified pixels."""
    changes = np.flatnonzero(np.diff(skyline.rows)) + 1
    starts = [0, *changes.tolist()]
    ends = [*changes.tolist(), len(skyline.rows)]
    points: list[tuple[float, float]] = []
    for start, end in zip(starts, ends, strict=True):
        y = round(float(skyline.rows[start]) * k.down, 2)
        points += [(round(start * k.across, 2), y), (round(end * k.across, 2), y)]
    return points
