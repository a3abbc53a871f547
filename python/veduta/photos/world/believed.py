"""Whether the best placement of walls in a model is believed.

Evidence is in nats: logarithms of how much likelier the walls, and the height of the cameras, are
with the placement than by chance. A placement is believed where
- it is far likelier than that one of all the placements that could have been tried fits so well by
  chance: evidence above the logarithm of their number, by `SURE`;
- the second best is far less likely: repeated houses fit at several places, and nothing of the fit
  at one of them says that;
- it explains most of what the walls show, and contradicts nearly nothing that was seen;
- what it leaves open is small.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SURE = float(np.log(1000.0))
"""Odds of a thousand to one against chance."""
MARGIN = 10.0
"""Nats between the best two: more than one wall says, for one wall may err."""
FEWEST_WALLS = 3
LEAST_EXPLAINED = 0.5
MOST_BLOCKED, MOST_INSIDE = 0.15, 0.1
MOST_SCALE_SD, MOST_TURN_SD_RAD, MOST_TILT_SD_RAD = 0.02, np.deg2rad(1.0), np.deg2rad(1.5)
MOST_SHIFT_SD_M, MOST_LIFT_SD_M = 0.5, 1.0


@dataclass(frozen=True)
class Standing:
    """What speaks for the best placement.

    evidence, second: nats. chance: logarithm of the number of placements. walls: that match.
    explained: share of their widths. blocked, inside: shares of sight lines and cameras that
    cannot be. covariance: (7, 7) as in `wall_refine.Refined`.
    """

    evidence: float
    second: float | None
    chance: float
    walls: int
    explained: float
    blocked: float
    inside: float
    covariance: NDArray[np.float64]


@dataclass(frozen=True)
class PoseStanding(Standing):
    """Of a placement that began with a pose. facades: whose points speak for it.

    chance: logarithm of the number of placements that refinement about the pose led to. explained:
    of the walls' widths, or of the squares of facades with points, the lesser.
    """

    facades: int


POSE_MARGIN = 5.0
"""Nats between the best two about a pose: what one wall says."""
FEWEST_FACADES = 5
"""On which points lie, in at least two directions, as the covariance shows."""


def pose_believed(standing: PoseStanding) -> tuple[bool, str]:
    """As `believed`, with less that chance had to choose from, and a smaller margin."""
    few = ""
    if standing.facades < FEWEST_FACADES:
        few = f"only {standing.facades} facades have points in their planes, of {FEWEST_FACADES}"
    ambiguous = _ambiguous(standing, POSE_MARGIN)
    for reason in (few, _weak(standing), ambiguous, _contradicted(standing), _loose(standing)):
        if reason:
            return False, f"where GPS says, {reason}"
    return True, (
        f"from where GPS says, refined: {standing.walls} walls fit and {standing.facades} facades"
        f" have points in their planes, {100 * standing.explained:.0f} % of what is seen of walls;"
        f" {standing.evidence:.0f} nats of evidence against {standing.chance:.0f} that chance could"
        f" find about the pose"
    )


def believed(standing: Standing) -> tuple[bool, str]:
    """Yes or no, and why in one sentence."""
    for reason in (
        _weak(standing),
        _ambiguous(standing),
        _contradicted(standing),
        _loose(standing),
    ):
        if reason:
            return False, reason
    margin = "no other fits at all"
    if standing.second is not None:
        margin = f"the second best is {standing.evidence - standing.second:.0f} nats less likely"
    return True, (
        f"{standing.walls} walls fit, {100 * standing.explained:.0f} % of what is seen of walls;"
        f" {standing.evidence:.0f} nats of evidence against {standing.chance:.0f} that chance"
        f" could find, and {margin}"
    )


def _weak(standing: Standing) -> str:
    if standing.walls < FEWEST_WALLS:
        return f"only {standing.walls} walls fit, of {FEWEST_WALLS} that it takes"
    if standing.evidence < standing.chance + SURE:
        return (
            f"chance could have found as much: {standing.evidence:.0f} nats of evidence, of"
            f" {standing.chance + SURE:.0f} that it takes in a model of this size"
        )
    if standing.explained < LEAST_EXPLAINED:
        return f"it explains only {100 * standing.explained:.0f} % of what is seen of walls"
    return ""


def _ambiguous(standing: Standing, margin: float = MARGIN) -> str:
    if standing.second is None or standing.evidence - standing.second >= margin:
        return ""
    return (
        f"two placements fit nearly as well: {standing.evidence:.0f} and {standing.second:.0f}"
        f" nats of evidence, which {margin:.0f} should part"
    )


def _contradicted(standing: Standing) -> str:
    if standing.inside > MOST_INSIDE:
        return f"{100 * standing.inside:.0f} % of the photos would be taken inside of buildings"
    if standing.blocked > MOST_BLOCKED:
        return f"buildings would stand before {100 * standing.blocked:.0f} % of what is seen"
    return ""


def _loose(standing: Standing) -> str:
    sd = np.sqrt(np.diag(standing.covariance))
    bounds = (
        ("the scale", sd[0], MOST_SCALE_SD, ""),
        ("the tilt", float(sd[1:3].max()), MOST_TILT_SD_RAD, " rad"),
        ("the direction", sd[3], MOST_TURN_SD_RAD, " rad"),
        ("the place", float(sd[4:6].max()), MOST_SHIFT_SD_M, " m"),
        ("the height", sd[6], MOST_LIFT_SD_M, " m"),
    )
    for what, found, most, unit in bounds:
        if found > most:
            return (
                f"{what} stays open: a deviation of {found:.2g}{unit}, of at most {most:.2g}{unit}"
            )
    return ""
