"""Components of one camera: what the larger says of it holds, and absurd focal lengths do not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from known_structure import known_structure

from veduta.photos.cameras.component import Component
from veduta.photos.cameras.lens import CameraKind, LensChoice
from veduta.photos.cameras.plausible import absurd, cameras_by_group, focal_lengths
from veduta.photos.finding import finish_components
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.options import CameraOptions, PhotosOptions
from veduta.photos.structure import Structure

SHARED = PhotosOptions(
    camera=CameraOptions(lens="simple-radial", cameras="shared", principal_point="middle")
)


def photo(image_id: int, focal_px: float | None = None) -> PhotoRecord:
    name = f"{image_id:02d}.jpg"
    return PhotoRecord(
        image_id, name, Path(name), "", 1600, 1200, focal_px, None, None, None, 1, ()
    )


def moved_ids(structure: Structure, step: int, focal: float) -> Structure:
    """The same as photos of other numbers, mapped with another focal length."""
    ids = tuple(image + step for image in structure.image_ids)
    cameras = {}
    for number, camera in structure.cameras.items():
        other = type(camera)(camera.todict())
        other.params = [focal, *camera.params[1:]]
        cameras[number] = other
    return replace(
        structure,
        cameras=cameras,
        image_ids=ids,
        names=tuple(f"{image:02d}.jpg" for image in ids),
        camera_of={image + step: camera for image, camera in structure.camera_of.items()},
    )


@pytest.fixture(scope="module")
def two() -> tuple[Structure, Structure]:
    params = (1400.0, 800.0, 600.0, -0.1)
    one = known_structure("SIMPLE_RADIAL", params, points=200)
    few = known_structure("SIMPLE_RADIAL", params, photos=4, points=200, seed=3)
    return one, moved_ids(few, 20, 1700.0)


def test_components_share_the_camera_of_the_largest(two: tuple[Structure, Structure]) -> None:
    photos = [photo(image) for structure in two for image in structure.image_ids]
    components, left = finish_components(two, photos, SHARED)
    assert left == []
    (first,) = components[0].structure.cameras.values()
    (second,) = components[1].structure.cameras.values()
    assert second.params.tolist() == first.params.tolist()
    assert components[1].errors_px.mean() < 1.0


def component(focal: float) -> tuple[Component, dict[int, PhotoRecord]]:
    structure = known_structure("SIMPLE_RADIAL", (1400.0, 800.0, 600.0, 0.0), points=60)
    structure = moved_ids(structure, 0, focal)
    kind = CameraKind("simple-radial", "shared", "middle")
    return Component(structure, LensChoice(kind, ()), 0.0), {
        image: photo(image) for image in structure.image_ids
    }


def test_a_focal_length_that_cannot_be_is_named() -> None:
    sound, photos = component(1400.0)
    assert absurd(sound, photos, {}) == ""
    assert focal_lengths(sound, dict.fromkeys(photos, 7)) == {7: 1400.0}
    tele, photos = component(14_000.0)
    assert "where others of the same kind have 1400 px" in absurd(tele, photos, {1: 1400.0})
    stated = {image: replace(one, focal_px=1400.0) for image, one in photos.items()}
    assert "EXIF states 1400 px" in absurd(tele, stated, {})
    beyond, photos = component(40_000.0)
    assert "is none of photos of 1600 px" in absurd(beyond, photos, {})


def test_the_camera_of_a_group_is_one_that_all_share() -> None:
    structure = known_structure(points=60)
    kind = CameraKind("pinhole", "per-photo", "middle")
    each = Component(structure, LensChoice(kind, ()), 0.0)
    together = dict.fromkeys(structure.image_ids, 1)
    assert len(set(structure.camera_of.values())) > 1
    assert cameras_by_group(each, together) == {}
