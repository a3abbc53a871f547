"""`veduta.derive`: from rules and lots to a place, for programs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.place.door import path_or_none
from veduta.place.place import Place
from veduta.run.errors import InputError
from veduta.run.flat import options_of
from veduta.run.progress import Progress
from veduta.run.scratch import goes_with, scratch_folder


def derive(
    rules: str | Path,
    lots: str | Path | None = None,
    out: str | Path | None = None,
    *,
    attributes: Mapping[str, bool | float | str] | None = None,
    edits: str | Path | None = None,
    project: str | Path | None = None,
    libraries: Sequence[str | Path] = (),
    force: bool = False,
    **options: Any,
) -> Place:
    """The buildings that rules make on the lots of a file, each a part.

    rules: a rule file, or the name of a style such as "haussmann". lots: GeoJSON, CityJSON,
    CityGML, GeoPackage, Shapefile, FlatGeobuf, KML, OpenStreetMap (XML, PBF), DXF, OBJ and others;
    a synthetic street where there are none. attributes: of the rules, for all lots. edits: a file
    of edits of single shapes, one a line. project: the CityEngine project of the rule file, found
    by itself where its folders lie as usual. libraries: folders beside it in which imports and
    assets are looked for, too (`--library`). out: a folder for all that `veduta grammar derive -o
    OUT` writes; without it nothing stays. options: as on the command line, `seed=7`. For one lot
    and its tree of shapes: `veduta.grammar.derive`. InputError names the file or the lot that
    cannot be used.
    """
    asked: dict[str, Any] = {"separate": True} | options
    chosen = options_of(
        GrammarOptions, asked | ({"values": dict(attributes)} if attributes else {})
    )
    folder, scratch = (Path(out), None) if out is not None else scratch_folder()
    done = run_derive(
        str(rules),
        None if lots is None else Path(lots),
        folder,
        chosen,
        Progress(quiet=True),
        edits_path=path_or_none(edits),
        project=path_or_none(project),
        libraries=[Path(one) for one in libraries],
        force=force,
    )
    if not done.built.count:
        reason = next((one.reason for one in done.failures), "there are no lots")
        raise InputError(str(lots or rules), f"nothing was built: {reason}", "Mend rules or lots.")
    place = Place.load(folder)
    if scratch is not None:
        goes_with(place, scratch)
    return place
