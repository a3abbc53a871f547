"""How far cameras on a rig are off, and places after the best similarity."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray

from veduta.photos.world.absolute_orientation import absolute_orientation
from veduta.photos.world.georeference import Similarity

Floats = NDArray[np.float64]


def places_off(
    found: Mapping[str, Floats], truth: Mapping[str, Floats]
) -> tuple[Similarity, Floats]:
    """The similarity that lays places onto the true ones, and (n,) what is left (m), by name.

    found: (4, 4) world_from_cam. truth: (4, 4) cam_from_world.
    """
    names = sorted(found)
    own = np.array([found[name][:3, 3] for name in names])
    true = np.array([np.linalg.inv(truth[name])[:3, 3] for name in names])
    fit = absolute_orientation(own, true)
    apart = np.linalg.norm(fit.scale * own @ fit.rotation.T + fit.shift - true, axis=1)
    return fit, np.asarray(apart)


def ties_off(
    pairs: Iterable[tuple[str, str]],
    found: Mapping[str, Floats],
    truth: Mapping[str, Floats],
    scale: float,
) -> tuple[float | None, float | None]:
    """How far the place (cm) and the turn (degrees) of a camera on the rig are off, in the median.

    pairs: names of photos of one moment: of the camera, and of that which it is seen from.
    """
    bases, turns = [], []
    for name, base in pairs:
        own = np.linalg.inv(found[name]) @ found[base]
        true = truth[name] @ np.linalg.inv(truth[base])
        centre, wanted = (-one[:3, :3].T @ one[:3, 3] for one in (own, true))
        bases.append(100.0 * float(np.linalg.norm(scale * centre - wanted)))
        turns.append(angle_deg(own[:3, :3].T @ true[:3, :3]))
    if not bases:
        return None, None
    return float(np.median(bases)), float(np.median(turns))


def angle_deg(rotation: Floats) -> float:
    """Of a (3, 3) rotation."""
    return float(np.rad2deg(np.arccos(np.clip((np.trace(rotation) - 1.0) / 2.0, -1.0, 1.0))))
