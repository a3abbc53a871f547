"""Which legs are the left ones of an animal seen from the side.

The near ones are those of the side that the camera sees. The pictures tell them where there are
any; else the order in which quadrupeds set down their feet says which front leg belongs to which
hind leg.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.motion.figure import Floats, Limb
from veduta.fauna.read.fit import Fit, Fitted
from veduta.fauna.read.nearer import Nearer, NearerLooks, nearer_legs

_EARLY = 0.06
"""A front foot comes down half a cycle to so much of one before half a cycle after the hind foot of
its side: in a walk a quarter after it, in a trot half a cycle.
"""


def sides_told(
    fit: Fit, numbers: Floats, fitted: Fitted, pictures: NDArray[np.uint8] | None
) -> tuple[Floats, tuple[Nearer, ...]]:
    """The numbers with each pair of legs on its sides, and what the pictures told of that.

    From above sides are seen, and where joints of legs are marked they are known: nothing is done.
    """
    if fit.top or _are_marked(fit):
        return numbers, ()
    looks = NearerLooks()
    told: list[Nearer] = []
    if pictures is not None:
        found = nearer_legs(pictures, fitted, fit.windows, fit.frames, looks)
        told = [one for one in found if one.places >= looks.places and abs(one.left) >= looks.sure]
    for one in told:
        if (one.left > 0.0) != (fit.windows.faces < 0.0):
            numbers = fit.other_way_round(numbers, one.part)
    return _in_step(fit, numbers, fitted.px_per_length, {one.part for one in told}), tuple(told)


def _are_marked(fit: Fit) -> bool:
    legs = {fit.figure.names[joint] for limb in fit.figure.feet() for joint in limb.joints}
    return bool(legs & set(fit.pinned))


def _in_step(fit: Fit, numbers: Floats, px_per_length: float, told: set[str]) -> Floats:
    """With that of two pairs of which nothing was told on the sides that its steps say.

    Most mammals but primates set down a front foot a quarter of a cycle after the hind foot of its
    side as they walk (Hildebrand's lateral sequence), and half a cycle after it as they trot.
    """
    pairs = [limb for limb in fit.figure.feet() if limb.side == "left"]
    if not fit.basis.shared or len(pairs) != 2 or len(told) == 2:
        return numbers
    joints = fit.fitted(numbers, px_per_length, 0.05).joints()
    hind, front = sorted(pairs, key=lambda limb: float(joints[:, limb.joints[0], 0].mean()))
    later = (_forward_most(fit, joints, front) - _forward_most(fit, joints, hind)) % 1.0
    if _EARLY <= later < 0.5 + _EARLY:
        return numbers
    untold = hind if front.part.name in told else front
    return fit.other_way_round(numbers, untold.part.name)


def _forward_most(fit: Fit, joints: Floats, limb: Limb) -> float:
    """The phase (0..1) at which a foot is ahead of where it hangs; then it comes down."""
    ahead = joints[:, limb.joints[-1], 0] - joints[:, limb.joints[0], 0]
    count = (fit.basis.near.shape[1] - 1) // 2
    share, *_ = np.linalg.lstsq(fit.basis.near, ahead, rcond=None)
    return float(np.arctan2(share[1 + count], share[1]) / (2.0 * np.pi)) % 1.0
