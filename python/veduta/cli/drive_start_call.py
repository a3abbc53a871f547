"""The arguments of `veduta drive start`: the log, and the page to write."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.drive_call import Log
from veduta.cli.run_arguments import Quiet

Page = Annotated[
    Path, tyro.conf.arg(aliases=["-o"], metavar="HTML", help="page to write, for any browser")
]
Force = Annotated[bool, tyro.conf.arg(help="replace a page that is there")]


@dataclass(frozen=True)
class DriveStartCall:
    """Write a page on which a click says where a drive begins.

    It shows the surface model that LOG/drive.toml names in [surface]. Press where the drive begins
    and drag to where it goes: the page shows what to write into drive.toml.
    """

    log: Log
    out: Page
    force: Force = False
    quiet: Quiet = False
