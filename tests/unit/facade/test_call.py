"""What a call is asked to do: which files, under which names."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from veduta.facade.call import plan_call
from veduta.facade.load import MAX_BYTES
from veduta.imaging.read import MAX_FILE_BYTES
from veduta.run.errors import InputError


def touch(path: Path, content: str = "x") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content)
    return path


def test_order_folders_and_doubles(tmp_path: Path) -> None:
    for name in ("b.JPG", "a.png", "notes.txt", "deep/c.jpg"):
        touch(tmp_path / name)
    call = plan_call([tmp_path / "b.JPG", tmp_path, tmp_path / "deep" / ".." / "a.png"])
    assert [source.name for source in call.inputs] == ["b", "a"]
    assert call.kind == "photo"


def test_a_document_is_named_after_its_folder(tmp_path: Path) -> None:
    document = touch(tmp_path / "house" / "facade.json")
    touch(tmp_path / "house" / "rectified.jpg", "photo")
    (source,) = plan_call([document]).inputs
    assert (source.name, source.kind, len(source.digests)) == ("house", "document", 2)


def test_the_identity_is_content_and_name(tmp_path: Path) -> None:
    one = plan_call([touch(tmp_path / "1" / "a.jpg")]).inputs[0].identity
    assert one == plan_call([touch(tmp_path / "2" / "a.jpg")]).inputs[0].identity
    assert one != plan_call([touch(tmp_path / "3" / "a.jpg", "y")]).inputs[0].identity
    assert one != plan_call([touch(tmp_path / "4" / "b.jpg")]).inputs[0].identity


def test_refused(tmp_path: Path) -> None:
    photo = touch(tmp_path / "a.jpg")
    document = touch(tmp_path / "house" / "facade.json")
    touch(tmp_path / "house" / "rectified.jpg")
    empty = tmp_path / "empty"
    empty.mkdir()
    large = touch(tmp_path / "large.jpg")
    os.truncate(large, MAX_FILE_BYTES + 1)
    long = touch(tmp_path / "long" / "facade.json")
    os.truncate(long, MAX_BYTES + 1)
    loop = tmp_path / "loop" / "facade.json"
    loop.parent.mkdir()
    loop.symlink_to(loop)
    for paths, fault in [
        ([], "no image"),
        ([large], r"large.jpg: is 1 GB large, more than 1 GB"),
        ([long], r"facade.json: is 20 MB large, more than 20 MB"),
        ([loop], r"facade.json: cannot be read \(Too many levels"),
        ([tmp_path / (300 * "a") / "x.jpg"], r"cannot be read \(File name too long"),
        ([tmp_path / "none.jpg"], "does not exist"),
        ([empty], "without images"),
        ([photo, document], "between photos"),
        ([photo, touch(tmp_path / "b" / "a.png")], "same name"),
        ([touch(tmp_path / "place.json.jpg")], "cannot name"),
    ]:
        with pytest.raises(InputError, match=fault):
            plan_call(paths)
