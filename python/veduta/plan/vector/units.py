"""How large a unit of a DXF drawing is: what the file says of it, and whether that can be.

$INSUNITS is often left as the template had it, so it is one witness among several. A unit by which
the house would be as small as a box or as large as a town is out; of the others that with the most
witnesses is taken.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from ezdxf.document import Drawing as DxfDocument

from veduta.plan.document import Scale, ScaleEvidence
from veduta.plan.vector.entities import Entities
from veduta.plan.vector.faces import LEAF_M, LEAF_SWEEP
from veduta.plan.vector.layers import OPENINGS
from veduta.run.errors import InputError

METRES = {
    "millimetres": 0.001, "centimetres": 0.01, "decimetres": 0.1, "metres": 1.0,
    "inches": 0.0254, "feet": 0.3048,
}  # fmt: skip
_INSUNITS = {
    1: "inches", 2: "feet", 4: "millimetres", 5: "centimetres", 6: "metres", 14: "decimetres",
}  # fmt: skip
_ARCHITECTURAL = (3, 4)
"""DIMLUNIT and LUNITS of feet and inches, which count in inches."""
HOUSE_M = (2.5, 200.0)
"""Least and most of the longer side of what is drawn as walls."""
_USUAL_LEAF_M = 0.85
_WALL_M = 0.18
_FEET = re.compile(r"\d\s*'\s*-?\s*\d*|\d\s*\"")
_LEAST_FEET = 3
_SURE = 0.001
_UNSURE = 0.01
_TEXTS_DISAGREE = 0.03


@dataclass(frozen=True)
class Witness:
    """One thing that speaks for units; `weight` is how much."""

    text: str
    units: tuple[str, ...]
    weight: float


def unit_scale(
    path: Path,
    document: DxfDocument,
    found: Entities,
    extent: float,
    given_m: float | None = None,
) -> Scale:
    """Metres per drawing unit of a file. `extent` is the longer side of its walls, in those units.

    `given_m` is by --scale and goes before everything. Raises InputError where a house of that size
    is none.
    """
    if given_m is not None:
        if not math.isfinite(extent * given_m) or not 0.1 < extent * given_m < 10_000:
            fault = f"makes {path.name} {extent * given_m:.3g} m wide"
            raise InputError("--scale", fault, "Mend the number.")
        said = ScaleEvidence(kind="given", metres_per_px=given_m, sigma=_SURE, agrees=True)
        return Scale(metres_per_px=given_m, sigma=_SURE, basis="given", evidence=[said])
    witnesses = [*_of_header(document), *_of_writing(document, found), *_of_leaves(found)]
    able = [name for name, size in METRES.items() if HOUSE_M[0] <= extent * size <= HOUSE_M[1]]
    if not able:
        raise InputError(
            path,
            f"is {extent:.4g} units wide, which is no house in any unit",
            "Give the size of a unit with --scale (mm).",
        )
    votes = {name: sum(one.weight for one in witnesses if name in one.units) for name in able}
    best = max(able, key=lambda name: (votes[name], -abs(math.log(extent * METRES[name] / 14.0))))
    return _scale(best, votes[best], witnesses)


def unit_notes(scale: Scale, extent: float) -> list[str]:
    """What must be said of the units: that they were guessed, or that the file's own cannot be."""
    if scale.basis == "given":
        return []
    name = _name(scale.metres_per_px)
    notes = []
    if scale.basis == "assumed":
        notes.append(
            f"Nothing in the drawing says its units: {name} are assumed, by which the house is"
            f" {extent * scale.metres_per_px:.1f} m wide. --scale sets the size of a unit in mm."
        )
    wrong = [one for one in scale.evidence if not one.agrees]
    for one in wrong:
        notes.append(f"The drawing is in {name}, though {one.text}.")
    return notes


def text_notes(scale: Scale, said: Scale) -> list[str]:
    """What must be said where the sizes that are written in a drawing contradict its unit.

    `said` is the scale by the texts alone. Single sizes that differ say nothing: many belong to
    something else than was measured.
    """
    if said.basis != "evidence":
        return []
    times = said.metres_per_px / scale.metres_per_px
    if abs(times - 1.0) <= max(3.0 * said.sigma, _TEXTS_DISAGREE):
        return []
    behind = [one.text for one in said.evidence if one.agrees]
    return [
        f"{len(behind)} of {len(said.evidence)} sizes written in the drawing ({behind[0]}, for one)"
        f" say that a unit is {times:.3g} times as large. --scale sets the size of a unit in mm."
    ]


def _scale(name: str, votes: float, witnesses: Sequence[Witness]) -> Scale:
    evidence = [
        ScaleEvidence(
            kind="units",
            text=one.text,
            metres_per_px=METRES[name if name in one.units else one.units[0]],
            sigma=_SURE,
            agrees=name in one.units,
        )
        for one in witnesses
    ]
    told = votes > 0
    sigma = _SURE if told else _UNSURE
    if not told:
        evidence.append(
            ScaleEvidence(
                kind="assumed",
                text=f"{name} make a house of a usual size",
                metres_per_px=METRES[name],
                sigma=sigma,
                agrees=True,
            )
        )
    return Scale(
        metres_per_px=METRES[name],
        sigma=sigma,
        basis="evidence" if told else "assumed",
        evidence=evidence,
    )


def _of_header(document: DxfDocument) -> list[Witness]:
    name = _INSUNITS.get(int(document.header.get("$INSUNITS", 0)))
    return [Witness(f"$INSUNITS says {name}", (name,), 1.0)] if name else []


def _of_writing(document: DxfDocument, found: Entities) -> list[Witness]:
    """Styles of dimensions that are in use, and sizes in feet among the texts."""
    used = {str(one.dxf.dimstyle) for one in document.modelspace().query("DIMENSION")}
    witnesses = []
    for style in document.dimstyles:
        if style.dxf.name in used and style.dxf.get("dimlunit", 2) in _ARCHITECTURAL:
            text = f"dimensions are written in feet and inches (style {style.dxf.name})"
            witnesses.append(Witness(text, ("inches",), 1.5))
            break
    feet = sum(bool(_FEET.search(word.text)) for word in found.words)
    if feet >= _LEAST_FEET:
        witnesses.append(Witness(f"{feet} texts are in feet", ("inches", "feet"), 1.0))
    return witnesses


def _of_leaves(found: Entities) -> list[Witness]:
    """Quarter circles of doors: their radius is the width of a leaf."""
    arcs = [
        one
        for one in found.strokes
        if one.arc is not None and LEAF_SWEEP[0] <= one.arc[3] <= LEAF_SWEEP[1]
    ]
    named = [one for one in arcs if one.role in OPENINGS]
    radii = [one.arc[0] for one in named or arcs if one.arc is not None]
    if not radii:
        return []
    usual = float(np.median(radii if named else sorted(radii)[len(radii) // 2 :]))
    units = [name for name, size in METRES.items() if LEAF_M[0] <= usual * size <= LEAF_M[1]]
    units.sort(key=lambda name: abs(math.log(usual * METRES[name] / _USUAL_LEAF_M)))
    if not units:
        return []
    text = f"leaves of doors are {usual:.4g} units wide"
    return [Witness(text, tuple(units), 2.0 if named else 0.5)]


def _name(metres: float) -> str:
    return next(name for name, size in METRES.items() if size == metres)
