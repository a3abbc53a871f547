"""Which folder is a place, and what a person is told who names another."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.run.errors import InputError
from veduta.studio.content import SHOWN, place_folder

ANY = "Give a folder that veduta wrote: what was given with -o to facade, plan, drive or another verb."


def make_places(*folders: Path) -> None:
    for folder in folders:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "place.json").touch()


def told(out: Path, verb: str = "view") -> str:
    with pytest.raises(InputError) as raised:
        place_folder(out, verb)
    return raised.value.remedy


def test_a_place_is_found(tmp_path: Path) -> None:
    make_places(tmp_path)
    assert place_folder(tmp_path) == tmp_path.resolve()


def test_places_below_are_named(tmp_path: Path) -> None:
    make_places(tmp_path / "b", tmp_path / "a", tmp_path / ".hidden", tmp_path / "c" / "place")
    (tmp_path / "empty").mkdir()
    names = f"{tmp_path}/a, {tmp_path}/b, {tmp_path}/c/place"
    assert told(tmp_path) == f"Did you mean: veduta view {names}"
    assert told(tmp_path, "export") == f"Did you mean: veduta export {names}"


def test_names_can_be_typed_as_they_are_told(tmp_path: Path) -> None:
    make_places(tmp_path / "my house")
    assert told(tmp_path) == f"Did you mean: veduta view '{tmp_path}/my house'"


def test_many_places_are_counted(tmp_path: Path) -> None:
    make_places(*(tmp_path / f"p{number}" for number in range(SHOWN + 3)))
    assert told(tmp_path).endswith(f"{tmp_path}/p{SHOWN - 1} and 3 more")


def test_the_place_that_a_result_is_part_of(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_places(tmp_path)
    (tmp_path / "house").mkdir()
    assert told(tmp_path / "house") == f"Did you mean: veduta view {tmp_path}"
    monkeypatch.chdir(tmp_path / "house")
    assert told(Path()) == f"Did you mean: veduta view {tmp_path.resolve()}"


def test_no_place_anywhere(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    assert told(tmp_path / "a") == ANY
    assert told(tmp_path / "none") == ANY
