"""The run record `OUT/.veduta/run.json`: what Veduta wrote into OUT, and how far it came.

Of a run with many files the record is not written anew for each item: changes are added to
`OUT/.veduta/run.jsonl`, a line each, behind the digest of the record that they belong to. Whoever
loads the record finds them done; a line that was cut off is none.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Annotated, Literal, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    JsonValue,
    PrivateAttr,
    ValidationError,
)

import veduta
from veduta.run.atomic import write_bytes
from veduta.run.errors import InputError
from veduta.run.faults import first_fault
from veduta.run.report import Failure

T = TypeVar("T")
PRIVATE = ".veduta"
CALL = "."
"""The item that stands for the call as a whole: the files that lie in OUT itself."""
RECORD = "run.json"
JOURNAL = "run.jsonl"
JOURNAL_FROM = 2000
"""Files of a run from which on changes of its record are added to the journal."""


def _inside(path: str) -> str:
    """Refuse a path that leads out of OUT: the record may come from somebody else."""
    pure = PurePosixPath(path)
    if pure.is_absolute() or ".." in pure.parts or not pure.parts or pure.parts[0] == PRIVATE:
        raise ValueError(f"{path!r} leads out of the result folder")
    return path


RelativePath = Annotated[str, AfterValidator(_inside)]


class _Record(BaseModel):
    model_config = ConfigDict(extra="forbid")


class Item(_Record):
    """One result of the run, usually of one input, in a folder of its own name."""

    key: str
    state: Literal["publishing", "done", "failed"]
    failure: Failure | None = None
    summary: dict[str, JsonValue] = Field(
        default={}, description="what the verb needs of a finished item without reading it again"
    )


class Change(_Record):
    """What becomes otherwise in a record; None takes something out."""

    items: dict[str, Item | None] = {}
    files: dict[RelativePath, str | None] = {}
    pending: dict[RelativePath, str] = {}


class RunRecord(_Record):
    """What the last run into OUT was, and every file that Veduta wrote there."""

    schema_: Literal["veduta/run"] = Field(default="veduta/run", alias="schema")
    version: Literal[1] = 1
    veduta: str = veduta.__version__
    command: str
    key: str = Field(description="digest of inputs, options and the verb's version")
    state: Literal["unfinished", "finished"] = "unfinished"
    inputs: list[str] = Field(default=[], description="the call's items, in its order")
    items: dict[str, Item] = {}
    files: dict[RelativePath, str] = Field(
        default={}, description="SHA-256 of each file as Veduta last wrote it, by path in OUT"
    )
    pending: dict[RelativePath, str] = Field(
        default={}, description="the same for files that are being renamed into place"
    )

    _folders: dict[str, set[str]] | None = PrivateAttr(default=None)
    _saved: str | None = PrivateAttr(default=None)

    def save(self, out: Path) -> None:
        """Write the record whole or not at all."""
        # By name: what is made at once is done in another order each time.
        ordered = {"items": _by_name(self.items), "files": _by_name(self.files)}
        told = self.model_copy(update=ordered)
        content = (told.model_dump_json(by_alias=True, indent=1) + "\n").encode()
        write_bytes(out / PRIVATE / RECORD, content)
        self._saved = hashlib.sha256(content).hexdigest()
        (out / PRIVATE / JOURNAL).unlink(missing_ok=True)

    def change(self, out: Path, change: Change) -> None:
        """Change the record, here and on the disk."""
        self.apply(change)
        journal = out / PRIVATE / JOURNAL
        if len(self.files) < JOURNAL_FROM or self._saved is None:
            self.save(out)
            return
        head = "" if journal.exists() else f"{self._saved}\n"
        with journal.open("a", encoding="utf-8") as lines:
            lines.write(f"{head}{change.model_dump_json()}\n")
            lines.flush()
            os.fsync(lines.fileno())

    def apply(self, change: Change) -> None:
        """Change the record here."""
        for name, item in change.items.items():
            if item is None:
                self.items.pop(name, None)
            else:
                self.items[name] = item
        for path, digest in change.files.items():
            if digest is None:
                self.files.pop(path, None)
            else:
                self.files[path] = digest
            if self._folders is not None:
                _note(self._folders, path, is_there=digest is not None)
        self.pending = change.pending

    def files_of(self, item: str) -> list[str]:
        """The paths in OUT of the files that belong to one item."""
        if self._folders is None:
            self._folders = {}
            for path in self.files:
                _note(self._folders, path, is_there=True)
        return sorted(self._folders.get(item, ()))


def _note(folders: dict[str, set[str]], path: str, *, is_there: bool) -> None:
    """Keep in mind of which folders, all those around it, a file is; CALL is for those of none."""
    parts = path.split("/")
    for count in range(1, len(parts)) if len(parts) > 1 else (0,):
        folder = "/".join(parts[:count]) or CALL
        if is_there:
            folders.setdefault(folder, set()).add(path)
        else:
            folders.get(folder, set()).discard(path)


def load_record(out: Path) -> RunRecord | None:
    """The record in `out`, or None where Veduta has written nothing."""
    path = out / PRIVATE / RECORD
    try:
        content = path.read_bytes()
        record = RunRecord.model_validate_json(content)
        for change in _changes(out / PRIVATE / JOURNAL, hashlib.sha256(content).hexdigest()):
            record.apply(change)
        return record
    except FileNotFoundError:
        return None
    except NotADirectoryError as error:
        raise InputError(out, "is not a folder", "Choose another one with -o.") from error
    except ValidationError as error:
        raise InputError(
            path,
            f"is not a run record of this version ({first_fault(error)})",
            "Choose another folder with -o.",
        ) from error


def _changes(journal: Path, digest: str) -> Iterator[Change]:
    """What was changed in the record of this digest."""
    try:
        with journal.open(encoding="utf-8", errors="replace") as lines:
            if lines.readline() == f"{digest}\n":
                for line in lines:
                    if line.endswith("\n"):
                        yield Change.model_validate_json(line)
    except FileNotFoundError:
        return


def _by_name(given: dict[str, T]) -> dict[str, T]:
    return dict(sorted(given.items()))
