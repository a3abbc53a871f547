"""The arguments of `veduta drive`: the log, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.drive.options import (
    ColumnOptions,
    DriveOptions,
    MeshOptions,
    OtherOptions,
    TextureOptions,
)

Log = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="LOG",
        help_behavior_hint="",
        help=(
            "folder of a drive: with a drive.toml, in a layout of KITTI (odometry or raw), or of"
            " scans (PCD, LAS, LAZ)"
        ),
    ),
]
Document = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="JSON",
        help_behavior_hint="",
        help="an edited drive.json of this log: its path and segments are taken",
    ),
]
Seed = Annotated[int, tyro.conf.arg(metavar="INT", help="seed of what is drawn at random")]


@dataclass(frozen=True)
class DriveCall:
    """Turn a street drive with laser scans and images into textured facades.

    Cars, trees and all else that stands before the facades is taken out, the holes are filled, and
    what is invented is marked. `veduta drive start LOG -o HTML` writes a page on which one clicks
    where the drive begins. OUT/place.json is what `veduta view` shows; OUT/points.laz has the
    scan points with their classes; OUT/drive.json the path and its segments.

    Exit codes: 0 done, 2 bad use or input, 3 there is no facade, 1 a bug.
    """

    log: Log
    out: Out
    columns: ColumnOptions = field(default_factory=ColumnOptions)
    others: OtherOptions = field(default_factory=OtherOptions)
    mesh: MeshOptions = field(default_factory=MeshOptions)
    texture: TextureOptions = field(default_factory=TextureOptions)
    document: Document = None
    seed: Seed = 1
    force: Force = False
    quiet: Quiet = False

    def options(self) -> DriveOptions:
        """What changes the result."""
        return DriveOptions(
            columns=self.columns,
            others=self.others,
            mesh=self.mesh,
            texture=self.texture,
            seed=self.seed,
        )
