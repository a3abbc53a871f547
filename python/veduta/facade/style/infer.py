"""Which style a front has, and which structure of it: the second half of `veduta facade`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from veduta.facade.document import FacadeDocument
from veduta.facade.style.deformed import Deformed, deformed
from veduta.facade.style.grammar import ANY_FRONT, StyleGrammar, style_grammar
from veduta.facade.style.likelihood import log_likelihood
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
_SEED = 20
STARTED, CLIMBED, WALKED = 0.15, 0.35, 0.6
"""Shares of the time at which the starts, the climbs and the short walks are done."""
Heard = Callable[[str, float], None]


ASSUMED = Real(0.85, 1.2, 0.6, 1.7)
GIVEN = Real(0.97, 1.03, 0.9, 1.1)


@dataclass(frozen=True)
class InferParameters:
    """How styles are compared.

    assumed, given: how much the document's metres may be wrong where a storey is assumed to be 3 m
    high, and where a size was given (evenly, or within a wider range). near_m, near_scale:
    attributes that differ by less (m; of the scale) are the same structure. hopeless_nats: styles
    whose start, deformed, is less likely than the best one by more are not climbed. near_nats,
    near_steps: candidates that are less likely than the best by no more are walked on for so many
    steps. All three save time.

    temperature: what the logarithms of the evidences of styles are divided by, as the cells of a
    front are not independent. none_offset, none_worse, none_apart: the logarithm of the odds that
    the front has none of the styles, where that is as likely as not before the photo, is the offset
    less `none_worse` times how much likelier the best style is than the best front without one,
    less `none_apart` times how likely the style is, both as shares of what labels of cells without
    any rules could have. None of the styles is before the photo as likely as each of them.

    All four were fitted on renders of five styles with the faults of real fronts (with the own
    style, and with it taken away: then none is right) and on pictures of CMP that the eyes were
    trained on, which are taken to have none of the styles (`benchmarks/facade/style_odds.py`).
    """

    assumed: Real = ASSUMED
    given: Real = GIVEN
    near_m: float = 0.15
    near_scale: float = 0.03
    hopeless_nats: float = 70.0
    near_nats: float = 35.0
    near_steps: int = 40
    temperature: float = 21.0
    none_offset: float = 6.4
    none_worse: float = 6.3
    none_apart: float = 12.6


USUAL = InferParameters()


@dataclass(frozen=True)
class Candidate:
    """A style with the best structure that was found of it."""

    posterior: Posterior
    best: Scored
    searched: Searched | None = None
    parameters: InferParameters = USUAL
    real: Deformed | None = None

    def deformed(self) -> Candidate:
        """With the likeliest house whose sizes are not quite those of the structure."""
        found = deformed(self.best.front, self.posterior.observed, self.posterior.parameters)
        return replace(self, real=found)

    def settled(self, rng: np.random.Generator) -> Candidate:
        """The same with what its rules choose where storeys and bays really are.

        A search compares choices in the front as drawn, where a floor that lies a little off has
        no railing where one was seen. So each choice is tried again with the borders moved.
        """
        found = self if self.real is not None else self.deformed()
        if found.real is None or not found.best.state.choices:
            return found
        chosen = _rechosen(found, found.real, rng)
        if chosen is found.best:
            return found
        other = replace(found, best=chosen).deformed()
        return _better(found, other)

    @property
    def name(self) -> str:
        """Of the style; `none` where it stands for none of them."""
        return self.posterior.grammar.name

    @property
    def log_seen(self) -> float:
        """Logarithm of the likelihood of the best structure, deformed as real houses are."""
        return self.best.log_likelihood if self.real is None else self.real.log_total

    @property
    def log_evidence(self) -> float:
        """About the logarithm of what the style gives to what was seen: the likelihood of its best
        structure, with the prior mass of those that are like it.
        """
        return self.log_seen + log_mass(self.posterior.grammar, self.best, self.parameters)


@dataclass(frozen=True)
class StyleFound:
    """The candidates by falling odds, with the probability of each; `chosen` was searched."""

    candidates: tuple[Candidate, ...]
    chances: tuple[float, ...]
    chosen: Candidate


def log_mass(grammar: StyleGrammar, scored: Scored, parameters: InferParameters = USUAL) -> float:
    """Natural logarithm of the prior probability of all structures like this one."""
    total = math.fsum(taken.log_chance for taken in scored.state.choices.values())
    for name, distribution in grammar.distributions.items():
        total += distribution.log_density(scored.state.attributes[name])
        if not isinstance(distribution, Choice):
            near = parameters.near_scale if name == SCALE else parameters.near_m
            total += math.log(2.0 * near)
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
    own: InferParameters = USUAL,
) -> StyleFound:
    """Compare the styles, with none of them, and search the structures of the likeliest.

    heard: gets the name of the style and the share of all that is done, and may end it by an error
    of its own. NotFoundError where no style makes a building of the front's size.
    """
    rng = np.random.default_rng(_SEED)
    read = read_attributes(document)
    scale = own.assumed if document.scale.basis == "assumed-storey" else own.given
    names = [*candidate_names(style), ANY_FRONT]
    started = []
    for place, name in enumerate(names):
        if heard is not None:
            heard(name, STARTED * place / len(names))
        one = _started(name, document, observed, read, scale, rng)
        if one is not None:
            started.append(replace(one, parameters=own).deformed())
    found = _climbed(started, rng, heard)
    styles = [one for one in found if one.name != ANY_FRONT]
    if not styles:
        remedy = "Call without --style."
        raise NotFoundError("a style", "no rules make a building of this size", remedy)
    best = max(one.log_evidence for one in styles)
    near = [one for one in found if one.log_evidence > best - own.near_nats]
    rest = [one for one in found if one.log_evidence <= best - own.near_nats]
    walked = [
        _walked(one, rng, _within(heard, one.name, CLIMBED, WALKED, place, len(near)))
        for place, one in enumerate(near)
    ]
    likeliest = max(
        (one for one in walked if one.name != ANY_FRONT), key=lambda one: one.log_evidence
    )
    chosen = _searched(likeliest, rng, parameters, heard)
    return ranked([*(chosen if one is likeliest else one for one in walked), *rest], chosen)


def ranked(candidates: Sequence[Candidate], chosen: Candidate) -> StyleFound:
    """The candidates by falling odds; before the photo all are equally likely."""
    own = chosen.parameters
    styles = [one for one in candidates if one.name != ANY_FRONT]
    none = [one for one in candidates if one.name == ANY_FRONT]
    rest = 1.0
    shares: dict[str, float] = {}
    if none and styles:
        best = max(styles, key=lambda one: one.log_evidence)
        most = float(chosen.posterior.observed.ratios.max(axis=0).sum())
        log_odds = log_odds_of_none(best.log_seen, none[0].log_seen, most, own)
        shares[ANY_FRONT] = 1.0 / (1.0 + len(styles) * math.exp(-min(log_odds, 700.0)))
        rest = 1.0 - shares[ANY_FRONT]
    elif none:
        shares[ANY_FRONT] = 1.0
    logs = np.array([one.log_evidence / own.temperature for one in styles])
    if len(logs):
        parts = np.exp(logs - logs.max())
        parts *= rest / parts.sum()
        shares |= {one.name: part for one, part in zip(styles, parts.tolist(), strict=True)}
    ordered = sorted(candidates, key=lambda one: -shares[one.name])
    return StyleFound(tuple(ordered), tuple(shares[one.name] for one in ordered), chosen)


def log_odds_of_none(
    style: float, none: float, most: float, parameters: InferParameters = USUAL
) -> float:
    """Logarithm of the odds that a front has none of the styles, where both are as likely before.

    style, none: logarithms of the likelihoods of the best of the styles, and of the best front
    without one. most: what labels of cells could have without any rules.
    """
    scale = max(most, 1e-6)
    own = parameters
    worse = own.none_worse * (style - none) / scale
    return own.none_offset - worse - own.none_apart * style / scale


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
            heard(one.name, STARTED + (CLIMBED - STARTED) * place / len(started))
        hopeless = one.name != ANY_FRONT and one.log_evidence < best - one.parameters.hopeless_nats
        climb = None if hopeless else climbed(one.posterior, one.best.state, rng)
        if climb is not None:
            one = _better(one, replace(one, best=climb, real=None).settled(rng))
        found.append(one)
    return found


def _rechosen(candidate: Candidate, real: Deformed, rng: np.random.Generator) -> Scored:
    """The structure with the likeliest alternative of each choice, its borders kept."""
    posterior, at = candidate.posterior, candidate.best

    def level(one: Scored) -> float:
        front = real.borders.carry(one.front)
        seen = log_likelihood(front, posterior.observed, posterior.parameters)
        return seen + math.fsum(taken.log_chance for taken in one.state.choices.values())

    highest = level(at)
    for path in sorted(at.state.choices):
        taken = at.state.choices.get(path)
        others = () if taken is None else tuple(posterior.grammar.alternatives(path, taken))
        for other in others:
            found = posterior.score(at.state.with_choice(path, other), rng, (at.state, path))
            if found is not None and (new := level(found)) > highest:
                at, highest = found, new
    return at


def _within(
    heard: Heard | None, name: str, begin: float, end: float, place: int = 0, count: int = 1
) -> Callable[[float], None]:
    """What tells the share of one of `count` searches as that of all, from `begin` to `end`."""

    def told(share: float) -> None:
        if heard is not None:
            heard(name, begin + (end - begin) * (place + share) / count)

    return told


def _walked(
    candidate: Candidate, rng: np.random.Generator, told: Callable[[float], None]
) -> Candidate:
    """The same after a short chain from its structure: climbs end at the first edge."""
    short = SearchParameters(betas=(1.0,), steps=candidate.parameters.near_steps)
    found = search(candidate.posterior, [candidate.best], rng, short, told)
    return _better(candidate, replace(candidate, best=found.best, real=None).settled(rng))


def _better(one: Candidate, other: Candidate) -> Candidate:
    """The one with more evidence: what is likelier as drawn need not be so when it is deformed."""
    return other if other.log_evidence >= one.log_evidence else one


def _searched(
    candidate: Candidate,
    rng: np.random.Generator,
    parameters: SearchParameters | None,
    heard: Heard | None,
) -> Candidate:
    told = _within(heard, candidate.name, WALKED, 1.0)
    found = search(candidate.posterior, [candidate.best], rng, parameters, told)
    walked = replace(candidate, best=found.best, searched=found, real=None).settled(rng)
    return _better(replace(candidate, searched=found), walked)
