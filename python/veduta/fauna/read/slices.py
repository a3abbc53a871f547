"""Elliptic slices of an animal without limbs: what one view shows, and another one across it."""

from __future__ import annotations

import numpy as np

from veduta.fauna.document.schema import Body, Origin, Slice
from veduta.fauna.motion.angles import Floats
from veduta.fauna.options import Limbless
from veduta.fauna.read.second_view import SecondLooks, SecondView, thickness
from veduta.fauna.read.usual import usual_slices

_THINNEST = 5e-4
"""Half of how thick a slice is at least, in lengths."""
_STEPS = 100


def body_of(
    half: Floats | None,
    length: float,
    kind: Limbless,
    second: SecondView | None,
    *,
    from_side: bool = False,
) -> tuple[Body, list[str]]:
    """Widths and heights as measured where they are, else by the kind's shape; and doubts of what
    was not.

    half: (t, m) half thickness at equal steps from the head, of an animal of that length, NaN where
    none was measured; None: the record has none. from_side: it is the heights. second: the animal
    from the other side.
    """
    doubts: list[str] = []
    usual = usual_slices(kind)
    places = np.array([piece.at for piece in usual])
    width = np.array([piece.half_width for piece in usual])
    height = np.array([piece.half_height for piece in usual])
    across_seen, seen = (width / height, height) if from_side else (height / width, width)
    first: Origin = "invented"
    other: Origin = "invented"
    score = 0.0
    if half is None or not np.isfinite(half).any():
        doubts.append("the record has no widths: the slices are those of the kind")
    else:
        seen, score = _measured(half / length, places)
        first = "measured"
    across = seen * across_seen
    if second is not None:
        found = thickness(second, np.interp(_even(_STEPS), places, seen), SecondLooks())
        across = np.maximum(np.interp(places, _even(len(found.half)), found.half), _THINNEST)
        other = "measured"
        score = found.score if first == "invented" else min(score, found.score)
        if not found.is_sure:
            doubts.append("which end of the second view is the head is not clear")
    elif first == "measured":
        doubts.append(
            f"one view does not show how {'wide' if from_side else 'high'} the animal is: the"
            " kind's shape was taken (--second-view)"
        )
    width, height = (across, seen) if from_side else (seen, across)
    widths, heights = (other, first) if from_side else (first, other)
    slices = [
        Slice(at=float(at), half_width=float(wide), half_height=float(high))
        for at, wide, high in zip(places, width, height, strict=True)
    ]
    return Body(slices=slices, widths=widths, heights=heights, score=score), doubts


def _measured(shares: Floats, places: Floats) -> tuple[Floats, float]:
    """The median of all frames at the places, and how well the frames agree."""
    seen = np.isfinite(shares).any(axis=0)
    steps = _even(shares.shape[1])
    median = np.interp(steps, steps[seen], np.nanmedian(shares[:, seen], axis=0))
    apart = np.nanmedian(np.abs(shares[:, seen] - median[seen]), axis=0).mean()
    score = float(np.clip(1.0 - apart / max(median.mean(), 1e-9), 0.0, 1.0))
    return np.maximum(np.interp(places, _even(len(median)), median), _THINNEST), score


def _even(count: int) -> Floats:
    """So many equal steps from head to tail."""
    return np.linspace(0.0, 1.0, count)
