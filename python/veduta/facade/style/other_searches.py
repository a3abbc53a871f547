"""The thesis's other searches, beside Metropolis-Hastings at equal time: greedy and annealing."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

from veduta.facade.style.posterior import Posterior, Scored
from veduta.facade.style.proposals import propose
from veduta.facade.style.starts import climbed


@dataclass(frozen=True)
class AnnealParameters:
    """hot, cold: the powers of the likelihood that annealing begins and ends with."""

    hot: float = 0.05
    cold: float = 4.0


def greedy(posterior: Posterior, start: Scored, rng: np.random.Generator, seconds: float) -> Scored:
    """The best of climbs from a start, and then from structures drawn from the prior."""
    begun, best = time.perf_counter(), start
    state = start.state
    while True:
        found = climbed(posterior, state, rng)
        if found is not None and found.log_posterior > best.log_posterior:
            best = found
        if time.perf_counter() - begun > seconds:
            return best
        state = posterior.grammar.draw(rng)


def anneal(
    posterior: Posterior,
    start: Scored,
    rng: np.random.Generator,
    seconds: float,
    parameters: AnnealParameters | None = None,
) -> Scored:
    """One chain that cools down; the best that it met."""
    own = parameters or AnnealParameters()
    begun, at, best = time.perf_counter(), start, start
    while (spent := time.perf_counter() - begun) < seconds:
        beta = own.hot * (own.cold / own.hot) ** (spent / seconds)
        step = propose(posterior, at, rng)
        if step is None:
            continue
        gain = beta * (step.proposed.log_likelihood - at.log_likelihood)
        if math.log(1.0 - rng.random()) < gain + step.log_ratio:
            at = step.proposed
            if at.log_posterior > best.log_posterior:
                best = at
    return best
