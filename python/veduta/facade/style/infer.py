"""Which style a front has, and which structure of it: the second half of `veduta facade`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from veduta.facade.document import FacadeDocument
from veduta.facade.style.grammar import ANY_FRONT, StyleGrammar, style_grammar
from veduta.facade.style.observed import Observed
from veduta.facade.style.posterior import Posterior, Scored
from veduta.facade.style.prior import Choice, Real
from veduta.facade.style.search import Searched, SearchParameters, search
from veduta.facade.style.starts import (
    best_start,
    climbed,
    read_attributes,
    read_state,
    usual_states,
)
from veduta.facade.style.state import SCALE
from veduta.grammar.rules import style_names
from veduta.run.errors import InputError, NotFoundError

AUTO = "auto"
NOT_ON_THE_STREET = ("suburban-house",)
"""Styles of houses in gardens: their fronts are not the lot's first edge."""
ASSUMED = Real(0.85, 1.2, 0.6, 1.7)
GIVEN = Real(0.97, 1.03, 0.9, 1.1)
"""How much the metres may be wrong: where a storey is assumed to be 3 m high; with a size given."""
NEAR_M, NEAR_SCALE = 0.15, 0.03
"""Attributes that differ by less are the same structure."""
HOPELESS_NATS = 150.0
"""Styles whose start is less likely than the best one by more are not climbed."""
NEAR_NATS, NEAR_STEPS = 60.0, 150
"""Candidates that are less likely than the best by no more are walked on for so many steps."""
NONE_COUNTS = 0.65
"""What the likelihood of the best front without a style counts. It may have any sizes, a style's
are those of its rules, which no real house of the style has quite: set so that one Parisian front
(of ECP's part that is not measured on) is taken for its style, which explained 0.75 of that.
"""
_SEED = 20
Heard = Callable[[str, float], None]


@dataclass(frozen=True)
class Candidate:
    """A style with the best structure that was found of it."""

    posterior: Posterior
    best: Scored
    searched: Searched | None = None

    @property
    def name(self) -> str:
        """Of the style; `none` where it stands for none of them."""
        return self.posterior.grammar.name

    @property
    def log_evidence(self) -> float:
        """About the logarithm of what the style gives to what was seen: the likelihood of its best
        structure, with the prior mass of those that are like it.
        """
        seen = self.best.log_likelihood
        if self.name == ANY_FRONT:
            # Never more than it is: where all explain badly, this does no better for it.
            seen = min(seen, NONE_COUNTS * seen)
        return seen + log_mass(self.posterior.grammar, self.best)


@dataclass(frozen=True)
class StyleFound:
    """The candidates by falling odds, with the probability of each; `chosen` was searched."""

    candidates: tuple[Candidate, ...]
    chances: tuple[float, ...]
    chosen: Candidate


def log_mass(grammar: StyleGrammar, scored: Scored) -> float:
    """Natural logarithm of the prior probability of all structures like this one."""
    total = math.fsum(taken.log_chance for taken in scored.state.choices.values())
    for name, distribution in grammar.distributions.items():
        total += distribution.log_density(scored.state.attributes[name])
        if not isinstance(distribution, Choice):
            total += math.log(2.0 * (NEAR_SCALE if name == SCALE else NEAR_M))
    return total


def require_style(style: str | None) -> None:
    """InputError where there is no such style on the street."""
    known = candidate_names(AUTO)
    if style is None or style == AUTO or style in known:
        return
    remedy = f"Name {AUTO} or one of {', '.join(known)}."
    raise InputError(f"--style {style}", "is no style of fronts on a street", remedy)


def candidate_names(style: str) -> list[str]:
    """The styles that are compared: all that stand on the street for `auto`, else the one named."""
    if style != AUTO:
        return [style]
    return [name for name in style_names() if name not in NOT_ON_THE_STREET]


def infer_style(
    document: FacadeDocument,
    observed: Observed,
    style: str,
    parameters: SearchParameters | None = None,
    heard: Heard | None = None,
) -> StyleFound:
    """Compare the styles, with none of them, and search the structures of the likeliest.

    NotFoundError where no style makes a building of the front's size.
    """
    rng = np.random.default_rng(_SEED)
    read = read_attributes(document)
    scale = ASSUMED if document.scale.basis == "assumed-storey" else GIVEN
    names = [*candidate_names(style), ANY_FRONT]
    started = []
    for place, name in enumerate(names):
        if heard is not None:
            heard(name, 0.2 * place / len(names))
        one = _started(name, document, observed, read, scale, rng)
        if one is not None:
            started.append(one)
    found = _climbed(started, rng, heard)
    styles = [one for one in found if one.name != ANY_FRONT]
    if not styles:
        remedy = "Call without --style."
        raise NotFoundError("a style", "no rules make a building of this size", remedy)
    best = max(one.log_evidence for one in styles)
    near = [one for one in found if one.log_evidence > best - NEAR_NATS]
    rest = [one for one in found if one.log_evidence <= best - NEAR_NATS]
    walked = [_walked(one, rng) for one in near]
    likeliest = max(
        (one for one in walked if one.name != ANY_FRONT), key=lambda one: one.log_evidence
    )
    chosen = _searched(likeliest, rng, parameters, heard)
    return ranked([*(chosen if one is likeliest else one for one in walked), *rest], chosen)


def ranked(candidates: Sequence[Candidate], chosen: Candidate) -> StyleFound:
    """The candidates by falling odds; before the photo all are equally likely."""
    ordered = sorted(candidates, key=lambda one: -one.log_evidence)
    logs = np.array([one.log_evidence for one in ordered])
    shares = np.exp(logs - logs.max())
    chances = tuple((shares / shares.sum()).tolist())
    return StyleFound(tuple(ordered), chances, chosen)


def _started(
    name: str,
    document: FacadeDocument,
    observed: Observed,
    read: dict[str, float],
    scale: Real,
    rng: np.random.Generator,
) -> Candidate | None:
    """The likeliest of a style's starts: as read, and its usual houses of this height."""
    grammar = style_grammar(name, document.facade.width_m, scale)
    posterior = Posterior(grammar, observed)
    states = [read_state(grammar, read), *usual_states(grammar, observed.eaves_m, rng)]
    best = best_start(posterior, states, rng)
    return None if best is None else Candidate(posterior, best)


def _climbed(
    started: Sequence[Candidate], rng: np.random.Generator, heard: Heard | None
) -> list[Candidate]:
    """The same climbed; those whose start is hopeless stay as they are."""
    best = max((one.log_evidence for one in started), default=0.0)
    found = []
    for place, one in enumerate(started):
        if heard is not None:
            heard(one.name, 0.2 + 0.4 * place / len(started))
        hopeless = one.name != ANY_FRONT and one.log_evidence < best - HOPELESS_NATS
        climb = None if hopeless else climbed(one.posterior, one.best.state, rng)
        found.append(one if climb is None else Candidate(one.posterior, climb))
    return found


def _walked(candidate: Candidate, rng: np.random.Generator) -> Candidate:
    """The same after a short chain from its structure: climbs end at the first edge."""
    short = SearchParameters(betas=(1.0,), steps=NEAR_STEPS)
    found = search(candidate.posterior, [candidate.best], rng, short)
    return Candidate(candidate.posterior, found.best)


def _searched(
    candidate: Candidate,
    rng: np.random.Generator,
    parameters: SearchParameters | None,
    heard: Heard | None,
) -> Candidate:
    def told(share: float) -> None:
        if heard is not None:
            heard(candidate.name, 0.6 + 0.4 * share)

    found = search(candidate.posterior, [candidate.best], rng, parameters, told)
    return Candidate(candidate.posterior, found.best, found)
