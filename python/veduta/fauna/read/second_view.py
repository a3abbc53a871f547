"""The animal seen from the other side: how high one is that was seen from above, or how wide.

A second view need not be of the same moment or scale: all is taken in shares of the animal's length
(paper 4.1, which takes its slices from two views).
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.plan import BodyPlan
from veduta.fauna.motion.angles import Floats
from veduta.fauna.read.axis import Axis, main_axes, medial_axis
from veduta.run.errors import NotFoundError

Mask = NDArray[np.bool_]
_STEPS = 100
"""Along the animal, from end to end."""


@dataclass(frozen=True)
class SecondLooks:
    """How a silhouette of the second view is laid along the animal."""

    limbs: float = 0.45
    """What is thinner than this share of the thickest place is a limb, and no body."""
    sure: float = 0.05
    """By so much one way round must fit better than the other (correlation, or spread)."""
    roundest: float = 4.0
    """The largest width for the thickness that a body plan has; the least is its inverse."""


@dataclass(frozen=True, eq=False)
class SecondView:
    """masks: silhouettes, perhaps of several sizes. name: of the record, for what is said of it."""

    masks: tuple[Mask, ...]
    name: str


@dataclass(frozen=True, eq=False)
class Across:
    """half: (n,) half of how thick the animal is, beside equal steps from its head, in lengths.

    score: 1 less the spread between silhouettes. is_sure: whether it is clear where the head is.
    """

    half: Floats
    score: float
    is_sure: bool


def thickness(view: SecondView, beside: Floats, looks: SecondLooks) -> Across:
    """How thick an animal without limbs is along its axis; NotFoundError where it has none.

    beside: (m,) half widths of the first view at equal steps from the head: where it is thick
    there, it is so here, which tells the head.
    """
    axes = [axis for axis in (medial_axis(mask, _STEPS + 1) for mask in view.masks) if axis]
    if not axes:
        raise NotFoundError(
            "the animal's axis in the second view",
            f"no silhouette in {view.name} is long and narrow",
            "Give one that shows it at full length from the other side.",
        )
    shares = np.stack([_in_lengths(axis) for axis in axes])
    seen = np.interp(np.linspace(0, 1, _STEPS + 1), np.linspace(0, 1, len(beside)), beside)
    likes = np.array([(_alike(row, seen), _alike(row[::-1], seen)) for row in shares])
    turned = likes[:, 1] > likes[:, 0]
    shares[turned] = shares[turned, ::-1]
    half = np.median(shares, axis=0)
    spread = float(np.median(np.abs(shares - half), axis=0).mean() / max(half.mean(), 1e-9))
    margin = float(np.abs(likes[:, 0] - likes[:, 1]).mean())
    return Across(half, float(np.clip(1.0 - spread, 0.0, 1.0)), margin >= looks.sure)


def rounded(plan: BodyPlan, view: SecondView, looks: SecondLooks) -> tuple[BodyPlan, bool]:
    """The plan with its body as wide (or high) for its thickness as the second view shows it, and
    whether it is clear where the head is there.
    """
    body = plan.parts[0]
    forward = np.array([point[0] for point in body.points])
    deep = np.array(body.deep)
    order = np.argsort(forward, kind="stable")
    low, high = _ends(plan)
    places = np.linspace(forward.min(), forward[:-1].max(), _STEPS)
    own = np.interp(places, forward[order], deep[order])
    shares = (places - low) / (high - low)
    fits = []
    for mask in view.masks:
        half = _across(mask, looks)
        at = (np.arange(len(half)) + 0.5) / len(half)
        for turned in (False, True):
            wide = np.interp(shares, at, half[::-1] if turned else half) * (high - low)
            ratio = wide / own
            middle = float(np.median(ratio))
            # Laid the wrong way round the body may lie where there is but a tail.
            spread = float(np.median(np.abs(ratio - middle))) / middle if middle > 0.0 else np.inf
            fits.append((spread, middle, turned))
    ways = np.median(np.array([fit[0] for fit in fits]).reshape(-1, 2), axis=0)
    if not np.isfinite(ways).any():
        raise NotFoundError(
            "the animal's body in the second view",
            f"what {view.name} shows is nowhere as thick as a body",
            "Give a silhouette of the whole animal from the other side.",
        )
    best = int(ways.argmin())
    middles = [middle for _, middle, turned in fits if turned == bool(best)]
    ratio = float(np.clip(np.median(middles), 1 / looks.roundest, looks.roundest))
    parts = (body.model_copy(update={"round": round(ratio, 4)}), *plan.parts[1:])
    apart = float(ways[1 - best] - ways[best])
    return plan.model_copy(update={"parts": list(parts)}), apart >= looks.sure


def _in_lengths(axis: Axis) -> Floats:
    length = float(np.linalg.norm(np.diff(axis.points, axis=0), axis=1).sum())
    return np.asarray(axis.half_width / max(length, 1e-9))


def _alike(first: Floats, second: Floats) -> float:
    """Their correlation along the animal."""
    a, b = first - first.mean(), second - second.mean()
    size = float(np.linalg.norm(a) * np.linalg.norm(b))
    return float(a @ b) / size if size > 0.0 else 0.0


def _ends(plan: BodyPlan) -> tuple[float, float]:
    """How far the animal goes backwards and forwards at rest, with its thickness, in lengths."""
    low, high = np.inf, -np.inf
    for part in plan.parts:
        points = [*([part.start] if part.start else []), *part.points]
        for (forward, _), deep in zip(points, part.deep, strict=True):
            low, high = min(low, forward - deep), max(high, forward + deep)
    return low, high


def _across(mask: Mask, looks: SecondLooks) -> Floats:
    """(n,) half of how thick the body is, from end to end of the animal, in shares of its extent.

    The silhouette is laid along its main axis; limbs are taken off by what is as thick as the body.
    """
    y, x = np.nonzero(mask)
    points = np.stack([x, y], axis=1).astype(np.float64)
    middle, axes = main_axes(points)
    angle = np.degrees(np.arctan2(axes[0, 1], axes[0, 0]))
    height, width = mask.shape
    side = int(np.ceil(np.hypot(height, width))) + 2
    turn = cv2.getRotationMatrix2D((float(middle[0]), float(middle[1])), angle, 1.0)
    turn[:, 2] = turn[:, 2] + (0.5 * side - middle)
    upright = np.asarray(cv2.warpAffine(mask.astype(np.uint8), turn, (side, side))) > 0
    columns = np.flatnonzero(upright.any(axis=0))
    if not len(columns):
        return np.zeros(1)  # thinner than a pixel
    first, last = int(columns[0]), int(columns[-1]) + 1
    reach = float(cv2.distanceTransform(upright.astype(np.uint8), cv2.DIST_L2, 5).max())
    size = 2 * max(1, round(looks.limbs * reach)) + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    body = cv2.morphologyEx(upright.astype(np.uint8), cv2.MORPH_OPEN, disc)
    return np.asarray(0.5 * body[:, first:last].sum(axis=0).astype(np.float64) / (last - first))
