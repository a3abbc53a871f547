"""The arguments of `veduta export`: a place, and what it is to become."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from veduta.place.about import AboutOptions
from veduta.studio.card import CardOptions

Place = Annotated[
    tyro.conf.Positional[Path],
    tyro.conf.arg(
        metavar="OUT",
        help_behavior_hint="",
        help="folder with a place.json, as -o of the other verbs writes it",
    ),
]
File = Annotated[
    tyro.conf.Positional[Path | None],
    tyro.conf.arg(
        metavar="[FILE]",
        help_behavior_hint="",
        help="file to write; its ending says the format (.obj, .glb, .usd, .gml, .gpkg, ...)",
    ),
]
To = Annotated[
    str | None,
    tyro.conf.arg(
        metavar="NAME,...",
        help_behavior_hint="",
        help="formats to write to the folder of -o, by name: `--to obj,stl`; `--to list` shows all",
    ),
]
Folder = Annotated[
    Path | None,
    tyro.conf.arg(
        aliases=("-o",),
        metavar="FOLDER",
        help_behavior_hint="",
        help="folder for the formats of --to; it is made where it is missing",
    ),
]
Web = Annotated[
    Path | None,
    tyro.conf.arg(
        metavar="PATH",
        help_behavior_hint="",
        help="folder to write, which any static web server can show",
    ),
]
Force = Annotated[
    bool,
    tyro.conf.arg(
        help_behavior_hint="",
        help="replace a file that is there, or an earlier export of another place",
    ),
]


@dataclass(frozen=True)
class ExportCall:
    """Write a place as a file that others read, or as a folder that any web server can show.

    One of three: `veduta export OUT FILE`, `veduta export OUT --to obj,usd -o FOLDER`, or
    `veduta export OUT --web DIR`.

    Exit codes: 0 done, 2 bad use or input, 1 a bug.
    """

    out: Place
    file: File = None
    to: To = None
    folder: Folder = None
    web: Web = None
    about: AboutOptions = field(default_factory=AboutOptions)
    card: CardOptions = field(default_factory=CardOptions)
    force: Force = False
