"""The likeliest use of a room that has no label: by size, shape, doors and neighbours.

Bayes' rule with independent facts. The table is what rooms of houses and flats usually measure; it
was written for this project from building codes and experience, not fitted to any data set, so the
probabilities are no more than an order. Fittings that are drawn in a room say more than all of it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from veduta.plan.document import FittingKind, RoomUse


@dataclass(frozen=True)
class RoomFacts:
    """What is known of a room besides words.

    `elongation` is long side over short side; `doors` and `windows` are counts; `outdoors` whether
    it lies outside the walls; `stairs` whether stairs are drawn in it. `way_out_m`
    is how wide its widest way out of the house is, 0 where it has none, None where nobody knows.
    `fittings` are the kinds of what is drawn in it.
    """

    area_m2: float
    elongation: float = 1.3
    doors: int = 1
    windows: int = 1
    outdoors: bool = False
    stairs: bool = False
    way_out_m: float | None = None
    fittings: frozenset[FittingKind] = frozenset()


@dataclass(frozen=True)
class _Usual:
    """Of a use: how common it is, its area (median, m2), and its usual doors and windows."""

    share: float
    area_m2: float
    spread: float
    doors: float
    window: float
    long: float = 1.35


_USUAL: dict[RoomUse, _Usual] = {
    "living": _Usual(1.0, 24.0, 0.40, 2.5, 0.95),
    "dining": _Usual(0.3, 13.0, 0.35, 2.0, 0.85),
    "kitchen": _Usual(0.9, 10.0, 0.40, 1.5, 0.85),
    "bedroom": _Usual(2.5, 12.0, 0.30, 1.3, 0.95),
    "bathroom": _Usual(1.2, 5.0, 0.35, 1.1, 0.4),
    "toilet": _Usual(0.6, 1.8, 0.35, 1.0, 0.25),
    "utility": _Usual(0.3, 5.5, 0.40, 1.5, 0.4),
    "storage": _Usual(0.7, 2.5, 0.60, 1.0, 0.1),
    "wardrobe": _Usual(0.8, 1.8, 0.60, 1.0, 0.03, 1.8),
    "hall": _Usual(0.8, 7.0, 0.50, 4.0, 0.15, 1.7),
    "corridor": _Usual(0.5, 6.0, 0.50, 4.5, 0.1, 3.5),
    "stairs": _Usual(0.1, 5.0, 0.40, 2.0, 0.3, 1.8),
    "study": _Usual(0.2, 9.0, 0.30, 1.1, 0.95),
    "garage": _Usual(0.2, 26.0, 0.35, 1.5, 0.3),
    "technical": _Usual(0.1, 3.5, 0.50, 1.0, 0.1),
}
_TOILET_M2, _OPEN_KITCHEN_M2 = 2.6, 26.0
_STAIRWELL_M2 = 16.0  # with stairs that turn, and the way to them
_WITH_STAIRS: tuple[RoomUse, ...] = ("living", "hall", "corridor", "dining")  # ways through
_DEAD_ENDS: tuple[RoomUse, ...] = ("bathroom", "toilet", "storage", "wardrobe", "technical")
_THROUGH, _CROSSED = 3, 0.1
"""How much less likely they are with doors to so many rooms: who goes anywhere crosses them."""
_GATE_M = 1.9
"""Through a narrower way no car comes into a garage."""
_ONLY_ONE: tuple[RoomUse, ...] = ("living", "kitchen", "dining", "garage", "utility")
_SECOND = 0.15  # how much less likely a second one of these is
_FIRST_NEEDED: tuple[RoomUse, ...] = ("living", "kitchen", "bathroom")
_FIRST = 2.0
# Behind the only door of a room is: (room, what it leads to) and how much likelier that is.
_BEHIND: dict[tuple[RoomUse, RoomUse], float] = {
    ("wardrobe", "bedroom"): 3.0,
    ("bathroom", "bedroom"): 1.5,
    ("toilet", "hall"): 2.0,
    ("toilet", "corridor"): 2.0,
    ("bedroom", "corridor"): 1.5,
    ("bedroom", "hall"): 1.3,
    ("storage", "kitchen"): 2.0,
    ("utility", "kitchen"): 1.5,
    ("bedroom", "bedroom"): 0.2,
    ("bedroom", "bathroom"): 0.3,
    ("kitchen", "bedroom"): 0.1,
    ("living", "bedroom"): 0.4,
}


def guess_uses(
    facts: Sequence[RoomFacts],
    doors: Sequence[tuple[int, int]],
    known: Sequence[RoomUse | None],
) -> list[tuple[RoomUse, float]]:
    """For each room its likeliest use and the probability; those that are `known` have theirs, 1.

    `doors` are pairs of rooms. The surest guess is made first and helps with the rest.
    """
    uses: list[RoomUse | None] = list(known)
    scores = [1.0] * len(facts)
    neighbours: list[set[int]] = [set() for _ in facts]
    for one, other in doors:
        if one != other:
            neighbours[one].add(other)
            neighbours[other].add(one)
    while None in uses:
        guesses = [
            (*_likeliest(facts[index], _around(index, neighbours, uses), uses), index)
            for index, use in enumerate(uses)
            if use is None
        ]
        score, use, index = max(guesses, key=lambda guess: (guess[0], -guess[2]))
        uses[index], scores[index] = use, score
    return [(use or "unknown", score) for use, score in zip(uses, scores, strict=True)]


def _around(
    index: int, neighbours: list[set[int]], uses: list[RoomUse | None]
) -> list[RoomUse | None]:
    return [uses[other] for other in sorted(neighbours[index])]


def _likeliest(
    room: RoomFacts, around: list[RoomUse | None], uses: list[RoomUse | None]
) -> tuple[float, RoomUse]:
    if room.outdoors:
        # A balcony is narrow and small; nothing else is said by its shape.
        return (0.6, "balcony") if room.area_m2 < 12.0 else (0.6, "terrace")
    told = _by_fittings(room)
    if told is not None:
        return told
    if room.stairs and room.area_m2 < _STAIRWELL_M2:
        return (0.7, "stairs")
    possible = _WITH_STAIRS if room.stairs else tuple(_USUAL)
    if room.way_out_m is not None and room.way_out_m < _GATE_M:
        possible = tuple(use for use in possible if use != "garage")
    weights = {use: math.exp(_log_weight(use, room, around, uses)) for use in possible}
    total = sum(weights.values())
    best = max(weights, key=lambda use: weights[use])
    return (weights[best] / total, best) if total > 0 else (0.0, "unknown")


def _by_fittings(room: RoomFacts) -> tuple[float, RoomUse] | None:
    """What is drawn in a room says what it is for; a basin or a machine may stand anywhere."""
    drawn = room.fittings
    if "bathtub" in drawn or "shower" in drawn:
        return (0.9, "bathroom")
    if "toilet" in drawn:
        return (0.85, "toilet" if room.area_m2 < _TOILET_M2 else "bathroom")
    if "hob" in drawn:
        return (0.9, "kitchen" if room.area_m2 < _OPEN_KITCHEN_M2 else "living")
    return (0.85, "bedroom") if "bed" in drawn else None


def _log_weight(
    use: RoomUse, room: RoomFacts, around: list[RoomUse | None], uses: list[RoomUse | None]
) -> float:
    usual = _USUAL[use]
    weight = math.log(usual.share)
    away = math.log(max(room.area_m2, 0.1) / usual.area_m2) / usual.spread
    weight += -0.5 * away**2 - math.log(usual.spread)
    stretch = math.log(max(room.elongation, 1.0) / usual.long) / 0.4
    weight += -0.5 * min(stretch**2, 9.0)
    # Counts of doors by Poisson's law; a room has one at least.
    doors = max(room.doors, 1)
    weight += doors * math.log(usual.doors) - usual.doors - math.lgamma(doors + 1)
    weight += math.log(usual.window if room.windows else 1.0 - usual.window)
    if use in _ONLY_ONE and use in uses:
        weight += math.log(_SECOND)
    if use in _FIRST_NEEDED and use not in uses:
        weight += math.log(_FIRST)
    if use in _DEAD_ENDS and len(around) >= _THROUGH:
        weight += math.log(_CROSSED)
    if len(around) == 1 and around[0] is not None:
        weight += math.log(_BEHIND.get((use, around[0]), 1.0))
    return weight
