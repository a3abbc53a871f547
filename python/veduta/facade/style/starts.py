"""Where searches begin: the front that the first half read, in the attributes of a style."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from veduta.facade.document import FacadeDocument
from veduta.facade.style.grammar import StyleGrammar
from veduta.facade.style.posterior import Posterior, Scored
from veduta.facade.style.prior import Choice, Real, Value
from veduta.facade.style.state import SCALE, Path, State

PITCHES = {"bayWidth": 1.0, "moduleWidth": 2.0, "houseWidth": 2.0}
"""Attributes that have the width of so many columns."""
SHARES = ("windowShare",)
"""Attributes that are no lengths."""


@dataclass(frozen=True)
class StartParameters:
    """least_chance: numbers of storeys that are less likely are no starts. halvings: of the step in
    which an attribute is moved up and down. rounds: of climbs. gain: nats that a round must bring.
    """

    least_chance: float = 0.02
    halvings: int = 3
    rounds: int = 2
    gain: float = 0.1


_OWN = StartParameters()


def read_attributes(document: FacadeDocument) -> dict[str, float]:
    """Numbers of the front as it was read: shares, and lengths in metres of the document."""
    sizes = document.rules.facade.sizes_m
    found = {"storeys": float(max(1, len(sizes) - 1))}
    if len(sizes) > 1:
        found["groundHeight"] = sizes[0]
        found["storeyHeight"] = float(np.mean(sizes[1:]))
    else:
        found["storeyHeight"] = sizes[0] / 2.0
    pitch = _pitch(document)
    if pitch is not None:
        found["bayWidth"] = pitch
    windows = [e for e in document.elements if e.class_ == "window" and (e.floor or 0) > 0]
    if windows:
        found["windowWidth"] = float(np.median([e.width_m for e in windows]))
        high = float(np.median([e.height_m for e in windows]))
        found["windowShare"] = high / found["storeyHeight"]
    found["roofHeight"] = document.rules.roof_height_m
    return found


def _pitch(document: FacadeDocument) -> float | None:
    """The median distance from window to window on a floor."""
    floors: dict[int, list[float]] = {}
    for element in document.elements:
        if element.class_ == "window" and element.floor is not None:
            floors.setdefault(element.floor, []).append(element.x_m + 0.5 * element.width_m)
    apart = [np.diff(sorted(middles)) for middles in floors.values() if len(middles) > 1]
    return float(np.median(np.concatenate(apart))) if apart else None


def read_state(grammar: StyleGrammar, read: dict[str, float]) -> State:
    """The state with the attributes of a front that was read, as far as the style has them."""
    state = grammar.start()
    known = grammar.distributions
    usual = known.get("storeyHeight")
    scale = known[SCALE]
    factor = float(scale.middle)
    if isinstance(usual, Real) and isinstance(scale, Real):
        factor = float(np.clip(usual.middle / read["storeyHeight"], scale.least, scale.most))
    values: dict[str, Value] = {SCALE: factor}
    for name, distribution in known.items():
        if isinstance(distribution, Choice) and name == "storeys":
            nearest = min(distribution.values, key=lambda v: abs(float(v) - read["storeys"]))
            values[name] = nearest
        elif isinstance(distribution, Real) and name != SCALE:
            own = read.get(name)
            if name in PITCHES and "bayWidth" in read:
                own = PITCHES[name] * read["bayWidth"]
            if own is not None:
                own *= 1.0 if name in SHARES else factor
                values[name] = float(np.clip(own, distribution.least, distribution.most))
    return state.with_attributes(**values)


def usual_states(grammar: StyleGrammar, eaves_m: float, rng: np.random.Generator) -> list[State]:
    """The style's usual houses of each number of storeys, in the scale that makes them as high.

    For fronts whose floors were not read, or were read wrongly. eaves_m: the height of the front.
    """
    storeys, scale = grammar.distributions.get("storeys"), grammar.distributions[SCALE]
    if not isinstance(storeys, Choice) or not isinstance(scale, Real):
        return []
    found = []
    for number, chance in zip(storeys.values, storeys.chances, strict=True):
        if chance < _OWN.least_chance:
            continue
        state = grammar.start().with_attributes(storeys=number)
        made = grammar.complete(state, rng)
        if made is None or made.front.eaves_m <= 0.0:
            continue
        factor = made.front.eaves_m * made.state.scale / eaves_m
        if scale.least <= factor <= scale.most:
            found.append(state.with_attributes(**{SCALE: factor}))
    return found


def best_start(
    posterior: Posterior, states: Sequence[State], rng: np.random.Generator
) -> Scored | None:
    """The likeliest of some states, each with its best choices; None where none makes a building.

    What a state leaves open is drawn at first: a front of the right size that drew other railings
    than were seen would lose against one of a wrong size that drew better ones.
    """
    scored = [found for state in states if (found := posterior.score(state, rng)) is not None]
    chosen = [_best_choices(posterior, one, rng) for one in scored]
    return max(chosen, key=lambda one: one.log_posterior, default=None)


def climbed(posterior: Posterior, start: State, rng: np.random.Generator) -> Scored | None:
    """The greedy search of the thesis: what is best for one choice or attribute after the other.

    Two rounds; None where the start makes no building.
    """
    at = posterior.score(start, rng)
    if at is None:
        return None
    for _ in range(_OWN.rounds):
        before = at.log_posterior
        at = _best_attributes(posterior, at, rng)
        at = _best_choices(posterior, at, rng)
        if at.log_posterior <= before + _OWN.gain:
            break
    return at


def _best_choices(posterior: Posterior, at: Scored, rng: np.random.Generator) -> Scored:
    for path in sorted(at.state.choices):
        taken = at.state.choices.get(path)
        if taken is None:
            continue
        for other in posterior.grammar.alternatives(path, taken):
            if other.alternatives != taken.alternatives:
                near = at.state, path
                at = _better(posterior, at, at.state.with_choice(path, other), rng, near)
    return at


def _best_attributes(posterior: Posterior, at: Scored, rng: np.random.Generator) -> Scored:
    for name, distribution in posterior.grammar.distributions.items():
        if isinstance(distribution, Choice):
            for value in _near(distribution, at.state.attributes[name]):
                at = _better(posterior, at, at.state.with_attributes(**{name: value}), rng)
            continue
        step = distribution.step
        for _ in range(_OWN.halvings):
            for sign in (1.0, -1.0):
                value = float(at.state.attributes[name]) + sign * step
                if distribution.least <= value <= distribution.most:
                    at = _better(posterior, at, at.state.with_attributes(**{name: value}), rng)
            step *= 0.5
    return at


def _near(distribution: Choice, value: Value) -> list[Value]:
    """The values beside it where they are in order, else all."""
    if not distribution.ordered:
        return list(distribution.values)
    place = distribution.values.index(value)
    return [
        distribution.values[k] for k in (place - 1, place + 1) if 0 <= k < len(distribution.values)
    ]


def _better(
    posterior: Posterior,
    at: Scored,
    state: State,
    rng: np.random.Generator,
    near: tuple[State, Path] | None = None,
) -> Scored:
    found = posterior.score(state, rng, near)
    if found is None or found.log_posterior <= at.log_posterior:
        return at
    return found
