"""`place.json`: read with care, written whole or not at all."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pydantic import ValidationError

from veduta.place.manifest import LATER, Place
from veduta.run.atomic import write_bytes
from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.inputs import require_file

# A manifest larger than this is refused before it is read (bytes).
LARGEST_BYTES = 256 * 2**20


def write_place(place: Place, path: Path) -> None:
    """Write the manifest as indented JSON."""
    write_bytes(path, manifest_bytes(place))


def manifest_bytes(place: Place) -> bytes:
    """The manifest as indented JSON."""
    unsaid: dict[str, Any] = {name: True for name in LATER if not getattr(place, name)}
    unsaid["parts"] = {
        n: {name for name in ("core", "raw") if getattr(part, name) is None}
        for n, part in enumerate(place.parts)
    }
    text = place.model_dump_json(by_alias=True, indent=2, exclude=unsaid)
    return (text + "\n").encode()


def read_place(path: Path) -> Place:
    """Read and check a manifest; raises InputError with the field that is wrong."""
    try:
        require_file(path, LARGEST_BYTES)
        text = path.read_bytes()
    except OSError as error:
        raise InputError(
            path, f"cannot be read ({error.strerror})", "Name a folder that Veduta has written."
        ) from error
    try:
        return Place.model_validate_json(text)
    except ValidationError as error:
        raise InputError(
            path, first_fault(error), "Let Veduta write it again, or mend the field."
        ) from error


def name_tileset(path: Path, tileset: str) -> None:
    """Write into a manifest that its parts lie in tiles, too."""
    write_place(read_place(path).model_copy(update={"tileset": tileset}), path)
