"""One animal's gait on another's body: turns by where they are along a limb, strides by the legs.

A limb's turns are those of its directions: how far each has turned, from the body on. So a leg of
three segments can move as one of four does. How long a cycle takes goes with the square root of the
legs' length, as a pendulum's does (equal Froude numbers).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from veduta.fauna.document.limbed import LimbedAnimal, LimbedGait, Swing
from veduta.fauna.motion.figure import Figure, Floats, Limb, figure_of
from veduta.fauna.motion.stride import swung
from veduta.run.errors import InputError

_KEYS = 96


def borrowed(animal: LimbedAnimal, other: LimbedAnimal, file: str) -> LimbedAnimal:
    """The animal with the other's gaits beside its own; InputError where they have no legs in
    common.

    file: what the other's document is called, for messages. The gaits are marked as invented.
    """
    if animal.plan.view != other.plan.view:
        fault = f"is of an animal seen from the {other.plan.view}, and this one's is another view"
        raise InputError(file, fault, "Give a document of footage from the same view.")
    if not other.gaits:
        raise InputError(file, "holds no gait", "Give a document of footage with a cycle in it.")
    figure, theirs = figure_of(animal.plan), figure_of(other.plan)
    shared = {limb.name for limb in figure.feet()} & {limb.name for limb in theirs.feet()}
    if not shared:
        fault = f"has no leg that this body has ({', '.join(one.name for one in theirs.feet())})"
        raise InputError(file, fault, "Call the legs of both body plans the same.")
    legs = _leg_length(figure, shared) / _leg_length(theirs, shared)
    slower = np.sqrt(legs * animal.length.metres / other.length.metres)
    taken = {gait.name for gait in animal.gaits}
    gaits = list(animal.gaits)
    for gait in other.gaits:
        name = gait.name if gait.name not in taken else f"{gait.name} of {other.name}"
        rise = _scaled(gait.rise, legs)
        found = gait.model_copy(
            update={
                "name": name, "cycle_s": gait.cycle_s * float(slower),
                "stride": gait.stride * legs, "swings": _swings(figure, theirs, gait), "rise": rise,
                "feet": [step for step in gait.feet if step.limb in shared],
                "provenance": "invented",
            }
        )  # fmt: skip
        gaits.append(found)
    doubt = f"the gaits of {other.name} are another animal's: strides were scaled by the legs"
    return animal.model_copy(update={"gaits": gaits, "doubts": [*animal.doubts, doubt]})


def _leg_length(figure: Figure, names: set[str]) -> float:
    """The mean length of legs, in lengths of the animal."""
    long = [
        figure.length[list(limb.segments)].sum() for limb in figure.feet() if limb.name in names
    ]
    return float(np.mean(long))


def _swings(figure: Figure, theirs: Figure, gait: LimbedGait) -> list[Swing]:
    """The swings of all limbs that both have, one for each segment of this figure."""
    by_name = {swing.segment: swing for swing in gait.swings}
    limbs = {limb.name: limb for limb in theirs.limbs}
    found: list[Swing] = []
    for limb in figure.limbs:
        other = limbs.get(limb.name)
        if other is None:
            continue
        given = [by_name.get(theirs.segments[segment]) for segment in other.segments]
        order = max((len(swing.cos) for swing in given if swing is not None), default=0)
        if order == 0:
            continue
        shares = np.zeros((len(given), 2 * order))
        for row, swing in enumerate(given):
            if swing is not None:
                shares[row, : len(swing.cos)] = swing.cos
                shares[row, order : order + len(swing.sin)] = swing.sin
        own = _along(figure, limb, theirs, other, shares)
        found += [
            _swing(figure.segments[segment], own[row, :order], own[row, order:])
            for row, segment in enumerate(limb.segments)
        ]
    return found


def _along(figure: Figure, limb: Limb, theirs: Figure, other: Limb, shares: Floats) -> Floats:
    """Turns (n, k) of this limb's segments from those (m, k) of the other's."""
    if len(limb.segments) == len(other.segments):
        return shares
    whole = np.cumsum(shares, axis=0)
    middles = _middles(theirs, other)
    own = np.stack(
        [np.interp(_middles(figure, limb), middles, column) for column in whole.T], axis=1
    )
    return np.diff(own, axis=0, prepend=0.0)


def _middles(figure: Figure, limb: Limb) -> Floats:
    """Where along the limb, 0..1, the middles of its segments are."""
    long = figure.length[list(limb.segments)]
    return np.asarray((np.cumsum(long) - 0.5 * long) / long.sum())


def _swing(name: str, cos: Sequence[float] | Floats, sin: Sequence[float] | Floats) -> Swing:
    loose = Swing(
        segment=name, cos=[round(float(v), 5) for v in cos], sin=[round(float(v), 5) for v in sin],
        low=-7.0, high=7.0,
    )  # fmt: skip
    turns = swung(loose, np.arange(_KEYS) / _KEYS)
    low, high = float(turns.min()) - 1e-4, float(turns.max()) + 1e-4
    return loose.model_copy(update={"low": round(low, 5), "high": round(high, 5)})


def _scaled(swing: Swing, by: float) -> Swing:
    return swing.model_copy(
        update={
            "cos": [by * value for value in swing.cos], "sin": [by * value for value in swing.sin],
            "low": by * swing.low, "high": by * swing.high,
        }
    )  # fmt: skip
