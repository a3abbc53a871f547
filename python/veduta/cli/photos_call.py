"""The arguments of `veduta photos`: the folder, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Jobs, Out, Quiet
from veduta.photos.options import CameraOptions, MatchOptions, PhotosOptions, RandomOptions

Photos = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="folder of photos of one place (JPEG, PNG, TIFF, WebP)",
    ),
]


@dataclass(frozen=True)
class PhotosCall:
    """Find where photos of a place were taken, with which lens, and the points that they show.

    The cameras and points are in OUT/sparse (COLMAP), OUT/points.ply and OUT/place.json.

    Exit codes: 0 done (photos left out are named), 2 bad use or input, 3 no photos hang
    together, 1 a bug.
    """

    photos: Photos
    out: Out
    match: MatchOptions = field(default_factory=MatchOptions)
    camera: CameraOptions = field(default_factory=CameraOptions)
    random: RandomOptions = field(default_factory=RandomOptions)
    force: Force = False
    jobs: Jobs = None
    quiet: Quiet = False

    def options(self) -> PhotosOptions:
        """What changes the result."""
        return PhotosOptions(match=self.match, camera=self.camera, random=self.random)
