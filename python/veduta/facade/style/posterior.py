"""The posterior of a structure (6.10 to 6.12): prior by grammar, likelihood by what was seen."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from veduta.facade.style.grammar import Derived, StyleGrammar
from veduta.facade.style.labels import Front
from veduta.facade.style.likelihood import (
    LikelihoodParameters,
    evidence_score,
    log_likelihood,
)
from veduta.facade.style.observed import Observed
from veduta.facade.style.state import Path, State


@dataclass(frozen=True)
class Scored:
    """A complete state with its front; natural logarithms of prior and likelihood."""

    state: State
    front: Front
    log_prior: float
    log_likelihood: float

    @property
    def log_posterior(self) -> float:
        """But for the evidence of the style, which is the same for all of its states."""
        return self.log_prior + self.log_likelihood


@dataclass
class Posterior:
    """Of the states of one style, given one front."""

    grammar: StyleGrammar
    observed: Observed
    parameters: LikelihoodParameters = field(default_factory=LikelihoodParameters)
    evaluations: int = 0

    def score(
        self, state: State, rng: np.random.Generator, near: tuple[State, Path] | None = None
    ) -> Scored | None:
        """A state with what it leaves open drawn from the prior; None where nothing is built.

        near: a state with the same attributes, and the shape below which alone it differs.
        """
        derived = self.grammar.complete(state, rng, near)
        return None if derived is None else self.of(derived)

    def of(self, derived: Derived) -> Scored:
        """A state that was derived."""
        self.evaluations += 1
        likelihood = log_likelihood(derived.front, self.observed, self.parameters)
        prior = self.grammar.log_prior(derived.state)
        return Scored(derived.state, derived.front, prior, likelihood)

    def evidence_score(self, scored: Scored) -> float:
        """The thesis's own score of it (6.19)."""
        return evidence_score(scored.front, self.observed, self.parameters)

    def every_choice(self, scored: Scored, rng: np.random.Generator) -> Iterator[Scored]:
        """All states with the same attributes: a small space as a whole."""
        waiting = [scored]
        seen = {scored.state.key}
        while waiting:
            one = waiting.pop()
            yield one
            for path, taken in one.state.choices.items():
                for other in self.grammar.alternatives(path, taken):
                    state = one.state.with_choice(path, other)
                    found = self.score(state, rng, (one.state, path))
                    if found is not None and found.state.key not in seen:
                        seen.add(found.state.key)
                        waiting.append(found)
