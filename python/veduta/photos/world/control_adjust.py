"""Bundle adjustment with ground control points, so that they take the bend out of long walks too.

A similarity lays a model onto control points as it is. Here their marks are observations as others
are, and where they were surveyed counts by how well that is known. The engine's adjustment knows
no such constraint on a point, but it knows cameras that stand still: one far above and one far to
the south see a point where it was surveyed, with a focal length at which the deviation of the
survey is that of an observation. The frame is then settled by them, and needs no gauge of its own.
(Constraints as observations of their own: Triggs et al., Bundle adjustment, a modern synthesis,
section 9.) A mark counts as an observation of the engine's features, not as the 1.5 px of
`control_fit`: few among thousands, they place the points and cannot bend the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pycolmap
from numpy.typing import NDArray

from veduta.photos.cameras.component import Component
from veduta.photos.cameras.orient import transformed
from veduta.photos.structure import Structure, adjusted, errors_px
from veduta.photos.world.control_file import ControlPoint, ControlPoints
from veduta.photos.world.control_fit import SURVEY_SD_M, control_georeference
from veduta.photos.world.georeference import Similarity
from veduta.run.errors import NotFoundError
from veduta.run.report import StepRecord

FAR = 1e4
"""How far the survey's cameras are, in extents of the place: their rays are as good as parallel."""
LEAST_SD_PX = 0.1
MOST_WORSE = 1.5
"""The features' errors may not grow by more: points that demand it contradict the photos."""
_LOOKS = (
    np.array([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]),
    np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
)
"""Down, with north above, and north, with the sky above: (3, 3) cam_from_world."""
_BLIND = 1e-9
"""Of the second, which is not to tell east again: its focal length along, beside that upwards."""


@dataclass(frozen=True)
class AdjustedToControl:
    """The structure in the frame that it had, and what is to be told.

    is_adjusted: whether it was moved; the note says why not.
    """

    structure: Structure
    is_adjusted: bool
    note: str


def adjust_components(
    components: Sequence[Component], control: ControlPoints, step: StepRecord
) -> tuple[list[Component], list[str]]:
    """The components by their photos and the control points, and what is to be told of each."""
    adjusted_ones, notes = [], []
    for component in components:
        free = component.lens.kind.principal_point == "free"
        found = adjusted_to_control(component.structure, control, free_principal_point=free)
        if found is None:
            adjusted_ones.append(component)
            continue
        adjusted_ones.append(replace(component, structure=found.structure))
        notes.append(found.note)
        if not found.is_adjusted:
            step.rejected.append(found.note)
    step.counts["components adjusted"] = len(notes) - len(step.rejected)
    return adjusted_ones, notes


def adjusted_to_control(
    structure: Structure, control: ControlPoints, *, free_principal_point: bool
) -> AdjustedToControl | None:
    """The structure by its photos and the control points; None where too few are marked in it.

    Where they contradict a model that is bent they need not contradict each other: what counts is
    whether they do when it is adjusted. If so, or if the photos then contradict themselves, the
    structure stays as it was.
    """
    found = _adjusted_to_all(structure, control, free_principal_point)
    if found is None or found.is_adjusted:
        return found
    # One point is wrong, and the adjustment cannot make it right: without it, then.
    trusted = control_georeference(structure, control)
    if trusted.best is None:
        return found
    names = {residual.name for residual in trusted.best.residuals}
    if not trusted.dropped:
        names -= {trusted.suspect}
    fewer = replace(control, points=tuple(one for one in control.points if one.name in names))
    again = _adjusted_to_all(structure, fewer, free_principal_point)
    if again is None or not again.is_adjusted:
        return found
    left = ", ".join(point.name for point in control.points if point.name not in names)
    note = f"{again.note}; without {left}: with it the points contradict each other ({found.note})"
    return replace(again, note=note)


def _adjusted_to_all(
    structure: Structure, control: ControlPoints, free_principal_point: bool
) -> AdjustedToControl | None:
    """By all points that can be placed; not adjusted where they contradict each other then."""
    found = control_georeference(structure, control, trust=False)
    if found.best is None:
        return None
    world, before = found.best.world_from_model, found.best.rms_m
    taken = {residual.name for residual in found.best.residuals}
    points = [point for point in control.points if point.name in taken]
    places = np.array([point.place_m for point in points]) - found.origin_m
    there = transformed(structure, world.scale, world.rotation, world.shift)
    error_px = _error_px(there)
    marked = _with_survey(_with_marks(there, points), places, max(error_px, LEAST_SD_PX))
    try:
        solved = adjusted(
            marked, free_principal_point=free_principal_point, fixed=_survey_of(marked)
        )
    except NotFoundError as error:
        return _not_adjusted(structure, error.evidence)
    bent = _without_marks(solved, there)
    after_px = _error_px(bent)
    if after_px > MOST_WORSE * max(error_px, LEAST_SD_PX):
        why = f"the features' error would grow from {error_px:.2f} to {after_px:.2f} px"
        return _not_adjusted(structure, why)
    own = _back(bent, world)
    again = control_georeference(own, control, trust=False)
    if again.best is None or not again.accepted:
        return _not_adjusted(structure, again.why)
    after = again.best.rms_m
    note = (
        f"cameras and points were adjusted to {len(points)} control points: {before:.3f} m off"
        f" before, {after:.3f} m after; features {error_px:.2f} px before, {after_px:.2f} px after"
    )
    return AdjustedToControl(own, True, note)


def _not_adjusted(structure: Structure, why: str) -> AdjustedToControl:
    return AdjustedToControl(structure, False, f"not adjusted to control points: {why}")


def _error_px(structure: Structure) -> float:
    """Deviation of the features' errors along one axis, by the median: false ones do not count."""
    return float(np.median(errors_px(structure)) / np.sqrt(2.0 * np.log(2.0)))


def _with_marks(structure: Structure, points: list[ControlPoint]) -> Structure:
    """The structure with the control points as its last points, where they are marked."""
    row_of = {name: row for row, name in enumerate(structure.names)}
    keypoints = list(structure.keypoints_px)
    first = len(structure.points)
    rows, numbers, seen = [], [], []
    for number, point in enumerate(points):
        for name, pixel in point.seen:
            row = row_of.get(name)
            if row is None:
                continue
            rows.append(row)
            numbers.append(len(keypoints[row]))
            seen.append(first + number)
            keypoints[row] = np.vstack([keypoints[row], pixel])
    return replace(
        structure,
        keypoints_px=tuple(keypoints),
        points=np.vstack([structure.points, np.zeros((len(points), 3))]),
        colours=np.vstack([structure.colours, np.zeros((len(points), 3), np.uint8)]),
        image_of=np.concatenate([structure.image_of, rows]).astype(np.int64),
        keypoint_of=np.concatenate([structure.keypoint_of, numbers]).astype(np.int64),
        point_of=np.concatenate([structure.point_of, seen]).astype(np.int64),
    )


def _with_survey(structure: Structure, places: NDArray[np.float64], sd_px: float) -> Structure:
    """The structure with two photos more, that see the last points at (k, 3) where they are."""
    count = len(places)
    first = len(structure.points) - count
    middle = places.mean(axis=0)
    far = FAR * max(1.0, float(np.ptp(structure.points[:first], axis=0).max()))
    focal = sd_px / SURVEY_SD_M * far
    cameras, camera_of = dict(structure.cameras), dict(structure.camera_of)
    image_ids, poses, keypoints = list(structure.image_ids), list(structure.cam_from_world), []
    for look, along in zip(_LOOKS, (focal, _BLIND * focal), strict=True):
        number, image = max(cameras) + 1, max(image_ids) + 1
        cameras[number] = pycolmap.Camera(
            camera_id=number, model="PINHOLE", width=1, height=1, params=[along, focal, 0.0, 0.0]
        )
        camera_of[image] = number
        image_ids.append(image)
        pose = np.column_stack([look, [0.0, 0.0, far] - look @ middle])
        poses.append(pose)
        keypoints.append(cameras[number].img_from_cam(places @ pose[:, :3].T + pose[:, 3]))
    photos = len(structure.names)
    points = structure.points.copy()
    points[first:] = places
    return replace(
        structure,
        cameras=cameras,
        camera_of=camera_of,
        image_ids=tuple(image_ids),
        names=(*structure.names, "survey from above", "survey from the south"),
        cam_from_world=np.array(poses),
        keypoints_px=(*structure.keypoints_px, *keypoints),
        points=points,
        image_of=np.concatenate([structure.image_of, np.repeat([photos, photos + 1], count)]),
        keypoint_of=np.concatenate([structure.keypoint_of, np.tile(np.arange(count), 2)]),
        point_of=np.concatenate([structure.point_of, np.tile(first + np.arange(count), 2)]),
    )


def _survey_of(structure: Structure) -> tuple[int, int]:
    """The ids of the two photos that are none."""
    return structure.image_ids[-2], structure.image_ids[-1]


def _without_marks(solved: Structure, before: Structure) -> Structure:
    """What was found of the photos and the points of `before`."""
    return replace(
        before,
        cameras={number: solved.cameras[number] for number in before.cameras},
        cam_from_world=solved.cam_from_world[: len(before.names)],
        points=solved.points[: len(before.points)],
    )


def _back(structure: Structure, world: Similarity) -> Structure:
    """From the world to the frame that `world` is of."""
    turn = world.rotation.T
    return transformed(structure, 1.0 / world.scale, turn, -turn @ world.shift / world.scale)
