"""`veduta grammar format`: a rule file in the house style."""

from __future__ import annotations

from pathlib import Path

from veduta import _core
from veduta.grammar.rules import read_text
from veduta.run.atomic import write_bytes
from veduta.run.errors import InputError

_MARK = b"\xef\xbb\xbf"


def formatted(path: Path) -> tuple[str, bool]:
    """The text of the file in the house style, and whether it differs from what is there."""
    text = read_text(path)
    try:
        laid_out = _core.grammar_format(str(path), text)
    except _core.GrammarFault as fault:
        raise InputError(
            path,
            f"has faults\n{str(fault).rstrip()}\nIt cannot be formatted",
            "Mend these first.",
        ) from fault
    return laid_out, laid_out.encode() != path.read_bytes().removeprefix(_MARK)


def write_formatted(path: Path) -> bool:
    """Rewrite the file whole or not at all; an unchanged one is not touched."""
    text, differs = formatted(path)
    if differs:
        # A link stays a link: what it names is rewritten.
        target = path.resolve()
        try:
            write_bytes(target, text.encode())
        except OSError as error:
            raise InputError(
                path, f"cannot be written ({error.strerror})", "Check its permissions."
            ) from error
    return differs
