"""The arguments of every verb that writes an OUT: where, how, and what to say."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import tyro

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
