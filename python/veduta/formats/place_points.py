"""The points that a place was seen to have, as formats of points want them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.place.place import Place


@dataclass(frozen=True, eq=False)
class PlacePoints:
    """points_m: (n, 3), world. colours: (n, 3) sRGB. classes: (n,) ASPRS's; None: not all known."""

    points_m: NDArray[np.float64]
    colours: NDArray[np.uint8]
    classes: NDArray[np.uint8] | None


def points_of(place: Place) -> PlacePoints | None:
    """All clouds of a place in one; None where it has none.

    Its layer of distances is the same points again, in colours that tell how far they lie from a
    model: they are taken only where there are no others.
    """
    clouds = [cloud for cloud in place.clouds if cloud.layer == "points"] or place.clouds[:1]
    if not clouds:
        return None
    known = [cloud.classes for cloud in clouds if cloud.classes is not None]
    return PlacePoints(
        np.concatenate([cloud.points_m for cloud in clouds]).astype(np.float64),
        np.concatenate([cloud.colours for cloud in clouds]),
        np.concatenate(known) if len(known) == len(clouds) else None,
    )
