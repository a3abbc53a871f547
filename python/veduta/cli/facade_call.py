"""The arguments of `veduta facade`: the inputs, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.facade.options import FacadeOptions, ModelOptions, RectifyOptions, ScaleOptions

Images = Annotated[
    tyro.conf.Positional[tuple[Path, ...]],
    tyro.conf.arg(
        metavar="IMAGE...",
        help_behavior_hint="",
        help="photos (JPEG, PNG, TIFF, WebP), folders of photos, or facade.json documents",
    ),
]
Out = Annotated[Path, tyro.conf.arg(aliases=["-o"], metavar="OUT", help="folder for the results")]
Force = Annotated[
    bool,
    tyro.conf.arg(help="replace results of other inputs or options; edited files are always kept"),
]
Jobs = Annotated[
    int | None,
    tyro.conf.arg(
        metavar="N",
        help_behavior_hint="",
        help="processes that work at once; one per core where it is not given",
    ),
]
Quiet = Annotated[bool, tyro.conf.arg(aliases=["-q"], help="say nothing but errors")]


@dataclass(frozen=True)
class FacadeCall:
    """Turn photos of facades into LoD3 buildings.

    The results of each photo are written to OUT/NAME/, all together to OUT/place.json.

    An edited OUT/NAME/facade.json in the place of a photo rebuilds its model.

    Exit codes: 0 done, 2 bad use or input, 3 some images failed (named), 1 a bug.
    """

    images: Images
    out: Out
    rectify: RectifyOptions = field(default_factory=RectifyOptions)
    scale: ScaleOptions = field(default_factory=ScaleOptions)
    model: ModelOptions = field(default_factory=ModelOptions)
    force: Force = False
    jobs: Jobs = None
    quiet: Quiet = False

    def options(self) -> FacadeOptions:
        """What changes the result."""
        return FacadeOptions(rectify=self.rectify, scale=self.scale, model=self.model)
