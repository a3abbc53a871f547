"""The likelihood of what was seen given a derived front, as a logarithm; and the thesis's score.

Pixels: the sum over all cells of what was seen of them (`observed`). Elements: each element of the
front is found with a chance, with normal deviations of place and size; whatever is found beside
that is clutter that may lie anywhere and have any size. Against clutter alone, an element that is
found counts as

    log(found / clutter) + log N(deviations of its four sides)

and one that is not as `log(1 - found)`. Which detection belongs to which element: those that are
nearest to each other. Both speak of the same look of the same network and are not independent, so
that the mean of their logarithms is taken: each counts half.

The thesis (6.14 to 6.19) adds scores of single elements instead; a structure with more elements
then is likelier, found or not. `evidence_score` is that sum without its texture factor (6.18).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.facade.style.labels import Front, painted
from veduta.facade.style.observed import KINDS, Observed

Float = NDArray[np.float64]


@dataclass(frozen=True)
class LikelihoodParameters:
    """found: chance that an element is found, as recalled on CMP. side_m: deviation of its sides.

    clutter: density of chance elements per square metre of front and square metre of widths and
    heights: one on 100 m2, up to 3 m wide and high. pixels, elements: what each counts.
    taken_for: how often one of the kinds `alike` is taken for each other one of them.
    place_m, size_m: the thesis's deviations of place and size (6.15, 6.16).
    """

    found: float = 0.8
    side_m: float = 0.25
    clutter: float = 0.01 / 9.0
    pixels: float = 0.5
    elements: float = 0.5
    alike: tuple[str, ...] = ("window", "door", "shop")
    taken_for: float = 0.1
    place_m: float = 0.3
    size_m: float = 0.1


def log_likelihood(
    front: Front, observed: Observed, parameters: LikelihoodParameters | None = None
) -> float:
    """Natural logarithm, against a front of which nothing is known."""
    own = parameters or LikelihoodParameters()
    cells, elements = parts_of(front, observed, own)
    return own.pixels * cells + own.elements * elements


def parts_of(
    front: Front, observed: Observed, parameters: LikelihoodParameters | None = None
) -> tuple[float, float]:
    """What the logarithm is the mean of: that of the cells, and that of the elements."""
    own = parameters or LikelihoodParameters()
    labels = painted(front, observed.shape, observed.cell_m)
    cells = float(np.take_along_axis(observed.ratios, labels[None], axis=0).sum())
    return cells, _elements(front, observed, own)


def _elements(front: Front, observed: Observed, own: LikelihoodParameters) -> float:
    missed = float(np.log1p(-own.found))
    boxes, kind = _stacked(front.boxes)
    detected, kind_detected = _stacked(observed.boxes)
    if not len(boxes) or not len(detected):
        return missed * len(boxes)
    gains = _gains(boxes, detected, own) + _kinds(own)[kind[:, None], kind_detected]
    best, back = gains.argmax(axis=1), gains.argmax(axis=0)
    rows = np.arange(len(boxes))
    own_gain = np.where(back[best] == rows, gains[rows, best], -np.inf)
    return float(np.maximum(own_gain, missed).sum())


def _stacked(boxes: dict[str, Float]) -> tuple[Float, NDArray[np.intp]]:
    """All boxes (n, 4), and the place of the kind of each."""
    counts = [len(boxes[kind]) for kind in KINDS]
    return np.concatenate([boxes[kind] for kind in KINDS]), np.repeat(np.arange(len(KINDS)), counts)


def _kinds(own: LikelihoodParameters) -> Float:
    """(4, 4) logarithm of how often an element of a kind is taken for one of another."""
    chances = np.full((len(KINDS), len(KINDS)), 1e-9)
    alike = [KINDS.index(kind) for kind in own.alike]
    chances[np.ix_(alike, alike)] = own.taken_for
    for place in range(len(KINDS)):
        others = chances[place].sum() - chances[place, place]
        chances[place, place] = 1.0 - others
    return np.asarray(np.log(chances), np.float64)


def _gains(boxes: Float, detected: Float, own: LikelihoodParameters) -> Float:
    """(n, k) what it counts that detection k is element n."""
    apart = boxes[:, None] - detected
    # Place and size deviate by independent sides: N over x0, z0, x1, z1 is one over x, z, w, h.
    exponent = -0.5 * (apart**2).sum(axis=2) / own.side_m**2
    density = exponent - 4.0 * np.log(np.sqrt(2.0 * np.pi) * own.side_m)
    return np.asarray(np.log(own.found / own.clutter) + density, np.float64)


def evidence_score(
    front: Front, observed: Observed, parameters: LikelihoodParameters | None = None
) -> float:
    """The thesis's sum over elements of position and size evidence (6.14 to 6.16, 6.19)."""
    own = parameters or LikelihoodParameters()
    return float(
        sum(_best_scores(front.boxes[kind], observed.boxes[kind], own).sum() for kind in KINDS)
    )


def _best_scores(boxes: Float, detected: Float, own: LikelihoodParameters) -> Float:
    if not len(boxes) or not len(detected):
        return np.zeros(len(boxes))
    places = _middles(boxes)[:, None] - _middles(detected)
    sizes = _sizes(boxes)[:, None] - _sizes(detected)
    exponent = (places**2).sum(axis=2) / own.place_m**2 + (sizes**2).sum(axis=2) / own.size_m**2
    return np.asarray(np.exp(-0.5 * exponent).max(axis=1), np.float64)


def _middles(boxes: Float) -> Float:
    return 0.5 * (boxes[:, :2] + boxes[:, 2:])


def _sizes(boxes: Float) -> Float:
    return boxes[:, 2:] - boxes[:, :2]
