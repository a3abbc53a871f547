"""Photos that say nothing of their cameras, mapped again as if one camera had taken them.

Two photos of one size may come from two cameras, so each gets its own where EXIF is silent. Where a
camera moves ahead, a focal length of each photo's own cannot be told from where it stands, and
nothing hangs together; with one for all it can: 704 px where 707 are true, on twelve frames of a
drive that began with 1471.
"""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pycolmap

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.mapping.mapping import SMALLEST
from veduta.photos.mapping.settling import Settled, map_settled
from veduta.photos.options import PhotosOptions
from veduta.photos.stages import Stages
from veduta.run.atomic import atomic_write
from veduta.run.outputs import writing_to
from veduta.run.progress import StepProgress

TOLD = (
    "with a camera for each photo nothing hung together: photos of one size were taken to be of one"
    " camera (--cameras per-photo if they are not)"
)


def mapped_as_of_one_camera(
    alone: Settled,
    photos: Sequence[PhotoRecord],
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
) -> tuple[Settled, bool]:
    """The components with shared cameras, and True; as they are where that is not called for.

    alone: mapped with a camera for each photo that says nothing of its own.
    """
    unknown = Counter(photo.group for photo in photos if not photo.one_camera)
    grown, several = bool(alone.mapped.models), max(unknown.values(), default=0) >= SMALLEST
    if grown or not several or options.camera.cameras != "auto":
        return alone, False
    database = stages.shared_database()
    with writing_to(stages.out):
        if not database.exists():
            write_shared_database(stages.database(), photos, database)
        ids = [photo.image_id for photo in photos]
        work = database.with_suffix(".mapping")
        kind = options.map.mapping
        together = map_settled(database, work, ids, options.random.seed, progress, kind)
    return together, bool(together.mapped.models)


def write_shared_database(database: Path, photos: Sequence[PhotoRecord], target: Path) -> None:
    """A copy of a database in which all photos of a group have the camera of its first."""
    first: dict[int, int] = {}
    for photo in sorted(photos, key=lambda one: one.image_id):
        first.setdefault(photo.group, photo.image_id)
    group_of = {photo.image_id: photo.group for photo in photos}
    with atomic_write(target) as temporary:
        shutil.copyfile(database, temporary)
        with pycolmap.Database.open(temporary) as opened:
            images = {image.image_id: image for image in opened.read_all_images()}
            camera_of = {group: images[number].camera_id for group, number in first.items()}
            opened.clear_frames()
            opened.clear_rigs()
            for camera in sorted({*camera_of.values()}):
                rig = pycolmap.Rig(rig_id=camera)
                rig.add_ref_sensor(opened.read_camera(camera).sensor_id)
                opened.write_rig(rig, use_rig_id=True)
            for number, image in sorted(images.items()):
                image.camera_id = camera_of[group_of[number]]
                frame = pycolmap.Frame(frame_id=number, rig_id=image.camera_id)
                frame.add_data_id(image.data_id)
                opened.write_frame(frame, use_frame_id=True)
                opened.update_image(image)
