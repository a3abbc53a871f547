"""Level scans and consecutive images fill holes of walls, and what is wrong in them does not."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from veduta.drive.build.beside import column_spacing, others_beside, points_beside
from veduta.drive.build.misfit import Frame
from veduta.drive.build.segment import frame_of, reconstruct
from veduta.drive.build.stereo_points import stereo_points
from veduta.drive.options import DriveOptions, OtherOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.drive.record import DriveRecord, Shot
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> DriveRecord:
    folder = tmp_path_factory.mktemp("log")
    street = build_street(StreetOptions(length_m=40.0), 6)
    write_drive(scan_street(street, TruckOptions(level=True), 6), folder)
    return read_own(folder)


def test_level_scans_fill_holes_where_the_wall_is(record: DriveRecord) -> None:
    options = DriveOptions()
    spacing = column_spacing(record, options)
    segments = cut_segments(driven_line(record.path(), spacing, 0.0), spacing)
    segment = next(one for one in segments if one.side == "left" and one.fate == "build")
    frame = frame_of(segment, options, record.height_m)
    points = points_beside(record, segment, options)
    others = others_beside(record, segment, options)
    assert len(others) > 500
    without = reconstruct(segment, frame, points, options)
    wrong = others + np.array([5.0, 0.0, 0.0])  # as if they were of things before the wall
    own = reconstruct(segment, frame, points, options, np.concatenate([others, wrong]))
    assert without.others.pixels == 0
    assert own.others.pixels > 10
    assert own.others.off_m < 0.1
    apart = np.abs(own.background.depth - without.background.depth)
    assert np.nanquantile(apart, 0.99) < 0.3


def test_nothing_is_read_that_nobody_wants(record: DriveRecord) -> None:
    none = DriveOptions(others=OtherOptions(level_scans=False))
    line = driven_line(record.path(), 0.25, 0.0)
    segment = cut_segments(line, 0.25)[0]
    assert len(others_beside(record, segment, none)) == 0


def images_of_a_wall(depth_m: float, moved: int = 3) -> list[Frame]:
    """Images taken along a wall with noise on it, warped by what a plane does to a pinhole."""
    random = np.random.default_rng(4)
    noise = random.integers(0, 255, (80, 160, 3)).astype(np.uint8)
    texture = cv2.resize(noise, (1600, 800), interpolation=cv2.INTER_CUBIC)
    focal, centre, size = 400.0, (240.0, 160.0), (480, 320)
    frames = []
    for row in range(moved):
        # x right, y down, z to the wall; the texture has 100 pixels to the metre, from (-8, -4).
        eye = np.array([0.4 * row, 0.0, 0.0])
        pixel_of = np.array([
            [focal / depth_m / 100.0, 0.0, focal * (-8.0 - eye[0]) / depth_m + centre[0]],
            [0.0, focal / depth_m / 100.0, focal * (-4.0 - eye[1]) / depth_m + centre[1]],
            [0.0, 0.0, 1.0],
        ])  # fmt: skip
        half = np.array([[1.0, 0.0, -0.5], [0.0, 1.0, -0.5], [0.0, 0.0, 1.0]])
        pixels = cv2.warpPerspective(texture, half @ pixel_of @ np.linalg.inv(half), size)
        pose = np.eye(4)
        pose[:3, 3] = eye
        shot = Shot(f"{row}", Path("none.png"), 0.1 * row, *size, (focal, focal), centre, pose)
        frames.append(Frame(shot, np.asarray(pixels, dtype=np.uint8)))
    return frames


def test_corners_of_three_images_lie_on_the_wall() -> None:
    points = stereo_points(images_of_a_wall(7.0))
    assert len(points) > 100
    assert np.abs(points[:, 2] - 7.0).max() < 0.2
    assert abs(np.median(points[:, 2]) - 7.0) < 0.02


def test_two_images_and_plain_ones_give_no_points() -> None:
    assert len(stereo_points(images_of_a_wall(7.0, moved=2))) == 0
    plain = [Frame(one.shot, np.full_like(one.pixels, 90)) for one in images_of_a_wall(7.0)]
    assert len(stereo_points(plain)) == 0
