"""Bounds of `veduta drive` on real streets."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from veduta.drive.build.layers import PointClass
from veduta.drive.build.segment import frame_of, reconstruct
from veduta.drive.options import DriveOptions
from veduta.drive.read.clouds import read_clouds
from veduta.drive.read.segments import cut_segments, driven_line

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "benchmarks" / "drive"))

pytestmark = pytest.mark.regression


def test_labelled_street(veduta_data: Path) -> None:
    from kitti_labels import measure

    folder = veduta_data / "laser" / "kitti00"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    share = {
        str(row["what"]): float(row["share"] or 0.0) for row in measure(folder, DriveOptions())
    }
    assert share["cars found"] > 0.99
    assert share["poles and signs found"] > 0.99
    assert share["trunks found"] > 0.99
    assert 0.95 < share["plants found"] < 0.999
    assert share["building kept"] > 0.97


def test_street_without_poses(veduta_data: Path) -> None:
    folder = veduta_data / "laser" / "street-pcd"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    options = DriveOptions()
    record = read_clouds(folder, options.seed)
    path = record.path()
    length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    assert 15.6 < length < 16.3  # the last scan straight onto the first: 15.87 m
    points = np.concatenate([sweep.world_points() for sweep in record.sweeps])
    columns = options.columns
    line = driven_line(path, columns.column_spacing_m, columns.reach_m)
    for segment in cut_segments(line, columns.column_spacing_m):
        frame = frame_of(segment, options, float(record.sweeps[0].world_from_sensor[2, 3]))
        geometry = reconstruct(segment, frame, points, options)
        kind = geometry.layers.kind
        assert np.isfinite(geometry.layers.depths.main).mean() > 0.8  # a row of houses
        assert (kind == PointClass.GLASS).sum() > 10_000  # shop windows
        assert geometry.object_count >= 3  # parked cars
