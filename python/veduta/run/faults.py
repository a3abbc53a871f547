"""What is wrong with a document that does not fit its schema, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pydantic import ValidationError


def first_fault(error: ValidationError, whole: str = "the file") -> str:
    """The first field that is wrong, by the way to it, and what is wrong; else `whole`."""
    first = error.errors()[0]
    where = ".".join(str(step) for step in first["loc"]) or whole
    return f"{where}: {first['msg']}"
