"""What the steps found, in pixels and metres: the facade document."""

from __future__ import annotations

import numpy as np

from veduta.facade.columns import Columns
from veduta.facade.derive import derivation, rule_parameters
from veduta.facade.document import (
    Element,
    EnergyTerm,
    Extent,
    FacadeBox,
    FacadeDocument,
    Scale,
    Source,
)
from veduta.facade.evidence import Evidence
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.openings import Box
from veduta.facade.options import FacadeOptions, ScaleOptions
from veduta.facade.rectify import Rectified

ASSUMED_STOREY_M = 3.0


def compose(
    rectified: Rectified,
    source: Source,
    options: FacadeOptions,
    evidence: Evidence,
    skyline: Skyline,
    floors: Floors,
    columns: Columns,
    boxes: list[Box],
) -> FacadeDocument:
    """Bring everything to rectified pixels and metres, and derive rules and tree from it."""
    record = rectified.record
    k = 1.0 / evidence.px_per_rectified
    rows = [round(b * k, 2) for b in floors.boundaries]
    scale = metres(rows, record.height_px, options.scale)
    m = scale.metres_per_px
    eaves = rows[0]
    facade = FacadeBox(
        x_px=0,
        y_px=eaves,
        width_px=record.width_px,
        height_px=record.height_px - eaves,
        width_m=record.width_px * m,
        height_m=(record.height_px - eaves) * m,
    )
    elements = [_element(b, k, facade, m) for b in boxes]
    rules = rule_parameters(rows, skyline.level * k, facade, elements, m)
    notes = list(rectified.notes)
    if scale.basis == "assumed-storey":
        notes.append(f"scale: the mean storey is assumed to be {ASSUMED_STOREY_M} m")
    if skyline.reason:
        notes.append(f"no sky: {skyline.reason}")
    return FacadeDocument(
        source=source,
        rectification=record,
        scale=scale,
        facade=facade,
        extents=_extents(skyline, rows, k, record.width_px, record.height_px),
        elements=elements,
        storeys=len(floors.boundaries),
        rules=rules,
        derivation=derivation(rules, facade, elements),
        energy={
            "floors": EnergyTerm(
                total=floors.energy,
                terms=floors.terms,
                nodes=len(floors.boundaries) - 1,
                labels=floors.labels,
            ),
            "columns": EnergyTerm(
                total=columns.energy, terms={}, nodes=len(columns.stripes), labels=columns.labels
            ),
        },
        notes=notes,
    )


def metres(rows: list[float], height_px: int, options: ScaleOptions) -> Scale:
    """Metres per rectified pixel from the height, the storey, or an assumed storey of 3 m."""
    if options.height_m is not None:
        return Scale(metres_per_px=options.height_m / (height_px - rows[0]), basis="height")
    storey_px = (rows[-1] - rows[0]) / (len(rows) - 1)
    if options.storey_m is not None:
        return Scale(metres_per_px=options.storey_m / storey_px, basis="storey")
    return Scale(metres_per_px=ASSUMED_STOREY_M / storey_px, basis="assumed-storey")


def _element(box: Box, k: float, facade: FacadeBox, m: float) -> Element:
    x, y, width, height = (round(v * k, 2) for v in (box.x, box.y, box.width, box.height))
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
            "floor": box.floor,
            "column": box.column,
        }
    )


def _extents(
    skyline: Skyline, rows: list[float], k: float, width: int, height: int
) -> list[Extent]:
    """Wall, ground, roof and sky; each covers what was painted before it."""
    right, bottom = float(width), float(height)
    eaves = rows[0]
    outline = _skyline_outline(skyline, k, right)
    regions = {
        "roof": [(0.0, 0.0), (right, 0.0), (right, eaves), (0.0, eaves)],
        "wall": [(0.0, eaves), (right, eaves), (right, bottom), (0.0, bottom)],
    }
    if skyline.rows.any():
        regions["sky"] = [(0.0, 0.0), *outline, (right, 0.0)]
    return [
        Extent.model_validate({"class": name, "polygon_px": points})
        for name, points in regions.items()
    ]


def _skyline_outline(skyline: Skyline, k: float, right: float) -> list[tuple[float, float]]:
    """The skyline as steps, left to right, in rectified pixels."""
    changes = np.flatnonzero(np.diff(skyline.rows)) + 1
    starts = [0, *changes.tolist()]
    ends = [*changes.tolist(), len(skyline.rows)]
    points: list[tuple[float, float]] = []
    for start, end in zip(starts, ends, strict=True):
        y = round(float(skyline.rows[start]) * k, 2)
        points += [(round(start * k, 2), y), (min(round(end * k, 2), right), y)]
    return points
