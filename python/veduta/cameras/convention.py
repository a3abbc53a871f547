"""Whether cameras mean what they are read as: their points have to lie where they were seen.

A file with the same numbers in another convention gives no error by itself, only a world that is
mirrored, turned inside out or of another size. Where a source has points and says where they were
seen, the points tell.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.cameras.camera import Camera
from veduta.run.errors import InputError

Floats = NDArray[np.float64]
FEWEST_SEEN = 12
"""Places in a picture from which the convention is told."""


@dataclass(frozen=True)
class ConventionParameters:
    """When the points speak against the cameras.

    most_share: of the picture's diagonal, the median error that is taken. Bundle adjustment leaves
    1e-4 to 1e-3; another convention 0.1 and more; wrong pictures' scales 0.05 and more.
    clear: so many times smaller must the error of another convention be to be named.
    """

    most_share: float = 0.01
    clear: float = 5.0


@dataclass(frozen=True, eq=False)
class Seen:
    """Points that a camera saw: (k, 3) in the world, (k, 2) px where."""

    points: Floats
    places_px: Floats


def _opengl(camera: Camera, scale: float) -> Camera:
    return replace(camera, cam_from_world=np.diag([1.0, -1.0, -1.0]) @ camera.cam_from_world)


def _inverse(camera: Camera, scale: float) -> Camera:
    turn, shift = camera.cam_from_world[:, :3].T, camera.cam_from_world[:, 3]
    return replace(camera, cam_from_world=np.column_stack([turn, -turn @ shift]))


def _mirrored(camera: Camera, scale: float) -> Camera:
    return replace(camera, cam_from_world=np.diag([-1.0, 1.0, 1.0]) @ camera.cam_from_world)


def _upside_down(camera: Camera, scale: float) -> Camera:
    return replace(camera, cam_from_world=np.diag([1.0, -1.0, 1.0]) @ camera.cam_from_world)


def _scaled(camera: Camera, scale: float) -> Camera:
    focal, centre = camera.focal_px, camera.centre_px
    return replace(
        camera,
        focal_px=(focal[0] * scale, focal[1] * scale),
        centre_px=(centre[0] * scale, centre[1] * scale),
    )


_OTHERS: Mapping[str, tuple[Callable[[Camera, float], Camera], str]] = {
    "are in OpenGL's convention (y up, z backward)": (
        _opengl,
        "Export them with x right, y down, z forward, as OpenCV and COLMAP have them.",
    ),
    "are given as world-from-camera": (_inverse, "Export them as camera-from-world."),
    "are mirrored (left and right)": (
        _mirrored,
        "Export them in a right-handed world, or the pictures unmirrored.",
    ),
    "are mirrored (up and down)": (
        _upside_down,
        "Export them with y down in the picture, or the pictures unmirrored.",
    ),
    "were made for pictures of another size": (
        _scaled,
        "Export the cameras of these pictures, or give the pictures at that size.",
    ),
}


def require_convention(
    path: Path,
    cameras: tuple[Camera, ...],
    seen: Mapping[int, Seen],
    parameters: ConventionParameters | None = None,
) -> float | None:
    """The median error (px) of what was seen; None where too little was.

    seen: by the cameras' places in their tuple; px of each camera's own size.
    InputError where the points are elsewhere: it names the convention that fits, if one does.
    """
    bounds = parameters or ConventionParameters()
    if sum(len(one.points) for one in seen.values()) < FEWEST_SEEN:
        return None
    error = _median_share(cameras, seen, lambda camera, scale: camera)
    if error <= bounds.most_share:
        diagonal = np.median([np.hypot(one.width_px, one.height_px) for one in cameras])
        return float(error * diagonal)
    for fault, (change, remedy) in _OTHERS.items():
        other = _median_share(cameras, seen, change)
        if other <= bounds.most_share and other * bounds.clear < error:
            raise InputError(path, f"its cameras {fault}", remedy)
    far = f"{100.0 * error:.0f} % of the picture away" if np.isfinite(error) else "behind them"
    fault = f"its points are not where its cameras saw them (in the middle {far})"
    remedy = "Give cameras and points of one reconstruction, and the pictures that they are of."
    raise InputError(path, fault, remedy)


def _median_share(
    cameras: tuple[Camera, ...],
    seen: Mapping[int, Seen],
    change: Callable[[Camera, float], Camera],
) -> float:
    """Median distance as a share of the diagonal; infinite for a point behind its camera."""
    shares = []
    scale = _best_scale(cameras, seen) if change is _scaled else 1.0
    for index, one in seen.items():
        camera = cameras[index]
        places, depth = change(camera, scale).project(one.points)
        far = np.linalg.norm(places - one.places_px, axis=1)
        far = far / np.hypot(camera.width_px, camera.height_px)
        shares.append(np.where(depth > 0.0, far, np.inf))
    return float(np.median(np.concatenate(shares)))


def _best_scale(cameras: tuple[Camera, ...], seen: Mapping[int, Seen]) -> float:
    """By how much places are larger than projected ones: the median of the ratios."""
    ratios = []
    for index, one in seen.items():
        places, depth = cameras[index].project(one.points)
        own = np.linalg.norm(places, axis=1)
        good = (depth > 0.0) & (own > 1.0)
        ratios.append(np.linalg.norm(one.places_px[good], axis=1) / own[good])
    found = np.concatenate(ratios) if ratios else np.ones(0)
    return float(np.median(found)) if len(found) else 1.0
