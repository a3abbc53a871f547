"""The skeleton of an animal with limbs: a root on the ground, and a bone for each segment.

Part frame: the animal stands along x, its head at +x, the middle of its body over the origin, its left
side at +y, the ground at z = 0. At rest no joint is turned against the part.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.build.going import ROOT
from veduta.fauna.document.limbed import LimbedAnimal
from veduta.fauna.motion.figure import Figure, Floats, figure_of, posed
from veduta.place.skin import Skin

_BELLY = 1.15
"""An animal seen from above carries its belly over the ground by this share less one."""


@dataclass(frozen=True, eq=False)
class Bones:
    """start_m, end_m: (b, 3) of the segments at rest. deep_m: (b, 2) half thickness at both ends.
    round: (b,) half width for that, along the axis `across` (1: y, 2: z). shift_m: part x less the
    figure's.
    """

    figure: Figure
    start_m: Floats
    end_m: Floats
    deep_m: Floats
    round: Floats
    across: int
    shift_m: float
    length_m: float


def bones_of(animal: LimbedAnimal) -> Bones:
    """The bones as the animal stands."""
    figure = figure_of(animal.plan)
    length = animal.length.metres
    at = posed(
        figure, np.array([animal.plan.parts[0].points[0]]), figure.rest[None], figure.length,
        figure.apart,
    ).joints[0]  # fmt: skip
    body = at[list(figure.limbs[0].joints)]
    shift = -0.5 * float(body[0, 0] + body[-1, 0])
    points = np.zeros((len(at), 3))
    points[:, 0] = at[:, 0] + shift
    if animal.plan.view == "side":
        for limb in figure.limbs:
            side = {"left": 1.0, "right": -1.0, "middle": 0.0}[limb.side]
            points[list(limb.joints), 1] = side * limb.part.beside
        points[:, 2] = at[:, 1]
        across = 1
    else:
        points[:, 1] = at[:, 1]
        points[:, 2] = _heights(figure)
        across = 2
    part_round = np.array([figure.limbs[number].part.round for number in figure.limb])
    deep = np.stack([figure.deep[figure.start], figure.deep[figure.end]], axis=1)
    return Bones(
        figure, points[figure.start] * length, points[figure.end] * length, deep * length,
        part_round, across, shift * length, length,
    )  # fmt: skip


def _heights(figure: Figure) -> Floats:
    """How high joints lie that were seen from above: the body on its belly, toes on the ground."""
    body = figure.limbs[0]
    high = _BELLY * float(figure.deep[list(body.joints)].max()) * body.part.round
    found = np.full(len(figure.names), high)
    for limb in figure.limbs:
        rows = list(limb.joints)
        if limb.part.ground:
            low = float(figure.deep[rows[-1]]) * limb.part.round
            found[rows] = np.linspace(high, low, len(rows))
        elif limb.side == "middle" and limb is not body:
            low = float(figure.deep[rows[-1]]) * limb.part.round
            found[rows] = np.linspace(high, low, len(rows))
    return found


def limbed_skin(
    bones: Bones, joints: NDArray[np.uint16], weights: NDArray[np.float32]
) -> Skin:
    """The skin of vertices that follow the bones; bone k is joint k + 1."""
    count = len(bones.start_m)
    rest = np.tile(np.eye(4), (count + 1, 1, 1))
    rest[1:, :3, 3] = bones.start_m
    parent = np.concatenate([[-1], bones.figure.hangs + 1]).astype(np.int32)
    return Skin((ROOT, *bones.figure.segments), parent, rest, joints, weights)
