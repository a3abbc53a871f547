"""The arguments of `veduta grammar check`, `format` and `derive`."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Jobs, Out, Quiet
from veduta.grammar.options import DeriveOptions, OutputOptions

Rules = Annotated[
    tyro.conf.Positional[str],
    tyro.conf.arg(
        metavar="RULES",
        help_behavior_hint="",
        help="a rule file (.cga), or a style that Veduta brings along (haussmann)",
    ),
]
Files = Annotated[
    tyro.conf.Positional[tuple[Path, ...]],
    tyro.conf.arg(metavar="RULES...", help_behavior_hint="", help="rule files (.cga)"),
]
Write = Annotated[bool, tyro.conf.arg(help="rewrite the files; unchanged ones are not touched")]
LotsFile = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="LOTS",
        help_behavior_hint="",
        help="GeoJSON or CityJSON with the lots; a synthetic street where it is not given",
    ),
]
Attr = Annotated[
    tyro.conf.UseAppendAction[tuple[str, ...]],
    tyro.conf.arg(
        metavar="NAME=VALUE",
        help_behavior_hint="",
        help="an attribute of the rule file, for all lots; may be given several times",
    ),
]


@dataclass(frozen=True)
class CheckCall:
    """Check a rule file and what it imports; every fault is shown with its line.

    Exit codes: 0 no errors (warnings are told), 2 errors or a file that cannot be read.
    """

    rules: Rules


@dataclass(frozen=True)
class FormatCall:
    """Lay out rule files in the house style: print the text of one, or rewrite them.

    Exit codes: 0 done, 2 a file that cannot be read, parsed or written.
    """

    rules: Files
    write: Write = False


@dataclass(frozen=True)
class DeriveCall:
    """Derive a building for each lot.

    All of them are in OUT/tileset.json (3D Tiles), OUT/city.city.json and OUT/place.json.

    Exit codes: 0 done, 2 bad use or input, 3 some lots failed (named), 1 a bug.
    """

    rules: Rules
    out: Out
    lots: LotsFile = None
    attr: Attr = ()
    derive: DeriveOptions = field(default_factory=DeriveOptions)
    output: OutputOptions = field(default_factory=OutputOptions)
    force: Force = False
    jobs: Jobs = None
    quiet: Quiet = False
