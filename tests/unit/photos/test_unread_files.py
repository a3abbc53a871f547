"""Each file of the folder that is not used is named with its reason."""

from __future__ import annotations

from pathlib import Path

import pytest
from photo_scene import write_photos

from veduta.photos.intake.call import plan_call


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    found = tmp_path / "photos"
    write_photos(found)
    for name in ("a.HEIC", "b.bmp", "c.CR2", "d.dng", "notes.txt", "geo.txt", "walk.MP4", ".hid"):
        (found / name).write_bytes(b"x")
    return found


def test_pictures_that_are_not_read_are_left_out_by_name(folder: Path) -> None:
    call = plan_call(folder)
    why = dict(call.unread)
    assert sorted(why) == ["b.bmp", "c.CR2", "d.dng"]
    assert "a.HEIC" in {source.name for source in call.sources}
    assert "BMP picture" in why["b.bmp"]
    assert "raw photo" in why["c.CR2"]
    assert not {source.name for source in call.sources} & set(why)


def test_other_files_are_told(folder: Path) -> None:
    notes = " | ".join(plan_call(folder).notes)
    assert "no photos, not used: notes.txt" in notes
    assert "geo.txt: give it with --positions" in notes
    assert "walk.MP4: is a film" in notes
    assert ".hid" not in notes
