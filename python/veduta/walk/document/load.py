"""`walk.json`, read with care and written whole."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from veduta.run.atomic import write_bytes
from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.inputs import require_file
from veduta.walk.document.schema import WalkDocument

DOCUMENT = "walk.json"
LARGEST_BYTES = 64 * 2**20


def write_document(document: WalkDocument, path: Path) -> None:
    """Write it as indented JSON."""
    text = document.model_dump_json(by_alias=True, indent=1)
    write_bytes(path, (text + "\n").encode())


def read_document(path: Path) -> WalkDocument:
    """Read and check it; InputError with the field that is wrong."""
    require_file(path, LARGEST_BYTES)
    try:
        return WalkDocument.model_validate_json(path.read_bytes())
    except ValidationError as error:
        raise InputError(path, first_fault(error), "Mend the field.") from error
