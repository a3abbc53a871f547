"""The result folder OUT: who may write, what is already there, and what is never replaced.

The rules, for a call with certain inputs and options:

- OUT is new or empty: it is made.
- It holds an unfinished run of the same call: that run resumes.
- It holds the finished result of the same call: it is up to date (`--force` makes it anew).
- It holds results of another call, or files that Veduta did not make: refused without `--force`.
- A file whose digest is not the one that Veduta recorded has been edited. It belongs to the
  user and is never replaced or removed, not even with `--force`; it is named instead.

Results of an item are made in a folder under `OUT/.veduta/work` and renamed into place; the
digests are recorded before the first rename, so that a run killed in between recognises its own
files. One process at a time writes: the lock is the kernel's and ends with the process that
holds it, also by `kill -9`.
"""

from __future__ import annotations

import fcntl
import os
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import Literal

from pydantic import JsonValue

from veduta.run.atomic import drop_halves, sync_folder, sync_tree
from veduta.run.digests import file_digest
from veduta.run.errors import InputError, UnwritableError
from veduta.run.record import CALL, JOURNAL, PRIVATE, RECORD, Change, Item, RunRecord, load_record
from veduta.run.report import Failure


class Standing(Enum):
    """What the folder is to the call that opened it."""

    NEW = "new"
    RESUMED = "resumed"
    UP_TO_DATE = "up to date"
    REPLACED = "replaced"
    AMENDED = "amended"


@dataclass
class OutFolder:
    """An OUT that this process has opened and locked."""

    path: Path
    record: RunRecord
    standing: Standing
    former: dict[str, Item] = field(default_factory=dict)
    """The items of the run that this one replaces."""
    kept: list[str] = field(default_factory=list)
    """Files that were not replaced because they are the user's, as paths in OUT."""

    def is_current(self, item: str, key: str) -> bool:
        """Whether the item's result for `key` is there, with all its files."""
        known = self.record.items.get(item)
        if known is None or known.key != key or known.state == "publishing":
            return False
        return all((self.path / name).exists() for name in self.record.files_of(item))

    def is_done(self, item: str, key: str) -> bool:
        """Whether the item's result for `key` was finished; files of it may have gone since."""
        known = self.record.items.get(item)
        return known is not None and known.key == key and known.state == "done"

    def edited(self, item: str | None = None) -> list[str]:
        """The recorded files (of one item) that somebody has changed, as paths in OUT."""
        names = sorted(self.record.files) if item is None else self.record.files_of(item)
        return [name for name in names if self._is_users(name)]

    def work_path(self, item: str) -> Path:
        """The folder in which an item's files are made."""
        return self.path / PRIVATE / "work" / ("call" if item == CALL else f"item-{item}")

    def work_folder(self, item: str) -> Path:
        """The same folder, made and empty."""
        folder = self.work_path(item)
        with writing_to(self.path):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
        return folder

    def publish(
        self,
        item: str,
        key: str,
        work: Path,
        summary: dict[str, JsonValue] | None = None,
        failure: Failure | None = None,
        stays: Sequence[str] = (),
    ) -> None:
        """Make the content of `work` the item's result; what the user edited stays.

        `stays`: folders of the item whose files belong to the result though `work` has none.
        UnwritableError where the system refuses to write: the next run makes the item again.
        """
        state: Literal["failed", "done"] = "failed" if failure else "done"
        result = Item(key=key, state=state, failure=failure, summary=summary or {})
        with writing_to(self.path):
            self._publish(item, work, result, tuple(f"{item}/{name}/" for name in stays))

    def _publish(self, item: str, work: Path, result: Item, stays: tuple[str, ...]) -> None:
        new = _digests(work, "" if item == CALL else f"{item}/")
        users = [name for name in new if self._is_users(name)]
        former = [name for name in self.record.files_of(item) if name not in new]
        stale = [name for name in former if not name.startswith(stays)]
        ours = {name: digest for name, digest in new.items() if name not in users}

        begun = Item(key=result.key, state="publishing", summary=result.summary)
        self.record.change(self.path, Change(items={item: begun}, pending=ours))
        self._move_into_place(item, work, list(ours))
        gone: dict[str, str | None] = {name: None for name in stale if self._is_removed(name)}
        self.record.change(self.path, Change(items={item: result}, files={**gone, **ours}))
        self.kept.extend(users)

    def keep(self, item: str) -> bool:
        """Leave an item of the former run as it is; False where it was not done."""
        known = self.former.get(item) or self.record.items.get(item)
        if known is None or known.state != "done":
            return False
        self.record.items[item] = known
        self._save()
        return True

    def forget(self, item: str) -> None:
        """Have the next run of the same call make the item again."""
        if item in self.record.items:
            with writing_to(self.path):
                self.record.change(self.path, Change(items={item: None}))

    def finish(self) -> None:
        """Everything that the call asked for is there."""
        self.record.state = "finished"
        self._save()

    def _save(self) -> None:
        with writing_to(self.path):
            self.record.save(self.path)

    def _move_into_place(self, item: str, work: Path, names: list[str]) -> None:
        sync_tree(work)
        if not names:
            shutil.rmtree(work, ignore_errors=True)
            return
        target = self.path if item == CALL else self.path / item
        target.parent.mkdir(exist_ok=True)
        if not target.exists() and len(names) == sum(1 for file in work.rglob("*")):
            os.replace(work, target)
            sync_folder(target.parent)
        else:
            target.mkdir(exist_ok=True)
            for name in names:
                destination = self.path / name
                destination.parent.mkdir(parents=True, exist_ok=True)
                os.replace(work / destination.relative_to(target), destination)
            shutil.rmtree(work, ignore_errors=True)
            sync_folder(target)
        sync_folder(self.path)

    def _is_users(self, name: str) -> bool:
        """Whether a file is there that is not as Veduta wrote it."""
        path = self.path / name
        return path.exists() and (
            not path.is_file() or file_digest(path) != self.record.files.get(name)
        )

    def _is_removed(self, name: str) -> bool:
        """Remove a file, unless it is the user's."""
        if self._is_users(name):
            self.kept.append(name)
            return False
        path = self.path / name
        path.unlink(missing_ok=True)
        with suppress(OSError):  # of the first that is not empty, or is not there
            for folder in path.relative_to(self.path).parents[:-1]:
                (self.path / folder).rmdir()
        return True


@contextmanager
def open_out(
    path: Path, command: str, key: str, *, force: bool = False, amend: bool = False
) -> Iterator[OutFolder]:
    """Open OUT for a call, by the rules above; `amend` adds to whatever run made it."""
    made = not path.exists()
    try:
        _refuse_foreign(path, force)
        # Of a link to nothing, what it names is made.
        Path(os.path.realpath(path), PRIVATE).mkdir(parents=True, exist_ok=True)
        lock = (path / PRIVATE / "lock").open("a+")
    except OSError as error:
        raise InputError(
            path, f"cannot be written ({error.strerror})", "Choose another folder with -o."
        ) from error
    with lock:
        work = path / PRIVATE / "work"
        with writing_to(path):
            _take(lock.fileno(), path)
            record = load_record(path)
            if record is not None:
                _settle(record, path)
            out = _open_locked(path, record, command, key, force=force, amend=amend)
            shutil.rmtree(work, ignore_errors=True)
            drop_halves(path / PRIVATE)
            if out.standing is not Standing.UP_TO_DATE:
                out.record.save(path)
        try:
            yield out
        except InputError as error:
            shutil.rmtree(work, ignore_errors=True)
            if not isinstance(error, UnwritableError):  # the same call goes on from there
                _remove_bare(out, made=made)
            raise
        finally:
            shutil.rmtree(work, ignore_errors=True)
            if (path / PRIVATE / JOURNAL).exists():
                with suppress(OSError):  # then the next run finds the changes in the journal
                    out.record.save(path)


@contextmanager
def writing_to(out: Path) -> Iterator[None]:
    """Turn what the system refuses (a full disk, a quota, permissions) into an UnwritableError.

    It stands wherever something is written into OUT; `out` is what the message names.
    """
    try:
        yield
    except OSError as error:
        then = ": what is finished is on disk, and the same command goes on from there"
        raise UnwritableError.of(error, out, then) from error


def _remove_bare(out: OutFolder, *, made: bool) -> None:
    """Take a new OUT away in which a call that was refused has left nothing but its record."""
    private = out.path / PRIVATE
    if out.standing is not Standing.NEW or not made or out.record.items:
        return
    own = {private / "lock", private / RECORD, private / JOURNAL}
    if any(file not in own for file in out.path.rglob("*") if not file.is_dir()):
        return
    shutil.rmtree(os.path.realpath(out.path), ignore_errors=True)


def _refuse_foreign(path: Path, force: bool) -> None:
    """Refuse a folder with files that Veduta did not make."""
    if path.exists() and not path.is_dir():
        raise InputError(path, "is a file, not a folder", "Choose another name with -o.")
    if force or not path.exists() or (path / PRIVATE).exists() or not any(path.iterdir()):
        return
    raise InputError(
        path,
        "is not empty and was not made by veduta",
        "Choose a new folder with -o, or --force to write beside the files that are there.",
    )


def _take(descriptor: int, out: Path) -> None:
    """Lock OUT for this process; the file names the holder for others to read."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError as error:
        holder = os.pread(descriptor, 20, 0).decode("ascii", "replace").strip() or "unknown"
        raise InputError(
            out,
            f"another run (process {holder}) is writing into it",
            "Wait for it to end, or choose another folder with -o.",
        ) from error
    os.ftruncate(descriptor, 0)
    os.write(descriptor, f"{os.getpid()}\n".encode())


def _settle(record: RunRecord, out: Path) -> None:
    """Recognise the files that a killed run had renamed into place but not yet recorded."""
    there = {
        name: digest
        for name, digest in record.pending.items()
        if (out / name).is_file() and file_digest(out / name) == digest
    }
    record.apply(Change(files=there))


def _open_locked(
    path: Path, record: RunRecord | None, command: str, key: str, *, force: bool, amend: bool
) -> OutFolder:
    if amend:
        if record is None:
            raise InputError(
                path, "was not made by veduta", "Choose a new folder with -o to rebuild into."
            )
        return OutFolder(path, record, Standing.AMENDED)
    if record is None:
        return OutFolder(path, RunRecord(command=command, key=key), Standing.NEW)
    if record.command == command and record.key == key:
        complete = all(
            item.state != "publishing" and (path / file).exists()
            for name, item in record.items.items()
            for file in record.files_of(name)
        )
        if record.state == "finished" and not force and complete:
            return OutFolder(path, record, Standing.UP_TO_DATE)
        if record.state == "unfinished" or not force:
            record.state = "unfinished"
            return OutFolder(path, record, Standing.RESUMED)
    elif not force and _has_results(record):
        raise InputError(
            path,
            f"holds the {record.state} result of other inputs or options"
            if record.command == command
            else f"holds a result of `veduta {record.command}`",
            "Choose another folder with -o, or --force to replace it"
            " (files that were edited are kept).",
        )
    fresh = RunRecord(command=command, key=key, files=record.files)
    return OutFolder(path, fresh, Standing.REPLACED, former=record.items)


def _has_results(record: RunRecord) -> bool:
    """Whether anything was made: the call itself counts where it has no items of its own."""
    items = {name: item for name, item in record.items.items() if name != CALL} or record.items
    return any(item.state != "failed" for item in items.values())


def _digests(folder: Path, prefix: str) -> dict[str, str]:
    """The digest of every file below `folder`, by its path in OUT."""
    return {
        prefix + file.relative_to(folder).as_posix(): file_digest(file)
        for file in sorted(folder.rglob("*"))
        if file.is_file()
    }
