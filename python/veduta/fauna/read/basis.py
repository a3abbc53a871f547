"""What a fit's angles are sums of in time, and how far shapes and poses may be from the plan's.

Of footage with cycles these are the harmonics of the cycle, and the right legs do half a cycle
later what the left ones do: a walk, trot or pace has few numbers, which all frames tell together.
Without cycles they are cubic splines, and each leg has its own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import BSpline

from veduta.fauna.motion.figure import Floats, Ints


@dataclass(frozen=True)
class FitLooks:
    """How far shapes and poses may be from the plan's; each is one standard deviation."""

    size: float = 0.2
    """Of all lengths at once, as a logarithm: the scale of the start is told by the area alone, and
    an animal of other proportions than the plan's has another one.
    """
    length: float = 0.25
    """Of a segment's length, as a logarithm."""
    deep: float = 0.35
    """Of its thickness, as a logarithm."""
    apart: float = 0.05
    """Of where a limb begins, in lengths; of the far limbs from the near ones half of it."""
    hung: float = 0.4
    """Of what touches the ground so much of it along the body: a leg hangs on its joint, which is
    otherwise free to go where the thigh covers it.
    """
    rest_rad: float = 0.35
    """Of a joint's mean angle."""
    swing_rad: float = 0.4
    """Of the first harmonic of its motion; the k-th has it over k to the power 1.5."""
    root: float = 0.06
    """Of the root's acceleration between frames, in lengths."""
    pin: float = 20.0
    """The loss of a marked joint that is a length away; they pull by the square."""
    beyond: float = 20.0
    """The loss of a joint that is a length outside of the windows, where no cell is looked at; by
    the square, too.
    """
    weight: float = 1e-3
    """Of all that beside the silhouettes: the loss of a deviation in one number."""
    hanging: float = 0.5
    """What swings by itself, as a tail, moves so much less than a leg."""
    freer: float = 0.3
    """Each segment of a leg moves so much more than the one before it."""
    harmonics: int = 4
    spline_frames: float = 3.5
    """Without cycles: frames between the knots."""


@dataclass(frozen=True, eq=False)
class Basis:
    """near, far: (t, m) what a left and a right limb's angles are sums of; spread: (m,) how large
    each share may be. shared: whether both sides have the same shares.
    """

    near: Floats
    far: Floats
    spread: Floats
    shared: bool

    def of(self, rows: Ints) -> Basis:
        """In some of the frames."""
        return replace(self, near=self.near[rows], far=self.far[rows])


def cycle_basis(
    frames: Floats, cycle: float, looks: FitLooks, harmonics: int | None = None
) -> Basis:
    """Harmonics of a cycle of so many frames. frames: (t,) their numbers."""
    order = np.arange(1, (harmonics or looks.harmonics) + 1)

    def at(phase: Floats) -> Floats:
        turn = 2.0 * np.pi * phase[:, None] * order
        return np.concatenate([np.ones((len(phase), 1)), np.cos(turn), np.sin(turn)], axis=1)

    phase = frames / cycle
    swing = looks.swing_rad / order**1.5
    spread = np.concatenate([[looks.rest_rad], swing, swing])
    return Basis(at(phase), at(phase + 0.5), spread, shared=True)


def spline_basis(frames: Floats, looks: FitLooks) -> Basis:
    """Cubic splines through time; the first share is the mean angle."""
    first, last = float(frames[0]), float(frames[-1])
    inner = max(1, round((last - first) / looks.spline_frames))
    knots = np.concatenate(
        [[first] * 3, np.linspace(first, last + 1e-6, inner + 1), [last + 1e-6] * 3]
    )
    splines = BSpline.design_matrix(frames, knots, 3).toarray()
    near = np.concatenate([np.ones((len(frames), 1)), splines], axis=1)
    spread = np.concatenate([[looks.rest_rad], np.full(near.shape[1] - 1, looks.swing_rad)])
    return Basis(near, near, spread, shared=False)


def as_many(shares: Floats, own: Basis, other: Basis) -> Floats:
    """Shares of a basis as those of another with more harmonics, or of other splines."""
    count = other.near.shape[1]
    if shares.shape[1] == count:
        return shares
    found = np.zeros((len(shares), count))
    found[:, 0] = shares[:, 0]
    if own.shared and other.shared:
        few, many = (own.near.shape[1] - 1) // 2, (count - 1) // 2
        for begins, whole in ((0, 0), (few, many)):
            kept = shares[:, 1 + begins : 1 + begins + min(few, many)]
            found[:, 1 + whole : 1 + whole + kept.shape[1]] = kept
    return found
