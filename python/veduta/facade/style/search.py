"""Metropolis-Hastings (algorithm 7) over the structures of a style, as chains of several
temperatures.

A chain at temperature 1 / beta has the likelihood to the power beta: hot ones wander, cold ones
stay at what fits. Neighbours exchange their states by the ratio of parallel tempering, so that the
coldest chain, whose samples are those of the posterior, leaves maxima that are not the highest.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from veduta.facade.style.posterior import Posterior, Scored
from veduta.facade.style.proposals import propose

Heard = Callable[[float], None]


@dataclass(frozen=True)
class SearchParameters:
    """betas: of the chains, the coldest first. seconds and steps: a search ends with the first of
    them; a step is one proposal, and only steps give the same result each time. exchange: steps of
    each chain between exchanges. burn: share of the coldest chain that is no sample yet.
    """

    betas: tuple[float, ...] = (1.0, 0.4, 0.12)
    seconds: float = math.inf
    steps: int = 600
    exchange: int = 4
    burn: float = 0.3


@dataclass
class Chain:
    """One temperature: where it is, the best that it met, and how many proposals it took."""

    beta: float
    at: Scored
    best: Scored
    proposed: int = 0
    accepted: int = 0

    @property
    def acceptance(self) -> float:
        """Share of the proposals that were taken."""
        return self.accepted / max(1, self.proposed)


@dataclass(frozen=True)
class Searched:
    """What a search found. samples: of the coldest chain after its first part, one a step."""

    best: Scored
    chains: tuple[Chain, ...]
    samples: tuple[Scored, ...]
    exchanges: int
    exchanged: int
    steps: int
    seconds: float


def search(
    posterior: Posterior,
    starts: list[Scored],
    rng: np.random.Generator,
    parameters: SearchParameters | None = None,
    heard: Heard | None = None,
) -> Searched:
    """From these starts, one for each chain (the last one for those beyond).

    heard: gets the share that is done, and may end the search by an error of its own.
    """
    own = parameters or SearchParameters()
    chains = [
        Chain(beta, starts[min(k, len(starts) - 1)], starts[min(k, len(starts) - 1)])
        for k, beta in enumerate(own.betas)
    ]
    samples: list[Scored] = []
    exchanges = exchanged = steps = 0
    begun = time.perf_counter()
    while steps < own.steps and (spent := time.perf_counter() - begun) < own.seconds:
        for chain in chains:
            _advance(posterior, chain, rng)
            steps += 1
        samples.append(chains[0].at)
        if len(chains) > 1 and len(samples) % own.exchange == 0:
            exchanges += 1
            exchanged += _exchange(chains, rng)
        if heard is not None:
            heard(min(1.0, max(spent / own.seconds, steps / own.steps)))
    best = max((chain.best for chain in chains), key=lambda scored: scored.log_posterior)
    kept = tuple(samples[int(own.burn * len(samples)) :])
    seconds = time.perf_counter() - begun
    return Searched(best, tuple(chains), kept, exchanges, exchanged, steps, seconds)


def _advance(posterior: Posterior, chain: Chain, rng: np.random.Generator) -> None:
    step = propose(posterior, chain.at, rng)
    chain.proposed += 1
    if step is None:
        return
    gain = chain.beta * (step.proposed.log_likelihood - chain.at.log_likelihood)
    if math.log(1.0 - rng.random()) < gain + step.log_ratio:
        chain.at = step.proposed
        chain.accepted += 1
        if chain.at.log_posterior > chain.best.log_posterior:
            chain.best = chain.at


def _exchange(chains: list[Chain], rng: np.random.Generator) -> int:
    """Two neighbours change places, or stay; 1 where they changed."""
    k = int(rng.integers(len(chains) - 1))
    cold, hot = chains[k], chains[k + 1]
    ratio = (cold.beta - hot.beta) * (hot.at.log_likelihood - cold.at.log_likelihood)
    if math.log(1.0 - rng.random()) >= ratio:
        return 0
    cold.at, hot.at = hot.at, cold.at
    for chain in (cold, hot):
        if chain.at.log_posterior > chain.best.log_posterior:
            chain.best = chain.at
    return 1
