"""Opening a DXF file: whatever is wrong with it is an InputError that says what to do."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from veduta.plan.vector.copies import MOST_SHOWN, shown_count
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

if TYPE_CHECKING:
    from ezdxf.document import Drawing as DxfDocument

MAX_BYTES = 300_000_000
_BINARY = b"AutoCAD Binary DXF"
_LOOKED_AT = 4096
_AGAIN = "Export it as DXF (R2000 or later) again."


def is_dxf(path: Path) -> bool:
    """By the name, or by the content of a file without its name. False where it cannot be read."""
    if path.suffix.lower() in (".dxf", ".dwg"):
        return True
    head = _head(path)
    return head.startswith(_BINARY) or _begins_as_dxf(head)


def open_dxf(path: Path) -> DxfDocument:
    """The file's content, mended where that can be (`ezdxf.recover`)."""
    from ezdxf import recover  # not at the top: pictures need none of it
    from ezdxf.lldxf.const import DXFError

    require_file(path, MAX_BYTES)
    head = _head(path)
    if head[:4] == b"AC10" and head[:6].decode("ascii", "replace")[2:].isalnum():
        raise InputError(
            path, "is a DWG file", "Save it as DXF (R2000 or later) in the program that made it."
        )
    if not head.strip():
        raise InputError(path, "is empty", _AGAIN)
    if not (head.startswith(_BINARY) or _begins_as_dxf(head)):
        raise InputError(path, "is no DXF file, whatever its name says", _AGAIN)
    try:
        with _silent():
            document, _ = recover.readfile(str(path))
    except (DXFError, OSError) as error:
        raise InputError(path, f"is a damaged DXF file ({error})", _AGAIN) from error
    except (
        ValueError, KeyError, IndexError, AttributeError, TypeError, AssertionError, RecursionError,
    ) as error:  # fmt: skip
        # What no repair of ezdxf foresees: tags of other kinds than the format has.
        raise InputError(path, f"is a damaged DXF file ({error!r})", _AGAIN) from error
    if shown_count(document) >= MOST_SHOWN:
        fault = f"repeats its blocks to more than {MOST_SHOWN:,} lines and words"
        raise InputError(path, fault, "Take the arrays of blocks out of it.")
    return document


@contextmanager
def _silent() -> Iterator[None]:
    """Without the loader's words on each tag that it mends."""
    logger = logging.getLogger("ezdxf")
    before = logger.level
    logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        logger.setLevel(before)


def _head(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(_LOOKED_AT)
    except OSError:
        return b""


def _begins_as_dxf(head: bytes) -> bool:
    """Whether the first tags are comments (999) or the start of a section (0 SECTION)."""
    lines = [line.strip() for line in head.removeprefix(b"\xef\xbb\xbf").splitlines()]
    while len(lines) > 2 and lines[0] == b"999":
        lines = lines[2:]
    return len(lines) > 1 and lines[0] == b"0" and lines[1].upper() == b"SECTION"
