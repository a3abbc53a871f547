"""A drive of 400 m in bends, past houses of the facade generator, with the paper's scanner."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.drive.build.beside import column_spacing, points_beside
from veduta.drive.build.fill import Source
from veduta.drive.build.layers import PointClass
from veduta.drive.build.segment import Geometry, frame_of, reconstruct
from veduta.drive.options import DriveOptions
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import cut_segments, driven_line
from veduta.synthetic.drives import (
    PAPER,
    DriveScans,
    Kind,
    MadeHouse,
    MadeStreet,
    MadeStreetOptions,
    Way,
    generated_house,
    make_street,
    scan_street,
    write_drive,
)

LENGTH_M = 400.0
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> tuple[MadeStreet, DriveScans, Path]:
    houses: dict[int, MadeHouse] = {}

    def of_few(seed: int) -> MadeHouse:
        return houses.setdefault(seed % 5, houses.get(seed % 5) or generated_house(seed % 5))

    options = MadeStreetOptions(length_m=LENGTH_M, way=Way(radius_m=90.0, period_m=200.0))
    street = make_street(options, 17, of_few)
    scans = scan_street(street, PAPER, 17)
    folder = tmp_path_factory.mktemp("long")
    write_drive(scans, folder)
    return street, scans, folder


@pytest.fixture(scope="module")
def geometries(drive: tuple[MadeStreet, DriveScans, Path]) -> list[Geometry]:
    options = DriveOptions()
    record = read_own(drive[2], spacing_m=options.columns.column_spacing_m)
    spacing = column_spacing(record, options)
    found = []
    for segment in cut_segments(driven_line(record.path(), spacing, 0.0), spacing):
        if segment.side == "left" and segment.fate == "build":
            frame = frame_of(segment, options, record.height_m)
            points = points_beside(record, segment, options)
            found.append(reconstruct(segment, frame, points, options))
    return found


def test_segments_are_all_of_the_street(geometries: list[Geometry]) -> None:
    """Bends of 90 m leave scans in order up to the facades: pieces of 100 m at most, no gaps."""
    lengths = [len(one.frame.origins) * one.frame.spacing_m for one in geometries]
    assert len(geometries) >= 4
    assert max(lengths) < 130.0
    assert sum(lengths) > 0.95 * LENGTH_M


def test_foreground_is_taken_out_and_facades_stay(
    drive: tuple[MadeStreet, DriveScans, Path], geometries: list[Geometry]
) -> None:
    scans = drive[1]
    poses = scans.world_from_vehicle
    middle = poses[:, :, 3] + [0.0, 0.0, scans.options.height_m]
    taken = kept = before = true = 0
    for one in geometries:
        points = one.layers.points.points
        near = np.linalg.norm(points[:, None, :2] - middle[None, ::10, :2], axis=2).argmin(axis=1)
        kind = np.empty(len(points), dtype=np.uint8)
        for row in np.unique(near).tolist():
            own = np.flatnonzero(near == row)
            part = slice(max(10 * row - 60, 0), 10 * row + 60)
            ahead = np.abs(
                points[own] @ poses[part, :, 0].T - (middle * poses[:, :, 0]).sum(1)[part]
            )
            scan = ahead.argmin(axis=1) + part.start
            offset = points[own] - middle[scan]
            level = (offset * poses[scan, :, 1]).sum(axis=1)
            beam = np.rint(90.0 + np.rad2deg(np.arctan2(offset[:, 2], level))).astype(int)
            kind[own] = scans.kind[scan, np.clip(beam, 0, 180)]
        found = one.layers.kind
        thing, wall = kind == Kind.OBJECT, (kind == Kind.WALL) | (kind == Kind.GROUND)
        kept_here = (found == PointClass.BUILDING) | (found == PointClass.GROUND)
        before += int(thing.sum())
        taken += int((found[thing] == PointClass.FOREGROUND).sum())
        kept += int(kept_here.sum())
        true += int((wall & kept_here).sum())
    assert before > 5_000
    assert taken / before > 0.97
    assert true / kept > 0.97


def test_filled_walls_lie_near_the_true_ones(
    drive: tuple[MadeStreet, DriveScans, Path], geometries: list[Geometry]
) -> None:
    """Where something hides a wall; of glass, which answers nothing, only the frame is known."""
    street = drive[0]
    off = []
    for one in geometries:
        frame, background = one.frame, one.background
        rows, columns = np.nonzero((background.source == Source.FILLED) & background.wall)
        angle = frame.angles_rad[rows]
        flat = frame.outward[columns] * np.cos(angle)[:, None]
        directions = np.concatenate([flat, np.sin(angle)[:, None]], axis=1)
        origins = frame.origins[columns]
        facade, is_wall = street.facade(origins, directions)
        _, kind = street.meet(origins, directions, np.ones(len(origins), dtype=bool))
        hidden = is_wall & (kind == Kind.OBJECT)
        depth = background.depth[rows, columns]
        off.append((depth - facade * np.cos(angle))[hidden])
    apart = np.concatenate(off)
    assert len(apart) > 1_000
    assert np.sqrt((apart**2).mean()) < 0.25
    assert np.median(np.abs(apart)) < 0.06
