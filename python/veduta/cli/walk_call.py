"""The arguments of `veduta walk`: the folder, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.walk.options import MorphOptions, PlayOptions, TakeOptions, WalkOptions

Folder = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help=(
            "folder with left/ and right/, image_2/ and image_3/, or image_l/ and image_r/, and the"
            " calibration of the two cameras"
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
    take: TakeOptions = field(default_factory=TakeOptions)
    morph: MorphOptions = field(default_factory=MorphOptions)
    play: PlayOptions = field(default_factory=PlayOptions)
    force: Force = False
    quiet: Quiet = False

    def options(self) -> WalkOptions:
        """What changes the result."""
        return WalkOptions(take=self.take, morph=self.morph, play=self.play)
