"""Reading a JSON document that somebody may have edited: each fault by its place in the file."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from veduta.run.errors import InputError
from veduta.run.inputs import require_file

SHOWN_FAULTS = 5

Document = TypeVar("Document", bound=BaseModel)


def read_edited(path: Path, schema: type[Document], max_bytes: int, remedy: str) -> Document:
    """The document of `schema` in `path`, of at most `max_bytes`.

    InputError names each place in the file and its fault; `remedy` is what it says of those that
    the schema finds.
    """
    content = _read(path, max_bytes)
    try:
        json.loads(content)  # says the line of a fault
        # Strictly: a number in quotes, or true, is a slip and no number.
        return schema.model_validate_json(content, strict=True)
    except json.JSONDecodeError as error:
        fault = f"line {error.lineno}, column {error.colno}: not JSON: {error.msg}"
        raise InputError(path, fault, "Mend the file there.") from error
    except (UnicodeDecodeError, RecursionError) as error:
        raise InputError(path, f"is not JSON ({error})", "Check the file.") from error
    except ValidationError as error:
        faults = [f"{_place(fault['loc'])}: {fault['msg']}" for fault in error.errors()]
        raise InputError(path, shown_faults(faults), remedy) from error
    except ValueError as error:  # after its kinds above: a number of too many digits
        raise InputError(path, f"is not usable JSON ({error})", "Check the file.") from error


def refuse_other_json(
    path: Path, others: Mapping[str, str], document: str, remedy: Callable[[Path], str]
) -> None:
    """InputError where a file of OUT is given that is no document that one edits.

    others: what the files of OUT do that somebody may take for it, by name. document: what is
    meant, such as `a plan`. remedy: what to give in its place, for a path that is refused.
    """
    what = others.get(path.name)
    if what is not None:
        raise InputError(path, f"{what}, and is no document of {document}", remedy(path))


def shown_faults(faults: list[str]) -> str:
    """The first of them, and how many more there are."""
    more = len(faults) - SHOWN_FAULTS
    return "; ".join(faults[:SHOWN_FAULTS]) + (f"; and {more} more" if more > 0 else "")


def numbers_of(value: object, place: str = "") -> list[tuple[str, float]]:
    """All floats in a document with their places."""
    if isinstance(value, float):
        return [(place.lstrip("."), value)]
    if isinstance(value, BaseModel):
        fields = type(value).model_fields
        parts = [(f"{place}.{fields[name].alias or name}", part) for name, part in value]
    elif isinstance(value, dict):
        parts = [(f"{place}.{name}", part) for name, part in value.items()]
    elif isinstance(value, list | tuple):
        parts = [(f"{place}[{index}]", part) for index, part in enumerate(value)]
    else:
        return []
    return [number for name, part in parts for number in numbers_of(part, name)]


def _read(path: Path, max_bytes: int) -> bytes:
    try:
        require_file(path, max_bytes)
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(path, "does not exist", "Check its name.") from None
    except OSError as error:
        fault = f"cannot be read ({error.strerror})"
        raise InputError(path, fault, "Check its permissions.") from error


def _place(location: tuple[int | str, ...]) -> str:
    """A place in the file as a person would write it: `elements[3].width_px`."""
    parts = [f"[{part}]" if isinstance(part, int) else f".{part}" for part in location]
    return "".join(parts).lstrip(".") or "the document"
