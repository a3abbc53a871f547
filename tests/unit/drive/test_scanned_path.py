"""Logs without poses: the path comes from the horizontal scans, clocks are compared, stops leave
one.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
import pytest
import rasterio
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from rasterio.transform import from_origin

from veduta.drive.read.clocks import clock_apart
from veduta.drive.read.localise import Localised, LocaliseParameters
from veduta.drive.read.own import read_own
from veduta.drive.read.rivals import Margin
from veduta.drive.read.scan_chain import ScanChain
from veduta.drive.read.spacing import equally_spaced
from veduta.run.errors import InputError, NotFoundError
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)
from veduta.synthetic.drives.scan import DriveScans

Floats = NDArray[np.float64]


@given(st.lists(st.floats(-0.5, 1.5), min_size=2, max_size=60), st.floats(0.05, 1.0))
def test_kept_scans_are_so_far_apart_and_none_is_missed(steps: list[float], spacing: float) -> None:
    path = np.zeros((len(steps), 3))
    path[:, 0] = np.cumsum(steps)
    kept = equally_spaced(path, spacing).tolist()
    last, expected = 0, [0]
    for row in range(1, len(path)):
        if abs(path[row, 0] - path[last, 0]) >= 0.999 * spacing:
            expected.append(row)
            last = row
    assert kept == expected


def test_stop_leaves_one_scan() -> None:
    path = np.zeros((3000, 3))
    path[:, 0] = np.concatenate(
        [np.linspace(0, 5, 500), np.full(2000, 5.0), np.linspace(5, 10, 500)]
    )
    kept = equally_spaced(path, 0.1)
    assert ((kept > 510) & (kept < 2490)).sum() == 0
    assert 95 <= len(kept) <= 101


@pytest.mark.parametrize("apart_s", [0.05, -0.12, 0.0])
def test_clocks_are_compared_by_what_both_see(apart_s: float) -> None:
    random = np.random.default_rng(1)
    true_s = np.arange(0.0, 40.0, 0.025)
    seen = 10.0 + np.interp(true_s, np.arange(0, 41, 0.7), random.uniform(-3, 3, 59))
    noisy = [seen + random.normal(0, 0.035, len(seen)) for _ in range(2)]
    told = clock_apart(true_s - apart_s, noisy[0], true_s[::2], noisy[1][::2])
    assert told == pytest.approx(apart_s, abs=0.006)


def test_clocks_of_a_bare_wall_tell_nothing() -> None:
    random = np.random.default_rng(1)
    times = np.arange(0.0, 40.0, 0.025)
    noisy = [10.0 + random.normal(0, 0.035, len(times)) for _ in range(2)]
    assert clock_apart(times, noisy[0], times, noisy[1]) is None


@pytest.fixture(scope="module")
def scans() -> DriveScans:
    street = build_street(StreetOptions(length_m=60.0), 4)
    return scan_street(street, TruckOptions(level=True), 4)


@pytest.fixture
def folder(scans: DriveScans, tmp_path: Path) -> Path:
    write_drive(scans, tmp_path, poses=False)
    return tmp_path


def _change(path: Path, **columns: object) -> None:
    table = pyarrow.parquet.read_table(path).to_pydict()
    pyarrow.parquet.write_table(pyarrow.table(table | columns), path)


def _off(folder: Path, scans: DriveScans) -> Floats:
    """How far each scan is from the truth, once the first pose of the path is put onto it (m)."""
    record = read_own(folder)
    truth = np.array([
        scans.world_from_vehicle[int(np.argmin(np.abs(scans.times_s - sweep.time_s)))]
        for sweep in record.sweeps
    ])  # fmt: skip
    own = np.array([sweep.world_from_sensor[:3, 3] for sweep in record.sweeps])[:, :2]
    one = (own - own.mean(axis=0)) @ np.array([1.0, 1j])
    there = truth[:, :2, 3] - truth[:, :2, 3].mean(axis=0)
    two = there @ np.array([1.0, 1j])
    turn = np.exp(1j * np.angle((np.conj(one) * two).sum()))
    return np.asarray(np.abs(one * turn - two))


def test_path_is_found_from_horizontal_scans(folder: Path, scans: DriveScans) -> None:
    record = read_own(folder)
    assert not record.given_poses
    assert "horizontal scans" in record.path_from
    assert _off(folder, scans).mean() < 0.5


def test_a_twentieth_of_the_scans_lost_is_no_harm(folder: Path, scans: DriveScans) -> None:
    table = pyarrow.parquet.read_table(folder / "horizontal.parquet")
    kept = np.random.default_rng(1).uniform(size=len(table)) > 0.05
    pyarrow.parquet.write_table(table.filter(pyarrow.array(kept)), folder / "horizontal.parquet")
    assert _off(folder, scans).mean() < 0.5


def test_clock_that_is_off_is_told_and_set(folder: Path, scans: DriveScans) -> None:
    _change(folder / "vertical.parquet", time_s=scans.times_s - 0.05)
    notes = read_own(folder).notes
    assert any("ms behind that of the horizontal one" in note for note in notes), notes


def test_log_without_path_and_horizontal_scanner_is_refused(folder: Path) -> None:
    toml = folder / "drive.toml"
    text = toml.read_text()
    toml.write_text(text[: text.index("[horizontal]")])
    with pytest.raises(InputError, match=r"neither.*Give poses"):
        read_own(folder)


def test_scans_of_nothing_give_no_path(folder: Path) -> None:
    table = pyarrow.parquet.read_table(folder / "horizontal.parquet")
    empty = [np.zeros(len(row), np.float32) for row in table["ranges_m"].to_pylist()]
    _change(folder / "horizontal.parquet", ranges_m=empty)
    with pytest.raises(NotFoundError, match="match none"):
        read_own(folder)


EAST_M, NORTH_M = 155_000.0, 463_000.0


def _aerial_photo(path: Path) -> None:
    """Three bands of bytes, 200 m wide."""
    place = from_origin(EAST_M - 100.0, NORTH_M + 100.0, 1.0, 1.0)
    with rasterio.open(
        path, "w", driver="GTiff", width=200, height=200, count=3, dtype="uint8",
        crs="EPSG:28992", transform=place,
    ) as file:  # fmt: skip
        file.write(np.random.default_rng(1).integers(0, 255, (3, 200, 200), dtype=np.uint8))


def test_surface_model_that_is_missing_or_has_no_start_is_refused(folder: Path) -> None:
    toml = folder / "drive.toml"
    toml.write_text(toml.read_text() + '\n[surface]\nfile = "photo.tif"\n')
    with pytest.raises(InputError, match="no such file"):
        read_own(folder)
    _aerial_photo(folder / "photo.tif")
    with pytest.raises(InputError, match=r"says not where the drive begins.*drive start LOG"):
        read_own(folder)


@pytest.mark.parametrize(
    ("share", "own", "rival", "doubted"),
    [
        (0.95, 0.8, 0.4, ""),
        (0.6, 0.8, 0.78, "nearly as well 9 m away"),
        (0.6, -0.2, -0.1, "nowhere"),
    ],
)
def test_over_an_aerial_photo_the_road_is_level(
    folder: Path, monkeypatch: pytest.MonkeyPatch, share: float, own: float, rival: float,
    doubted: str,
) -> None:  # fmt: skip
    """A photo tells no heights; what was corrected is told in metres, not in coordinates. A place
    where few points lie on edges is doubted.
    """
    _aerial_photo(folder / "photo.tif")
    toml = folder / "drive.toml"
    start = f"\n[surface]\nfile = 'photo.tif'\nstart = [{EAST_M}, {NORTH_M}]\n"
    toml.write_text(toml.read_text() + start)

    def found(chain: ScanChain, *_: object, **__: object) -> Localised:
        poses = chain.poses + np.array([EAST_M, NORTH_M, 0.0])
        count = len(poses)
        moved = np.zeros((count, 2))
        moved[-1] = 0.3, -0.4
        sure = np.ones(count, dtype=bool)
        fit = np.full(count, share)
        margin = Margin(own, rival, (9.0, 0.0))
        return Localised(poses, moved, fit, np.zeros(count), sure, np.zeros(count), margin)

    monkeypatch.setattr("veduta.drive.read.scanned_path.localise", found)
    record = read_own(folder)
    assert record.origin_m == (EAST_M, NORTH_M, 0.0)
    heights = [sweep.world_from_sensor[2, 3] for sweep in record.sweeps]
    np.testing.assert_allclose(heights, record.height_m, atol=1e-9)
    ((_, moved_m, why),) = record.corrections
    np.testing.assert_allclose(moved_m, [0.3, -0.4, 0.0])
    assert "localised" in why
    assert any("taken for level" in note for note in record.notes)
    assert [doubt[:4] for doubt in record.doubts] == (["60 %", "the "] if doubted else [])
    assert all(doubted in doubt for doubt in record.doubts[1:])


@pytest.mark.parametrize("sure", [False, True])
def test_who_is_sure_is_not_refused_for_what_is_alike(
    folder: Path, monkeypatch: pytest.MonkeyPatch, sure: bool
) -> None:
    _aerial_photo(folder / "photo.tif")
    toml = folder / "drive.toml"
    start = f"\n[surface]\nfile = 'photo.tif'\nstart = [{EAST_M}, {NORTH_M}]\n"
    toml.write_text(toml.read_text() + start + f"sure = {str(sure).lower()}\n")
    rules: list[LocaliseParameters] = []

    def found(*_: object, parameters: LocaliseParameters) -> Localised:
        rules.append(parameters)
        raise NotFoundError("the place", "nothing is looked for", "Look.")

    monkeypatch.setattr("veduta.drive.read.scanned_path.localise", found)
    with pytest.raises(NotFoundError):
        read_own(folder)
    assert (rules[0].least_margin > 0.0) == (rules[0].least_sharp > 0.0) == (not sure)
    assert (rules[0].sharp_alike > 0.0) == (not sure)
