"""Which interruptions are doors, windows and gaps, and of what type; each with a score."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from veduta.plan.document import OpeningType
from veduta.plan.openings.evidence import LEAST_ARC, Evidence
from veduta.plan.openings.gaps import Gap
from veduta.plan.openings.leaves import Arc

LEAST_CHORD = 0.6
LEAST_FOLD = 0.6
LEAST_BARE, BARE_SCORE = 0.75, 0.75
"""A leaf alone is drawn at least so well, and is less sure by this factor: a line may be another
thing's."""
LEAST_PANEL = 0.9
"""A panel before the wall is drawn at least so well."""
LEAST_TONE = 0.05
CENTRED = 0.3
"""Panels that slide past each other meet in a line so near to the wall's middle (half
thicknesses)."""

PLAIN_WIDTH = 14.0
"""Passages without any drawing are at most so many (thin) wall thicknesses wide between ends."""

PLAIN_DOORS = 2.0
"""Or so many usual doors, as those to open stairs are, where walls are sized by these."""

PLAIN_TO_SIDE = 9.0
"""And so many from an end to the side of a wall ..."""

STUB = 0.4
"""... where no stub stands there: one of so many thicknesses is an end."""

WIDEST_DOOR = 22.0
"""Leaves are at most so many (thin) wall thicknesses wide, both of a double door together."""

WIDEST_LEAFLESS = 20.0
"""Doors between rooms that are drawn without a leaf: panels of 0.9 m, two of them in a wall of
0.1 m."""


@dataclass(frozen=True)
class Judged:
    """A gap with its kind; `hinge` and `swing` are those of who goes from its start to its end.

    `seen` is what it was judged by, None where it was closed for another reason.
    """

    gap: Gap
    kind: Literal["door", "window", "gap"]
    type: OpeningType
    hinge: Literal["start", "end", "both", "none"]
    swing: Literal["left", "right", "both", "none"]
    score: float
    seen: Evidence | None = None


def judge(
    gap: Gap,
    seen: Evidence,
    thin_px: float,
    outer: bool | None,
    widest_plain: float = PLAIN_WIDTH,
) -> Judged | None:
    """The kind of a gap, or None where nothing says that the wall goes on behind it.

    `thin_px` is the usual thickness of thin walls, `outer` whether it leads outdoors (None: not
    known yet). `widest_plain`: passages between ends of walls, in these thicknesses.
    """
    judged = _drawn(gap, seen, thin_px, outer, widest_plain)
    return None if judged is None else replace(judged, seen=seen)


def _drawn(
    gap: Gap, seen: Evidence, thin_px: float, outer: bool | None, widest_plain: float
) -> Judged | None:
    door = _door(gap, seen) if gap.width_px < WIDEST_DOOR * thin_px else None
    if door is not None:
        return door
    if slides(seen) or (seen.meets and outer is False):
        return Judged(gap, "door", "sliding", "none", "none", 0.7)
    if seen.lines or seen.tone > LEAST_TONE:
        if outer is False and gap.width_px < WIDEST_LEAFLESS * thin_px:
            kind: OpeningType = "plain" if not seen.lines else "unknown"
            return Judged(gap, "door", kind, "none", "none", 0.6)
        return Judged(gap, "window", window_type(seen), "none", "none", _window_score(seen))
    if seen.beam and not outer:
        return Judged(gap, "gap", "plain", "none", "none", 0.7)
    stub_px = float(np.hypot(*(gap.far - gap.end)))
    to_side = gap.to_side and stub_px < STUB * gap.thickness_px
    limit = PLAIN_TO_SIDE if to_side else widest_plain
    if gap.width_px > limit * thin_px:
        return None
    if seen.panel >= LEAST_PANEL:
        return Judged(gap, "door", "sliding", "none", "none", 0.7)
    return _bare(gap, seen) or Judged(gap, "gap", "plain", "none", "none", 0.5 * seen.empty + 0.2)


def is_bare(judged: Judged) -> bool:
    """Whether an opening is a door by a leaf without its trace."""
    return (
        judged.seen is not None
        and judged.type == "swing"
        and bool(judged.seen.bare)
        and (_door(judged.gap, judged.seen) is None)
    )


def _bare(gap: Gap, seen: Evidence) -> Judged | None:
    """A way with a leaf beside it that is drawn without its trace."""
    if not seen.bare or (leaf := seen.bare[0]).score < LEAST_BARE:
        return None
    score = BARE_SCORE * min(1.0, leaf.score)
    hinge = _hinge(leaf.hinge_at_start)
    return Judged(gap, "door", "swing", hinge, _side(leaf.side, False), score)


def slides(seen: Evidence) -> bool:
    """Whether two panels are drawn that slide past each other."""
    centred = any(abs(line) < CENTRED for line in seen.lines)
    return seen.step != 0.0 and (centred or (seen.leaf_lines and not seen.inner))


def window_type(seen: Evidence) -> OpeningType:
    """The four drawings of AV3D (figure 7): by the lines that run along the window, and shade.

    Double lines run along both faces, a third between them; a single line stands alone.
    """
    if seen.shade > LEAST_TONE:
        return "filled"
    if not seen.inner:
        return "double-line"
    return "single-line" if len(seen.inner) == 1 and not seen.faces else "triple-line"


def _door(gap: Gap, seen: Evidence) -> Judged | None:
    """By its leaves; None where there are none."""
    if seen.folds and (fold := seen.folds[0]).score >= LEAST_FOLD:
        hinge: Literal["start", "end", "both"] = (
            "both" if fold.both else _hinge(fold.hinge_at_start)
        )
        return Judged(gap, "door", "folding", hinge, _side(fold.side, False), fold.score)
    good = [arc for arc in seen.arcs if arc.score >= LEAST_ARC]
    if good:
        return _swing(gap, good)
    if seen.pocket is not None:
        return _pocket(gap, *seen.pocket)
    if seen.chords and (chord := seen.chords[0]).score >= LEAST_CHORD:
        hinge = _hinge(chord.hinge_at_start)
        return Judged(gap, "door", "swing", hinge, _side(chord.side, False), chord.score)
    return None


def _swing(gap: Gap, good: list[Arc]) -> Judged | None:
    best = good[0]
    if best.radius_share == 0.5:
        other = [
            arc
            for arc in good
            if arc.radius_share == 0.5 and arc.hinge_at_start != best.hinge_at_start
        ]
        if not other:
            return None
        swing = _side(best.side, other[0].side != best.side)
        return Judged(gap, "door", "double", "both", swing, best.score)
    twice = any(
        arc.radius_share == 1.0
        and arc.side != best.side
        and arc.hinge_at_start == best.hinge_at_start
        for arc in good
    )
    hinge = _hinge(best.hinge_at_start)
    return Judged(gap, "door", "swing", hinge, _side(best.side, twice), min(1.0, best.score))


def _pocket(gap: Gap, low: float, high: float) -> Judged:
    """The leaf slides into the wall on the side where it is drawn, and that part is wall."""
    free = gap.part(low * gap.width_px, high * gap.width_px)
    return Judged(free, "door", "pocket", _hinge(low > 1 - high), "none", 0.8)


def _hinge(at_start: bool) -> Literal["start", "end"]:
    return "start" if at_start else "end"


def _side(side: int, both: bool) -> Literal["left", "right", "both"]:
    if both:
        return "both"
    return "right" if side > 0 else "left"


def _window_score(seen: Evidence) -> float:
    return float(np.clip(0.5 + 0.1 * len(seen.lines) + max(seen.tone, 0.0), 0, 0.95))
