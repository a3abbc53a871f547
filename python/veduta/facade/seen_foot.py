"""What is left below the lowest floor line: a ground floor, a strip that is none, or too much."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from veduta.facade.eyes import SeenElement
from veduta.facade.floors import Floors


@dataclass(frozen=True)
class FootParameters:
    """Heights in mean storeys. strip: a ground floor that is lower and has neither windows nor
    doors is none, but pavement, a plinth or a hedge. deep: one that is higher is not believed:
    storeys are missed there (of 80 fronts of CMP the highest has 2.3).
    """

    strip: float = 0.7
    deep: float = 3.5


def without_strip(
    floors: Floors,
    elements: Sequence[SeenElement],
    bottom: int,
    parameters: FootParameters | None = None,
) -> tuple[Floors, tuple[SeenElement, ...]]:
    """The floors without a ground floor that is a mere strip, and the shops in it, which are none.

    bottom: where the front ends; all in the pixels of the floors.
    """
    p = parameters or FootParameters()
    if len(floors.boundaries) < 3 or bottom - floors.ground_top >= p.strip * floors.mean_storey:
        return floors, ()
    top = floors.ground_top
    inside = [e for e in elements if 0.5 * (e.y0 + e.y1) > top and e.kind != "balcony"]
    if any(e.kind != "shop" for e in inside):
        return floors, ()
    return replace(floors, boundaries=floors.boundaries[:-1]), tuple(inside)


def is_too_deep(floors: Floors, bottom: int, parameters: FootParameters | None = None) -> bool:
    """Whether several storeys' height lies below the lowest floor line."""
    p = parameters or FootParameters()
    if len(floors.boundaries) < 2:
        return False
    return bottom - floors.ground_top > p.deep * floors.mean_storey
