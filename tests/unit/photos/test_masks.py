"""Masks: which photo they belong to, and what they hide."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from photo_scene import ARC, HEIGHT_PX, WIDTH_PX, write_photos
from PIL import Image
from PIL.ExifTags import Base

from veduta.imaging.read import read_image
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.given import Given
from veduta.photos.intake.masks import masks_in, read_mask, with_masks
from veduta.photos.intake.read import read_photos
from veduta.photos.intake.source import Source
from veduta.photos.matching.features import FeaturesJob, find_features, read_features, run_features
from veduta.photos.options import MatchOptions
from veduta.run.errors import InputError


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("scene")
    write_photos(folder, ARC[:2])
    return folder


def half(width: int = WIDTH_PX, height: int = HEIGHT_PX) -> np.ndarray:
    """White on the left, black on the right."""
    mask = np.zeros((height, width), dtype=np.uint8)
    mask[:, : width // 2] = 255
    return mask


def source(name: str) -> Source:
    return Source(name, Path(name), name)


@pytest.mark.parametrize("kind", ["L", "1", "RGB", "P", "I;16"])
def test_black_hides_whatever_the_kind_of_file(tmp_path: Path, kind: str) -> None:
    grey = Image.fromarray(half(20, 10))
    if kind == "I;16":
        grey = Image.fromarray(half(20, 10).astype(np.uint16) * 257)
    (grey if kind == "I;16" else grey.convert(kind)).save(tmp_path / "a.png")
    shown = read_mask(tmp_path / "a.png", "a.jpg", (20, 10))
    assert shown.tolist() == (half(20, 10) > 0).tolist()


def test_both_ways_to_name_them(tmp_path: Path) -> None:
    for name in ("a.png", "b.jpg.png", "else.png"):
        Image.fromarray(half(8, 8)).save(tmp_path / name)
    found, notes = with_masks(
        [source("A.JPG"), source("b.jpg"), source("c.jpg")], masks_in(tmp_path)
    )
    assert [one.mask and one.mask.name for one in found] == ["a.png", "b.jpg.png", None]
    assert notes == (
        "1 photo (c.jpg) without a mask: all of it is looked at",
        "1 mask (else.png) without a photo: not used",
    )


def test_two_masks_of_one_photo(tmp_path: Path) -> None:
    for name in ("a.png", "a.jpg.png"):
        Image.fromarray(half(8, 8)).save(tmp_path / name)
    with pytest.raises(InputError, match="second mask"):
        with_masks([source("a.jpg")], masks_in(tmp_path))


def test_no_masks(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no masks"):
        masks_in(tmp_path)
    with pytest.raises(InputError, match="does not exist"):
        masks_in(tmp_path / "nowhere")


def test_another_size_is_named(scene: Path, tmp_path: Path) -> None:
    Image.fromarray(half(100, 50)).save(tmp_path / "view0.png")
    call = plan_call(scene, Given(masks=tmp_path))
    with pytest.raises(InputError, match=r"100 x 50 px, and its photo view0\.png 480 x 360 px"):
        read_photos(call.sources)


def test_a_damaged_mask_stops_the_run(scene: Path, tmp_path: Path) -> None:
    Image.fromarray(half()).save(tmp_path / "view0.png")
    data = (tmp_path / "view0.png").read_bytes()
    (tmp_path / "view0.png").write_bytes(data[: len(data) // 2])
    with pytest.raises(InputError, match="truncated"):
        read_photos(plan_call(scene, Given(masks=tmp_path)).sources)


def test_a_mask_that_hides_all(scene: Path, tmp_path: Path) -> None:
    Image.fromarray(0 * half()).save(tmp_path / "view0.png")
    read = read_photos(plan_call(scene, Given(masks=tmp_path)).sources)
    assert [name for name, _ in read.set_aside] == ["view0.png"]
    assert "black everywhere" in read.set_aside[0][1]


def test_a_mask_is_for_the_upright_photo(tmp_path: Path) -> None:
    (tmp_path / "masks").mkdir()
    for number, pose in enumerate(ARC[:2]):
        exif = Image.Exif()
        exif[Base.Orientation] = 6
        write_photos(tmp_path / "own", (pose,), seed=number)
        lying = np.rot90(read_image(tmp_path / "own" / "view0.png").pixels)
        Image.fromarray(np.ascontiguousarray(lying)).save(tmp_path / f"{number}.jpg", exif=exif)
        Image.fromarray(half()).save(tmp_path / "masks" / f"{number}.png")
    read = read_photos(plan_call(tmp_path, Given(masks=tmp_path / "masks")).sources)
    assert [photo.mask is not None for photo in read.photos] == [True, True]


def test_features_are_those_that_no_mask_hides(scene: Path, tmp_path: Path) -> None:
    """The same as without a mask, less those on the right: the mask's edge makes none."""
    Image.fromarray(half()).save(tmp_path / "mask.png")
    options = MatchOptions(max_features=50_000)
    photo = scene / "view0.png"
    run_features(FeaturesJob(photo, options, tmp_path / "f.npz", tmp_path / "mask.png"))
    found = read_features(tmp_path / "f.npz").keypoints
    every = find_features(read_image(photo), options).keypoints
    expected = every[every[:, 0] < WIDTH_PX // 2]
    assert 100 < len(found) < len(every)
    assert np.array_equal(found[np.lexsort(found.T)], expected[np.lexsort(expected.T)])


def test_as_many_features_as_without_a_mask(scene: Path, tmp_path: Path) -> None:
    Image.fromarray(half()).save(tmp_path / "mask.png")
    options = MatchOptions(max_features=500)
    photo = read_image(scene / "view0.png")
    shown = half() > 0
    assert len(find_features(photo, options, shown).keypoints) == 500
    assert len(find_features(photo, options).keypoints) >= 500
