"""The arguments of `veduta photos`: the folder, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Jobs, Out, Quiet
from veduta.photos.intake.given import Given
from veduta.photos.options import (
    CameraOptions,
    MapOptions,
    MatchOptions,
    ModelOptions,
    PhotosOptions,
    RandomOptions,
    TextureOptions,
    VideoOptions,
    WallOptions,
)

Photos = Annotated[
    tyro.conf.Positional[Path | None],
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="folder of photos of one place (JPEG, PNG, TIFF, WebP); may be left out with --video",
    ),
]
Masks = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="folder of masks: hall.png or hall.jpg.png for hall.jpg; nothing is looked for where"
        " they are black",
    ),
]
Film = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FILE",
        help_behavior_hint="",
        help="film whose sharpest frames are photos, too (MP4, MOV, AVI, MKV, WebM)",
    ),
]
Model = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="COLMAP model of the photos (binary or text) to take in place of matching and mapping",
    ),
]


@dataclass(frozen=True)
class PhotosCall:
    """Find where photos of a place were taken, with which lens, and the points that they show.

    The cameras and points are in OUT/sparse (COLMAP), OUT/points.ply and OUT/place.json, in metres
    of the world where a city model, ground control points or GPS say where they lie; the walls are
    in OUT/walls.json and OUT/walls.

    Exit codes: 0 done (photos left out are named), 2 bad use or input, 3 no photos hang
    together, 1 a bug.
    """

    photos: Photos = None
    out: Out = field(kw_only=True)
    masks: Masks = None
    video: Film = None
    from_colmap: Model = None
    match: MatchOptions = field(default_factory=MatchOptions)
    map: MapOptions = field(default_factory=MapOptions)
    camera: CameraOptions = field(default_factory=CameraOptions)
    frames: VideoOptions = field(default_factory=VideoOptions)
    walls: WallOptions = field(default_factory=WallOptions)
    world: ModelOptions = field(default_factory=ModelOptions)
    texture: TextureOptions = field(default_factory=TextureOptions)
    random: RandomOptions = field(default_factory=RandomOptions)
    force: Force = False
    jobs: Jobs = None
    quiet: Quiet = False

    def options(self) -> PhotosOptions:
        """What changes the result."""
        return PhotosOptions(
            match=self.match,
            map=self.map,
            camera=self.camera,
            video=self.frames,
            walls=self.walls,
            world=self.world,
            texture=self.texture,
            random=self.random,
        )

    def given(self) -> Given:
        """What is given beside the photos."""
        named = (self.world.model, self.world.gcp, self.world.positions)
        others = tuple(path for path in named if path is not None)
        return Given(self.masks, self.video, self.from_colmap, others)
