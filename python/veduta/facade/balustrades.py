"""Balustrades: rails along the eaves, which the eyes take for balconies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from veduta.facade.boxes import Box


@dataclass(frozen=True)
class BalustradeParameters:
    """When a balcony is a balustrade on the roof's edge.

    long: the least width, in its heights. near: how far its foot may lie from the eaves, in its
    heights. behind: how far above it an opening may begin and still be one that leads out to it,
    in its heights; beside: the share of the opening's width that lies along it.
    Seen on 80 pictures of CMP that the eyes were trained on: nine balconies are told, seven of them
    are balustrades, one the edge of a roof and one a balcony whose doors were not seen; four more
    balustrades there are not told, for they are short, or their eaves were read elsewhere. Of 60
    that were held out two pictures have three, which are iron rails on the roof's edge.
    """

    long: float = 4.0
    near: float = 1.1
    behind: float = 0.5
    beside: float = 0.3


def with_balustrades(
    boxes: Sequence[Box], eaves: float, parameters: BalustradeParameters | None = None
) -> list[Box]:
    """The boxes, of which balconies along the eaves that nothing leads out to are balustrades.

    eaves: row of pixels.
    """
    p = parameters or BalustradeParameters()
    openings = [box for box in boxes if box.kind in ("window", "door")]

    def is_one(box: Box) -> bool:
        foot = box.y + box.height
        return (
            box.kind == "balcony"
            and box.width >= p.long * box.height
            and abs(foot - eaves) <= p.near * box.height
            and not any(_leads_to(one, box, p) for one in openings)
        )

    return [replace(box, is_balustrade=True) if is_one(box) else box for box in boxes]


def _leads_to(opening: Box, balcony: Box, p: BalustradeParameters) -> bool:
    """Whether an opening stands behind a balcony: along it, and not all below or far above it."""
    along = min(opening.x + opening.width, balcony.x + balcony.width) - max(opening.x, balcony.x)
    foot = opening.y + opening.height
    return (
        along > p.beside * opening.width
        and opening.y < balcony.y + balcony.height
        and foot > balcony.y - p.behind * balcony.height
    )
