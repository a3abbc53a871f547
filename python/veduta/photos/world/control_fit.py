"""Laying a component to surveyed points that were marked in its photos."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.structure import Structure
from veduta.photos.world.absolute_orientation import similarity_jacobian
from veduta.photos.world.control_file import ControlPoint, ControlPoints
from veduta.photos.world.control_trust import MOST_LEFT_OUT, Trusted, agrees, trusted, worst_of
from veduta.photos.world.georeference import Fit, Georeference, Residual, Similarity

FEWEST = 3
FEWEST_MARKS = 4
"""Of a point, from which on the others tell which of them is wrong."""
MARK_SD_PX = 1.5
"""How well people mark points."""
SURVEY_SD_M = 0.03
"""How well points are surveyed."""
NARROWEST_RAD = np.deg2rad(1.0)
"""Lines of sight that cross under less leave the depth open."""
FLATTEST = 0.02
"""Least second singular value of the points' spread, as a part of the first: less is a line."""
ITERATIONS = 10
MOST_OFF_PX = 20.0
"""A mark further from where the others put its point is another thing."""


@dataclass(frozen=True)
class _Placed:
    """A control point in the structure. place: (3,). sd: of its place, in the structure's unit.

    notes: which marks were left out.
    """

    point: ControlPoint
    place: NDArray[np.float64]
    sd: float
    notes: tuple[str, ...] = ()


def control_georeference(
    structure: Structure,
    control: ControlPoints,
    origin_m: tuple[float, float, float] | None = None,
    *,
    trust: bool = True,
) -> Georeference:
    """The absolute orientation by all points that two photos and more show.

    origin_m: that of a model in the same CRS; else the points' lower corner, in whole metres.
    trust: whether a point that contradicts the others is left out, and named.
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
    if _is_line(world):
        why = "the control points lie on a line: they leave the roll about it open"
        return Georeference("gcp", False, why, control.crs, (x, y, z), None)
    most = MOST_LEFT_OUT if trust else 0.0
    settled = trusted(own, world, np.array([one.sd for one in placed]), SURVEY_SD_M, most)
    kept = [one for one, is_kept in zip(placed, settled.kept, strict=True) if is_kept]
    apart, expected = settled.apart_m[settled.kept], settled.expected_m[settled.kept]
    fit = _fit(structure, settled.similarity, own[settled.kept], kept, apart, expected)
    if not agrees(settled) or _is_line(world[settled.kept]):
        why = f"the control points contradict each other: {_contradiction(placed, settled)}"
        suspect = worst_of(settled) if settled.suspect is None else settled.suspect
        name = placed[suspect].point.name
        return replace(
            Georeference("gcp", False, why, control.crs, (x, y, z), fit, suspect=name),
            dropped=tuple(placed[row].point.name for row in np.flatnonzero(~settled.kept).tolist()),
        )
    dropped = tuple(
        f"{placed[row].point.name} is left out: it lies {settled.apart_m[row]:.2f} m from where the"
        f" other points say, and without it they agree to {float(apart.max()):.3f} m"
        for row in np.flatnonzero(~settled.kept).tolist()
    )
    why = f"{len(kept)} control points, {fit.rms_m:.3f} m off{notes}"
    why += "".join(f"; {one}" for one in dropped)
    told = (*dropped, *(note for one in placed for note in one.notes))
    return Georeference("gcp", True, why, control.crs, (x, y, z), fit, notes=told)


def _is_line(world: NDArray[np.float64]) -> bool:
    spread = np.linalg.svd(world - world.mean(axis=0), compute_uv=False)
    return bool(spread[1] < FLATTEST * spread[0])


def _contradiction(placed: list[_Placed], found: Trusted) -> str:
    """Which point, or which points, for a person."""
    if len(found.doubtful) > 1:
        names = [placed[row].point.name for row in found.doubtful]
        return (
            f"one of {', '.join(names)} is wrong, and nothing says which; survey or mark one point"
            " more"
        )
    worst = worst_of(found) if found.suspect is None else found.suspect
    return (
        f"{placed[worst].point.name} lies {found.apart_m[worst]:.2f} m off, where"
        f" {found.expected_m[worst]:.2f} m are expected, and without it the others"
        " do not agree much better"
    )


def _placed(structure: Structure, point: ControlPoint) -> _Placed | str:
    """Where its lines of sight cross, but for a mark that the others contradict; a text where that
    cannot be said.
    """
    found = _crossing(structure, point)
    if isinstance(found, str) or _off_px(structure, found).max() <= MOST_OFF_PX:
        return found
    there = set(structure.names)
    marks = [mark for mark in point.seen if mark[0] in there]
    best: tuple[float, _Placed, str] | None = None
    for number, mark in enumerate(marks):
        fewer = replace(point, seen=tuple(marks[:number] + marks[number + 1 :]))
        tried = _crossing(structure, fewer)
        if isinstance(tried, str):
            continue
        off = float(_off_px(structure, tried).max())
        if len(marks) >= FEWEST_MARKS and (best is None or off < best[0]):
            best = off, tried, mark[0]
    if best is None or best[0] > MOST_OFF_PX:
        return found
    note = f"{point.name} is marked elsewhere in {best[2]}: that mark is left out"
    return replace(best[1], notes=(note,))


def _off_px(structure: Structure, placed: _Placed) -> NDArray[np.float64]:
    """(m,) how far each mark lies from where its photo shows the place."""
    row_of = {name: row for row, name in enumerate(structure.names)}
    off = []
    for name, pixel in placed.point.seen:
        if name in row_of:
            pose = structure.cam_from_world[row_of[name]]
            ahead = pose[:, :3] @ placed.place + pose[:, 3]
            shown = np.asarray(structure.camera(row_of[name]).img_from_cam(ahead[None]))[0]
            off.append(float(np.linalg.norm(shown - pixel)))
    return np.array(off)


def _crossing(structure: Structure, point: ControlPoint) -> _Placed | str:
    """By all marks; a text where that cannot be said."""
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
