"""The engine's database with a rig in it: photos of one frame then have one pose."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path

import pycolmap

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.mapping.rig_poses import RigPoses
from veduta.photos.rigged import rig_of
from veduta.run.atomic import atomic_write


def frames_of(photos: Sequence[PhotoRecord], cameras: Sequence[str]) -> dict[int, int]:
    """The frame of each photo of these cameras of a rig: the least image id of those in it."""
    first: dict[str, int] = {}
    found: dict[int, int] = {}
    for photo in sorted(photos, key=lambda one: one.image_id):
        if photo.mount is not None and photo.mount.camera in cameras:
            found[photo.image_id] = first.setdefault(photo.mount.frame, photo.image_id)
    return found


def write_rig_database(
    database: Path, photos: Sequence[PhotoRecord], rigs: Sequence[RigPoses], target: Path
) -> None:
    """A copy of a database whose photos are in frames of rigs, where the poses are known."""
    frames = [frames_of(photos, list(one.cam_from_rig)) for one in rigs]
    frame_of = {image: number for own in frames for image, number in own.items()}
    with atomic_write(target) as temporary:
        shutil.copyfile(database, temporary)
        with pycolmap.Database.open(temporary) as opened:
            images = {image.image_id: image for image in opened.read_all_images()}
            camera_of = {
                photo.mount.camera: images[photo.image_id].camera_id
                for photo in photos
                if photo.mount is not None and photo.image_id in frame_of
            }
            alone = [image for image in images if image not in frame_of]
            kept = [opened.read_frame(image) for image in alone]
            single = {frame.rig_id: opened.read_rig(frame.rig_id) for frame in kept}
            opened.clear_frames()
            opened.clear_rigs()
            for rig in single.values():
                opened.write_rig(rig, use_rig_id=True)
            for frame in kept:
                opened.write_frame(frame, use_frame_id=True)
            first = {images[photo.image_id].camera_id for photo in photos if photo.view is not None}
            for one, own in zip(rigs, frames, strict=True):
                known = {camera_of[name]: pose for name, pose in one.cam_from_rig.items()}
                order = sorted(known, key=lambda camera: (camera not in first, camera))
                rig = rig_of(min(known), {camera: known[camera] for camera in order})
                number = opened.write_rig(rig, use_rig_id=True)
                _write_frames(opened, images, own, int(number))


def _write_frames(
    opened: pycolmap.Database,
    images: Mapping[int, pycolmap.Image],
    frame_of: Mapping[int, int],
    rig: int,
) -> None:
    members: dict[int, list[int]] = {}
    for image, number in frame_of.items():
        members.setdefault(number, []).append(image)
    for number, own in sorted(members.items()):
        frame = pycolmap.Frame(frame_id=number, rig_id=rig)
        for image in own:
            frame.add_data_id(images[image].data_id)
        opened.write_frame(frame, use_frame_id=True)
