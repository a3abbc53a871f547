"""Focal lengths from EXIF, against the arithmetic of sensors."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from PIL import Image
from PIL.ExifTags import IFD, Base

from veduta.imaging.exif import focal_px_from_mm35
from veduta.imaging.read import read_image


def _write(
    path: Path,
    size: tuple[int, int],
    orientation: int = 1,
    make: str | None = None,
    model: str | None = None,
    **tags: object,
) -> Path:
    exif = Image.Exif()
    exif[Base.Orientation] = orientation
    if make and model:
        exif[Base.Make], exif[Base.Model] = make, model
    block = exif.get_ifd(IFD.Exif)
    for name, value in tags.items():
        block[Base[name]] = value
    Image.new("RGB", size, (90, 90, 90)).save(path, exif=exif)
    return path


def test_full_frame_keeps_the_horizontal_angle() -> None:
    # 36 mm over 3600 px: 100 px per mm.
    assert focal_px_from_mm35(50.0, 3600, 2400) == pytest.approx(5000.0)


@pytest.mark.parametrize("orientation", [1, 6])
def test_reads_the_35mm_equivalent(orientation: int, tmp_path: Path) -> None:
    path = _write(tmp_path / "a.jpg", (360, 240), orientation, FocalLengthIn35mmFilm=28)
    photo = read_image(path)
    assert photo.focal_mm35 == 28.0
    assert photo.focal_px == pytest.approx(280.0)


def test_reads_the_focal_plane_resolution(tmp_path: Path) -> None:
    # A 22.5 x 15 mm sensor of 4500 x 3000 px (5080 px per inch), an 18 mm lens, photo reduced.
    path = _write(
        tmp_path / "a.jpg",
        (450, 300),
        FocalLength=18.0,
        FocalPlaneXResolution=5080.0,
        FocalPlaneResolutionUnit=2,
        ExifImageWidth=4500,
        ExifImageHeight=3000,
    )
    assert read_image(path).focal_px == pytest.approx(18.0 / 22.5 * 450, rel=1e-3)


def test_a_cropped_photo_has_no_known_focal_length(tmp_path: Path) -> None:
    path = _write(
        tmp_path / "a.jpg",
        (400, 120),
        FocalLengthIn35mmFilm=28,
        ExifImageWidth=4000,
        ExifImageHeight=3000,
    )
    photo = read_image(path)
    assert photo.focal_px is None
    assert any("cropped" in note for note in photo.notes)


@pytest.mark.parametrize(("value", "told"), [(0, False), (1, True), (65535, True)])
def test_absurd_focal_lengths_are_ignored(value: int, told: bool, tmp_path: Path) -> None:
    """0 is how EXIF says that it is not known."""
    photo = read_image(_write(tmp_path / "a.jpg", (360, 240), FocalLengthIn35mmFilm=value))
    assert photo.focal_mm35 is None
    assert any("cannot be true" in note for note in photo.notes) == told


@pytest.mark.parametrize("focal_mm", [0.0, 1e6])
def test_an_absurd_focal_length_is_not_looked_up(focal_mm: float, tmp_path: Path) -> None:
    path = _write(tmp_path / "a.jpg", (360, 240), make="Canon", model="Canon EOS 5D",
        FocalLength=focal_mm)  # fmt: skip
    assert read_image(path).focal_px is None


def test_the_sensor_from_the_table_of_cameras(tmp_path: Path) -> None:
    # 36 mm over 3600 px: 100 px per mm, whichever way the camera was held.
    for orientation in (1, 6):
        path = _write(tmp_path / "a.jpg", (3600, 2400), orientation, make="Canon",
            model="Canon EOS 5D", FocalLength=50.0)  # fmt: skip
        photo = read_image(path)
        assert photo.focal_px == pytest.approx(5000.0)
        assert photo.focal_source == "camera-table"


def test_another_aspect_than_the_sensors(tmp_path: Path) -> None:
    """16:9 from a sensor of 17.3 x 13 mm keeps its width; 4:3 from one of 36 x 24 its height."""
    wide = _write(tmp_path / "a.jpg", (1730, 973), make="Panasonic", model="DMC-GF1",
        FocalLength=20.0)  # fmt: skip
    assert read_image(wide).focal_px == pytest.approx(2000.0)
    high = _write(tmp_path / "b.jpg", (3200, 2400), make="SONY", model="ILCE-7", FocalLength=20.0)
    assert read_image(high).focal_px == pytest.approx(2000.0)


def test_a_digital_zoom_is_not_in_the_table(tmp_path: Path) -> None:
    path = _write(tmp_path / "a.jpg", (3600, 2400), make="Canon", model="Canon EOS 5D",
        FocalLength=50.0, DigitalZoomRatio=2.0)  # fmt: skip
    assert read_image(path).focal_px is None


def test_what_is_stated_comes_first(tmp_path: Path) -> None:
    path = _write(tmp_path / "a.jpg", (3600, 2400), make="Canon", model="Canon EOS 5D",
        FocalLength=50.0, FocalLengthIn35mmFilm=28)  # fmt: skip
    photo = read_image(path)
    assert (photo.focal_mm35, photo.focal_source) == (28.0, "stated")


def test_the_diagonal_counts_not_the_width() -> None:
    wide, tall = focal_px_from_mm35(30.0, 400, 300), focal_px_from_mm35(30.0, 300, 400)
    assert wide == tall == pytest.approx(30.0 * 500 / math.hypot(36, 24))
