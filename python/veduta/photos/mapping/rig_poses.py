"""How the cameras of a rig are fixed to each other, as a map tells that knows of no rig.

Each frame of which two cameras are placed in one component says it once. The middle one of what
they say is taken (the one that the others are nearest to), and the mean of those that agree with
it: photos that were placed falsely then do not count.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from veduta.photos.intake.panoramas import cam_from_panorama
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.rigged import after, between, mean_pose
from veduta.photos.structure import Structure

FEWEST_FRAMES = 3
"""Frames that must agree: of two nobody knows which is wrong."""
MOST_TURN_DEG = 2.0
"""Up to which two frames agree in how the cameras are turned against each other."""
MOST_SHIFT = 0.02
"""And in where they are, as a share of the distance to what they see."""

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class RigPoses:
    """cam_from_rig: (3, 4) by the name of the camera. held: given, and not to be adjusted.

    frames: by the name of the camera, of how many frames its pose was found; 0 where given.
    unknown: cameras whose pose nothing tells.
    """

    cam_from_rig: Mapping[str, Floats]
    held: bool
    frames: Mapping[str, int]
    unknown: tuple[str, ...] = ()


def found_poses(structure: Structure, photos: Sequence[PhotoRecord]) -> RigPoses:
    """Of the cameras that frames of a component tie to each other; its unit of length is theirs.

    Cameras that are placed as often, and pairs with as many frames, go by the names of their
    folders: where those are renamed, another camera may be the one that the others hang on.
    """
    placed = _placed(structure, photos)
    first = max(placed, key=lambda camera: (len(placed[camera]), camera))
    told = RigPoses({first: np.eye(3, 4)}, held=False, frames={first: len(placed[first])})
    told = with_views(told, photos)
    reach = MOST_SHIFT * _depth(structure)
    while (tie := _strongest_tie(structure, placed, told.cam_from_rig, reach)) is not None:
        camera, pose, count = tie
        known = {**told.cam_from_rig, camera: pose}
        told = with_views(
            replace(told, cam_from_rig=known, frames={**told.frames, camera: count}), photos
        )
    return replace(told, unknown=_unknown(told, photos))


def _unknown(told: RigPoses, photos: Sequence[PhotoRecord]) -> tuple[str, ...]:
    """The cameras that nothing ties to the others; that of panoramas is one."""
    return tuple(
        sorted(
            {
                photo.mount.camera if photo.view is None else photo.view.body
                for photo in photos
                if photo.mount is not None and photo.mount.camera not in told.cam_from_rig
            }
        )
    )


def with_views(poses: RigPoses, photos: Sequence[PhotoRecord]) -> RigPoses:
    """The same with all views of the panoramas that one of their views, or their folder, places."""
    cameras = {
        photo.mount.camera: photo.view
        for photo in photos
        if photo.view is not None and photo.mount is not None
    }
    known, frames = dict(poses.cam_from_rig), dict(poses.frames)
    for body in sorted({view.body for view in cameras.values()}):
        of_body = {name: one.number for name, one in sorted(cameras.items()) if one.body == body}
        told = next((name for name in of_body if name in known), body)
        if told not in known:
            continue
        own = cam_from_panorama(of_body.get(told, 0))
        body_from_rig = after(between(own, np.eye(3, 4)), known[told])
        known.pop(body, None)
        count = frames.pop(body, frames.get(told, 0))
        for name, number in of_body.items():
            known[name] = after(cam_from_panorama(number), body_from_rig)
            frames[name] = count
    return replace(poses, cam_from_rig=known, frames=frames)


def _placed(structure: Structure, photos: Sequence[PhotoRecord]) -> dict[str, dict[str, int]]:
    """Of each camera the row of each frame in which it is placed."""
    row_of = {image: row for row, image in enumerate(structure.image_ids)}
    placed: dict[str, dict[str, int]] = {}
    for photo in photos:
        if photo.mount is not None:
            own = placed.setdefault(photo.mount.camera, {})
            if photo.image_id in row_of:
                own[photo.mount.frame] = row_of[photo.image_id]
    return placed


def _strongest_tie(
    structure: Structure,
    placed: Mapping[str, Mapping[str, int]],
    known: Mapping[str, Floats],
    reach: float,
) -> tuple[str, Floats, int] | None:
    """One more camera, its pose, and how many frames agree in it; None where no more is tied."""
    poses = structure.cam_from_world
    shared = {
        (camera, other): sorted(placed[camera].keys() & placed[other].keys())
        for camera in known
        for other in placed.keys() - known.keys()
    }
    for camera, other in sorted(shared, key=lambda pair: (-len(shared[pair]), pair)):
        frames = shared[camera, other]
        if len(frames) < FEWEST_FRAMES:
            break
        each = [
            between(poses[placed[camera][frame]], poses[placed[other][frame]]) for frame in frames
        ]
        found = agreed(np.array(each), reach)
        if found is not None:
            return other, after(found[0], known[camera]), found[1]
    return None


def agreed(each: Floats, reach: float) -> tuple[Floats, int] | None:
    """The pose that most of (n, 3, 4) agree in, and how many do; None where too few do.

    reach: up to which two places agree.
    """
    turns = _angles_deg(each[:, :, :3])
    centres = -np.einsum("nji,nj->ni", each[:, :, :3], each[:, :, 3])
    shifts = np.linalg.norm(centres[:, None] - centres[None], axis=-1)
    near = (turns <= MOST_TURN_DEG) & (shifts <= reach)
    votes = near.sum(axis=1)
    apart = np.where(near, turns / MOST_TURN_DEG + shifts / max(reach, 1e-12), 0.0).sum(axis=1)
    middle = int(np.lexsort((apart / votes, -votes))[0])
    kept = near[middle]
    if votes[middle] < max(FEWEST_FRAMES, 0.5 * len(each)):
        return None
    return mean_pose(each[kept]), int(votes[middle])


def _angles_deg(rotations: Floats) -> Floats:
    """(n, n) angles between (n, 3, 3) rotations."""
    traces = np.einsum("aij,bij->ab", rotations, rotations)
    return np.asarray(np.rad2deg(np.arccos(np.clip((traces - 1.0) / 2.0, -1.0, 1.0))))


def _depth(structure: Structure) -> float:
    """Median distance of what is seen from where it is seen."""
    rays = structure.points[structure.point_of] - structure.centres()[structure.image_of]
    return float(np.median(np.linalg.norm(rays, axis=1)))
