"""The arguments of `veduta facade`: the inputs, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.facade.options import FacadeOptions, ModelOptions, RectifyOptions, ScaleOptions


@dataclass(frozen=True)
class FacadeCall:
    """Turn photos of facades into LoD3 buildings.

    The results of each photo are written to OUT/NAME/, all together to OUT/place.json.
    An edited OUT/NAME/facade.json in the place of a photo rebuilds its model.
    Exit codes: 0 done, 2 bad use or input, 3 some images failed (named), 1 a bug.
    """

    images: Annotated[tyro.conf.Positional[tuple[Path, ...]], tyro.conf.arg(metavar="IMAGE...")]
    """photos (JPEG, PNG, TIFF, WebP), folders of photos, or facade.json documents"""
    out: Annotated[Path, tyro.conf.arg(aliases=["-o"], metavar="OUT")]
    """folder for the results"""
    rectify: RectifyOptions = field(default_factory=RectifyOptions)
    scale: ScaleOptions = field(default_factory=ScaleOptions)
    model: ModelOptions = field(default_factory=ModelOptions)
    force: bool = False
    """replace results of other inputs or options; edited files are always kept"""
    jobs: Annotated[int | None, tyro.conf.arg(metavar="N")] = None
    """processes that work at once; as many as there are cores where it is not given"""
    quiet: Annotated[bool, tyro.conf.arg(aliases=["-q"])] = False
    """say nothing but errors"""

    def options(self) -> FacadeOptions:
        """What changes the result."""
        return FacadeOptions(rectify=self.rectify, scale=self.scale, model=self.model)
