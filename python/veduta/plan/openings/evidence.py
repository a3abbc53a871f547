"""All that is drawn in and beside an interruption of a wall."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaves import (
    Arc,
    Fold,
    find_arcs,
    find_bare,
    find_chords,
    find_folds,
    leaf_thickness,
)
from veduta.plan.openings.lines import (
    AT_FACE,
    dashed_faces,
    full_lines,
    leaf_lines,
    panel_step,
    pocket_share,
    shade,
)
from veduta.plan.openings.panels import find_panel, meets
from veduta.plan.openings.strip import Sheet, cut_strip

SURE_ARC = 0.85
LEAST_ARC = 0.5
MOSTLY_EMPTY = 0.7


@dataclass(frozen=True)
class Evidence:
    """Of one gap. `lines`: their places across the wall (-1 and 1 are its faces); `tone`: median
    ink between the faces above that beside the wall; `shade`: the same of the palest row;
    `empty`: the share without ink; `step`: panels side by side (see `panel_step`); `pocket`: the
    way through beside a pocket; arcs, chords and folds best first; `leaf_px`: how thick the leaf
    of the best arc is drawn, 0 without one; `leaf_lines`: a line along each half of it, which lie
    beside each other; `bare`: leaves without a trace, looked for where nothing lies in the gap;
    `beam`: both faces go on in dashes.
    """

    lines: tuple[float, ...]
    tone: float
    shade: float
    empty: float
    step: float
    pocket: tuple[float, float] | None
    arcs: tuple[Arc, ...]
    chords: tuple[Arc, ...]
    folds: tuple[Fold, ...]
    leaf_px: float
    leaf_lines: bool = False
    bare: tuple[Arc, ...] = ()
    panel: float = 0.0
    meets: bool = False
    beam: bool = False

    @property
    def inner(self) -> tuple[float, ...]:
        """Lines between the faces."""
        return tuple(line for line in self.lines if abs(line) < AT_FACE)

    @property
    def faces(self) -> int:
        """On how many faces of the wall a line runs."""
        return (max(self.lines, default=0) >= AT_FACE) + (min(self.lines, default=0) <= -AT_FACE)


def look_at(gap: Gap, sheet: Sheet) -> Evidence:
    """Gather the evidence of one gap."""
    trim = min(0.2 * gap.width_px, 2.0 + 0.1 * gap.thickness_px)
    strip = cut_strip(gap.start, gap.end, gap.thickness_px, sheet, trim, gap.bulge)
    middle = strip.ink[strip.within]
    arcs = find_arcs(gap, sheet)
    # A whole arc leaves no doubt: what takes longer to look for is not looked for.
    doubtful = arcs[0].score < SURE_ARC
    lines = full_lines(strip)
    empty = float((middle < 0.15).mean())
    free = arcs[0].score < LEAST_ARC and empty > MOSTLY_EMPTY
    return Evidence(
        lines=lines,
        tone=float(np.median(middle)) - strip.paper,
        shade=shade(strip),
        empty=empty,
        step=panel_step(strip),
        pocket=pocket_share(strip),
        arcs=arcs,
        chords=find_chords(gap, sheet) if doubtful and not _crossed(lines) else (),
        folds=find_folds(gap, sheet) if doubtful and not _crossed(lines) else (),
        leaf_px=leaf_thickness(arcs[0], sheet) if arcs[0].score >= LEAST_ARC else 0.0,
        leaf_lines=leaf_lines(strip),
        bare=find_bare(gap, sheet) if free else (),
        panel=find_panel(gap, sheet) if free else 0.0,
        meets=bool(lines) and meets(strip),
        beam=free and dashed_faces(strip),
    )


class Views:
    """What is drawn in gaps of a sheet; each is looked at once, however often it is asked for."""

    def __init__(self, sheet: Sheet) -> None:
        self.sheet = sheet
        self._known: dict[tuple[bytes, bytes, float, float], Evidence] = {}

    def __call__(self, gap: Gap) -> Evidence:
        """The evidence of one gap."""
        place = (gap.start.tobytes(), gap.end.tobytes(), gap.thickness_px, gap.bulge)
        if place not in self._known:
            self._known[place] = look_at(gap, self.sheet)
        return self._known[place]


def _crossed(lines: Sequence[float]) -> bool:
    """Whether a line between the faces stands in the way, where a door could not be open."""
    return any(abs(line) < AT_FACE for line in lines)
