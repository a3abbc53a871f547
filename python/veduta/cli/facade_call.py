"""The arguments of `veduta facade`: the inputs, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Jobs, Out, Quiet
from veduta.facade.options import (
    DepthOptions,
    EyesOptions,
    FacadeOptions,
    HouseOptions,
    ModelOptions,
    OntoOptions,
    RectifyOptions,
    ScaleOptions,
    StyleOptions,
)

Images = Annotated[
    tyro.conf.Positional[tuple[Path, ...]],
    tyro.conf.arg(
        metavar="IMAGE...",
        help_behavior_hint="",
        help="photos (JPEG, PNG, TIFF, WebP), folders of photos, or facade.json documents",
    ),
]


@dataclass(frozen=True)
class FacadeCall:
    """Turn photos of facades into LoD3 buildings.

    The results of each photo are written to OUT/NAME/, all together to OUT/place.json.

    An edited OUT/NAME/facade.json in the place of a photo rebuilds its model.

    Exit codes: 0 done, 2 bad use or input, 3 some images failed (named), 1 a bug.
    """

    images: Images
    out: Out
    eyes: EyesOptions = field(default_factory=EyesOptions)
    rectify: RectifyOptions = field(default_factory=RectifyOptions)
    scale: ScaleOptions = field(default_factory=ScaleOptions)
    houses: HouseOptions = field(default_factory=HouseOptions)
    model: ModelOptions = field(default_factory=ModelOptions)
    style: StyleOptions = field(default_factory=StyleOptions)
    onto: OntoOptions = field(default_factory=OntoOptions)
    depth: DepthOptions = field(default_factory=DepthOptions)
    force: Force = False
    jobs: Jobs = None
    quiet: Quiet = False

    def options(self) -> FacadeOptions:
        """What changes the result; InputError where there is no such style."""
        if self.style.style is not None:
            from veduta.facade.style import require_style  # what it needs is slow to load

            require_style(self.style.style)
        return FacadeOptions(
            eyes=self.eyes,
            rectify=self.rectify,
            scale=self.scale,
            houses=self.houses,
            model=self.model,
            style=self.style,
            onto=self.onto,
            depth=self.depth,
        )
