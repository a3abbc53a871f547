"""The arguments of `veduta carve`: the record, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cameras import ScaleOptions, SheetName
from veduta.carve.options import (
    CarveOptions,
    ColourOptions,
    PoseOptions,
    SilhouetteOptions,
    TextureOptions,
    VolumeOptions,
)
from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.run.card import DeviceOptions

Record = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="folder of photos with their cameras, and of masks where there are some",
    ),
]


@dataclass(frozen=True)
class BoardCall:
    """Print a board of markers, to lay under an object that is photographed.

    It is a PDF at its true size. `veduta carve DIR -o OUT --board a4` takes photos that show it.
    """

    print_board: Annotated[
        Path, tyro.conf.arg(metavar="FILE.pdf", help_behavior_hint="", help="where it is written")
    ]
    board: Annotated[SheetName, tyro.conf.arg(help="the sheet's size")] = "a4"


@dataclass(frozen=True)
class CarveCall:
    """Carve an object out of photos with its silhouettes.

    The object is in OUT/object.glb and OUT/object.ply, closed and coloured, and OUT/place.json has
    it with the cameras around it, for `veduta view`.

    `veduta carve --print-board board.pdf` prints a board of markers that gives photos cameras.

    Exit codes: 0 done, 2 bad use or input, 3 there is no object, 1 a bug.
    """

    record: Record
    out: Out
    poses: PoseOptions = field(default_factory=PoseOptions)
    silhouettes: SilhouetteOptions = field(default_factory=SilhouetteOptions)
    volume: VolumeOptions = field(default_factory=VolumeOptions)
    colour: ColourOptions = field(default_factory=ColourOptions)
    texture: TextureOptions = field(default_factory=TextureOptions)
    scale: ScaleOptions = field(default_factory=ScaleOptions)
    device: DeviceOptions = field(default_factory=DeviceOptions)
    force: Force = False
    quiet: Quiet = False

    def options(self) -> CarveOptions:
        """What changes the result."""
        return CarveOptions(
            poses=self.poses,
            silhouettes=self.silhouettes,
            volume=self.volume,
            colour=self.colour,
            texture=self.texture,
            scale=self.scale,
            device=self.device,
        )
