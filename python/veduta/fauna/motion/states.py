"""New states of an axis by equation (8): moduli within the footage's range, phases at will."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from veduta.fauna.motion.angles import Complexes, Floats, angles_of


@dataclass(frozen=True)
class StateSampling:
    """How many states, and which of those drawn are kept."""

    count: int = 160
    """New states; with those of the footage they are the nodes of the graph."""
    curvature_slack: float = 0.05
    """How far the curvature may exceed the footage's, as a share of it: (8) bounds each modulus,
    but seven of them with their crests in one place bend more sharply than the animal ever did."""
    samples: int = 100
    """Points along the axis at which the curvature is looked at."""
    most_draws: int = 60
    """Rounds of drawing, after which as many states as were found must do."""


@dataclass(frozen=True, eq=False)
class DrawnStates:
    """states: (k, 8) complex, coefficient 0 is zero. refused: drawn, but bent too sharply."""

    states: Complexes
    refused: int


def curvature_range(states: Complexes, samples: int) -> tuple[float, float]:
    """The least and the largest change of the angle along the axis (rad per length)."""
    bends = np.diff(angles_of(states, samples), axis=1) * samples
    return float(bends.min()), float(bends.max())


def draw_states(seen: Complexes, sampling: StateSampling, seed: int) -> DrawnStates:
    """States drawn by (8) from those of the footage, (t, 8); kept where they bend as it."""
    random = np.random.default_rng(seed)
    modulus = np.abs(seen[:, 1:])
    low, high = modulus.min(axis=0), modulus.max(axis=0)
    least, most = curvature_range(seen, sampling.samples)
    slack = sampling.curvature_slack * (most - least) / 2.0
    found: list[Complexes] = []
    kept = drawn = 0
    for _ in range(sampling.most_draws):
        shape = (4 * sampling.count, modulus.shape[1])
        sizes = low + random.random(shape) * (high - low)
        tuples = sizes * np.exp(2j * np.pi * random.random(shape))
        states = np.concatenate([np.zeros((len(tuples), 1)), tuples], axis=1)
        bends = np.diff(angles_of(states, sampling.samples), axis=1) * sampling.samples
        fits = (bends.min(axis=1) >= least - slack) & (bends.max(axis=1) <= most + slack)
        found.append(states[fits])
        kept, drawn = kept + int(fits.sum()), drawn + len(states)
        if kept >= sampling.count:
            break
    every = np.concatenate(found)[: sampling.count]
    return DrawnStates(np.asarray(every, dtype=np.complex128), refused=drawn - kept)


def without_turn(states: Complexes) -> Complexes:
    """The states without coefficient 0, how the whole is turned."""
    bare = states.copy()
    bare[..., 0] = 0.0
    return bare


def largest_step(states: Complexes, samples: int) -> Floats:
    """(samples,) the most that the angle at each point changes from one frame to the next (rad)."""
    return np.asarray(np.abs(np.diff(angles_of(states, samples), axis=0)).max(axis=0))
