"""An OUT that exists, through the command line: each case of the rules in `run.outputs`."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from command_line import facade, read_json, tree


@pytest.fixture
def out(tmp_path: Path, one_house: Path) -> Path:
    return Path(shutil.copytree(one_house, tmp_path / "out"))


def test_finished_and_same_is_up_to_date(out: Path, photo: Path) -> None:
    before = {file: file.stat().st_mtime_ns for file in out.rglob("*.*")}
    done = facade(photo, "-o", out)
    assert done.returncode == 0
    assert "up to date" in done.stdout
    assert before == {file: file.stat().st_mtime_ns for file in out.rglob("*.*")}


def test_a_lost_file_is_made_again(out: Path, photo: Path) -> None:
    before = tree(out)
    (out / "house0" / "model.glb").unlink()
    done = facade(photo, "-o", out)
    assert done.returncode == 0
    assert "up to date" not in done.stdout
    assert tree(out) == before


def test_other_options_are_refused(out: Path, photo: Path) -> None:
    before = tree(out)
    done = facade(photo, "-o", out, "--depth-m", "7")
    assert done.returncode == 2
    assert "--force" in done.stderr
    assert tree(out) == before


def test_force_replaces(out: Path, photo: Path, photos: list[Path]) -> None:
    before = tree(out)
    assert facade(photo, "-o", out, "--depth-m", "7", "--force").returncode == 0
    after = tree(out)
    assert after["house0/labels.png"] == before["house0/labels.png"]
    assert after["house0/model.glb"] != before["house0/model.glb"]
    done = facade(photos[1], "-o", out, "--force")
    assert done.returncode == 0
    assert f"{out / 'house0'}: is left from an earlier call" in done.stdout
    assert [part["id"] for part in read_json(out / "place.json")["parts"]] == ["house1"]


def test_changed_photo_is_another_input(out: Path, tmp_path: Path, photos: list[Path]) -> None:
    other = tmp_path / "house0.png"
    other.write_bytes(photos[1].read_bytes())
    assert facade(other, "-o", out).returncode == 2


def test_edited_picture_is_kept_and_named(out: Path, photo: Path) -> None:
    edited = out / "house0" / "overlay.png"
    edited.write_bytes(b"mine")
    for arguments in ([], ["--force"], ["--force", "--depth-m", "7"]):
        done = facade(photo, "-o", out, *arguments)
        assert done.returncode == 0
        assert f"{edited}: was edited and is left as it is\n" in done.stdout
        assert edited.read_bytes() == b"mine"


def test_edited_document_keeps_its_folder(out: Path, photo: Path) -> None:
    """New models beside an old document would contradict it."""
    edited = out / "house0" / "facade.json"
    edited.write_text(edited.read_text() + "\n")
    before = tree(out)
    done = facade(photo, "-o", out, "--force", "--depth-m", "7")
    assert done.returncode == 0
    assert (
        f"{edited}: was edited and is left as it is; to rebuild from it: "
        f"veduta facade {edited} -o {out}\n"
    ) in done.stdout
    assert tree(out) == before
    again = facade(photo, "-o", out, "--depth-m", "7")
    assert again.returncode == 0
    assert "up to date" in again.stdout


def test_foreign_folder(tmp_path: Path, photo: Path) -> None:
    (tmp_path / "letter.txt").write_text("mine")
    (tmp_path / "place.json").write_text("mine too")
    assert facade(photo, "-o", tmp_path).returncode == 2
    assert {file.name for file in tmp_path.iterdir()} == {"letter.txt", "place.json"}
    done = facade(photo, "-o", tmp_path, "--force")
    assert done.returncode == 0
    assert (tmp_path / "place.json").read_text() == "mine too"
    assert f"{tmp_path / 'place.json'}: was not made by veduta" in done.stdout
    assert (tmp_path / "house0" / "model.glb").is_file()


def test_an_empty_folder_is_welcome(tmp_path: Path, photo: Path) -> None:
    assert facade(photo, "-o", tmp_path).returncode == 0
