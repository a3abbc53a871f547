"""What the vote over the scale is made of."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

EvidenceKind = Literal["dimension", "area", "line", "bar", "ratio", "door"]


@dataclass(frozen=True)
class Hypothesis:
    """One way to understand a piece of evidence: it would make a pixel so large.

    `log_mpp` is the natural logarithm of metres per pixel, `sigma` its standard deviation (a share
    of the scale), `trust` 0 to 1.
    """

    log_mpp: float
    sigma: float
    trust: float


@dataclass(frozen=True)
class Voter:
    """One thing on the sheet with all ways to understand it. It has one vote, of weight `mass`.

    `place` names what was measured in the drawing (a room, a line): what was measured twice, as in
    metres and in feet, is no second measurement.
    """

    kind: EvidenceKind
    text: str
    place: str
    hypotheses: tuple[Hypothesis, ...]
    mass: float = 1.0


def side_hypothesis(
    metres: float, pixels: float, step_m: float, blur_px: float, trust: float
) -> Hypothesis:
    """A length of `metres`, printed to `step_m`, that spans `pixels`; ends within `blur_px`."""
    return Hypothesis(math.log(metres / pixels), side_sigma(metres, pixels, step_m, blur_px), trust)


def side_sigma(metres: float, pixels: float, step_m: float, blur_px: float) -> float:
    """Standard deviation of metres per pixel, as a share, by rounding of both sides.

    What is rounded to a step has a standard deviation of step / sqrt(12).
    """
    return math.hypot(step_m / metres / math.sqrt(12.0), blur_px * math.sqrt(2.0) / pixels, 0.002)
