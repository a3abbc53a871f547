"""The arguments of `veduta demo`: the street, what is known about it, and how to run."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Out, Quiet
from veduta.facade.demo_options import DemoOptions
from veduta.synthetic.options import SyntheticOptions

Force = Annotated[
    bool, tyro.conf.arg(help="replace results of other options; edited files are always kept")
]
Animal = Annotated[
    bool, tyro.conf.arg(help="send an animal through the street: OUT/animal is the place with it")
]

Walk = Annotated[
    bool,
    tyro.conf.arg(
        help="a walk through a synthetic gorge in place of the street, from its stereo pictures:"
        " OUT/stereo and OUT/walk; of the other options only --seed counts"
    ),
]


@dataclass(frozen=True)
class DemoCall:
    """Make a street with known truth, photograph it, rebuild it from the photo, and compare.

    OUT/truth has the photo, OUT/place what `veduta facade` makes of it, OUT/comparison both
    beside each other.

    Exit codes: 0 done (however well), 2 bad use, 3 no facade found, 1 a bug.
    """

    out: Out = Path("veduta-demo")
    demo: DemoOptions = field(default_factory=DemoOptions)
    street: SyntheticOptions = field(default_factory=SyntheticOptions)
    walk: Walk = False
    animal: Animal = False
    force: Force = False
    quiet: Quiet = False
