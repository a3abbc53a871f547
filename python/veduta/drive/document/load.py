"""Reading a `drive.json`, edited or not."""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from veduta.drive.document.model import DriveDocument
from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.inputs import require_file

DOCUMENT = "drive.json"
_MOST_BYTES = 1 << 30


def load_document(path: Path) -> DriveDocument:
    """InputError says what is wrong with it, and where."""
    if not path.is_file():
        raise InputError(path, "there is no such file", f"Name a {DOCUMENT} that Veduta wrote.")
    require_file(path, _MOST_BYTES)
    try:
        document = DriveDocument.model_validate_json(path.read_bytes())
    except ValidationError as error:
        raise InputError(path, first_fault(error), "Mend it, or drive anew.") from error
    names = [segment.id for segment in document.segments]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise InputError(path, f"has two segments {twice[0]!r}", "Give each a name of its own.")
    return document
