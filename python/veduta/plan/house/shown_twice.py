"""One flight that both storeys show: UP on the lower sheet, DN on the upper one.

Each sheet may show what the other hides: a break line cuts the lower one off, a slab the upper one,
and the arrow may be read on one of them alone. What both show becomes one flight of the lower
storey.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely.geometry import Polygon, box

from veduta.plan.document import Stairs


@dataclass(frozen=True)
class TwiceRule:
    """over: of the smaller one's area, so much lies under the other. beside_m: straight flights of
    one width lie beside each other by no more; longer_m: and are that much longer together, at
    most, than the longer one. opposed: the cosine between ways that contradict each other.
    """

    over: float = 0.4
    beside_m: float = 0.25
    longer_m: float = 2.6
    opposed: float = -0.5


TWICE = TwiceRule()


def shown_twice(
    lower: Sequence[Stairs], upper: Sequence[Stairs], rule: TwiceRule = TWICE
) -> tuple[list[Stairs], list[str]]:
    """The stairs of a storey with what the sheet above says of them, and what is to be told."""
    found, notes = [], list[str]()
    for one in lower:
        other = max(upper, key=lambda each: _common(one, each), default=None)
        if other is None or _common(one, other) < rule.over:
            found.append(one)
            continue
        same, opposed = _known(one), False
        if _known(one) and _known(other):
            opposed = float(np.dot(one.up, other.up)) < rule.opposed
        elif _known(other) and not one.steps_m:
            same = True
            one = one.model_copy(update={"up": other.up})
        if opposed:
            notes.append(
                f"stairs {one.id} rise one way on the lower sheet and the other way on the upper"
                " one: the lower one is believed"
            )
        longer = _whole(one, other, rule) if same else None
        found.append(longer or one)
    return found, notes


def going_on(
    below: Sequence[Stairs],
    own: Sequence[Stairs],
    above: Sequence[Stairs],
    rule: TwiceRule = TWICE,
) -> list[Stairs]:
    """The stairs of a storey that lead up from it: not those by which one arrives from below.

    Such stand where the storey below shows a flight, and the sheet above has its flights elsewhere:
    these are then the ones that go on. Where it has none, or all are over each other, all lead up.
    """

    def over(one: Stairs, others: Sequence[Stairs]) -> bool:
        return any(_common(one, other) >= rule.over for other in others)

    return [one for one in own if not above or over(one, above) or not over(one, below)]


def _known(one: Stairs) -> bool:
    return math.hypot(*one.up) > 0.5


def _common(one: Stairs, other: Stairs) -> float:
    first, second = Polygon(one.outline_m), Polygon(other.outline_m)
    least = min(first.area, second.area)
    return float(first.intersection(second).area / least) if least > 0.0 else 0.0


def _whole(one: Stairs, other: Stairs, rule: TwiceRule) -> Stairs | None:
    """A straight flight as long as both sheets show it together; None where it is none."""
    if one.steps_m or other.steps_m:
        return None
    along = np.array(one.up) / math.hypot(*one.up)
    if float(np.abs(along).max()) < 1.0 - 1e-6:
        return None
    axis = int(np.argmax(np.abs(along)))
    own, its = (_extent(each, axis) for each in (one, other))
    across, its_across = (_extent(each, 1 - axis) for each in (one, other))
    if np.abs(across - its_across).max() > rule.beside_m:
        return None
    low, high = min(own[0], its[0]), max(own[1], its[1])
    longest = max(float(np.ptp(own)), float(np.ptp(its)))
    if high - low <= float(np.ptp(own)) + 1e-6 or high - low > longest + rule.longer_m:
        return None
    going = float(np.ptp(own)) / one.treads
    treads = max(one.treads, round((high - low) / going))
    corners = ((low, across[0]), (high, across[1]))
    (left, bottom), (right, top) = corners if axis == 0 else [pair[::-1] for pair in corners]
    ring = [(float(x), float(y)) for x, y in box(left, bottom, right, top).exterior.coords[:-1]]
    return one.model_copy(update={"outline_m": ring, "treads": treads})


def _extent(one: Stairs, axis: int) -> NDArray[np.float64]:
    """From where to where stairs go along an axis, (2,)."""
    points = np.array(one.outline_m)[:, axis]
    return np.array([points.min(), points.max()])
