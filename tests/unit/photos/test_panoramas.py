"""Panoramas become views of known lenses; fisheyes are mapped as what they are."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pycolmap
import pytest
from known_structure import known_structure
from noise_room import equirectangular_rays, room, seen
from PIL import Image

from veduta.imaging.read import read_image
from veduta.photos.cameras.lens import AUTO, MODELS
from veduta.photos.finding import finish_components
from veduta.photos.intake.call import plan_call
from veduta.photos.intake.panoramas import VIEWS, panoramas_among, views_of, with_panoramas
from veduta.photos.intake.read import PhotoRecord, read_photos
from veduta.photos.options import CameraOptions, PhotosOptions
from veduta.photos.stages import Stages
from veduta.run.errors import InputError

XMP = b'<x:xmpmeta><rdf:Description GPano:ProjectionType="equirectangular"/></x:xmpmeta>'


def test_views_show_what_a_pinhole_would() -> None:
    """Against the rays of a pinhole with the focal length that EXIF then states."""
    textures, place = room(0), np.array([0.5, -0.7, 0.2])
    panorama = seen(textures, place, equirectangular_rays(1600))
    side = 300
    focal = 16.0 * np.hypot(side, side) / np.hypot(36.0, 24.0)
    steps = (np.arange(side) + 0.5 - side / 2.0) / focal
    x, y = np.meshgrid(steps, steps)
    for number, pixels in enumerate(views_of(panorama, side)):
        turn = 2.0 * np.pi * number / VIEWS
        c, s = np.cos(turn), np.sin(turn)
        rays = np.stack([c * x + s, -s * x + c, -y], axis=2)
        apart = np.abs(pixels.astype(int) - seen(textures, place, rays).astype(int))
        assert np.median(apart) <= 3.0
        assert np.quantile(apart, 0.95) < 16.0


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    found = tmp_path / "photos"
    found.mkdir()
    textures = room(1)
    for number in range(2):
        place = np.array([0.4 * number, 0.0, 0.0])
        pixels = seen(textures, place, equirectangular_rays(640))
        exif = Image.Exif()
        exif[306] = f"2026:01:01 10:00:0{number}"
        xmp = XMP if number == 0 else b""
        Image.fromarray(pixels).save(found / f"p{number}.jpg", xmp=xmp, exif=exif)
    Image.fromarray(pixels[:, :300]).save(found / "plain.jpg")
    return found


def test_panoramas_are_known_by_their_xmp_or_when_asked_for(folder: Path) -> None:
    sources = plan_call(folder).sources
    assert [one.source.name for one in panoramas_among(sources, asked=False)] == ["p0.jpg"]
    asked = panoramas_among(sources, asked=True)
    assert [one.source.name for one in asked] == ["p0.jpg", "p1.jpg"]


def test_a_panorama_is_eight_photos_of_a_known_lens(folder: Path, tmp_path: Path) -> None:
    call = plan_call(folder)
    stages = Stages(tmp_path / "out", call, PhotosOptions())
    (tmp_path / "out").mkdir()
    stages.open()
    cut = with_panoramas(call, stages)
    names = [source.name for source in cut.sources]
    assert names == ["p1.jpg", "plain.jpg", *(f"p0_view{number}.jpg" for number in range(VIEWS))]
    assert "1 panoramas were cut into 8" in cut.notes[-1]
    photos = read_photos(cut.sources).photos[2:]
    assert [photo.mount.camera for photo in photos if photo.mount] == [
        f"panorama/view{number}" for number in range(VIEWS)
    ]
    assert {photo.mount.frame for photo in photos if photo.mount} == {"p0"}
    assert len({photo.group for photo in photos}) == VIEWS
    assert photos[0].focal_px == pytest.approx(0.523 * photos[0].width_px, rel=1e-2)
    assert photos[0].time is not None
    assert read_image(cut.sources[2].path).pixels.shape == (160, 160, 3)
    assert with_panoramas(plan_call(folder), stages).sources == cut.sources


def test_two_panoramas_that_differ_by_their_ending_are_refused(
    folder: Path, tmp_path: Path
) -> None:
    with Image.open(folder / "p0.jpg") as image:
        image.save(folder / "p0.webp", xmp=XMP)
    call = plan_call(folder)
    (tmp_path / "out").mkdir()
    stages = Stages(tmp_path / "out", call, PhotosOptions())
    stages.open()
    with pytest.raises(InputError, match=r"p0\.webp.*as those of p0\.jpg.*Rename"):
        with_panoramas(call, stages)


def test_a_fisheye_is_found_by_its_own_model() -> None:
    """Half around: no other model has rays there. It is not among those that are tried unasked."""
    params = (500.0, 500.0, 800.0, 600.0, 0.02, -0.01, 0.003, 0.0)
    structure = known_structure("OPENCV_FISHEYE", params, points=250)
    photos = [
        PhotoRecord(image, name, Path(name), "", 1600, 1200, None, None, None, None, 1, ())
        for image, name in zip(structure.image_ids, structure.names, strict=True)
    ]
    options = PhotosOptions(
        camera=CameraOptions(lens="fisheye", cameras="shared", principal_point="middle")
    )
    (found,), left = finish_components([structure], photos, options)
    assert left == []
    (camera,) = found.structure.cameras.values()
    assert camera.model == pycolmap.CameraModelId.OPENCV_FISHEYE
    assert camera.mean_focal_length() == pytest.approx(500.0, rel=0.01)
    assert found.errors_px.mean() < 1.0
    assert "fisheye" in MODELS
    assert "fisheye" not in AUTO
