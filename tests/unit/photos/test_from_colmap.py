"""A given model: which photos are its images, and what is said of the others."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from known_structure import HEIGHT_PX, WIDTH_PX, known_structure

from veduta.formats.colmap_folder import ModelFiles, models_in
from veduta.photos.intake.from_colmap import given_model
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.structure import Structure, model_of
from veduta.run.errors import InputError


@pytest.fixture(scope="module")
def truth() -> Structure:
    return known_structure(points=80, photos=6)


def written(structure: Structure, folder: Path) -> tuple[ModelFiles, ...]:
    folder.mkdir(exist_ok=True)
    model_of(structure).write_binary(folder)
    return models_in(folder)


def photo(number: int, name: str, **other: object) -> PhotoRecord:
    record = PhotoRecord(
        image_id=number,
        name=name,
        path=Path(name),
        sha256=str(number),
        width_px=WIDTH_PX,
        height_px=HEIGHT_PX,
        focal_px=None,
        camera=None,
        time=None,
        position=None,
        group=1,
        notes=(),
    )
    return replace(record, **other)  # type: ignore[arg-type]


PHOTOS = [photo(number, f"{number}.jpg") for number in range(1, 7)]


def test_the_model_comes_back(truth: Structure, tmp_path: Path) -> None:
    """In another frame: all distances are the same but for one scale."""
    given = given_model(written(truth, tmp_path), PHOTOS)
    (component,) = given.components
    assert component.structure.names == truth.names
    kind = component.lens.kind
    assert (kind.lens, kind.sharing, kind.principal_point) == ("pinhole", "per-photo", "middle")
    ours, true = component.structure.centres(), truth.centres()
    ratios = [
        np.linalg.norm(ours[a] - ours[b]) / np.linalg.norm(true[a] - true[b])
        for a, b in combinations(range(6), 2)
    ]
    assert np.allclose(ratios, ratios[0], rtol=1e-6)
    assert 0.1 < component.errors_px.mean() < 0.6
    assert given.left == ()


def test_pairs_have_the_points_that_both_see(truth: Structure, tmp_path: Path) -> None:
    given = given_model(written(truth, tmp_path), PHOTOS)
    seen = [set(truth.point_of[truth.image_of == row].tolist()) for row in range(6)]
    for pair in given.pairs:
        assert pair.verified == len(seen[pair.first - 1] & seen[pair.second - 1])
    assert len(given.pairs) == 15


def test_images_without_a_photo_and_photos_without_an_image(
    truth: Structure, tmp_path: Path
) -> None:
    photos = [*PHOTOS[:4], photo(5, "else.jpg")]
    given = given_model(written(truth, tmp_path), photos)
    assert given.components[0].structure.names == ("1.jpg", "2.jpg", "3.jpg", "4.jpg")
    assert given.left == (("else.jpg", "is not in the COLMAP model"),)
    assert any("2 images" in note and "5.jpg, 6.jpg" in note for note in given.notes)
    assert given.keypoints[4] == 0


def test_names_with_folders(truth: Structure, tmp_path: Path) -> None:
    moved = replace(truth, names=tuple(f"walk/day 1/{name}" for name in truth.names))
    given = given_model(written(moved, tmp_path), PHOTOS)
    assert given.components[0].structure.names == truth.names


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ({"width_px": 800, "height_px": 600}, "is 800 x 600 px"),
        ({"width_px": 1200, "height_px": 1600, "orientation": 6}, "turned as it is stored"),
        ({"orientation": 3}, "EXIF orientation 3"),
    ],
)
def test_photos_that_the_model_was_not_made_of(
    truth: Structure, tmp_path: Path, other: dict[str, int], words: str
) -> None:
    photos = [replace(PHOTOS[0], **other), *PHOTOS[1:]]  # type: ignore[arg-type]
    given = given_model(written(truth, tmp_path), photos)
    assert [name for name, _ in given.left] == ["1.jpg"]
    assert words in given.left[0][1]


def test_no_photo_of_the_model(truth: Structure, tmp_path: Path) -> None:
    files = written(truth, tmp_path)
    with pytest.raises(InputError, match=r"such as 1\.jpg"):
        given_model(files, [photo(1, "a.jpg"), photo(2, "b.jpg")])


def test_a_model_without_points(truth: Structure, tmp_path: Path) -> None:
    bare = truth.with_points(np.zeros(80, dtype=bool))
    with pytest.raises(InputError, match="no points"):
        given_model(written(bare, tmp_path), PHOTOS)


def test_two_components(truth: Structure, tmp_path: Path) -> None:
    """The larger one comes first, and a photo that both have counts for the first file."""
    more = known_structure(points=80, photos=9, seed=4)
    files = (*written(truth, tmp_path / "a"), *written(more, tmp_path / "b"))
    photos = [photo(number, f"{number}.jpg") for number in range(1, 10)]
    given = given_model(files, photos)
    assert [len(component.structure.names) for component in given.components] == [6, 3]
    assert given.left == ()
