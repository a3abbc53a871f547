"""Edits of single shapes of derived buildings, as a text file: one edit a line.

    # LOT  PATH:RULE  EDIT
    north-1  /:Lot             storeys = 6
    north-1  /0/0/2/0:Floor    delete
    north-1  /0/0/2/3/1:Pane   choice 1 = 2

A path is that of `veduta grammar tree`: the places of children from the start shape on, counted
from 0. The rule behind the colon may be left out; where it is there and the shape has another one
by now, the edit is refused. `choice K = N` takes alternative N of the K-th random choice of the
shape's rule, both counted from 1. `NAME = VALUE` sets a parameter of the rule, or an attribute for
the shape and all below it; texts stand in double quotes.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from veduta.grammar.outline import Attribute
from veduta.run.errors import InputError
from veduta.run.inputs import require_file

MAX_BYTES = 8 * 2**20
MAX_DEPTH = 1000
MAX_PLACE = 2**32 - 1
_DIGITS = len(str(MAX_PLACE))
MAX_CHOICES = 1000
CoreEdit = tuple[
    list[int], str | None, bool, list[int | None], list[tuple[str, bool | float | str]]
]
_LINE = re.compile(r"(\S+)\s+(/\S*)\s+(.+)")
_CHOICE = re.compile(r"choice\s+(\d{1,6})\s*=\s*(\d{1,6})")
_VALUE = re.compile(r"([A-Za-z_][\w.]*)\s*=\s*(.+)")


class EditFault(ValueError):
    """What is wrong with an edit."""


@dataclass(frozen=True)
class Edit:
    """What is to be otherwise at one shape.

    path: the places of children from the start shape on, from 0. name: the rule that the shape must
    have; None for any. choices: the alternative to take in each random choice of its rule, from 0;
    None is drawn. values: parameters of the rule, or attributes. where: the line that says it.
    """

    path: tuple[int, ...]
    name: str | None = None
    delete: bool = False
    choices: tuple[int | None, ...] = ()
    values: tuple[tuple[str, Attribute], ...] = ()
    where: str = field(default="", compare=False)

    @property
    def core(self) -> CoreEdit:
        """As the extension takes it."""
        return (list(self.path), self.name, self.delete, list(self.choices), list(self.values))

    @property
    def is_empty(self) -> bool:
        """Whether it changes nothing."""
        return not (self.delete or self.values or any(c is not None for c in self.choices))


def path_text(path: Sequence[int], name: str | None = None) -> str:
    """A path as files and messages have it: `/0/2:Floor`."""
    text = "/" + "/".join(str(place) for place in path)
    return text if name is None else f"{text}:{name}"


def parse_path(text: str) -> tuple[tuple[int, ...], str | None]:
    """Path and name of `/0/2:Floor`; EditFault where it is none."""
    places, colon, name = text.partition(":")
    words = [word for word in places.removeprefix("/").split("/") if word or places != "/"]
    if not places.startswith("/") or (colon and not name) or len(words) > MAX_DEPTH:
        raise EditFault(f"`{text[:60]}` is no path such as /0/2:Floor")
    # Its length first: Python refuses to make a number of thousands of digits.
    if not all(
        len(word) <= _DIGITS and word.isascii() and word.isdigit() and int(word) <= MAX_PLACE
        for word in words
    ):
        raise EditFault(f"`{text[:60]}` is no path such as /0/2:Floor")
    return tuple(int(word) for word in words), name or None


def read_edits(path: Path) -> dict[str, tuple[Edit, ...]]:
    """The edits of each lot; InputError with the line where one cannot be read."""
    found: dict[str, dict[tuple[int, ...], Edit]] = {}
    for number, line in enumerate(_text(path).splitlines(), 1):
        stripped = line.strip()
        if not stripped or stripped.startswith("#"):
            continue
        try:
            lot, edit = parse_line(stripped)
            own = found.setdefault(lot, {})
            edit = replace(edit, where=f"{path}:{number}")
            before = own.get(edit.path)
            own[edit.path] = edit if before is None else _both(before, edit)
        except EditFault as fault:
            raise InputError(
                path,
                f"line {number}: {fault}",
                "Write LOT PATH and delete, NAME = VALUE or choice K = N.",
            ) from fault
    return {lot: tuple(edits[key] for key in sorted(edits)) for lot, edits in found.items()}


def parse_line(line: str) -> tuple[str, Edit]:
    """Lot and edit of a line; EditFault where it is none."""
    parts = _LINE.fullmatch(line)
    if parts is None:
        raise EditFault("is not LOT, PATH and EDIT with spaces between them")
    path, name = parse_path(parts[2])
    what = parts[3].strip()
    if what == "delete":
        return parts[1], Edit(path, name, delete=True)
    if choice := _CHOICE.fullmatch(what):
        number, taken = int(choice[1]), int(choice[2])
        if not (1 <= number <= MAX_CHOICES and 1 <= taken <= MAX_CHOICES):
            raise EditFault(f"choices are counted from 1 to {MAX_CHOICES}")
        return parts[1], Edit(path, name, choices=(*[None] * (number - 1), taken - 1))
    if value := _VALUE.fullmatch(what):
        return parts[1], Edit(path, name, values=((value[1], _value(value[2])),))
    raise EditFault(f"`{what[:60]}` is neither delete, NAME = VALUE nor choice K = N")


def edits_text(edits: dict[str, Iterable[Edit]]) -> str:
    """The file of these edits: by lot and path, one a line, so that versions can be compared."""
    lines = ["# Edits of derived buildings: LOT PATH:RULE EDIT, see docs/grammar.md"]
    for lot in sorted(edits):
        for edit in sorted(edits[lot], key=lambda one: one.path):
            head = f"{lot}  {path_text(edit.path, edit.name)}"
            lines += [f"{head}  {what}" for what in _whats(edit)]
    return "\n".join(lines) + "\n"


def fault_told(edits: Sequence[Edit], faults: Sequence[tuple[Sequence[int], str]]) -> str | None:
    """What to say of edits that could not be done; None where all were."""
    by_path = {edit.path: edit for edit in edits}
    told = []
    for path, fault in faults:
        edit = by_path.get(tuple(path))
        name = path_text(path, edit.name if edit else None)
        where = f"{edit.where}: " if edit and edit.where else ""
        told.append(f"{where}the edit of {name} cannot be done: {fault}")
    if not told:
        return None
    more = f" (and {len(told) - 3} more)" if len(told) > 3 else ""
    remedy = "take it out, or find the shape with `veduta grammar tree`"
    return f"{'; '.join(told[:3])}{more}; {remedy}"


def _whats(edit: Edit) -> list[str]:
    choices = enumerate(edit.choices, 1)
    words = ["delete"] if edit.delete else []
    words += [f"choice {number} = {taken + 1}" for number, taken in choices if taken is not None]
    return words + [f"{name} = {json.dumps(value)}" for name, value in sorted(edit.values)]


def _value(text: str) -> Attribute:
    try:
        value = json.loads(text)
    except ValueError:
        value = None
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int | float) and abs(value) < 1e300:
        return float(value)
    raise EditFault(f"`{text[:60]}` is no number, true, false, or text in double quotes")


def _both(one: Edit, other: Edit) -> Edit:
    """Two lines about one shape as one edit; EditFault where they contradict each other."""
    if one.name is not None and other.name is not None and one.name != other.name:
        raise EditFault(f"names the shape {other.name}, another line {one.name}")
    if one.delete or other.delete:
        raise EditFault("the shape is deleted, and edited in another line")
    if {name for name, _ in one.values} & {name for name, _ in other.values}:
        raise EditFault("the same value is set twice")
    length = max(len(one.choices), len(other.choices))
    pairs = zip(_padded(one.choices, length), _padded(other.choices, length), strict=True)
    choices = []
    for first, second in pairs:
        if first is not None and second is not None:
            raise EditFault("the same choice is set twice")
        choices.append(second if first is None else first)
    values = (*one.values, *other.values)
    return replace(one, name=one.name or other.name, choices=tuple(choices), values=values)


def _padded(choices: tuple[int | None, ...], length: int) -> tuple[int | None, ...]:
    return choices + (None,) * (length - len(choices))


def _text(path: Path) -> str:
    try:
        require_file(path, MAX_BYTES)
        return path.read_bytes().decode("utf-8-sig")
    except FileNotFoundError as error:
        raise InputError(path, "does not exist", "Check its name.") from error
    except OSError as error:
        told = f"cannot be read ({error.strerror})"
        raise InputError(path, told, "Check its permissions.") from error
    except UnicodeDecodeError as error:
        raise InputError(path, "is not text in UTF-8", "Save it as UTF-8.") from error
