"""A file of positions in place of GPS, as OpenDroneMap has it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from pyproj import Transformer
from test_which_way_up import records, survey

from veduta.imaging.shot import Position
from veduta.photos.world.position_file import at_positions, read_positions
from veduta.run.errors import InputError


def written(folder: Path, text: str) -> Path:
    path = folder / "geo.txt"
    path.write_text(text)
    return path


def test_positions_are_read(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        "EPSG:32632\n# drone\nDJI_0001.JPG 500000 5400000 320.5 0 -90 0 2 3\n"
        '"my photo.jpg" 500010 5400000\nIMG 7.jpg\t500020\t5400000\t300\n',
    )
    found = read_positions(path).by_name
    assert list(found) == ["DJI_0001.JPG", "my photo.jpg", "IMG 7.jpg"]
    to_world = Transformer.from_crs("EPSG:32632", "EPSG:4326", always_xy=True)
    longitude, latitude = to_world.transform(500000, 5400000)
    first = found["DJI_0001.JPG"]
    assert (first.longitude_deg, first.latitude_deg) == pytest.approx((longitude, latitude))
    assert first.altitude_m == 320.5
    assert found["my photo.jpg"].altitude_m is None


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("", "is empty"),
        ("EPSG:32632\n", "has no positions"),
        ("EPSG:32632\na.jpg 1\n", "line 2 is no position"),
        ("EPSG:32632\na.jpg one two\n", "line 2 is no position"),
        ("here\na.jpg 1 2\n", "names no CRS"),
        ("EPSG:32632\na.jpg 9.18 48.7\nb.jpg 9.19 48.7\n", "looks like degrees"),
        ("WGS84\na.jpg 48.7 109.18\n", "latitude seems to come first"),
    ],
)
def test_bad_files_say_what_is_wrong(tmp_path: Path, text: str, fault: str) -> None:
    with pytest.raises(InputError, match=fault):
        read_positions(written(tmp_path, text))


def test_they_take_the_place_of_gps(tmp_path: Path) -> None:
    structure, _, _ = survey(0)
    photos = records(structure, None)[:3]
    names = [photo.name for photo in photos]
    lines = [f"{name.upper()} {500000 + row} 5400000 9" for row, name in enumerate(names[:2])]
    path = written(tmp_path, "\n".join(["EPSG:32632", *lines, "other.jpg 500000 5400000 9"]))
    placed, told = at_positions(photos, read_positions(path))
    assert [photo.position is not None for photo in placed] == [True, True, False]
    assert "other.jpg is not among the photos" in told[0]
    assert "positions of 2 photos" in told[1]
    with pytest.raises(InputError, match=r"names no photo.*OTHER.jpg is"):
        at_positions(
            [replace(photos[0], name="OTHER.jpg")],
            read_positions(written(tmp_path, "EPSG:32632\nothers.jpg 500000 5400000\n")),
        )


def test_a_file_of_another_place_than_exif_is_told(tmp_path: Path) -> None:
    structure, _, _ = survey(0)
    shown = Position(latitude_deg=48.7, longitude_deg=9.18)
    photos = [replace(photo, position=shown) for photo in records(structure, None)[:3]]
    names = [photo.name for photo in photos]
    exchanged = "\n".join(["WGS84", *(f"{name} 48.7 9.18" for name in names)])
    (told,) = [
        one
        for one in at_positions(photos, read_positions(written(tmp_path, exchanged)))[1]
        if "EXIF" in one
    ]
    assert "longitude stands before latitude" in told
    right = "\n".join(["WGS84", *(f"{name} 9.1801 48.7" for name in names)])
    assert "EXIF" not in " ".join(at_positions(photos, read_positions(written(tmp_path, right)))[1])
