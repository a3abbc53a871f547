"""The arguments of `veduta plan`: the drawings, the options, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Out, Quiet
from veduta.plan.options import HouseOptions, InputOptions, PlanOptions, ScaleOptions, SiteOptions

Drawings = Annotated[
    tyro.conf.Positional[tuple[Path, ...]],
    tyro.conf.arg(
        metavar="IMAGE...",
        help_behavior_hint="",
        help=(
            "drawings of the storeys, the lowest first: pictures, DXF files, or PDFs with a storey"
            " on each page; or a plan.json to rebuild from"
        ),
    ),
]

Photos = Annotated[
    tyro.conf.UseAppendAction[tuple[str, ...]],
    tyro.conf.arg(
        metavar="ROOM=FILE",
        help_behavior_hint="",
        help=(
            "a photo of a room, by its id or name: its walls get the colour, its floor and walls"
            " the tiles that it shows; may be given several times"
        ),
    ),
]


@dataclass(frozen=True)
class PlanCall:
    """Turn floor plans into a house that one can walk through.

    Each picture, and each page of a PDF, is a storey, the lowest first. What is found is in
    OUT/plan.json, the house in OUT/house.glb, OUT/house.ifc and OUT/place.json, the plan in
    OUT/plan.dxf and OUT/plan.svg.

    An edited OUT/plan.json in the place of the drawings rebuilds all of it.

    Exit codes: 0 done, 2 bad use or input, 3 there is no plan in the drawings, 1 a bug.
    """

    drawings: Drawings
    out: Out
    input: InputOptions = field(default_factory=InputOptions)
    scale: ScaleOptions = field(default_factory=ScaleOptions)
    house: HouseOptions = field(default_factory=HouseOptions)
    site: SiteOptions = field(default_factory=SiteOptions)
    photos: Photos = ()
    force: Force = False
    quiet: Quiet = False

    def options(self) -> PlanOptions:
        """What changes the result."""
        return PlanOptions(input=self.input, scale=self.scale, house=self.house, site=self.site)
