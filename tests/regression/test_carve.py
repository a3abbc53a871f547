"""Carving real objects: bounds on silhouettes that were left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from veduta.cameras import read_cameras
from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.hull import carve_hull, root_of
from veduta.carve.build.measures import overlaps
from veduta.carve.options import SilhouetteOptions
from veduta.carve.read.turntable import Focal, find_turns
from veduta.carve.read.views import read_views


@pytest.mark.regression
def test_the_oxford_dinosaur_from_every_second_view(veduta_data: Path) -> None:
    folder = veduta_data / "silhouettes" / "vgg-dino"
    views = read_views(folder, read_cameras(folder), SilhouetteOptions()).views
    assert len(views) == 36
    used, unseen = views[1::2], views[::2]
    positions, triangles = carve_hull(used, root_of(find_bounds(used), 7)).surface()
    assert 25_000 < len(triangles) < 50_000
    mesh = trimesh.Trimesh(positions, triangles, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert 0.95 < overlaps(unseen, positions, triangles).mean() < 0.995


@pytest.mark.regression
@pytest.mark.slow
def test_the_turns_of_a_ring_that_nothing_was_tuned_by(veduta_data: Path) -> None:
    folder = veduta_data / "silhouettes" / "dinoSparseRing"
    cameras = read_cameras(folder)
    views = read_views(folder, cameras, SilhouetteOptions()).views
    found = find_turns([view.mask for view in views], Focal(1.3 * 640, 0.4))
    turned = np.degrees(np.abs(found.table.angles))
    error = turned - 23.48 * np.arange(16)  # as its cameras' rotations say
    error -= np.median(error)
    assert 0.05 < np.sqrt(np.square(error).mean()) < 1.0
    assert found.table.focal_px == pytest.approx(cameras.cameras[0].focal_px[0], rel=0.12)
