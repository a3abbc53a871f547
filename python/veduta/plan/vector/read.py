"""The recipe of reading a DXF file: units, solid walls, a sheet, the common reader, exact lines."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from veduta.plan.document import Scale
from veduta.plan.drawn import Drawn
from veduta.plan.reading import KnownWalls, read_cleaned
from veduta.plan.vector.entities import Entities, entities_of
from veduta.plan.vector.exact import Segments, exact_axes
from veduta.plan.vector.faces import Walls, extent_of, shows_house, solid_walls
from veduta.plan.vector.layers import OPENINGS
from veduta.plan.vector.named import named_openings
from veduta.plan.vector.open_dxf import open_dxf
from veduta.plan.vector.sheet import VectorSheet, lay_out
from veduta.plan.vector.units import unit_notes, unit_scale
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, NotFoundError
from veduta.run.limits import Limits

_LEAST_STROKES = 4
DXF_LIMITS = Limits(memory_mb=3000, seconds=240)
"""A plan of 100,000 lines takes a fifth of this."""
DXF_REMEDY = "Purge what is not drawn, or export the plan alone."


@dataclass(frozen=True)
class VectorPlan:
    """What a DXF file shows; `unit` is the scale of a drawing unit, `drawn` is in pixels."""

    drawn: Drawn
    unit: Scale
    px_per_unit: float
    sha256: str
    notes: tuple[str, ...]
    counts: dict[str, int]


def read_given(given: tuple[Path, float | None]) -> VectorPlan:
    """As `read_vectors`, of both its arguments at once: for a process of its own."""
    return read_vectors(*given)


def read_vectors(path: Path, given_m: float | None = None) -> VectorPlan:
    """Read a DXF file; `given_m` is the size of a drawing unit, where --scale gives it.

    Raises InputError where the file cannot be read, NotFoundError where it shows no plan.
    """
    document = open_dxf(path)
    found = entities_of(document)
    _require_lines(path, found)
    extent = extent_of(found)
    unit = unit_scale(path, document, found, extent, given_m)
    walls = solid_walls(found, unit.metres_per_px)
    sheet = lay_out(found, walls, unit.metres_per_px)
    segments = _segments(found, walls, sheet)
    known = KnownWalls(
        sheet.solid if not walls.solid.is_empty else None, lambda axes: exact_axes(axes, segments)
    )
    drawn = read_cleaned(sheet.cleaned, sheet.texts, known=known)
    drawn = replace(drawn, openings=named_openings(drawn, found, sheet))
    return VectorPlan(
        drawn=drawn,
        unit=unit,
        px_per_unit=sheet.px_per_unit,
        sha256=file_digest(path),
        notes=(*unit_notes(unit, extent), *_notes(found, walls)),
        counts={"lines": len(found.strokes), "texts": len(found.words)},
    )


def _require_lines(path: Path, found: Entities) -> None:
    if len(found.strokes) + len(found.filled) >= _LEAST_STROKES and shows_house(found):
        return
    if found.missing:
        named = ", ".join(found.missing[:3])
        raise InputError(
            path, f"refers to {named} for its content", "Bind the references (XREF, Bind) first."
        )
    if found.bodies:
        raise InputError(
            path,
            f"has {found.bodies} 3D faces or solids and no lines",
            "Export a plan view of it as 2D lines.",
        )
    if found.strokes or found.filled:
        fault = f"{path.name} has no lines that may be of a house, by the names of its layers"
        raise NotFoundError("a floor plan", fault, "Draw it on layers of other names.")
    raise NotFoundError(
        "a floor plan", f"{path.name} has no lines in its model space", "Give a drawn plan."
    )


def _segments(found: Entities, walls: Walls, sheet: VectorSheet) -> Segments:
    """The lines that walls may lie on, in pixels: those of walls, or all where no layer tells."""
    lines = [
        one.points
        for one in found.strokes
        if one.role == "wall" or (not walls.by_name and one.role in ("other", *OPENINGS))
    ]
    lines += [np.array(ring.coords) for ring in _rings(walls.solid)]
    parts = [np.stack([one[:-1], one[1:]], axis=1) for one in lines if len(one) > 1]
    if not parts:
        return np.empty((0, 2, 2))
    matrix: NDArray[np.float64] = sheet.px_from_units
    return np.asarray(np.concatenate(parts) @ matrix[:2, :2].T + matrix[:2, 2])


def _rings(shape: BaseGeometry) -> list[BaseGeometry]:
    parts = [one for one in getattr(shape, "geoms", [shape]) if not one.is_empty]
    return [ring for part in parts for ring in (part.exterior, *part.interiors)]


def _notes(found: Entities, walls: Walls) -> list[str]:
    notes = []
    if not walls.by_name:
        notes.append("no layer is named as walls: they are told from the lines alone")
    if walls.single:
        notes.append("walls are drawn as single lines: their thickness is assumed")
    if found.missing:
        named = ", ".join(sorted(set(found.missing))[:5])
        notes.append(f"the drawing refers to {named}, which is not in the file: left out")
    if found.unread:
        named = ", ".join(f"{count} {kind}" for kind, count in sorted(found.unread.items()))
        notes.append(f"entities that were not understood are left out: {named}")
    if found.more:
        notes.append("the drawing has more entities than are read: the rest is left out")
    return notes
