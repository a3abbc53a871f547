"""Where two walls that nearly line up have been taken for one: a step or a bend of the line.

Neighbouring houses stand a little before or behind each other. A line through both fits neither;
two lines, parted at a place along it, do. They are taken where they explain the points so much
better that chance is no reason, and where the two lie apart by more than the points scatter.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

EVIDENCE = 12.0
"""Fall of the summed squares, in variances and per logarithm of the number of points, that two
lines must bring: their three more numbers would be worth 3 if points erred independently."""
APART = 1.0
"""Least distance of the two lines, in standard deviations of the points about them."""


def parting(
    along: NDArray[np.float64],
    off: NDArray[np.float64],
    sigma: NDArray[np.float64],
    least: int,
    shortest: float,
) -> float | None:
    """The place along a line at which two lines should take its part; None where one does.

    (n,) places along it, distances off it and their standard deviations. Each of the two has
    `least` points over the length `shortest` at least.
    """
    order = np.argsort(along, kind="stable")
    t, r, weight = along[order], off[order], 1.0 / sigma[order] ** 2
    count = len(t)
    if count < 2 * least:
        return None
    t = t - t.mean()
    ahead = _squares(t, r, weight)
    behind = _squares(t[::-1], r[::-1], weight[::-1])[::-1]
    cut = np.arange(least, count - least + 1)
    cut = cut[(t[cut - 1] - t[0] >= shortest) & (t[-1] - t[np.minimum(cut, count - 1)] >= shortest)]
    if not len(cut):
        return None
    both = ahead[cut - 1] + behind[cut]
    best = int(both.argmin())
    at, left = int(cut[best]), float(both[best])
    scatter = max(left / max(1, count - 4), 1e-300)
    if (float(ahead[-1]) - left) / scatter < EVIDENCE * np.log(count):
        return None
    if _apart(t, r, weight, at) < APART * np.sqrt(scatter / float(weight.mean())):
        return None
    return float(0.5 * (along[order][at - 1] + along[order][at]))


def _squares(
    t: NDArray[np.float64], r: NDArray[np.float64], weight: NDArray[np.float64]
) -> NDArray[np.float64]:
    """(n,) weighted squares left by a straight line through the first k points, k = 1 to n."""
    w, wt, wr = (np.cumsum(weight * value) for value in (np.ones_like(t), t, r))
    wtt, wtr, wrr = (np.cumsum(weight * value) for value in (t * t, t * r, r * r))
    spread = np.maximum(wtt - wt * wt / w, 1e-300)
    cross = wtr - wt * wr / w
    found: NDArray[np.float64] = np.maximum(wrr - wr * wr / w - cross**2 / spread, 0.0)
    return found


def _apart(
    t: NDArray[np.float64], r: NDArray[np.float64], weight: NDArray[np.float64], at: int
) -> float:
    """Largest distance between the two lines over the middle half of either's points."""
    one = np.polyfit(t[:at], r[:at], 1, w=np.sqrt(weight[:at]))
    two = np.polyfit(t[at:], r[at:], 1, w=np.sqrt(weight[at:]))
    places = np.concatenate([np.quantile(t[:at], [0.25, 0.75]), np.quantile(t[at:], [0.25, 0.75])])
    return float(np.abs(np.polyval(one - two, places)).max())
