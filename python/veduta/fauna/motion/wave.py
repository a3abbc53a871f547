"""A swimmer's wave: the one frequency at which the axis swings, and how it runs along the body."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

from veduta.fauna.motion.angles import Complexes, Floats

FEWEST_CYCLES = 1.0
"""A wave that the footage does not hold once is not claimed."""


@dataclass(frozen=True, eq=False)
class Wave:
    """A(s, t) = mean(s) + Re(amplitude(s) exp(2 pi i f t)).

    frequency_hz: f. mean: (n,) rad, about the course. amplitude: (n,) complex, rad. share: of the
    angles' variance that the wave explains, 0..1. cycles: how many the footage holds.
    """

    frequency_hz: float
    mean: Floats
    amplitude: Complexes
    share: float
    cycles: float

    def at(self, phase: Floats) -> Floats:
        """(t, n) the angles at phases (t,) in turns."""
        spin = np.exp(2j * np.pi * phase)[:, None]
        return np.asarray(self.mean + (self.amplitude * spin).real, dtype=np.float64)


def swimming_wave(angles: Floats, times_s: Floats) -> Wave:
    """Fit the wave to angles (t, n) at times (t,) by least squares over the frequency.

    The course, about which the whole body turns slowly, is taken out first: the mean angle's
    straight line in time.
    """
    course = np.polynomial.polynomial.Polynomial.fit(times_s, angles.mean(axis=1), 1)
    swings = angles - course(times_s)[:, None]
    mean = swings.mean(axis=0)
    duration = float(times_s[-1] - times_s[0])
    step = duration / max(len(times_s) - 1, 1)
    coarse = np.arange(FEWEST_CYCLES / duration, 0.45 / step, 0.1 / duration)
    costs = [_fit(swings, times_s, frequency)[1] for frequency in coarse]
    best = float(coarse[int(np.argmin(costs))])
    bounds = (max(best - 0.15 / duration, 0.5 / duration), best + 0.15 / duration)
    fine = minimize_scalar(
        lambda frequency: _fit(swings, times_s, frequency)[1], bounds=bounds, method="bounded"
    )
    frequency = float(fine.x)
    (mean, amplitude), left = _fit(swings, times_s, frequency)
    total = float(((swings - swings.mean(axis=0)) ** 2).sum())
    share = 1.0 - left / total if total > 0.0 else 0.0
    return Wave(frequency, mean, amplitude, share, frequency * duration)


def _fit(
    swings: Floats, times_s: Floats, frequency: float
) -> tuple[tuple[Floats, Complexes], float]:
    """Mean and amplitude at one frequency, and the sum of squares that is left."""
    turn = 2.0 * np.pi * frequency * times_s
    design = np.stack([np.ones_like(turn), np.cos(turn), -np.sin(turn)], axis=1)
    found, *_ = np.linalg.lstsq(design, swings, rcond=None)
    left = float(((swings - design @ found) ** 2).sum())
    return (found[0], found[1] + 1j * found[2]), left
