"""What happens to an OUT that exists, rule by rule."""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from veduta.run.errors import InputError
from veduta.run.outputs import OutFolder, Standing, open_out
from veduta.run.record import CALL, load_record
from veduta.run.report import Failure


def make(out: OutFolder, item: str = "a", content: str = "one", *names: str) -> None:
    work = out.work_folder(item)
    for name in names or ("x.txt", "y.txt"):
        (work / name).write_text(content)
    out.publish(item, "k", work)


def finished(path: Path, key: str = "k", content: str = "one") -> None:
    with open_out(path, "facade", key, force=path.exists()) as out:
        make(out, "a", content)
        out.finish()


def test_new_folder(tmp_path: Path) -> None:
    with open_out(tmp_path / "new" / "out", "facade", "k") as out:
        assert out.standing is Standing.NEW
        make(out)
        out.finish()
    assert (tmp_path / "new" / "out" / "a" / "x.txt").read_text() == "one"
    assert not (tmp_path / "new" / "out" / ".veduta" / "work").exists()


def test_same_call_is_up_to_date(tmp_path: Path) -> None:
    finished(tmp_path / "out")
    with open_out(tmp_path / "out", "facade", "k") as out:
        assert out.standing is Standing.UP_TO_DATE
        assert out.is_current("a", "k")
        assert out.edited() == []


def test_missing_file_is_made_again(tmp_path: Path) -> None:
    finished(tmp_path / "out")
    (tmp_path / "out" / "a" / "x.txt").unlink()
    with open_out(tmp_path / "out", "facade", "k") as out:
        assert out.standing is Standing.RESUMED
        assert not out.is_current("a", "k")


def test_unfinished_resumes(tmp_path: Path) -> None:
    with open_out(tmp_path / "out", "facade", "k") as out:
        make(out, "a")
    with open_out(tmp_path / "out", "facade", "k") as out:
        assert out.standing is Standing.RESUMED
        assert out.is_current("a", "k")
        assert not out.is_current("b", "k")


def test_other_call_is_refused_without_force(tmp_path: Path) -> None:
    finished(tmp_path / "out")
    with (
        pytest.raises(InputError, match="other inputs or options"),
        open_out(tmp_path / "out", "facade", "other"),
    ):
        pass
    with (
        pytest.raises(InputError, match="veduta facade"),
        open_out(tmp_path / "out", "grammar", "k"),
    ):
        pass


def test_another_call_without_items_is_refused_too(tmp_path: Path) -> None:
    """Of a house, all files are the call's own."""
    out = tmp_path / "out"
    with open_out(out, "plan", "k") as opened:
        make(opened, CALL)
        opened.finish()
    with pytest.raises(InputError, match="of other inputs or options"), open_out(out, "plan", "l"):
        pass
    with open_out(out, "plan", "l", force=True) as opened:
        assert opened.standing is Standing.REPLACED


def test_unfinished_of_another_call_is_refused_without_force(tmp_path: Path) -> None:
    with open_out(tmp_path, "facade", "k") as out:
        make(out, "a")
    with (
        pytest.raises(InputError, match="unfinished result of other inputs or options"),
        open_out(tmp_path, "facade", "other"),
    ):
        pass
    assert (tmp_path / "a" / "x.txt").read_text() == "one"
    with open_out(tmp_path, "facade", "other", force=True) as out:
        assert out.standing is Standing.REPLACED
        assert not out.is_current("a", "k")


def test_a_run_that_resumes_keeps_what_was_edited(tmp_path: Path) -> None:
    with open_out(tmp_path, "facade", "k") as out:
        make(out, "a")
    edited = tmp_path / "a" / "x.txt"
    edited.write_text("mine")
    (tmp_path / "a" / "y.txt").unlink()
    with open_out(tmp_path, "facade", "k") as out:
        assert (out.standing, out.edited()) == (Standing.RESUMED, ["a/x.txt"])
        assert not out.is_current("a", "k")
        make(out, "a", "two")
    assert edited.read_text() == "mine"
    assert (tmp_path / "a" / "y.txt").read_text() == "two"


def test_only_a_run_can_be_amended(tmp_path: Path) -> None:
    with (
        pytest.raises(InputError, match="was not made by veduta"),
        open_out(tmp_path / "new", "facade (rebuild)", "k", amend=True),
    ):
        pass
    finished(tmp_path / "out")
    with open_out(tmp_path / "out", "facade (rebuild)", "other", amend=True) as out:
        assert out.standing is Standing.AMENDED
        assert out.record.command == "facade"


def test_force_replaces_and_forgets_what_is_left_over(tmp_path: Path) -> None:
    finished(tmp_path / "out")
    with open_out(tmp_path / "out", "facade", "other", force=True) as out:
        assert out.standing is Standing.REPLACED
        assert not out.is_current("a", "k")
        make(out, "a", "two", "y.txt", "z.txt")
        out.finish()
    found = {file.name: file.read_text() for file in (tmp_path / "out" / "a").iterdir()}
    assert found == {"y.txt": "two", "z.txt": "two"}


def test_no_empty_folders_are_left(tmp_path: Path) -> None:
    """Neither of an item that has no files, nor where all files of a folder have gone."""
    path = tmp_path / "out"
    with open_out(path, "facade", "k") as out:
        work = out.work_folder("a")
        (work / "deep" / "er").mkdir(parents=True)
        (work / "deep" / "er" / "x.txt").write_text("one")
        out.publish("a", "k", work)
        make(out, "b")
        out.publish("c", "k", out.work_folder("c"))
        out.finish()
    assert not (path / "c").exists()
    (path / "b" / "mine.txt").write_text("mine")
    with open_out(path, "facade", "other", force=True) as out:
        for item in ("a", "b"):
            out.publish(item, "other", out.work_folder(item))
        out.finish()
    assert not (path / "a").exists()
    assert [file.name for file in (path / "b").iterdir()] == ["mine.txt"]


def refused(path: Path, *names: str) -> None:
    def run() -> None:
        with open_out(path, "facade", "k") as out:
            if names:
                make(out, "a", "one", *names)
            out.work_folder("b").joinpath("half.txt").write_text("half")
            raise InputError("a.jpg", "is too small", "Give another.")

    with pytest.raises(InputError, match="too small"):
        run()


def test_a_refused_call_leaves_no_new_folder(tmp_path: Path) -> None:
    """But what it has finished stays, and so does a folder that was there."""
    refused(tmp_path / "new")
    assert not (tmp_path / "new").exists()
    refused(tmp_path / "half", "x.txt")
    assert (tmp_path / "half" / "a" / "x.txt").exists()
    (tmp_path / "there").mkdir()
    refused(tmp_path / "there")
    assert (tmp_path / "there").exists()


def test_edited_file_is_never_replaced(tmp_path: Path) -> None:
    finished(tmp_path / "out")
    edited = tmp_path / "out" / "a" / "x.txt"
    edited.write_text("mine")
    for _ in range(2):  # also not by the second --force
        with open_out(tmp_path / "out", "facade", "other", force=True) as out:
            assert out.edited("a") == ["a/x.txt"]
            make(out, "a", "two")
            out.finish()
            assert out.kept == ["a/x.txt"]
        assert edited.read_text() == "mine"
        assert (tmp_path / "out" / "a" / "y.txt").read_text() == "two"


def test_edited_file_is_never_removed(tmp_path: Path) -> None:
    finished(tmp_path / "out")
    edited = tmp_path / "out" / "a" / "x.txt"
    edited.write_text("mine")
    with open_out(tmp_path / "out", "facade", "other", force=True) as out:
        make(out, "a", "two", "z.txt")
        assert out.kept == ["a/x.txt"]
    assert edited.read_text() == "mine"
    assert not (tmp_path / "out" / "a" / "y.txt").exists()


def test_foreign_folder_is_refused_and_its_files_stay(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "x.txt").write_text("mine")
    with pytest.raises(InputError, match="not made by veduta"), open_out(tmp_path, "facade", "k"):
        pass
    assert not (tmp_path / ".veduta").exists()
    with open_out(tmp_path, "facade", "k", force=True) as out:
        make(out, "a", "two")
        assert out.kept == ["a/x.txt"]
    assert (tmp_path / "a" / "x.txt").read_text() == "mine"


def test_only_failures_are_nothing_to_protect(tmp_path: Path) -> None:
    failure = Failure(subject="a.jpg", kind="not-found", reason="no facade")
    with open_out(tmp_path, "facade", "k") as out:
        out.publish("a", "k", out.work_folder("a"), failure=failure)
        out.finish()
    with open_out(tmp_path, "facade", "other") as out:
        assert out.standing is Standing.REPLACED


@pytest.mark.parametrize("renames", [0, 1, 2])
def test_killed_between_renames(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, renames: int
) -> None:
    """Wherever a kill falls, no file of ours is taken for an edited one."""
    finished(tmp_path / "out")

    class Killed(BaseException):
        pass

    done: list[Path] = []
    replace = os.replace

    def dying_replace(source: Path, target: Path) -> None:
        if Path(target).suffix == ".txt":
            if len(done) == renames:
                raise Killed
            done.append(target)
        replace(source, target)

    monkeypatch.setattr(os, "replace", dying_replace)

    def run() -> None:
        with open_out(tmp_path / "out", "facade", "k", force=True) as out:
            make(out, "a", "two")
            raise Killed

    with pytest.raises(Killed):
        run()
    monkeypatch.undo()
    with open_out(tmp_path / "out", "facade", "k") as out:
        assert out.standing is Standing.RESUMED
        assert out.edited() == []
        assert out.is_current("a", "k") == (renames == 2)
        make(out, "a", "three")
        out.finish()
    assert (tmp_path / "out" / "a" / "x.txt").read_text() == "three"


class Disk:
    """A disk on which, from some call of a function of `os` on, there is no room."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, name: str, calls: int) -> None:
        self.calls = calls
        real = getattr(os, name)

        def refuse(path: str, *arguments: Any, **named: Any) -> object:
            needs_room = {
                "open": lambda: arguments[0] & os.O_CREAT,
                "mkdir": lambda: not Path(path).exists(),
            }.get(name, lambda: True)
            self.calls -= bool(needs_room())
            if self.calls < 0 and needs_room():
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return real(path, *arguments, **named)

        monkeypatch.setattr(os, name, refuse)


def refusal(path: Path) -> InputError | None:
    """What making a result anew is refused with."""
    try:
        with open_out(path, "facade", "k", force=True) as out:
            make(out, "a", "two", "y.txt", "z.txt")
            out.finish()
    except InputError as error:
        return error
    return None


@pytest.mark.parametrize("name", ["replace", "fsync", "mkdir", "open"])
def test_a_full_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """Wherever it is full, it is said so, nothing is half there, and the next run goes on."""
    for calls in range(100):
        path = tmp_path / str(calls)
        finished(path, content="one")
        with monkeypatch.context() as patch:
            disk = Disk(patch, name, calls)
            error = refusal(path)
        if disk.calls >= 0:
            break
        assert error is not None
        assert error.subject == str(path)
        assert "No space left on device" in error.fault
        assert "the same command goes on" in error.remedy
        assert {file.read_text() for file in (path / "a").iterdir()} <= {"one", "two"}
        assert {file.name for file in (path / ".veduta").iterdir()} == {"run.json", "lock"}
        with open_out(path, "facade", "k") as out:
            assert out.edited() == []
            if not out.is_current("a", "k"):
                make(out, "a", "two", "y.txt", "z.txt")
            out.finish()
        assert load_record(path).state == "finished"
    assert 0 < calls < 99


def test_permissions_are_not_taken_for_a_full_disk(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*arguments: object) -> None:
        raise OSError(errno.EACCES, os.strerror(errno.EACCES))

    with open_out(tmp_path, "facade", "k") as out:
        monkeypatch.setattr(os, "replace", refuse)
        with pytest.raises(InputError, match=r"Permission denied.*\. Mend that"):
            make(out)


def test_one_writer_at_a_time_and_a_dead_one_is_no_hindrance(tmp_path: Path) -> None:
    code = (
        "import sys, time; from pathlib import Path; from veduta.run.outputs import open_out\n"
        "with open_out(Path(sys.argv[1]), 'facade', 'k'):\n"
        "    print('open', flush=True); time.sleep(60)"
    )
    holder = subprocess.Popen(
        [sys.executable, "-c", code, str(tmp_path / "out")], stdout=subprocess.PIPE, text=True
    )
    try:
        assert holder.stdout is not None
        assert holder.stdout.readline() == "open\n"
        with (
            pytest.raises(InputError, match=f"process {holder.pid}"),
            open_out(tmp_path / "out", "facade", "k"),
        ):
            pass
    finally:
        holder.kill()
        holder.wait()
    with open_out(tmp_path / "out", "facade", "k") as out:
        assert out.standing is Standing.RESUMED


def test_out_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    for path in (tmp_path / "file", tmp_path / "file" / "out", Path("/proc/veduta/out")):
        with pytest.raises(InputError, match="-o"), open_out(path, "facade", "k"):
            pass


@pytest.mark.parametrize("path", ["../x", "/etc/passwd", "a/../../x", ".veduta/run.json"])
def test_a_record_cannot_reach_outside(tmp_path: Path, path: str) -> None:
    finished(tmp_path)
    record = tmp_path / ".veduta" / "run.json"
    record.write_text(record.read_text().replace("a/x.txt", path))
    with pytest.raises(InputError, match="run record"):
        load_record(tmp_path)


KILLED = """
import os, signal, sys
from pathlib import Path
from veduta.run import atomic
from veduta.run.outputs import open_out

with open_out(Path(sys.argv[1]), "facade", "k") as out:
    cache = out.path / ".veduta" / "cache"
    cache.mkdir()
    with atomic.atomic_folder(cache / "views") as folder:
        (folder / "a").write_text("half")
        with atomic.atomic_write(cache / "b"):
            atomic.sync_file = lambda path: os.kill(os.getpid(), signal.SIGKILL)
            out.record.save(out.path)
"""


def test_halves_that_a_killed_run_left_are_taken_away(tmp_path: Path) -> None:
    path = tmp_path / "out"
    run = subprocess.run([sys.executable, "-c", KILLED, path], check=False)
    assert run.returncode < 0
    private = path / ".veduta"
    assert len(list(private.rglob(".*.tmp"))) == 3
    with open_out(path, "facade", "k") as out:
        assert out.standing is Standing.RESUMED
    assert {file.name for file in private.rglob("*")} == {"lock", "run.json", "cache"}
