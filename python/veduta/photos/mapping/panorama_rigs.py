"""Panoramas as rigs of the views that were cut out of them: their places to each other are known.

No view has a place of its own: a panorama is placed by all that it sees, to all sides at once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from veduta.photos.intake.panoramas import cam_from_panorama
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.intake.source import View
from veduta.photos.mapping.rig_poses import Floats, RigPoses
from veduta.photos.rigged import after, between, mean_pose
from veduta.photos.structure import Structure


def views_among(photos: Sequence[PhotoRecord]) -> dict[int, View]:
    """By image id, what was cut out of panoramas."""
    return {photo.image_id: photo.view for photo in photos if photo.view is not None}


def panorama_rigs(photos: Sequence[PhotoRecord]) -> list[RigPoses]:
    """A rig for each camera of panoramas, which has its views for cameras."""
    rigs: dict[str, dict[str, Floats]] = {}
    for photo in photos:
        if photo.view is not None and photo.mount is not None:
            own = rigs.setdefault(photo.view.body, {})
            own[photo.mount.camera] = cam_from_panorama(photo.view.number)
    return [
        RigPoses(dict(sorted(poses.items())), held=True, frames=dict.fromkeys(poses, 0))
        for _, poses in sorted(rigs.items())
        if len(poses) > 1
    ]


def snapped(structure: Structure) -> Structure:
    """The same with the views of each panorama in one place again, turned as they were cut.

    Mapping moves them where they are on a rig with other cameras, which the engine adjusts whole.
    """
    views = _views_by_frame(structure)
    if not views:
        return structure
    poses = structure.cam_from_world.copy()
    for rows in views.values():
        each = [
            after(between(cam_from_panorama(number), np.eye(3, 4)), poses[row])
            for row, number in rows.items()
        ]
        whole = mean_pose(np.array(each))
        for row, number in rows.items():
            poses[row] = after(cam_from_panorama(number), whole)
    return replace(structure, cam_from_world=poses)


def _views_by_frame(structure: Structure) -> Mapping[tuple[str, int], dict[int, int]]:
    """The number of each view, by its row, for each panorama: its body and its frame."""
    found: dict[tuple[str, int], dict[int, int]] = {}
    for row, image in enumerate(structure.image_ids):
        if image in structure.views and image in structure.frame_of:
            view = structure.views[image]
            found.setdefault((view.body, structure.frame_of[image]), {})[row] = view.number
    return found
