"""The vote over the scale: the scale that most evidence can be understood to mean.

Evidence is often wrong altogether, not inexact: a number is misread by ten, a size belongs to the
next room, a cupboard was measured. So the mode of a kernel density over the logarithm of the scale
is taken, in which each voter counts once, by that of its readings that fits best; then the mean of
what lies near it, weighted by precision. Figures in `benchmarks/plan/plan.py`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.plan.scale.evidence import Hypothesis, Voter

_KERNEL = 0.012  # least width: evidence of one sheet scatters so, whatever its own sigma says
_NEAR = 3.0  # standard deviations within which evidence agrees
_FLOOR = 0.003  # no sheet is printed and scanned more truly than this
_ROUNDS = 5


@dataclass(frozen=True)
class Verdict:
    """What the vote found.

    `chosen` has for each voter the reading that comes closest, `agrees` whether it is within what
    its own precision and the result allow, `rival_mpp` the scale of the strongest group of those
    that do not agree, and `rival_share` its votes as a share of those of the result.
    """

    metres_per_px: float
    sigma: float
    chosen: tuple[Hypothesis, ...]
    agrees: tuple[bool, ...]
    rival_mpp: float | None
    rival_share: float


def take_vote(voters: list[Voter]) -> Verdict:
    """The scale on which the voters agree best. There is one voter at least.

    The density is that of the paper's several rooms taken together (FPSE, AV3D section on automatic
    scale detection, has no rule for rooms that disagree).
    """
    centre, votes = _mode(voters)
    for _ in range(_ROUNDS):
        chosen = [_closest(voter, centre) for voter in voters]
        agrees = [_near(one, centre) for one in chosen]
        centre = _weighted_mean(voters, chosen, agrees, centre)
    rest = [voter for voter, near in zip(voters, agrees, strict=True) if not near]
    rival, rival_votes = _mode(rest) if rest else (None, 0.0)
    return Verdict(
        metres_per_px=math.exp(centre),
        sigma=_spread(voters, chosen, agrees, centre),
        chosen=tuple(chosen),
        agrees=tuple(agrees),
        rival_mpp=None if rival is None else math.exp(rival),
        rival_share=rival_votes / votes,
    )


def _mode(voters: list[Voter]) -> tuple[float, float]:
    """Where the density is highest, among all readings, and how high it is there."""
    places = np.array([one.log_mpp for voter in voters for one in voter.hypotheses])
    density = np.zeros(len(places))
    shares = _shares(voters)
    for voter, share in zip(voters, shares, strict=True):
        density += share * voter.mass * _support(voter, places)
    best = int(np.argmax(density))
    return float(places[best]), float(density[best])


def _support(voter: Voter, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """How well the best reading of a voter fits each scale, 0 to 1."""
    kernels = [
        one.trust * np.exp(-0.5 * ((places - one.log_mpp) / max(one.sigma, _KERNEL)) ** 2)
        for one in voter.hypotheses
    ]
    best: NDArray[np.float64] = np.max(kernels, axis=0)
    return best


def _shares(voters: list[Voter]) -> list[float]:
    """1 for each voter, less where one place was measured by several."""
    counts: dict[str, int] = {}
    for voter in voters:
        counts[voter.place] = counts.get(voter.place, 0) + 1
    return [1.0 / math.sqrt(counts[voter.place]) for voter in voters]


def _closest(voter: Voter, centre: float) -> Hypothesis:
    """The reading that fits a scale best; the nearest where none does."""

    def fit(one: Hypothesis) -> tuple[float, float]:
        away = abs(one.log_mpp - centre) / max(one.sigma, _KERNEL)
        return (one.trust * math.exp(-0.5 * min(away, 30.0) ** 2), -away)

    return max(voter.hypotheses, key=fit)


def _near(one: Hypothesis, centre: float) -> bool:
    return abs(one.log_mpp - centre) <= _NEAR * max(one.sigma, _KERNEL)


def _weights(
    voters: list[Voter], chosen: list[Hypothesis], agrees: list[bool], centre: float
) -> NDArray[np.float64]:
    """Precision times trust of what agrees, tapered to nothing at its border (Tukey's biweight)."""
    weights = np.zeros(len(voters))
    for index, (voter, one, share) in enumerate(zip(voters, chosen, _shares(voters), strict=True)):
        if agrees[index]:
            away = (one.log_mpp - centre) / (_NEAR * max(one.sigma, _KERNEL) * 1.2)
            taper = (1.0 - away**2) ** 2
            weights[index] = share * voter.mass * one.trust * taper / max(one.sigma, _FLOOR) ** 2
    return weights


def _weighted_mean(
    voters: list[Voter], chosen: list[Hypothesis], agrees: list[bool], centre: float
) -> float:
    weights = _weights(voters, chosen, agrees, centre)
    places = np.array([one.log_mpp for one in chosen])
    return float(weights @ places / weights.sum()) if weights.sum() > 0 else centre


def _spread(
    voters: list[Voter], chosen: list[Hypothesis], agrees: list[bool], centre: float
) -> float:
    """Standard deviation of the result: by what the evidence says or how it scatters."""
    weights = _weights(voters, chosen, agrees, centre)
    places = np.array([one.log_mpp for one in chosen])
    stated = np.array([one.sigma for one in chosen])
    share = weights / weights.sum()
    independent = 1.0 / float(share @ share)
    by_statement = math.sqrt(float(share**2 @ stated**2))
    scatter = math.sqrt(float(share @ (places - centre) ** 2) / max(independent - 1.0, 0.5))
    return max(by_statement, scatter, _FLOOR)
