"""The arguments of the actions of `veduta grammar`."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.cli.run_arguments import Force, Jobs, Out, Quiet
from veduta.grammar.options import (
    DeriveOptions,
    LimitOptions,
    LotOptions,
    OutputOptions,
    SampleOptions,
)

Rules = Annotated[
    tyro.conf.Positional[str],
    tyro.conf.arg(
        metavar="RULES",
        help_behavior_hint="",
        help="a rule file (.cga), or a style that Veduta brings along (such as haussmann)",
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
        help="the lots: GeoJSON, CityJSON, GeoPackage, Shapefile, FlatGeobuf, KML, OpenStreetMap"
        " (XML, PBF), DXF, OBJ and others; a synthetic street if not given",
    ),
]
OneLot = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="LOTS",
        help_behavior_hint="",
        help="file of lots to take one of; a lot of 14 x 12 m where it is not given",
    ),
]
LotName = Annotated[
    str | None,
    tyro.conf.arg(
        metavar="ID",
        help_behavior_hint="",
        help="which lot of LOTS, or of the synthetic street; the first of LOTS if not given",
    ),
]
Edits = Annotated[
    Path | None,
    tyro.conf.arg(metavar="FILE", help_behavior_hint="", help="edits of single shapes, one a line"),
]
Picture = Annotated[
    Path, tyro.conf.arg(aliases=["-o"], metavar="SHEET", help="the picture to write (PNG or JPEG)")
]
Drawing = Annotated[
    Path | None,
    tyro.conf.arg(
        aliases=["-o"],
        metavar="FILE",
        help_behavior_hint="",
        help="write it as a drawing (.svg) or as text (.txt), and print nothing",
    ),
]
Count = Annotated[
    int,
    tyro.conf.arg(
        aliases=["-n"],
        metavar="N",
        help_behavior_hint="",
        help="how many buildings, up to 64; 9 if not given",
    ),
]
Depth = Annotated[
    int,
    tyro.conf.arg(
        metavar="N",
        help_behavior_hint="",
        help="rules within each other that are shown, up to 1000; 6 if not given",
    ),
]
At = Annotated[
    str,
    tyro.conf.arg(
        metavar="PATH",
        help_behavior_hint="",
        help="shape to begin with, such as /0/2; / is the lot",
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

Names = Annotated[
    tyro.conf.UseAppendAction[tuple[str, ...]],
    tyro.conf.arg(
        metavar="ATTR=PROPERTY",
        help_behavior_hint="",
        help="which property of the lots an attribute takes, such as height=hauteur, or"
        " height=ROOF[ft] where bare numbers are feet; several with commas. Usual names of"
        " OpenStreetMap and INSPIRE are known",
    ),
]
Project = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="CityEngine project of the rule file, with its `assets` and `rules`; found by itself"
        " where `rules` lies beside them",
    ),
]
LibraryFolders = Annotated[
    tyro.conf.UseAppendAction[tuple[Path, ...]],
    tyro.conf.arg(
        metavar="DIR",
        help_behavior_hint="",
        help="a folder beside the project in which imports and assets are looked for, too (such as"
        " ESRI.lib); may be given several times",
    ),
]


@dataclass(frozen=True)
class CheckCall:
    """Check a rule file and what it imports; every fault is shown with its line.

    Rules without faults are derived on one lot, as `derive` would: what fails there is an error.

    Exit codes: 0 no errors (warnings are told), 2 errors or a file that cannot be read.
    """

    rules: Rules
    lots: OneLot = None
    lot: LotName = None
    attr: Attr = ()
    map: Names = ()
    project: Project = None
    library: LibraryFolders = ()
    derive: DeriveOptions = field(default_factory=DeriveOptions)
    limits: LimitOptions = field(default_factory=LimitOptions)
    read: LotOptions = field(default_factory=LotOptions)


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
    edits: Edits = None
    map: Names = ()
    project: Project = None
    library: LibraryFolders = ()
    derive: DeriveOptions = field(default_factory=DeriveOptions)
    limits: LimitOptions = field(default_factory=LimitOptions)
    read: LotOptions = field(default_factory=LotOptions)
    output: OutputOptions = field(default_factory=OutputOptions)
    force: Force = False
    jobs: Jobs = None
    quiet: Quiet = False


@dataclass(frozen=True)
class SampleCall:
    """Show what the rules can make: random derivations on one lot, in a picture.

    Each building has its seed and the logarithm of its prior probability; `veduta grammar tree`
    with the same lot and seed shows how it came about.

    Exit codes: 0 done, 2 bad use or input, 1 a bug.
    """

    rules: Rules
    out: Picture
    count: Count = 9
    lots: OneLot = None
    lot: LotName = None
    attr: Attr = ()
    derive: DeriveOptions = field(default_factory=DeriveOptions)
    limits: LimitOptions = field(default_factory=LimitOptions)
    read: LotOptions = field(default_factory=LotOptions)
    sheet: SampleOptions = field(default_factory=SampleOptions)
    quiet: Quiet = False


@dataclass(frozen=True)
class TreeCall:
    """Show how a building is derived: each shape with its rule, size, choices and path.

    Neighbours that are alike are one row. A path such as /0/2:Floor names the shape in a file of
    edits (`veduta grammar derive --edits`).

    Exit codes: 0 done, 2 bad use or input, 1 a bug.
    """

    rules: Rules
    lots: OneLot = None
    lot: LotName = None
    at: At = "/"
    depth: Depth = 6
    out: Drawing = None
    attr: Attr = ()
    edits: Edits = None
    derive: DeriveOptions = field(default_factory=DeriveOptions)
    limits: LimitOptions = field(default_factory=LimitOptions)
    read: LotOptions = field(default_factory=LotOptions)
