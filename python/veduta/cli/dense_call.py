"""The arguments of `veduta dense`: the cameras, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cameras import ScaleOptions
from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.dense.options import (
    DenseOptions,
    DepthOptions,
    FormatOptions,
    ModelOptions,
    RandomOptions,
    SurfaceOptions,
    ViewOptions,
)
from veduta.run.card import DeviceOptions

Cameras = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="CAMERAS",
        help="a result of `veduta photos`, or another set of cameras with its photos",
    ),
]
Images = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="folder of the photos, where they do not lie beside the cameras",
    ),
]


@dataclass(frozen=True)
class DenseCall:
    """Find the depths of calibrated photos, and make a cloud and a mesh of them.

    OUT/depth has the depth maps, OUT/cloud.ply and OUT/cloud.laz the points, OUT/place.json the
    place with the mesh.

    Exit codes: 0 done (photos left out are named), 2 bad use or input, 3 no depths are found,
    1 a bug.
    """

    cameras: Cameras
    out: Out = field(kw_only=True)
    images: Images = None
    views: ViewOptions = field(default_factory=ViewOptions)
    depth: DepthOptions = field(default_factory=DepthOptions)
    surface: SurfaceOptions = field(default_factory=SurfaceOptions)
    city: ModelOptions = field(default_factory=ModelOptions)
    formats: FormatOptions = field(default_factory=FormatOptions)
    random: RandomOptions = field(default_factory=RandomOptions)
    scale: ScaleOptions = field(default_factory=ScaleOptions)
    device: DeviceOptions = field(default_factory=DeviceOptions)
    force: Force = False
    quiet: Quiet = False

    def options(self) -> DenseOptions:
        """What changes the result."""
        return DenseOptions(
            views=self.views,
            depth=self.depth,
            surface=self.surface,
            city=self.city,
            formats=self.formats,
            random=self.random,
            scale=self.scale,
            device=self.device,
        )
