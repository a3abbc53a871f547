"""Laying a component to surveyed points that were marked in its photos."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.world.absolute_orientation import absolute_orientation, similarity_jacobian
from veduta.photos.world.control_file import ControlPoint, ControlPoints
from veduta.photos.world.georeference import Fit, Georeference, Residual, Similarity

FEWEST = 3
MARK_SD_PX = 1.5
"""How well people mark points."""
SURVEY_SD_M = 0.03
"""How well points are surveyed."""
NARROWEST_RAD = np.deg2rad(1.0)
"""Lines of sight that cross under less leave the depth open."""
FLATTEST = 0.02
"""Least second singular value of the points' spread, as a part of the first: less is a line."""
MOST_DEVIATIONS = 5.0
ITERATIONS = 10


@dataclass(frozen=True)
class _Placed:
    """A control point in the structure. place: (3,). sd: of its place, in the structure's unit."""

    point: ControlPoint
    place: NDArray[np.float64]
    sd: float


def control_georeference(
    structure: Structure,
    control: ControlPoints,
    origin_m: tuple[float, float, float] | None = None,
) -> Georeference:
    """The absolute orientation by all points that two photos and more show.

    origin_m: that of a model in the same CRS; else the points' lower corner, in whole metres.
    """
    lowest = np.floor(np.min([point.place_m for point in control.points], axis=0))
    x, y, z = lowest.tolist() if origin_m is None else origin_m
    origin = np.array([x, y, z])
    placed: list[_Placed] = []
    left: list[str] = []
    for point in control.points:
        found = _placed(structure, point)
        if isinstance(found, str):
            left.append(f"{point.name} {found}")
        else:
            placed.append(found)
    notes = f" ({'; '.join(left[:3])})" if left else ""
    if len(placed) < FEWEST:
        why = f"{len(placed)} control points can be used, of {FEWEST} that it takes{notes}"
        return Georeference("gcp", False, why, control.crs, (x, y, z), None)
    own = np.array([one.place for one in placed])
    world = np.array([one.point.place_m for one in placed]) - origin
    spread = np.linalg.svd(world - world.mean(axis=0), compute_uv=False)
    if spread[1] < FLATTEST * spread[0]:
        why = "the control points lie on a line: they leave the roll about it open"
        return Georeference("gcp", False, why, control.crs, (x, y, z), None)
    similarity = absolute_orientation(own, world)
    apart = np.linalg.norm(similarity.moved(own) - world, axis=1)
    expected = np.hypot(SURVEY_SD_M, similarity.scale * np.array([one.sd for one in placed]))
    fit = _fit(structure, similarity, own, placed, apart, expected)
    worst = int(np.argmax(apart / expected))
    if apart[worst] > MOST_DEVIATIONS * expected[worst]:
        why = (
            f"the control points contradict each other: {placed[worst].point.name} lies"
            f" {apart[worst]:.2f} m off, where {expected[worst]:.2f} m are expected"
        )
        return Georeference("gcp", False, why, control.crs, (x, y, z), fit)
    why = f"{len(placed)} control points, {fit.rms_m:.3f} m off{notes}"
    return Georeference("gcp", True, why, control.crs, (x, y, z), fit)


def _placed(structure: Structure, point: ControlPoint) -> _Placed | str:
    """Where its lines of sight cross; a text where that cannot be said."""
    row_of = {name: row for row, name in enumerate(structure.names)}
    seen = [(row_of[name], pixel) for name, pixel in point.seen if name in row_of]
    if len({row for row, _ in seen}) < 2:
        return f"is marked in {len({row for row, _ in seen})} photos that are placed, of 2"
    centres = structure.centres()[[row for row, _ in seen]]
    rays, focal = [], []
    for row, pixel in seen:
        camera = structure.camera(row)
        flat = camera.cam_from_img(np.array([pixel]))
        if flat is None or not np.isfinite(flat).all():
            return "is marked where its photo's lens shows nothing"
        ray = structure.cam_from_world[row, :, :3].T @ np.array([*flat[0][:2], 1.0])
        rays.append(ray / np.linalg.norm(ray))
        focal.append(camera.mean_focal_length())
    ways = np.array(rays)
    widest = float(np.arccos(np.clip((ways @ ways.T).min(), -1.0, 1.0)))
    if widest < NARROWEST_RAD:
        return "is seen from one direction only"
    # Each line lets the point move along it: the projector across it says how far off it is.
    across = np.eye(3) - ways[:, :, None] * ways[:, None, :]
    weight = np.ones(len(ways))
    place = np.zeros(3)
    for _ in range(ITERATIONS):
        normal = (weight[:, None, None] * across).sum(axis=0)
        right = (weight[:, None, None] * (across @ centres[:, :, None])).sum(axis=0)[:, 0]
        place = np.linalg.solve(normal, right)
        depth = np.maximum(np.einsum("ni,ni->n", place - centres, ways), 1e-6)
        weight = (np.array(focal) / (MARK_SD_PX * depth)) ** 2
    if (np.einsum("ni,ni->n", place - centres, ways) <= 0.0).any():
        return "would lie behind a photo that it is marked in"
    sure = (weight[:, None, None] * across).sum(axis=0)
    return _Placed(point, place, float(np.sqrt(np.trace(np.linalg.inv(sure)))))


def _fit(
    structure: Structure,
    similarity: Similarity,
    own: NDArray[np.float64],
    placed: list[_Placed],
    apart: NDArray[np.float64],
    expected: NDArray[np.float64],
) -> Fit:
    """With the uncertainty that residuals and marks speak for, the larger of the two."""
    middle = structure.centres().mean(axis=0)
    arm = similarity.scale * (own - middle) @ similarity.rotation.T
    jacobian = similarity_jacobian(arm)
    spare = max(1, 3 * len(own) - 7)
    # `expected` is of a distance; a coordinate has a third of its square.
    variance = np.maximum(expected**2 / 3.0, (apart**2).sum() / spare)
    strength = np.repeat(1.0 / variance, 3)
    covariance = np.linalg.inv(jacobian.T @ (strength[:, None] * jacobian))
    sd = np.sqrt(np.diag(covariance))
    return Fit(
        similarity,
        scale_sd=float(sd[0]),
        rotation_sd_rad=sd[1:4],
        shift_sd_m=sd[4:],
        rms_m=float(np.sqrt(np.mean(apart**2))),
        score=float(len(own)),
        residuals=tuple(
            Residual(one.point.name, float(distance))
            for one, distance in zip(placed, apart, strict=True)
        ),
    )
