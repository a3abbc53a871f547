"""What the plan draws in a room stands where it is drawn, before anything is thought up."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from veduta.plan.document import Fitting, FittingKind
from veduta.plan.furnish.arrangement import OFF_WALL_M
from veduta.plan.furnish.catalogue.entry import Wanted
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.layout import Layout, Stood
from veduta.plan.furnish.room import RoomSpace, Stretch, Vector

OBJECTS: dict[FittingKind, tuple[str, ...]] = {
    "toilet": ("toilet",),
    "basin": ("basin", "handbasin"),
    "bathtub": ("bathtub",),
    "shower": ("shower",),
    "washer": ("washer",),
    "bed": ("bed-double", "bed-single"),
}
"""Types of the catalogue that stand for what is drawn, the larger one first.

Hobs and sinks are parts of worktops, whose rows are `drawn_kitchen`'s.
"""
DOUBLE_M = 1.25
"""A bed that is drawn wider is for two."""
TO_WALL_M = 0.35
"""What is drawn so near to a wall stands against it."""
ASKEW_RAD = 0.2
"""What is drawn so little askew is meant to be straight."""
SHIFTS_M = (0.0, 0.05, -0.05, 0.1, -0.1, 0.2, -0.2)
"""Drawings are a little off: how far along its wall a thing is tried."""
SERVE: dict[str, frozenset[str]] = {
    "sleeping": frozenset({"bed-double", "bed-single"}),
    "bathtub": frozenset({"bathtub", "shower"}),
    "shower": frozenset({"bathtub", "shower"}),
    "handbasin": frozenset({"basin", "handbasin"}),
}
"""What does the work of a wish that is not called like its thing."""


def place_drawn(
    fittings: Iterable[Fitting], layout: Layout, choice: Choice, group: int
) -> list[str]:
    """Put the fittings of the room into it; returns the kinds that found no place where drawn.

    group: of all of them, so that they may stand as near to each other as they are drawn.
    """
    missing: list[str] = []
    for one in fittings:
        if one.kind not in OBJECTS:
            continue
        if not any(
            takes_place(thing, layout)
            for kind in _types(one)
            for thing in _tries(one, kind, layout.space, choice, group)
        ):
            missing.append(one.kind)
    return missing


def without_drawn(wishes: Sequence[Wanted], stood: Iterable[Stood]) -> list[Wanted]:
    """The wishes that what stands does not fulfil; a row of basin and toilet lacks one of them."""
    there = Counter(one.entry.type for one in stood)
    basin = there["basin"] + there["handbasin"]
    left: list[Wanted] = []
    for wish in wishes:
        if wish.type == "wash-row" and (basin or there["toilet"]):
            lacks = [
                kind for kind, count in (("toilet", there["toilet"]), ("basin", basin)) if not count
            ]
            left += [replace(wish, type=kind) for kind in lacks]
            continue
        if wish.type == "kitchen-run" and (there["kitchen-hob"] or there["kitchen-sink"]):
            run = ("kitchen-sink", "kitchen-hob", "fridge")
            left += [replace(wish, type=kind) for kind in run if not there[kind]]
            continue
        served = [kind for kind in SERVE.get(wish.type, {wish.type}) if there[kind] > 0]
        if served:
            # A bath serves both as a bath and as a shower.
            if wish.type not in {"bathtub", "shower"}:
                there[served[0]] -= 1
            continue
        left.append(wish)
    return left


def _types(one: Fitting) -> tuple[str, ...]:
    kinds = OBJECTS[one.kind]
    if one.kind == "bed":
        return kinds if one.size_m[0] >= DOUBLE_M else kinds[1:]
    return kinds


def _tries(
    one: Fitting, kind: str, space: RoomSpace, choice: Choice, group: int
) -> Iterable[Stood]:
    """The thing at its place, with its back to the wall that is near, and a little aside."""
    entry = choice.entry(kind)
    size = entry.sized(one.size_m[0])
    front, back = _front_and_back(one)
    turn, wall = one.turn_rad, wall_behind(one, space)
    if wall is not None:
        # Drawn lines are a little off: it stands as straight as its wall.
        front, turn = wall.inward, wall.turn
        back = wall.at(float((np.asarray(one.at_m) - wall.start) @ wall.along), OFF_WALL_M)
    aside = np.array([-front[1], front[0]])
    for shift in SHIFTS_M:
        x, y = (float(value) for value in back + front * size[1] / 2 + shift * aside)
        yield Stood(entry, size, (round(x, 4), round(y, 4)), turn, group=group, drawn=True)


def _front_and_back(one: Fitting) -> tuple[Vector, Vector]:
    """(2,) the way that what is drawn faces, and (2,) the middle of its back."""
    front = np.array([math.sin(one.turn_rad), -math.cos(one.turn_rad)])
    return front, np.asarray(one.at_m) - front * one.size_m[1] / 2


def wall_behind(one: Fitting, space: RoomSpace) -> Stretch | None:
    """The wall that what is drawn stands against; None where none is near its back."""
    front, back = _front_and_back(one)
    found: list[tuple[float, Stretch]] = []
    for wall in space.stretches:
        along = float((np.asarray(one.at_m) - wall.start) @ wall.along)
        away = abs(float((back - wall.start) @ wall.inward))
        straight = float(front @ wall.inward) > math.cos(ASKEW_RAD)
        if straight and -0.1 <= along <= wall.length + 0.1 and away <= TO_WALL_M:
            found.append((away, wall))
    return min(found, key=lambda pair: pair[0])[1] if found else None


def takes_place(thing: Stood, layout: Layout) -> bool:
    """Put a thing where it is; False where it may not stand there, or nobody could walk."""
    if not layout.allows(thing) or not layout.can_walk([thing]):
        return False
    layout.add([thing])
    return True
