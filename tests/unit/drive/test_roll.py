"""Leaning of the vehicle from drawn pictures of upright posts."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from numpy.typing import NDArray
from PIL import Image

from veduta.drive.read.own import read_own, read_toml
from veduta.drive.read.roll import find_roll, roll_in
from veduta.drive.record import Shot
from veduta.synthetic.drives import (
    StreetOptions,
    TruckOptions,
    build_street,
    scan_street,
    write_drive,
)

SIZE, FOCAL = (960, 540), 600.0
AHEAD = np.array([0.0, 1.0, 0.0])


def _pose(y: float, lean_rad: float) -> NDArray[np.float64]:
    """(4, 4) world_from_cam of a camera that looks north (y), and leans to the right."""
    pose = np.eye(4)
    right = np.array([np.cos(lean_rad), 0.0, -np.sin(lean_rad)])
    pose[:3, 0], pose[:3, 2] = right, AHEAD
    pose[:3, 1] = np.cross(AHEAD, right)
    pose[:3, 3] = (0.0, y, 2.0)
    return pose


def _shot(y: float, path: Path = Path("a")) -> Shot:
    """As the log has it: level."""
    centre = (SIZE[0] / 2, SIZE[1] / 2)
    return Shot(f"{y}", path, y, *SIZE, (FOCAL, FOCAL), centre, _pose(y, 0.0))


def _picture(y: float, lean_rad: float, tilted_rad: float = 0.0) -> NDArray[np.uint8]:
    """Posts beside a street, drawn four times finer; tilted: none is upright."""
    true = Shot("", Path("a"), y, *SIZE, (FOCAL, FOCAL), (480.0, 270.0), _pose(y, lean_rad))
    random = np.random.default_rng(int(10 * y) + 1)
    drawn = np.full((SIZE[1] * 2, SIZE[0] * 2), 200, dtype=np.uint8)
    for away in np.arange(y + 6.0, y + 40.0, 2.0):
        for side in (-1.0, 1.0):
            x = side * random.uniform(3.0, 6.0)
            slope = np.tan(tilted_rad) * random.choice([-1.0, 1.0]) * random.uniform(0.7, 1.0)
            ends = np.array([[x, away, 0.0], [x + 5.0 * slope, away, 5.0]])
            at = np.round(true.project(ends)[0] * 2).astype(int)
            cv2.line(drawn, at[0].tolist(), at[1].tolist(), int(random.integers(20, 120)), 5)
    small = cv2.resize(drawn, SIZE, interpolation=cv2.INTER_AREA)
    return np.repeat(small[..., None], 3, axis=2)


@pytest.mark.parametrize("lean_deg", [-4.0, -1.0, 0.0, 0.5, 3.0])
def test_a_picture_tells_how_far_it_leans(lean_deg: float) -> None:
    lean = np.deg2rad(lean_deg)
    found = roll_in(_picture(0.0, lean), _shot(0.0), AHEAD)
    assert found == pytest.approx(lean, abs=np.deg2rad(0.2))


def test_a_plain_picture_tells_nothing() -> None:
    plain = np.full((SIZE[1], SIZE[0], 3), 90, dtype=np.uint8)
    assert roll_in(plain, _shot(0.0), AHEAD) is None


def test_posts_that_all_lean_otherwise_tell_nothing() -> None:
    assert roll_in(_picture(0.0, 0.0, np.deg2rad(35.0)), _shot(0.0), AHEAD) is None


def test_poses_lean_as_the_images_say(tmp_path: Path) -> None:
    lean = np.deg2rad(2.0)
    shots = []
    for row in range(7):
        path = tmp_path / f"{row}.png"
        Image.fromarray(_picture(2.0 * row, lean)).save(path)
        shots.append(_shot(2.0 * row, path))
    found = find_roll(shots, np.tile(AHEAD, (7, 1)))
    assert found is not None
    level = np.eye(4)[:3]
    level[:, :3] = np.column_stack([AHEAD, [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    (turned,) = found.onto(np.array([5.0]), level[None])
    np.testing.assert_allclose(turned[:, 0], AHEAD, atol=1e-9)
    # The left side goes up where the vehicle leans to the right.
    assert np.rad2deg(np.arcsin(turned[2, 1])) == pytest.approx(2.0, abs=0.2)
    assert find_roll(shots[:2], np.tile(AHEAD, (2, 1))) is None


_CAMERA = """
[camera]
table = "images.parquet"
vehicle_from_camera = [0, 0, 1, 0, -1, 0, 0, 0, 0, -1, 0, 2.0]
width_px = 960
height_px = 540
focal_px = [600.0, 600.0]
centre_px = [480.0, 270.0]
"""


def test_a_path_from_scans_leans_as_its_images_say(tmp_path: Path) -> None:
    street = build_street(StreetOptions(length_m=16.0), 3)
    truck = TruckOptions(level=True, spacing_m=0.25, sway_m=0.0, sway_rad=0.0)
    scans = scan_street(street, truck, 3)
    write_drive(scans, tmp_path, poses=False)
    toml = tmp_path / "drive.toml"
    toml.write_text(toml.read_text() + _CAMERA)
    every = scans.times_s[::8]
    names = [f"{row}.png" for row in range(len(every))]
    for row, name in enumerate(names):
        Image.fromarray(_picture(2.0 * row, np.deg2rad(2.0))).save(tmp_path / name)
    table = pa.table({"time_s": every, "file": names})
    pq.write_table(table, tmp_path / "images.parquet")
    record = read_own(tmp_path)
    assert any(note.startswith("roll comes from upright edges") for note in record.notes)
    # The scanner's plane is across the vehicle: its y goes up to the left of it.
    mount = read_toml(toml).vertical
    assert mount is not None
    turn = record.sweeps[20].world_from_sensor[:3, :3]
    vehicle = turn @ np.reshape(mount.vehicle_from_scanner, (3, 4))[:, :3].T
    assert np.rad2deg(np.arcsin(vehicle[2, 1])) == pytest.approx(2.0, abs=0.3)
    for name in names:
        (tmp_path / name).unlink()
    assert any("taken not to lean" in note for note in read_own(tmp_path).notes)
