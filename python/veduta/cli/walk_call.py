"""The arguments of `veduta walk`: the folder, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.walk.options import (
    BoardOptions,
    MorphOptions,
    PhotoOptions,
    PlayOptions,
    TakeOptions,
    WalkOptions,
)

Folder = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help=(
            "folder with left/ and right/, image_2/ and image_3/, or image_l/ and image_r/, and the"
            " calibration of the two cameras; or an edited walk.json, from which it is built again"
        ),
    ),
]
Calibration = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="FILE",
        help_behavior_hint="",
        help="walk.toml, OpenCV YAML, Middlebury's or KITTI's calib.txt; if not given, that in DIR",
    ),
]
Boards = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="pictures of a board by both cameras (left/ and right/), by which they are calibrated",
    ),
]
Cameras = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="PATH",
        help_behavior_hint="",
        help="cameras of the frames in DIR, which a single camera took along a path: a result of"
        " veduta photos, a COLMAP model, or another that veduta reads",
    ),
]


@dataclass(frozen=True)
class WalkCall:
    """Turn stereo views along a path into a walk that morphs from view to view.

    The way and how good each of its transitions is are in OUT/walk.json, what the browser shows in
    OUT/place.json and OUT/walk/.

    Exit codes: 0 done, 2 bad use or input, 3 there is no walk in the pictures, 1 a bug.
    """

    folder: Folder
    out: Out
    calibration: Calibration = None
    calibrate: Boards = None
    cameras: Cameras = None
    take: TakeOptions = field(default_factory=TakeOptions)
    morph: MorphOptions = field(default_factory=MorphOptions)
    play: PlayOptions = field(default_factory=PlayOptions)
    board: BoardOptions = field(default_factory=BoardOptions)
    photo: PhotoOptions = field(default_factory=PhotoOptions)
    force: Force = False
    quiet: Quiet = False

    def options(self) -> WalkOptions:
        """What changes the result."""
        return WalkOptions(
            take=self.take, morph=self.morph, play=self.play, board=self.board, photo=self.photo
        )
