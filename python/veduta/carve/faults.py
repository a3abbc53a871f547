"""Silhouettes that cannot be right, and views that contradict the others."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.carve.views import View
from veduta.run.errors import InputError, NotFoundError


@dataclass(frozen=True)
class FaultRule:
    """empty, full: shares of the photo below and above which a silhouette shows no object.
    border: of the photo's border on the object, above which a silhouette may be inverted. odd: how
    many times the others' share of their border it must be.
    least_overlap: of a silhouette and the object's, below which the view is named.
    least_views: that must be left.
    """

    empty: float = 0.0005
    full: float = 0.98
    border: float = 0.75
    least_overlap: float = 0.8
    least_views: int = 3


def refuse_silhouettes(
    folder: Path, views: Sequence[View], rule: FaultRule | None = None
) -> tuple[View, ...]:
    """The views with a silhouette that can be one.

    NotFoundError where all are empty or full; InputError where one is inverted, or few are left.
    """
    rule = rule or FaultRule()
    shares = np.array([view.share for view in views])
    if len(views) and (shares < rule.empty).all():
        raise NotFoundError(
            "an object",
            f"all {len(views)} silhouettes in {folder} are empty",
            "Give masks that are white on the object, or photos before a plain background.",
        )
    if len(views) and (shares > rule.full).all():
        raise NotFoundError(
            "an object",
            f"all {len(views)} silhouettes in {folder} fill their photos",
            "Give masks that are white on the object only, or background.",
        )
    inverted = [view.name for view in views if _inverted(view, rule)]
    if inverted and 2 * len(inverted) <= len(views):
        raise InputError(
            ", ".join(inverted[:3]),
            "the silhouette is white along the photo's border and black within: it is inverted",
            "Make it white on the object.",
        )
    if inverted:
        raise InputError(
            folder,
            f"{len(inverted)} of {len(views)} silhouettes are white along the photo's border",
            "Make the masks white on the object, black elsewhere.",
        )
    left = tuple(view for view in views if view.share >= rule.empty)
    if len(left) < rule.least_views:
        raise InputError(
            folder,
            f"has {len(left)} views with a silhouette",
            f"Give {rule.least_views} at least, from different sides.",
        )
    return left


def _inverted(view: View, rule: FaultRule) -> bool:
    mask = view.mask
    border = np.concatenate([mask[0], mask[-1], mask[:, 0], mask[:, -1]])
    return bool(border.mean() > rule.border and view.share > 0.5)


def doubtful_views(
    views: Sequence[View], fits: NDArray[np.float64], rule: FaultRule | None = None
) -> list[str]:
    """What to say of views whose silhouettes the object does not fill."""
    rule = rule or FaultRule()
    odd = [view.name for view, fit in zip(views, fits, strict=True) if fit < rule.least_overlap]
    if not odd:
        return []
    named = ", ".join(odd[:5]) + (" and others" if len(odd) > 5 else "")
    return [
        f"{named}: the object fills less than {rule.least_overlap:.0%} of the silhouette; another"
        " silhouette or camera cuts it away"
    ]
