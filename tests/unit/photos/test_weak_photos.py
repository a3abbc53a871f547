"""Photos that too few points hold are taken out, and components without a solution left out."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from known_structure import HEIGHT_PX, WIDTH_PX, known_structure
from simulated_street import simulated_street

from veduta.photos.cameras.component import FEWEST_POINTS, without_weak
from veduta.photos.finding import doubtful_focal, finish_components
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.options import CameraOptions, PhotosOptions
from veduta.photos.structure import Structure, errors_px
from veduta.run.errors import NotFoundError


@pytest.fixture(scope="module")
def street() -> Structure:
    """All photos of a street: each sees enough of it."""
    return simulated_street(1)[2]


def weakened(structure: Structure, row: int, points: int) -> Structure:
    """The same with so many observations of one photo."""
    own = np.flatnonzero(structure.image_of == row)
    kept = np.ones(len(structure.image_of), dtype=bool)
    kept[own[points:]] = False
    return structure.observed(kept)


def errors_of(structure: Structure) -> dict[tuple[str, int], float]:
    """Of each observation, by its photo's name and its keypoint."""
    names = [structure.names[row] for row in structure.image_of]
    keys = zip(names, structure.keypoint_of.tolist(), strict=True)
    return dict(zip(keys, errors_px(structure).tolist(), strict=True))


def test_a_weak_photo_goes_and_the_others_stay_as_they_are(street: Structure) -> None:
    structure = weakened(street, 4, FEWEST_POINTS - 1)
    found, kept = without_weak(structure)
    assert kept == ()
    assert found.names == tuple(name for name in structure.names if name != "0005.jpg")
    assert np.array_equal(found.centres(), np.delete(structure.centres(), 4, axis=0))
    assert set(found.camera_of) == set(found.image_ids)
    before, after = errors_of(structure), errors_of(found)
    assert after
    assert all(before[key] == error for key, error in after.items())
    assert np.bincount(found.point_of, minlength=len(found.points)).min() >= 2
    lost = {key for key in before if key not in after}
    assert {name for name, _ in lost} >= {"0005.jpg"}


def test_enough_points_hold_a_photo(street: Structure) -> None:
    structure = weakened(street, 4, FEWEST_POINTS)
    assert without_weak(structure) == (structure, ())


def test_where_all_are_weak_nothing_goes(street: Structure) -> None:
    few = street
    for row in range(len(street.names)):
        few = weakened(few, row, 10)
    found, kept = without_weak(few)
    assert found is few
    assert kept == few.names


PINHOLE = PhotosOptions(
    camera=CameraOptions(lens="pinhole", cameras="shared", principal_point="middle")
)
PHOTOS = [
    PhotoRecord(
        image_id=number, name=f"{number}.jpg", path=Path(), sha256="", width_px=WIDTH_PX,
        height_px=HEIGHT_PX, focal_px=None, camera=None, time=None, position=None, group=1,
        notes=(),
    )
    for number in range(1, 6)
]  # fmt: skip


def test_weak_photos_that_stay_are_told() -> None:
    few = known_structure(photos=5, points=FEWEST_POINTS - 5)
    (component,), left = finish_components([few], PHOTOS, PINHOLE)
    assert left == []
    (note,) = component.notes
    assert note.startswith(", ".join(few.names))
    assert "kept, as fewer than two photos would be left" in note
    (sound,), _ = finish_components([known_structure(photos=5, points=120)], PHOTOS, PINHOLE)
    assert sound.notes == ()


def test_a_component_without_a_solution_is_left_out_and_the_others_go_on() -> None:
    good = known_structure(photos=5, points=120)
    lost = replace(good, points=np.full_like(good.points, np.nan))
    components, left = finish_components([lost, good], PHOTOS, PINHOLE)
    assert [component.structure.names for component in components] == [good.names]
    assert np.isfinite(components[0].structure.points).all()
    assert [name for name, _ in left] == list(good.names)
    assert all("5 photos did not converge" in reason for _, reason in left)
    with pytest.raises(NotFoundError, match="did not converge"):
        finish_components([lost], PHOTOS, PINHOLE)


def test_a_lone_component_that_contradicts_exif_is_told() -> None:
    (found,), _ = finish_components([known_structure(photos=5, points=120)], PHOTOS, PINHOLE)
    focal = float(found.structure.camera(0).mean_focal_length())
    stated = [replace(photo, focal_px=1.1 * focal) for photo in PHOTOS]
    assert doubtful_focal(found, stated, PINHOLE) == []
    wrong = [replace(photo, focal_px=0.1 * focal) for photo in PHOTOS]
    (told,) = doubtful_focal(found, wrong, PINHOLE)
    assert "where EXIF states" in told
    given = PINHOLE.model_copy(
        update={"camera": PINHOLE.camera.model_copy(update={"focal_px": focal})}
    )
    assert doubtful_focal(found, wrong, given) == []
