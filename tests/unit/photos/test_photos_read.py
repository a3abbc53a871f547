"""Which files are photos, and which of them are set aside."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from photo_scene import ARC, take_photo, write_photos
from PIL import Image
from PIL.ExifTags import IFD, Base

from veduta.photos.intake.call import plan_call
from veduta.photos.intake.read import read_photos
from veduta.run.errors import InputError


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("scene")
    write_photos(folder, ARC[:3])
    return folder


def copied(scene: Path, folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    for path in scene.iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    return folder


def test_photos_in_the_order_of_their_names(scene: Path) -> None:
    read = read_photos(plan_call(scene).sources)
    assert [photo.name for photo in read.photos] == ["view0.png", "view1.png", "view2.png"]
    assert [photo.image_id for photo in read.photos] == [1, 2, 3]
    assert {photo.group for photo in read.photos} == {1}
    assert read.set_aside == ()


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (lambda folder: None, "holds no photos"),
        (lambda folder: Image.new("RGB", (99, 99)).save(folder / "a.png"), "one photo"),
        (lambda folder: (folder / "a.jpg").mkdir(), "no photo that can be read"),
    ],
)
def test_too_few_photos(tmp_path: Path, made: object, words: str) -> None:
    made(tmp_path)  # type: ignore[operator]
    with pytest.raises(InputError, match=words):
        plan_call(tmp_path)


def test_a_folder_that_is_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        plan_call(tmp_path / "nowhere")
    (tmp_path / "file.jpg").write_bytes(b"x")
    with pytest.raises(InputError, match="is a file"):
        plan_call(tmp_path / "file.jpg")


def test_copies_are_told(scene: Path, tmp_path: Path) -> None:
    folder = copied(scene, tmp_path / "photos")
    (folder / "again.png").write_bytes((folder / "view1.png").read_bytes())
    call = plan_call(folder)
    assert call.copies == (("view1.png", "again.png"),)
    assert len(call.sources) == 3


def test_the_same_picture_saved_anew_and_smaller(scene: Path, tmp_path: Path) -> None:
    folder = copied(scene, tmp_path / "photos")
    with Image.open(folder / "view1.png") as image:
        image.save(folder / "z-again.jpg", quality=70)
        image.resize((240, 180), Image.Resampling.BOX).save(folder / "z-small.png")
    read = read_photos(plan_call(folder).sources)
    assert [name for name, _ in read.set_aside] == ["z-again.jpg", "z-small.png"]
    assert all("same picture as view1.png" in reason for _, reason in read.set_aside)


def test_what_cannot_be_read_is_set_aside(scene: Path, tmp_path: Path) -> None:
    folder = copied(scene, tmp_path / "photos")
    whole = (folder / "view0.png").read_bytes()
    (folder / "cut.png").write_bytes(whole[: len(whole) // 2])
    (folder / "text.jpg").write_text("no photo")
    Image.new("RGB", (40, 200)).save(folder / "sliver.png")
    read = read_photos(plan_call(folder).sources)
    reasons = dict(read.set_aside)
    assert "truncated" in reasons["cut.png"]
    assert "not an image" in reasons["text.jpg"]
    assert "40 x 200 px" in reasons["sliver.png"]
    assert len(read.photos) == 3


def test_upright_with_its_focal_length(tmp_path: Path) -> None:
    for number, pose in enumerate(ARC[:2]):
        exif = Image.Exif()
        exif[Base.Orientation] = 6  # the camera was turned: rows are stored as columns
        exif.get_ifd(IFD.Exif)[Base.FocalLengthIn35mmFilm] = 35
        lying = np.rot90(take_photo(pose))
        Image.fromarray(np.ascontiguousarray(lying)).save(tmp_path / f"{number}.jpg", exif=exif)
    first = read_photos(plan_call(tmp_path).sources).photos[0]
    assert (first.width_px, first.height_px) == (480, 360)
    assert first.focal_px == pytest.approx(35 * np.hypot(480, 360) / np.hypot(36, 24))


@pytest.mark.parametrize("focal", [0, 60_000])
def test_an_absurd_focal_length_is_none(tmp_path: Path, focal: int) -> None:
    for number, pose in enumerate(ARC[:2]):
        exif = Image.Exif()
        exif.get_ifd(IFD.Exif)[Base.FocalLengthIn35mmFilm] = focal
        Image.fromarray(take_photo(pose)).save(tmp_path / f"{number}.jpg", exif=exif)
    read = read_photos(plan_call(tmp_path).sources)
    assert [photo.focal_px for photo in read.photos] == [None, None]


def test_cameras_are_told_apart(scene: Path, tmp_path: Path) -> None:
    folder = copied(scene, tmp_path / "photos")
    exif = Image.Exif()
    exif[Base.Model] = "Another"
    Image.fromarray(take_photo(ARC[4])).save(folder / "x.jpg", exif=exif)
    Image.fromarray(take_photo(ARC[5])[:, :400]).save(folder / "y.png")
    read = read_photos(plan_call(folder).sources)
    assert [(photo.name, photo.group) for photo in read.photos] == [
        ("view0.png", 1),
        ("view1.png", 1),
        ("view2.png", 1),
        ("x.jpg", 2),
        ("y.png", 3),
    ]
