"""Logs with a `drive.toml`: what is read, what is said of faults, and a street with known truth."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest

from veduta.drive.read.above_street import points_above_street
from veduta.drive.read.log import log_files
from veduta.drive.read.own import read_own
from veduta.drive.read.segments import driven_line
from veduta.run.errors import InputError
from veduta.synthetic.drives import (
    DriveScans,
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)


@pytest.fixture(scope="module")
def scans() -> DriveScans:
    street = build_street(StreetOptions(length_m=12.0), 3)
    return scan_street(street, TruckOptions(), 3)


@pytest.fixture
def folder(scans: DriveScans, tmp_path: Path) -> Path:
    write_drive(scans, tmp_path)
    return tmp_path


def _change(path: Path, **columns: object) -> None:
    table = pyarrow.parquet.read_table(path).to_pydict()
    pyarrow.parquet.write_table(pyarrow.table(table | columns), path)


def test_points_are_where_the_beams_went(folder: Path, scans: DriveScans) -> None:
    record = read_own(folder)
    assert len(record.sweeps) == len(scans.times_s)
    assert record.height_m == pytest.approx(3.6)
    row = 20
    points = record.sweeps[row].world_points()
    pose, angles, ranges = scans.world_from_vehicle[row], scans.angles_rad, scans.ranges[row]
    hit = ranges >= 0.5
    left = ranges[hit] * np.cos(angles[hit])
    up = 3.6 + ranges[hit] * np.sin(angles[hit])
    expected = pose[:, 3] + left[:, None] * pose[:, 1] + up[:, None] * np.array([0.0, 0.0, 1.0])
    np.testing.assert_allclose(points, expected, atol=1e-5)


def test_nothing_of_zero_and_nan_ranges(folder: Path, scans: DriveScans) -> None:
    ranges = scans.ranges.copy()
    ranges[3, :90] = np.nan
    ranges[3, 90:] = 0.0
    _change(folder / "vertical.parquet", ranges_m=list(ranges))
    assert len(read_own(folder).sweeps[3].read()) == 0


def test_silence_is_said(folder: Path, scans: DriveScans) -> None:
    late = np.where(np.arange(len(scans.times_s)) > 30, 10.0, 0.0)
    _change(folder / "vertical.parquet", time_s=scans.times_s + late)
    _change(folder / "path.parquet", time_s=scans.times_s + late)
    assert any("silent for 10.0 s" in note for note in read_own(folder).notes)


def test_clocks_apart_move_the_scans(folder: Path, scans: DriveScans) -> None:
    text = (folder / "drive.toml").read_text()
    changed = text.replace("farthest_m = 80.0", "farthest_m = 80.0\nclock_offset_s = 0.05")
    (folder / "drive.toml").write_text(changed)
    record = read_own(folder)
    moved = record.path()[10, 1] - scans.world_from_vehicle[10, 1, 3]
    assert moved == pytest.approx(0.05 * 8.0, abs=0.02)
    assert any("left out" in note for note in record.notes)


def test_what_heights_count_from_is_kept(folder: Path) -> None:
    text = (folder / "drive.toml").read_text()
    (folder / "drive.toml").write_text(f'vertical_datum = "DHHN2016"\n{text}')
    assert read_own(folder).vertical_datum == "DHHN2016"


def test_missing_images_are_counted(folder: Path, scans: DriveScans) -> None:
    camera = """
[camera]
table = "images.parquet"
vehicle_from_camera = [0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 3.6]
width_px = 8
height_px = 6
focal_px = [5.0, 5.0]
centre_px = [4.0, 3.0]
"""
    (folder / "drive.toml").write_text((folder / "drive.toml").read_text() + camera)
    (folder / "a.png").write_bytes(b"")
    rows = pyarrow.table({"time_s": [0.0, 1.0], "file": ["a.png", "b.png"]})
    pyarrow.parquet.write_table(rows, folder / "images.parquet")
    record = read_own(folder)
    assert [shot.name for shot in record.shots] == ["a"]
    assert "1 of 2 images are missing" in record.notes
    rows = pyarrow.table({"time_s": [0.0], "file": ["../a.png"]})
    pyarrow.parquet.write_table(rows, folder / "images.parquet")
    with pytest.raises(InputError, match="outside"):
        read_own(folder)
    rows = pyarrow.table({"time_s": [0.0], "file": ["a" * 3000 + ".png"]})
    pyarrow.parquet.write_table(rows, folder / "images.parquet")
    with pytest.raises(InputError, match="a name that no file has"):
        read_own(folder)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("[path]", "[paths]", "paths"),
        ("beam_step_rad = 0", "beam_step_rad = -0", "beam_step_rad"),
        ("name = ", "name ", "no TOML"),
        ('"path.parquet"', '"none.parquet"', "no such file"),
        ('"path.parquet"', '"../path.parquet"', "table"),
        ('[path]\ntable = "path.parquet"', "", "names neither"),
    ],
)
def test_broken_descriptions_are_told(folder: Path, old: str, new: str, said: str) -> None:
    text = (folder / "drive.toml").read_text()
    assert old in text
    (folder / "drive.toml").write_text(text.replace(old, new))
    with pytest.raises(InputError, match=said):
        read_own(folder)


def test_cut_tables_are_told(folder: Path) -> None:
    path = folder / "vertical.parquet"
    path.write_bytes(path.read_bytes()[:-50])
    with pytest.raises(InputError, match="no Parquet table") as error:
        read_own(folder)
    assert error.value.subject.endswith("vertical.parquet")


def test_uneven_scans_are_told(folder: Path, scans: DriveScans) -> None:
    ranges = [row[:-1] if number == 4 else row for number, row in enumerate(scans.ranges)]
    _change(folder / "vertical.parquet", ranges_m=ranges)
    with pytest.raises(InputError, match="different lengths"):
        read_own(folder)


_TWELVE = [[0.0] * 12] * 2


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ({"time_s": ["0", "1"], "matrix": _TWELVE}, "string and not numbers in 'time_s'"),
        ({"time_s": [None, 1.0], "matrix": _TWELVE}, "no number"),
        ({"time_s": [0.0, 1.0], "matrix": [0.0, 1.0]}, "double and not lists"),
        ({"time_s": [0.0, 1.0], "matrix": ["a", "b"]}, "string and not lists"),
        ({"time_s": [0.0, 1.0], "matrix": [{"x": 1.0}, {"x": 2.0}]}, "struct.* and not lists"),
        ({"time_s": [0.0, 1.0], "matrix": [["a"] * 12] * 2}, "and not lists of numbers"),
        ({"time_s": [0.0, 1.0], "matrix": [[0.0] * 12, None]}, "rows without 'matrix'"),
        ({"time_s": [0.0, 1.0], "matrix": [[None] * 11 + [1.0]] * 2}, "twelve"),
        ({"time_s": [0.0, 1.0], "matrix": [[0.0] * 12, [0.0] * 11]}, "different lengths"),
    ],
)
def test_tables_of_other_types_are_told(
    folder: Path, columns: dict[str, list[object]], said: str
) -> None:
    pyarrow.parquet.write_table(pyarrow.table(columns), folder / "path.parquet")
    with pytest.raises(InputError, match=said) as error:
        read_own(folder)
    assert error.value.subject.endswith("path.parquet")
    assert error.value.remedy


@pytest.mark.parametrize("kind", [pyarrow.float64(), pyarrow.null()])
def test_empty_tables_are_told(folder: Path, kind: pyarrow.DataType) -> None:
    own = pyarrow.list_(kind)
    rows = {"time_s": pyarrow.array([], pyarrow.float64()), "matrix": pyarrow.array([], own)}
    pyarrow.parquet.write_table(pyarrow.table(rows), folder / "path.parquet")
    with pytest.raises(InputError, match=r"two poses|not lists"):
        read_own(folder)


def test_rows_of_a_fixed_length_are_read(folder: Path) -> None:
    path = folder / "path.parquet"
    expected = read_own(folder).path()
    table = pyarrow.parquet.read_table(path)
    fixed, place = pyarrow.list_(pyarrow.float64(), 12), table.column_names.index("matrix")
    matrix = pyarrow.array(table["matrix"].to_pylist(), fixed)
    pyarrow.parquet.write_table(table.set_column(place, "matrix", matrix), path)
    np.testing.assert_allclose(read_own(folder).path(), expected)


def test_huge_table_is_refused_unread(folder: Path) -> None:
    with (folder / "path.parquet").open("r+b") as file:
        file.truncate(5 << 30)
    with pytest.raises(InputError, match="more than"):
        read_own(folder)


def test_files_that_lie_elsewhere_count(scans: DriveScans, tmp_path: Path) -> None:
    log = tmp_path / "log"
    write_drive(scans, log)
    own = log_files(log)
    bag = tmp_path / "bags" / "drive"
    bag.mkdir(parents=True)
    (bag / "metadata.yaml").write_text("x")
    (tmp_path / "surface.tif").write_text("x")
    toml = log / "drive.toml"
    text = '\n[surface]\nfile = "../surface.tif"\n[bag]\nfile = "../bags/drive"\n'
    toml.write_text(toml.read_text() + text + '[bag.topics]\n"vertical.parquet" = "/up"\n')
    found = log_files(log)
    assert found[:-2] == own
    assert [path.name for path in found[-2:]] == ["metadata.yaml", "surface.tif"]


def test_points_above_the_street_are_few_in_gaps(folder: Path) -> None:
    record = read_own(folder)
    line = driven_line(record.path(), 0.2, 0.0)
    counts = points_above_street(record, line)
    assert counts is not None
    assert counts.sum() == sum(
        int((sweep.world_points()[:, 2] > 2.5).sum()) for sweep in record.sweeps
    )
