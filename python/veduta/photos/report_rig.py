"""What the report says of a rig: how its cameras are fixed to each other, and what it placed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.mapping.rig_poses import FEWEST_FRAMES
from veduta.photos.mapping.rigs import RigTold
from veduta.photos.rigged import rigs_among
from veduta.photos.structure import Structure
from veduta.run.page import Table
from veduta.run.report import counted

_NOTE = (
    "From the first camera, in its own axes and in the unit of the result. All frames have the"
    " same, which was {}."
)


_PANORAMAS = (
    "{} are in the result as {} views each, which are pinhole photos from one place: sparse/,"
    " place.json and textures know no lens that shows all around. Where the panoramas themselves"
    " stand, and how they are turned, is in panoramas.json"
)


def rig_measures(rig: RigTold | None) -> dict[str, Any]:
    """The rig in numbers; nothing where there is none."""
    if rig is None:
        return {}
    known = [] if rig.poses is None else sorted(rig.known)
    return {
        "rig_cameras": known,
        "rig_given": rig.held,
        "placed_without_rig": rig.alone,
        "placed_with_rig": rig.together,
    }


def panorama_measures(placed: Sequence[Structure]) -> dict[str, Any]:
    """How many panoramas are placed; nothing where there are none.

    placed: of each component.
    """
    views = {one.views[i].panorama for one in placed for i in one.image_ids if i in one.views}
    return {"panoramas": len(views)} if views else {}


def panorama_notes(photos: Sequence[PhotoRecord]) -> list[str]:
    """What the files of the result hold of panoramas, and what they do not."""
    views = [photo.view for photo in photos if photo.view is not None]
    if not views:
        return []
    names = {view.panorama for view in views}
    return [
        _PANORAMAS.format(counted(len(names), "panorama"), len({view.number for view in views}))
    ]


def rig_alarms(rig: RigTold | None) -> list[str]:
    """What has to be said at the terminal."""
    if rig is None:
        return []
    if len(rig.cameras) < 2:
        return [
            f"only of {''.join(rig.cameras) or 'none'} of the rig's cameras there are photos that"
            " can be used, so there is no rig: each photo is placed for itself"
        ]
    if rig.poses is None:
        return [
            "nothing tells how the cameras of the rig are fixed to each other, as fewer than"
            f" {FEWEST_FRAMES} frames have two of them in one component that agree: each photo is"
            " placed for itself. A file rig.json in DIR can say it"
        ]
    alarms = [
        f"the camera {name} of the rig is free: fewer than {FEWEST_FRAMES} frames have it in one"
        " component with another, and agree"
        for name in rig.poses.unknown
    ]
    if rig.together < rig.alone:
        alarms.append(
            f"with the rig {rig.together} photos are placed, without it {rig.alone}: it may have"
            " been bent, or photos of one frame may not be of one moment"
        )
    return alarms


def rig_table(
    rig: RigTold | None, structure: Structure, photos: Sequence[PhotoRecord]
) -> list[Table]:
    """Where the cameras are on the rig, in the unit of the result."""
    if rig is None or rig.poses is None:
        return []
    poses = dict(zip(structure.image_ids, structure.cam_from_world, strict=True))
    found = rigs_among(poses, structure.camera_of, structure.frame_of)
    if not found:
        return []
    camera_of = {
        structure.camera_of[photo.image_id]: photo.mount.camera
        if photo.view is None
        else f"{photo.view.body} (panorama)"
        for photo in photos
        if photo.mount is not None and photo.image_id in poses
    }
    rows: list[tuple[str, int, float, float, float, float]] = []
    for camera, pose in found[0].cam_from_rig.items():
        if camera_of.get(camera) in [row[0] for row in rows]:
            continue  # views of one panorama, of which the first stands for all
        right, down, ahead = (-pose[:, :3].T @ pose[:, 3]).tolist()
        turn = np.rad2deg(np.arccos(np.clip((np.trace(pose[:, :3]) - 1.0) / 2.0, -1.0, 1.0)))
        frames = sum(
            structure.camera_of[image] == camera
            for members in found[0].frames.values()
            for image in members
        )
        rows.append(
            (
                camera_of.get(camera, str(camera)),
                frames,
                round(right, 4),
                round(down, 4),
                round(ahead, 4),
                round(float(turn), 3),
            )
        )
    heads = ("camera", "frames", "right", "down", "ahead", "turned (°)")
    how = "given" if rig.held else "adjusted with the photos"
    return [Table("The rig", heads, rows, note=_NOTE.format(how))]
