"""Kitchen rows where the plan draws hob and sink: units stand there, a worktop runs between them.

What lies between them along one wall is counter; a unit goes on at either end where it fits, and
where only one of the two is drawn the other stands in the same row.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.plan.document import Fitting
from veduta.plan.furnish.arrangement import OFF_WALL_M
from veduta.plan.furnish.as_drawn import SHIFTS_M, takes_place, wall_behind
from veduta.plan.furnish.catalogue.entry import Entry
from veduta.plan.furnish.choice import Choice
from veduta.plan.furnish.layout import Layout, Stood
from veduta.plan.furnish.room import Stretch

UNIT, HOB, SINK = "kitchen-unit", "kitchen-hob", "kitchen-sink"
TYPES: dict[str, str] = {"hob": HOB, "kitchen-sink": SINK}
_DRAWN = {unit: kind for kind, unit in TYPES.items()}
RIM_M = 0.06
"""Of the worktop on either side of a sink that is drawn."""
LEAST_M, USUAL_M, LONGEST_M = 0.3, 0.6, 0.9
"""Widths of the units between."""
JOINT_M = 0.002
"""Between units, whose sizes are rounded."""
APART_M = 4.0
"""What is drawn further apart along a wall belongs to two rows."""


@dataclass(frozen=True)
class _Unit:
    """A unit of a row: its ends along the wall (m), whether it is drawn, or between what is."""

    kind: str
    low: float
    high: float
    drawn: bool = False
    between: bool = False


def place_kitchen(
    fittings: Iterable[Fitting], layout: Layout, choice: Choice, group: int
) -> list[str]:
    """Put the rows of a room's drawn hobs and sinks into it; the kinds that found no place there.

    group: of the whole row, whose units stand side by side.
    """
    rows: list[tuple[Stretch, list[_Unit]]] = []
    missing: list[str] = []
    drawn = [one for one in fittings if one.kind in TYPES]
    for one in drawn:
        found = _at_wall(one, layout, choice)
        if found is None:
            missing.append(one.kind)
            continue
        wall, unit = found
        row = next((units for other, units in rows if other is wall and _near(units, unit)), None)
        if row is None:
            rows.append((wall, [unit]))
        else:
            row.append(unit)
    kinds = {unit.kind for _, units in rows for unit in units}
    for wall, units in rows:
        whole = _row(sorted(units, key=lambda unit: unit.low), wall, lacks={HOB, SINK} - kinds)
        if _stands(whole, wall, layout, choice, group):
            kinds |= {unit.kind for unit in whole}
        else:
            missing += [_DRAWN[unit.kind] for unit in units]
    return missing


def _at_wall(one: Fitting, layout: Layout, choice: Choice) -> tuple[Stretch, _Unit] | None:
    """The unit around what is drawn, and the wall at its back; None where there is none."""
    wall = wall_behind(one, layout.space)
    if wall is None:
        return None
    kind = TYPES[one.kind]
    width = choice.entry(kind).sized(one.size_m[0] + 2 * RIM_M if kind == SINK else None)[0]
    along = float((np.asarray(one.at_m) - wall.start) @ wall.along)
    low = min(max(along - width / 2, 0.0), max(wall.length - width, 0.0))
    return wall, _Unit(kind, low, low + width, drawn=True)


def _near(units: Sequence[_Unit], unit: _Unit) -> bool:
    return any(max(one.low - unit.high, unit.low - one.high) <= APART_M for one in units)


def _row(drawn: Sequence[_Unit], wall: Stretch, lacks: set[str]) -> list[_Unit]:
    """The row from its low end to its high one, with what lies between and at the ends."""
    row = [drawn[0]]
    for unit in drawn[1:]:
        # Units that are drawn nearer than they are broad stand side by side.
        low = max(unit.low, row[-1].high)
        gap = low - row[-1].high
        if gap < LEAST_M:
            row[-1] = replace(row[-1], high=low) if row[-1].kind == SINK else row[-1]
            low = row[-1].high
        else:
            row += [replace(one, between=True) for one in _counter(row[-1].high, low)]
        row.append(replace(unit, low=low, high=low + unit.high - unit.low))
    before, behind = row[0].low, wall.length - row[-1].high
    for kind in sorted(lacks):
        needed = USUAL_M + (USUAL_M if kind == HOB else 0.8)
        if behind >= max(needed, before):
            row += _counter(row[-1].high, row[-1].high + USUAL_M)
            row.append(_Unit(kind, row[-1].high, row[-1].high + needed - USUAL_M))
        elif before >= needed:
            row = [*_counter(row[0].low - USUAL_M, row[0].low), *row]
            row = [_Unit(kind, row[0].low - needed + USUAL_M, row[0].low), *row]
        before, behind = row[0].low, wall.length - row[-1].high
    if before >= LEAST_M:
        row = [_Unit(UNIT, row[0].low - min(before, USUAL_M), row[0].low), *row]
    if behind >= LEAST_M:
        row.append(_Unit(UNIT, row[-1].high, row[-1].high + min(behind, USUAL_M)))
    return row


def _counter(low: float, high: float) -> list[_Unit]:
    """Units of equal width that fill a stretch."""
    count = max(1, round((high - low) / USUAL_M))
    if (high - low) / count > LONGEST_M:
        count += 1
    ends = np.linspace(low, high, count + 1).tolist()
    return [_Unit(UNIT, *pair) for pair in zip(ends, ends[1:], strict=False)]


def _stands(
    row: Sequence[_Unit], wall: Stretch, layout: Layout, choice: Choice, group: int
) -> bool:
    """Put a row where it is drawn, or a little aside; without units at its ends that do not fit."""
    for shift in SHIFTS_M:
        trial = layout.copy()
        # What is drawn first: the rest gives way.
        order = sorted(row, key=lambda unit: not unit.drawn)
        done = [_put(unit, wall, trial, choice, group, shift) for unit in order]
        if all(
            thing is not None or not unit.drawn for unit, thing in zip(order, done, strict=True)
        ):
            things = [thing for thing in done if thing is not None]
            layout.add(things)
            for unit, thing in zip(order, done, strict=True):
                if thing is not None:
                    _over(unit, thing, wall, layout, choice)
            return True
    return False


def _put(
    unit: _Unit, wall: Stretch, layout: Layout, choice: Choice, group: int, shift: float
) -> Stood | None:
    """A unit at its wall; None where it may not stand."""
    entry = choice.entry(unit.kind)
    size = entry.sized(unit.high - unit.low - (0.0 if unit.drawn else JOINT_M))
    if size[0] > unit.high - unit.low + 0.01 and not unit.drawn:
        return None
    thing = _against(entry, size, 0.5 * (unit.low + unit.high) + shift, wall)
    thing = replace(thing, group=group, drawn=unit.drawn, between=unit.between)
    return thing if takes_place(thing, layout) else None


def _against(
    entry: Entry, size: tuple[float, float, float], along_m: float, wall: Stretch
) -> Stood:
    x, y = (float(value) for value in wall.at(along_m, OFF_WALL_M + size[1] / 2))
    return Stood(entry, size, (round(x, 4), round(y, 4)), wall.turn)


def _over(unit: _Unit, below: Stood, wall: Stretch, layout: Layout, choice: Choice) -> None:
    """A hood over a hob, cupboards over counters, where nothing is in their way."""
    kind = "hood" if unit.kind == HOB else "kitchen-wall"
    if not choice.knows(kind):
        return
    entry = choice.entry(kind)
    size = entry.sized(below.size_m[0])
    along = float((np.array(below.at) - wall.start) @ wall.along)
    thing = _against(entry, size, along, wall)
    thing = replace(thing, above_m=entry.above_m, group=below.group)
    if layout.allows(thing):
        layout.add([thing])
