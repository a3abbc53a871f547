"""What a result depends on besides its drawings: a catalogue of the user's own, and its files."""

from __future__ import annotations

from pathlib import Path

from veduta.plan.furnish.catalogue.read import Catalogue
from veduta.run.digests import file_digest
from veduta.run.errors import InputError


def catalogue_digests(path: Path | None, catalogue: Catalogue) -> list[str]:
    """Of the catalogue's file and of the meshes that it names; none without such a file."""
    if path is None:
        return []
    found = [file_digest(path)]
    for entry in catalogue.entries.values():
        if entry.file is None or entry.folder is None:
            continue
        mesh = entry.folder / entry.file
        try:
            found.append(file_digest(mesh))
        except OSError as error:
            fault = f"cannot be read ({error.strerror}): object {entry.name!r} of the catalogue"
            raise InputError(mesh, fault, "Check its name in the table 'object'.") from error
    return found
