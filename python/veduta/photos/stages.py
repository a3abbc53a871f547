"""What a run has finished so far, in OUT/.veduta/photos, so that a killed one goes on from there.

Each file is named after its step and the key of what it depends on, and appears whole. Nothing is
kept once the run is finished.
"""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import JsonValue

from veduta.photos.intake.call import Call
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.intake.video import Video
from veduta.photos.options import PhotosOptions
from veduta.run.digests import result_key
from veduta.run.outputs import writing_to
from veduta.run.record import PRIVATE

VERSION = "18"
"""Raised when any step changes its result: no older result is then taken for a new one's."""
COMMAND = "photos"
FOLDER = f"{PRIVATE}/photos"


@dataclass(frozen=True)
class Stages:
    """The places of what the steps leave to later ones."""

    out: Path
    call: Call
    options: PhotosOptions

    @property
    def folder(self) -> Path:
        """Where all of it lies."""
        return self.out / FOLDER

    def open(self) -> None:
        """Make the folder."""
        with writing_to(self.out):
            self.folder.mkdir(parents=True, exist_ok=True)

    def frames(self, video: Video) -> Path:
        """The frames that were taken from a film."""
        key = result_key("video", VERSION, self.options.video, [video.name, video.sha256])
        return self.folder / f"frames-{key[:24]}"

    def views(self, panoramas: Sequence[tuple[str, str, str | None]]) -> Path:
        """The views that panoramas were cut into, by their names, digests, and those of masks."""
        told: list[JsonValue] = [list(one) for one in panoramas]
        key = result_key("panoramas", VERSION, self.options.camera, told)
        return self.folder / f"views-{key[:24]}"

    def features(self, photo: PhotoRecord) -> Path:
        """The features of a photo."""
        key = result_key("features", VERSION, self.options.match, [photo.sha256, photo.mask_sha256])
        return self.folder / f"features-{key[:24]}.npz"

    def database(self) -> Path:
        """The engine's database with features and matches of all photos."""
        photos: list[JsonValue] = [
            [source.name, source.sha256, source.mask_sha256] for source in self.call.sources
        ]
        camera = self.options.camera
        fisheye = camera.lens == "fisheye"
        told: list[JsonValue] = [photos, self.options.random.seed, camera.cameras, fisheye]
        told.append(camera.focal_px)
        if camera.rig:
            told.append(None if self.call.rig is None else self.call.rig.sha256)
        key = result_key("match", VERSION, self.options.match, told)
        return self.folder / f"matches-{key[:24]}.db"

    def mapping(self) -> Path:
        """Components that are mapped, pairs that are doubted, and snapshots."""
        kind = self.options.map.mapping
        return self.database().with_suffix(f".{kind}.mapping")

    def rig_database(self) -> Path:
        """The engine's database with the rig in it, as the map before it told."""
        return self.database().with_suffix(".rig.db")

    def panorama_database(self) -> Path:
        """The engine's database with each panorama as a rig of its views."""
        return self.database().with_suffix(".panoramas.db")

    def shared_database(self) -> Path:
        """The same for photos that are taken to be of one camera."""
        return self.database().with_suffix(".shared.db")

    def drop(self) -> None:
        """The run is finished: none of it is needed any more."""
        shutil.rmtree(self.folder, ignore_errors=True)
