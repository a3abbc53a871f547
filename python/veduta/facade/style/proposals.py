"""Steps from one structure of a style to another, with the ratio that makes the chain a sampler.

The thesis's step cuts the tree at a shape by chance and derives it anew. It leaves out that the way
back has another chance: the new tree may have more shapes to cut at. Here a cut is one of the
shapes that have a random choice at or below them, so that the ratio of the two ways is that of the
numbers of such shapes; what is drawn anew comes from the prior, which cancels against that of the
posterior.

A walk changes one attribute. The choices of shapes that are still there stay; those of new shapes
are drawn from the prior, which cancels, too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from veduta.facade.style.posterior import Posterior, Scored
from veduta.facade.style.prior import Choice, Real, Value
from veduta.facade.style.state import SCALE, State

_KEPT_WITH: dict[str, tuple[str, ...]] = {"storeys": ("storeyHeight",)}


@dataclass(frozen=True)
class ProposalParameters:
    """cut: share of the steps that cut the tree. together: of the walks, those that keep the height
    or the width where they change a number or the scale. finer: walks are as long as the
    attribute's own step, or this share of it.
    """

    cut: float = 0.4
    together: float = 0.3
    finer: tuple[float, ...] = (1.0, 0.3, 0.08)


_OWN = ProposalParameters()


@dataclass(frozen=True)
class Step:
    """A proposal, and the logarithm of all of its ratio but for the likelihoods."""

    proposed: Scored
    log_ratio: float


def propose(posterior: Posterior, at: Scored, rng: np.random.Generator) -> Step | None:
    """A step by chance; None where it leads to no building."""
    if rng.random() < _OWN.cut and at.state.choices:
        return _cut(posterior, at, rng)
    return _walk(posterior, at, rng)


def _cut(posterior: Posterior, at: Scored, rng: np.random.Generator) -> Step | None:
    cuts = at.state.cuts()
    cut = cuts[int(rng.integers(len(cuts)))]
    found = posterior.score(at.state.without(cut), rng, (at.state, cut))
    if found is None:
        return None
    back = found.state.cuts()
    if cut not in back:
        return None
    return Step(found, math.log(len(cuts) / len(back)))


def _walk(posterior: Posterior, at: Scored, rng: np.random.Generator) -> Step | None:
    distributions = posterior.grammar.distributions
    names = list(distributions)
    name = names[int(rng.integers(len(names)))]
    state, jacobian = moved(at.state, name, distributions[name], rng)
    others = _KEPT_WITH.get(name, ())
    if rng.random() < _OWN.together:
        if name == SCALE:
            others = tuple(n for n, d in distributions.items() if isinstance(d, Real) and n != name)
        if others:
            ratio = _ratio(at.state, state, name)
            for other in others:
                value = float(state.attributes[other]) * ratio
                state = state.with_attributes(**{other: value})
                jacobian += math.log(ratio)
    before = _density(posterior, at.state)
    after = _density(posterior, state)
    if not math.isfinite(after):
        return None
    found = posterior.score(state, rng)
    return None if found is None else Step(found, after - before + jacobian)


def moved(
    state: State, name: str, distribution: Real | Choice, rng: np.random.Generator
) -> tuple[State, float]:
    """A state with another value of an attribute, and the log of the ratio of the two ways."""
    value: Value
    if isinstance(distribution, Real):
        length = distribution.step * _OWN.finer[int(rng.integers(len(_OWN.finer)))]
        value = float(state.attributes[name]) + float(rng.normal(0.0, length))
        return state.with_attributes(**{name: value}), 0.0
    values = distribution.values
    if distribution.ordered:
        place = values.index(state.attributes[name]) + (1 if rng.random() < 0.5 else -1)
        inside = 0 <= place < len(values)
        return (state.with_attributes(**{name: values[place]}) if inside else state), 0.0
    value = values[int(rng.integers(len(values)))]
    return state.with_attributes(**{name: value}), 0.0


def _ratio(before: State, after: State, name: str) -> float:
    """What another attribute is multiplied with so that the front stays as large."""
    one, other = float(before.attributes[name]), float(after.attributes[name])
    if one <= 0.0 or other <= 0.0:
        return 1.0
    return other / one if name == SCALE else one / other


def _density(posterior: Posterior, state: State) -> float:
    distributions = posterior.grammar.distributions
    return sum(d.log_density(state.attributes[name]) for name, d in distributions.items())
