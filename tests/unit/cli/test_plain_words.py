"""Words of a command line that name files whose names are not UTF-8, and words that name none."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from veduta.cli.main import main
from veduta.cli.plain_words import plain_words
from veduta.run import names as run_names
from veduta.run.errors import InputError

E9 = os.fsdecode(b"\xe9")
RULES = "Lot --> extrude(3)\n"


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _badly_named(folder: Path) -> None:
    folder.mkdir()
    (folder / f"a{E9}.txt").write_text("a")


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux removes a working folder")
@pytest.mark.parametrize("call", ["view /nothere", "view nothere", "grammar check /nothere.cga"])
def test_a_working_folder_that_was_removed_is_no_bug(
    call: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    gone = here / "gone"
    gone.mkdir()
    os.chdir(gone)
    gone.rmdir()
    assert main(call.split()) == 2
    told = capsys.readouterr().err
    assert "nothere" in told
    assert "a bug" not in told


def test_an_action_is_no_folder(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _badly_named(here / "check")
    (here / "r.cga").write_text(RULES)
    assert main(["grammar", "check", "r.cga"]) == 0
    assert "0 errors" in capsys.readouterr().out


def test_values_that_name_no_file_stay(here: Path) -> None:
    for name in ("Lot", "all", "derive", "in"):
        _badly_named(here / name)
    words = ["derive", "in", "--start", "Lot", "--lot=all"]
    with plain_words("grammar", words) as plain:
        assert [plain[0], *plain[2:]] == [words[0], *words[2:]]
        assert os.listdir(plain[1]) == ["a=E9.txt"]
    with plain_words("photos", ["in", "--pairs", "all", "--out", "all"]) as plain:
        assert plain[1:] == ["--pairs", "all", "--out", "all"]


@pytest.mark.parametrize("turn", [list.sort, list.reverse])
def test_which_names_are_found_is_not_left_to_the_disk(
    turn: Callable[[list[str]], None], here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("in/a", "in/b"):
        (here / name).mkdir(parents=True)
    for number in range(8):
        (here / "in" / "b" / str(number)).write_text("")
    listed = os.walk

    def walk(folder: str) -> Iterator[tuple[str, list[str], list[str]]]:
        for where, folders, files in listed(folder):
            folders.sort()
            turn(folders)
            yield where, folders, files

    monkeypatch.setattr(os, "walk", walk)
    monkeypatch.setattr(run_names, "MOST_ENTRIES", 6)
    with plain_words("photos", ["in"]) as plain:
        assert plain == ["in"]
    (here / "in" / "a" / f"{E9}.txt").write_text("")
    with pytest.raises(InputError, match="more than 6 files"), plain_words("photos", ["in"]):
        pass
