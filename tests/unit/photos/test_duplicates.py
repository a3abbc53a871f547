"""One picture in several files: the best of them is used."""

from __future__ import annotations

from pathlib import Path

import pytest
from photo_scene import ARC, take_photo, write_photos
from PIL import Image
from PIL.ExifTags import IFD, Base

from veduta.photos.intake.call import plan_call
from veduta.photos.intake.read import read_photos


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_photos(tmp_path, ARC[:2])
    return tmp_path


def test_a_preview_before_its_photo(folder: Path) -> None:
    """The larger file comes later by its name, and keeps its own place in the order."""
    with Image.open(folder / "view1.png") as image:
        image.resize((240, 180), Image.Resampling.BOX).save(folder / "a-preview.png")
    read = read_photos(plan_call(folder).sources)
    assert [(photo.image_id, photo.name) for photo in read.photos] == [
        (1, "view0.png"),
        (2, "view1.png"),
    ]
    assert read.set_aside == (("a-preview.png", "shows the same picture as view1.png"),)


def test_the_same_pixels_with_other_exif(folder: Path) -> None:
    """Whichever comes first, that with a focal length is used."""
    exif = Image.Exif()
    exif[Base.Orientation] = 1
    exif.get_ifd(IFD.Exif)[Base.FocalLengthIn35mmFilm] = 28
    with Image.open(folder / "view0.png") as image:
        image.save(folder / "z.png", exif=exif)
    with Image.open(folder / "view1.png") as image:
        image.save(folder / "b.png", exif=exif)
    read = read_photos(plan_call(folder).sources)
    assert [photo.name for photo in read.photos] == ["b.png", "z.png"]
    assert all(photo.focal_px is not None for photo in read.photos)
    assert {name for name, _ in read.set_aside} == {"view0.png", "view1.png"}


def test_all_the_same_photo(folder: Path) -> None:
    for path in list(folder.iterdir()):
        path.unlink()
    for quality in (60, 75, 90):
        Image.fromarray(take_photo(ARC[0])).save(folder / f"{quality}.jpg", quality=quality)
    read = read_photos(plan_call(folder).sources)
    assert [photo.name for photo in read.photos] == ["60.jpg"]
    assert len(read.set_aside) == 2


def test_pictures_of_neighbouring_places_are_two(folder: Path) -> None:
    read = read_photos(plan_call(folder).sources)
    assert len(read.photos) == 2
