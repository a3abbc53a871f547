"""Which interruptions are doors, windows and gaps, and of what type; each with a score."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from veduta.plan.document import OpeningType
from veduta.plan.openings.evidence import Arc, Evidence
from veduta.plan.openings.gaps import Gap

LEAST_ARC = 0.5
LEAST_TONE = 0.05
PLAIN_WIDTH = 14.0
"""Passages without any drawing are at most so many (thin) wall thicknesses wide between ends."""

PLAIN_TO_SIDE = 9.0
"""And so many from an end to the side of a wall."""


WIDEST_DOOR = 22.0
"""Leaves are at most so many (thin) wall thicknesses wide, both of a double door together."""


@dataclass(frozen=True)
class Judged:
    """A gap with its kind; `hinge` and `swing` are those of who goes from its start to its end."""

    gap: Gap
    kind: Literal["door", "window", "gap"]
    type: OpeningType
    hinge: Literal["start", "end", "both", "none"]
    swing: Literal["left", "right", "both", "none"]
    score: float


def judge(gap: Gap, seen: Evidence, thin_px: float, outer: bool | None) -> Judged | None:
    """The kind of a gap, or None where nothing says that the wall goes on behind it.

    `thin_px` is the usual thickness of thin walls, `outer` whether it leads outdoors.
    """
    door = _door(gap, seen) if gap.width_px < WIDEST_DOOR * thin_px else None
    if door is not None:
        return door
    inner_lines = [line for line in seen.lines if abs(line) < 0.72]
    if seen.lines or seen.tone > LEAST_TONE:
        if outer is False and not inner_lines and gap.width_px < 16 * thin_px:
            kind: OpeningType = "plain" if not seen.lines else "unknown"
            return Judged(gap, "door", kind, "none", "none", 0.6)
        if outer is False and gap.width_px < 16 * thin_px:
            return Judged(gap, "door", "sliding", "none", "none", 0.6)
        return Judged(gap, "window", _window(seen), "none", "none", _window_score(seen))
    limit = PLAIN_TO_SIDE if gap.to_side else PLAIN_WIDTH
    if gap.width_px > limit * thin_px:
        return None
    return Judged(gap, "gap", "plain", "none", "none", 0.5 * seen.empty + 0.2)


def _door(gap: Gap, seen: Evidence) -> Judged | None:
    good = [arc for arc in seen.arcs if arc.score >= LEAST_ARC]
    if not good:
        return None
    best = good[0]
    pair = [arc for arc in good if arc.radius_share == 0.5]
    if best.radius_share == 0.5:
        other = [arc for arc in pair if arc.hinge_at_start != best.hinge_at_start]
        if not other:
            return None
        both = all(arc.side == best.side for arc in other[:1])
        return Judged(gap, "door", "double", "both", _side(best, not both), best.score)
    twice = [
        arc
        for arc in good
        if arc.radius_share == 1.0
        and arc.side != best.side
        and arc.hinge_at_start == best.hinge_at_start
    ]
    hinge: Literal["start", "end"] = "start" if best.hinge_at_start else "end"
    return Judged(gap, "door", "swing", hinge, _side(best, bool(twice)), min(1.0, best.score))


def _side(arc: Arc, both: bool) -> Literal["left", "right", "both"]:
    if both:
        return "both"
    return "right" if arc.side > 0 else "left"


def _window(seen: Evidence) -> OpeningType:
    """The paper's four drawings, by how many lines run along the window."""
    inner = [line for line in seen.lines if abs(line) < 0.72]
    if not seen.lines:
        return "filled"
    by_count: dict[int, OpeningType] = {0: "double-line", 1: "single-line", 2: "double-line"}
    return by_count.get(len(inner), "triple-line")


def _window_score(seen: Evidence) -> float:
    return float(np.clip(0.5 + 0.1 * len(seen.lines) + max(seen.tone, 0.0), 0, 0.95))
