"""A poor place in the world, where one is asked for and nothing is believed (`--georef rough`)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from veduta.photos.world.georeference import Fit, Georeference, Method

ORDER: tuple[Method, ...] = ("gcp", "gps", "model")
"""A refused model fits elsewhere, too; GPS is off by what it says."""


def roughly(tried: Sequence[Georeference]) -> list[Georeference]:
    """What was tried, with the first that has a fit taken: its deviation is what it leaves."""
    fits = [one for method in ORDER for one in tried if one.method == method and one.best]
    if not fits:
        return list(tried)
    chosen = fits[0]
    return [_rough(one) if one is chosen else one for one in tried]


def _rough(one: Georeference) -> Georeference:
    if one.best is None:
        return one
    fit = _widened(one.best)
    off = float(max(fit.shift_sd_m))
    note = f"the place is rough, as --georef rough asks: known to {off:.1f} m, for {one.why}"
    return replace(
        one, accepted=True, why=f"taken roughly, though {one.why}", best=fit, notes=(note,)
    )


def _widened(fit: Fit) -> Fit:
    """With deviations no less than what the fit leaves of all residuals."""
    left = np.array([residual.distance_m for residual in fit.residuals])
    if len(left) == 0:
        return fit
    off = float(np.sqrt(np.mean(left**2)))
    return replace(fit, shift_sd_m=np.maximum(fit.shift_sd_m, off))
