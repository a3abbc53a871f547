"""What each cell is used for, by its size, its shape and what lies beside it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely.geometry import Polygon

from veduta.synthetic.plans.house import Language, Use

TINY_M2 = 2.6
SMALL_M2 = 7.5
LIVING_M2 = 11.0
NARROW_M = 1.75
Sides = Sequence[set[int]]


def uses_of(
    rng: np.random.Generator,
    areas: Sequence[Polygon],
    given: Sequence[Use | None],
    beside: Sides,
    storey: int,
    language: Language,
) -> list[Use]:
    """A use for each cell; `beside[i]` are the cells with which cell i shares a wall."""
    uses: list[Use | None] = list(given)
    free = sorted((i for i, use in enumerate(uses) if use is None), key=lambda i: -areas[i].area)
    if storey == 0 and free:
        living = free.pop(0)
        uses[living] = "living"
        _day_rooms(rng, areas, uses, free, beside, living)
    free = [i for i, use in enumerate(uses) if use is None]
    _wet_rooms(rng, areas, uses, free, storey, language)
    for i in free:
        if uses[i] is None:
            uses[i] = "study" if rng.random() < 0.15 else "bedroom"
    return [use or "storage" for use in uses]


def _narrow(area: Polygon) -> bool:
    x0, y0, x1, y1 = area.bounds
    return bool(min(x1 - x0, y1 - y0) < NARROW_M)


def _day_rooms(
    rng: np.random.Generator,
    areas: Sequence[Polygon],
    uses: list[Use | None],
    free: list[int],
    beside: Sides,
    living: int,
) -> None:
    """The kitchen and now and then a dining room, beside the living room if possible."""

    def best(low: float, high: float) -> int | None:
        fitting = [
            i
            for i in free
            if uses[i] is None and low <= areas[i].area <= high and not _narrow(areas[i])
        ]
        near = [i for i in fitting if i in beside[living]]
        choice = near or fitting
        return choice[int(rng.integers(len(choice)))] if choice else None

    kitchen = best(6.0, 18.0)
    if kitchen is not None:
        uses[kitchen] = "kitchen"
    if rng.random() < 0.4:
        dining = best(8.0, 18.0)
        if dining is not None and dining in beside[living]:
            uses[dining] = "dining"


def _wet_rooms(
    rng: np.random.Generator,
    areas: Sequence[Polygon],
    uses: list[Use | None],
    free: Sequence[int],
    storey: int,
    language: Language,
) -> None:
    """Bathroom first, then toilet, utility and the rest among the small rooms."""
    small = [i for i in free if areas[i].area < SMALL_M2 or _narrow(areas[i])]
    small.sort(key=lambda i: -areas[i].area)
    later: list[Use] = ["utility", "storage", "toilet", "wardrobe", "bathroom"]
    if language == "fi" and storey == 0:
        later.insert(0, "sauna")
    wanted: list[Use] = ["bathroom", *later]
    for i in small:
        if areas[i].area < TINY_M2:
            uses[i] = "toilet" if rng.random() < 0.5 and "toilet" not in uses else "storage"
            continue
        if not wanted:
            uses[i] = "study" if areas[i].area > 4.5 and not _narrow(areas[i]) else "storage"
            continue
        use = wanted.pop(0)
        if use == "sauna" and areas[i].area > 6.0:
            use = wanted.pop(0)
        uses[i] = use
    if not small and free:
        last = min(free, key=lambda i: areas[i].area)
        if len(free) > 1:
            uses[last] = "bathroom"
