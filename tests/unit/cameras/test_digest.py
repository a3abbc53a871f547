"""Keys of results change with whatever the cameras are, and with nothing else."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from veduta.cameras import Camera, CameraSet, cameras_digest


@pytest.fixture
def cameras(tmp_path: Path) -> CameraSet:
    picture, mask = tmp_path / "a.jpg", tmp_path / "a.png"
    picture.write_bytes(b"picture")
    mask.write_bytes(b"mask")
    one = Camera("a", 64, 48, (50.0, 50.0), (32.0, 24.0), np.eye(4)[:3], picture=picture)
    points = np.arange(12.0).reshape(4, 3)
    return CameraSet((one,), points, visible=(np.array([0, 2]),), masks={"a": mask})


def test_it_changes_with_each_thing_that_counts(cameras: CameraSet) -> None:
    before = cameras_digest(cameras)
    assert cameras_digest(cameras) == before
    (one,) = cameras.cameras
    assert one.picture is not None
    moved = replace(one, focal_px=(51.0, 50.0))
    points = cameras.points
    assert points is not None
    others = [
        replace(cameras, cameras=(moved,)),
        replace(cameras, points=points + 1e-9),
        replace(cameras, visible=(np.array([0, 3]),)),
        replace(cameras, origin_m=(1.0, 0.0, 0.0)),
        replace(cameras, up=(0.0, 0.0, 1.0)),
        replace(cameras, crs="EPSG:25832"),
    ]
    told = [str(cameras_digest(other)) for other in others]
    one.picture.write_bytes(b"another picture")
    told.append(str(cameras_digest(cameras)))
    cameras.masks["a"].write_bytes(b"another mask")
    told.append(str(cameras_digest(cameras)))
    assert len({str(before), *told}) == len(told) + 1
