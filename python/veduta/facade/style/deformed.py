"""A front of a style as a real house has it: storeys and bays not quite as the rules draw them.

Rules draw storeys of one height and bays of one width; houses have them a little apart. So the
height of each storey of a derived front and the width of each bay may differ by a factor whose
logarithm is normal, with the deviations that neighbouring storeys and bays of CMP's fronts have
(`benchmarks/facade/real_fronts.py`), and the likeliest such front is taken: coordinates are climbed
one after the other. What that costs is the logarithm of the density against that of the front as
drawn, so that a front as the rules have it costs nothing.

Tried and left out: other railings on a floor than the rules draw (none, small ones, a long one, one
before the middle windows), each floor by itself at a price of 2.2 nats. Of the six fronts of ECP's
first ten that are not told as Haussmann none was then, as the other styles gained as much.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from veduta.facade.style.labels import Front
from veduta.facade.style.likelihood import LikelihoodParameters, log_likelihood
from veduta.facade.style.observed import Observed

Float = NDArray[np.float64]


@dataclass(frozen=True)
class DeformParameters:
    """storeys, bays: deviation of the logarithm of each one's size. apart_m: windows whose middles
    are nearer are of one row or column. steps_m: by which a border moves, tried both ways, the
    largest first; rounds: how often all of them.
    """

    storeys: float = 0.09
    bays: float = 0.12
    apart_m: float = 1.0
    steps_m: tuple[float, ...] = (0.6, 0.3, 0.15)
    rounds: int = 2


@dataclass(frozen=True)
class Borders:
    """Between columns (`across`) and rows (`up`) of elements, in metres: as drawn, and moved."""

    across: tuple[Float, Float]
    up: tuple[Float, Float]

    def carry(self, front: Front) -> Front:
        """A front, drawn on the same storeys and bays, with their borders moved."""
        boxes = {
            kind: np.stack(
                [
                    _moved(b[:, 0], self.across),
                    _moved(b[:, 1], self.up),
                    _moved(b[:, 2], self.across),
                    _moved(b[:, 3], self.up),
                ],
                axis=1,
            )
            for kind, b in front.boxes.items()
        }
        roofs = tuple(
            np.stack([_moved(r[:, 0], self.across), _moved(r[:, 1], self.up)], axis=1)
            for r in front.roofs
        )
        eaves = float(_moved(np.array([front.eaves_m]), self.up)[0])
        return replace(front, eaves_m=eaves, roofs=roofs, boxes=boxes)


@dataclass(frozen=True)
class Deformed:
    """The likeliest deformed front; log_likelihood: of what was seen; log_cost: at most 0."""

    front: Front
    log_likelihood: float
    log_cost: float
    borders: Borders = field(repr=False)

    @property
    def log_total(self) -> float:
        """Both together."""
        return self.log_likelihood + self.log_cost


def deformed(
    front: Front,
    observed: Observed,
    likelihood: LikelihoodParameters | None = None,
    parameters: DeformParameters | None = None,
) -> Deformed:
    """The front with storeys and bays moved to where they are likeliest."""
    p = parameters or DeformParameters()
    own = _Climb(front, observed, likelihood or LikelihoodParameters(), p)
    return own.climbed()


class _Climb:
    """Borders (as drawn, and where they are now) along both axes."""

    def __init__(
        self, front: Front, observed: Observed, own: LikelihoodParameters, p: DeformParameters
    ) -> None:
        self.front, self.observed, self.own, self.p = front, observed, own, p
        windows = front.boxes["window"]
        across = _borders(0.5 * (windows[:, 0] + windows[:, 2]), 0.0, front.width_m, p.apart_m)
        up = _borders(0.5 * (windows[:, 1] + windows[:, 3]), 0.0, front.eaves_m, p.apart_m)
        up = np.append(up, front.top_m) if front.top_m > front.eaves_m + 0.4 else up
        self.drawn = (across, up)
        self.at = [across.copy(), up.copy()]

    def climbed(self) -> Deformed:
        best = self._scored()
        for _ in range(self.p.rounds):
            before = best.log_total
            for step in self.p.steps_m:
                for axis in (1, 0):
                    # The ground stays, and so do the borders of the lot.
                    last = len(self.at[axis]) - (1 if axis == 0 else 0)
                    for place in range(1, last):
                        best = self._moved(best, axis, place, step)
            if best.log_total < before + 0.1:
                break
        return best

    def _moved(self, best: Deformed, axis: int, place: int, step: float) -> Deformed:
        """With one border moved, and with what lies beyond it or not, where that is likelier."""
        for sign in (1.0, -1.0):
            for whole in (False, True) if axis == 1 else (False,):
                kept = self.at[axis].copy()
                if whole:
                    self.at[axis][place:] += sign * step
                else:
                    self.at[axis][place] += sign * step
                if np.diff(self.at[axis]).min() > 0.3:
                    found = self._scored()
                    if found.log_total > best.log_total:
                        best = found
                        continue
                self.at[axis] = kept
        return best

    def _scored(self) -> Deformed:
        across, up = ((d, a.copy()) for d, a in zip(self.drawn, self.at, strict=True))
        borders = Borders(across, up)
        front = borders.carry(self.front)
        cost = 0.0
        for (drawn, at), deviation in ((across, self.p.bays), (up, self.p.storeys)):
            ratio = np.log(np.diff(at) / np.diff(drawn))
            cost -= 0.5 * float((ratio**2).sum()) / deviation**2
        return Deformed(front, log_likelihood(front, self.observed, self.own), cost, borders)


def _moved(values: Float, borders: tuple[Float, Float]) -> Float:
    drawn, now = borders
    beyond = np.maximum(values - drawn[-1], 0.0) + np.minimum(values - drawn[0], 0.0)
    return np.asarray(np.interp(values, drawn, now) + beyond, np.float64)


def _borders(middles: Float, low: float, high: float, apart: float) -> Float:
    """Borders between rows (or columns) of elements with these middles, and both ends."""
    ordered = np.sort(middles[(middles > low) & (middles < high)])
    if not len(ordered):
        return np.array([low, high])
    breaks = np.flatnonzero(np.diff(ordered) > apart)
    between = 0.5 * (ordered[breaks] + ordered[breaks + 1])
    return np.concatenate([[low], between, [high]])
