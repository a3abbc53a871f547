"""Each file of the folder that is not used is named with its reason."""

from __future__ import annotations

from pathlib import Path

import pytest
from photo_scene import write_photos

from veduta.photos.intake.call import plan_call
from veduta.photos.intake.given import Given


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


def test_all_of_many_other_files_are_named(folder: Path) -> None:
    names = [f"table-{number:02d}.csv" for number in range(30)]
    for name in names:
        (folder / name).write_bytes(b"x")
    told = " ".join(plan_call(folder).notes)
    assert all(name in told for name in names)


def test_what_the_call_names_is_not_called_unused(folder: Path) -> None:
    given = Given(named=(folder / "geo.txt", folder / "notes.txt"))
    told = " ".join(plan_call(folder, given).notes)
    assert "geo.txt" not in told
    assert "notes.txt" not in told


def test_photos_in_folders_below_are_told(folder: Path) -> None:
    write_photos(folder / "roof")
    (folder / "texts").mkdir()
    told = [note for note in plan_call(folder).notes if "/ has" in note]
    assert len(told) == 1
    assert told[0].startswith("roof/ has ")


def test_jpeg_by_its_other_names_is_read(folder: Path) -> None:
    first = sorted(folder.glob("*.png")) + sorted(folder.glob("*.jpg"))
    from PIL import Image

    Image.open(first[0]).convert("RGB").rotate(180).save(folder / "turned.jfif", "JPEG")
    call = plan_call(folder)
    assert "turned.jfif" in {source.name for source in call.sources}


def test_files_of_a_rig_are_named_too(tmp_path: Path) -> None:
    for camera in ("front", "back"):
        write_photos(tmp_path / camera)
    (tmp_path / "back" / "log.txt").write_bytes(b"x")
    write_photos(tmp_path)
    call = plan_call(tmp_path, rig=True)
    assert any("back: no photos, not used: log.txt" in note for note in call.notes)
    beside = [name for name, why in call.unread if "beside the cameras' folders" in why]
    assert beside == sorted(path.name for path in tmp_path.iterdir() if path.is_file())
