"""Photos of a rig are mapped again, with the rig, once the first map has told how it is built.

With a rig a photo is placed by all that its frame sees: one that shows a blank wall has its place
from the others. What a file says of the rig is taken as it is, and the first map is not asked.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from veduta.photos.intake.read import PhotoRecord
from veduta.photos.intake.rig import RigFile
from veduta.photos.mapping.growing import RigKind
from veduta.photos.mapping.panorama_rigs import panorama_rigs
from veduta.photos.mapping.rig_database import write_rig_database
from veduta.photos.mapping.rig_poses import RigPoses, found_poses, with_views
from veduta.photos.mapping.settling import Settled, map_settled
from veduta.photos.options import PhotosOptions
from veduta.photos.stages import Stages
from veduta.photos.structure import structure_of
from veduta.run.outputs import writing_to
from veduta.run.progress import StepProgress


@dataclass(frozen=True)
class RigTold:
    """What is known of the rig. poses: None where the photos tell nothing of it.

    alone, together: photos placed without the rig, and with it. cameras: those of which there are
    photos that can be used; of fewer than two no rig is made.
    """

    poses: RigPoses | None
    alone: int
    together: int
    cameras: tuple[str, ...]

    @property
    def known(self) -> tuple[str, ...]:
        """Those of the cameras whose poses are known."""
        unknown = () if self.poses is None else self.poses.unknown
        return () if self.poses is None else tuple({*self.cameras} - {*unknown})

    @property
    def held(self) -> bool:
        """Whether the poses were given."""
        return self.poses is not None and self.poses.held


def cameras_of(photos: Sequence[PhotoRecord]) -> tuple[str, ...]:
    """The rig's cameras that photos were taken with, by name; that of panoramas is one."""
    mounted = [(photo.mount.camera, photo.view) for photo in photos if photo.mount is not None]
    return tuple(sorted({name if view is None else view.body for name, view in mounted}))


def given_poses(file: RigFile | None, photos: Sequence[PhotoRecord]) -> RigPoses | None:
    """What the file of the call says of cameras with photos; of one all may be set aside."""
    if file is None:
        return None
    poses = {name: file.cam_from_rig[name] for name in cameras_of(photos)}  # of folders
    told = RigPoses(poses, held=True, frames=dict.fromkeys(poses, 0))
    return with_views(told, photos)


def mapped_with_rig(
    alone: Settled,
    photos: Sequence[PhotoRecord],
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
) -> tuple[Settled, RigTold | None]:
    """The components with the rig in them, and what is known of it; as they are without one.

    alone: mapped without the rig, but with the panoramas that are part of it.
    """
    if not options.camera.rig:
        return alone, None
    before, cameras = _placed(alone), cameras_of(photos)
    poses = given_poses(stages.call.rig, photos)
    if poses is None and alone.mapped.models:
        names = {photo.image_id: photo.name for photo in photos}
        poses = found_poses(structure_of(alone.mapped.models[0], names), photos)
    if poses is None or len(_bodies(poses, photos)) < 2:
        return alone, RigTold(None, before, before, cameras)
    kind: RigKind = "held" if poses.held else "adjusted"
    database = stages.rig_database()
    with writing_to(stages.out):
        if not database.exists():
            write_rig_database(stages.database(), photos, [poses], database)
        ids = [photo.image_id for photo in photos]
        work = database.with_suffix(".mapping")
        seed = options.random.seed
        # Also with the pairs that were doubted: a map that knows the rig is the better witness.
        together = map_settled(database, work, ids, seed, progress, "incremental", kind)
    return together, RigTold(poses, before, _placed(together), cameras)


def map_with_panoramas(
    photos: Sequence[PhotoRecord],
    options: PhotosOptions,
    stages: Stages,
    progress: StepProgress,
) -> Settled | None:
    """The components with each panorama as a rig of its views; None where there are none.

    Mapping all at once knows no such rigs.
    """
    rigs = panorama_rigs(photos)
    if not rigs or options.map.mapping == "global":
        return None
    database = stages.panorama_database()
    with writing_to(stages.out):
        if not database.exists():
            write_rig_database(stages.database(), photos, rigs, database)
        work, seed = database.with_suffix(".mapping"), options.random.seed
        ids = [photo.image_id for photo in photos]
        return map_settled(database, work, ids, seed, progress, "incremental", "held")


def _bodies(poses: RigPoses, photos: Sequence[PhotoRecord]) -> tuple[str, ...]:
    """The cameras whose poses are known; that of panoramas is one."""
    known = poses.cam_from_rig
    return cameras_of([one for one in photos if one.mount and one.mount.camera in known])


def _placed(settled: Settled) -> int:
    return sum(model.num_reg_images() for model in settled.mapped.models)
