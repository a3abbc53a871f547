"""Breaks that are worth closing, and which of them change nothing for each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from shapely.geometry import Polygon

from veduta.plan.openings.classify import Judged
from veduta.plan.rooms.breaks import Break

Reason = Literal[
    "a door is drawn there",
    "both faces are drawn on there",
    "a window is drawn there",
    "it is solid there",
    "walls face each other across a passage there",
    "two rooms are named in one space",
    "a room is open to the outdoors",
]

_BY_BOTH_PARTS: tuple[Reason, ...] = (
    "walls face each other across a passage there",
    "two rooms are named in one space",
)
"""Whether these hold depends on all of the space, and so on what else is closed in it."""

UNDRAWN: tuple[Reason, ...] = (*_BY_BOTH_PARTS, "a room is open to the outdoors")
"""Nothing that is drawn there speaks for these."""


@dataclass(frozen=True)
class Closing:
    """A break that is worth closing, why, how much speaks for it, what is drawn in its gaps."""

    broken: Break
    reason: Reason
    worth: float
    drawn: tuple[Judged | None, ...] = ()


@dataclass(frozen=True)
class Placed:
    """A closing, what it covers, and where it lies.

    spaces: the numbers of the spaces that it meets. parts: those into which it parts one of them.
    still_open: which of them reach the border of the sheet; None where the space does not.
    """

    closing: Closing
    body: Polygon
    spaces: frozenset[int]
    parts: tuple[Polygon, ...]
    still_open: tuple[bool, ...] | None


def apart(closings: Sequence[Placed]) -> list[Closing]:
    """The best closing, and the best others of which none changes what another parts or means.

    They can be closed together: one after the other, they would part the same rooms for the same
    reasons. (That a new wall may be what another break is measured to is neglected.) Those for
    which nothing is drawn wait: what follows from what is drawn may close the same space.
    """
    best: list[Placed] = []
    drawn = any(one.closing.reason not in UNDRAWN for one in closings)
    for one in sorted(closings, key=lambda one: -one.closing.worth):
        if drawn and one.closing.reason in UNDRAWN:
            continue
        if all(_independent(one, other) for other in best):
            best.append(one)
    return [one.closing for one in best]


def _independent(one: Placed, other: Placed) -> bool:
    if one.closing.broken.key == other.closing.broken.key:
        return False
    shared = one.spaces & other.spaces
    if not shared:
        return True
    if len(one.spaces) > 1 or len(other.spaces) > 1:
        return False
    if {one.closing.reason, other.closing.reason} & set(_BY_BOTH_PARTS):
        return False
    return _left_whole(one, other) and _left_whole(other, one)


def _left_whole(one: Placed, other: Placed) -> bool:
    """Whether a closing lies in one part that another leaves, outdoors in what stays outdoors."""
    if one.body.intersects(other.body):
        return False
    met = [place for place, part in enumerate(other.parts) if part.intersects(one.body)]
    return len(met) == 1 and (other.still_open is None or other.still_open[met[0]])
