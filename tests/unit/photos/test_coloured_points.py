"""The columns of a structure, to the engine and back, and in another frame."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from known_structure import known_structure
from photo_scene import Pose
from scipy.spatial.transform import Rotation

from veduta.photos.cameras.orient import TYPICAL_DISTANCE, oriented, transformed, up_direction
from veduta.photos.structure import (
    errors_px,
    model_of,
    observed_px,
    projected_px,
    structure_of,
    without_outliers,
)


def test_to_the_engine_and_back() -> None:
    before = known_structure("RADIAL", (1400.0, 800.0, 600.0, -0.2, 0.1), points=80, photos=4)
    names = dict(zip(before.image_ids, before.names, strict=True))
    after = structure_of(model_of(before), names)
    counts = np.bincount(before.point_of, minlength=80)
    assert after.names == before.names
    assert np.allclose(after.points, before.points[counts >= 2])
    assert np.allclose(after.cam_from_world, before.cam_from_world)
    assert np.allclose(
        np.sort(errors_px(after)), np.sort(errors_px(before)[counts[before.point_of] >= 2])
    )


def test_errors_are_those_of_the_engine() -> None:
    structure = known_structure("SIMPLE_RADIAL", (1400.0, 800.0, 600.0, -0.1), points=100)
    model = model_of(structure)
    model.update_point_3d_errors()
    own = np.bincount(structure.point_of, errors_px(structure)) / np.bincount(structure.point_of)
    for number, point in model.points3D.items():
        assert point.error == pytest.approx(own[number - 1], rel=1e-6)


def test_outliers_go_and_points_that_one_photo_sees() -> None:
    structure = known_structure(points=60, photos=3, noise_px=0.01)
    structure.keypoints_px[0][structure.keypoint_of[:5]] += 30.0
    clean = without_outliers(structure, 4.0)
    assert len(clean.point_of) == len(structure.point_of) - 5 - _lonely(structure)
    assert (np.bincount(clean.point_of, minlength=len(clean.points)) >= 2).all()
    assert errors_px(clean).max() < 4.0


def _lonely(structure: object) -> int:
    """Observations that are left alone when the first five are gone; counted one by one."""
    rows = structure.point_of.tolist()[5:]  # type: ignore[attr-defined]
    return sum(rows.count(row) == 1 for row in rows)


@given(turn=st.tuples(*[st.floats(-3, 3)] * 3), scale=st.floats(0.01, 100), seed=st.integers(0, 99))
def test_another_frame_shows_the_same(
    turn: tuple[float, float, float], scale: float, seed: int
) -> None:
    structure = known_structure(points=20, photos=3, seed=seed)
    shift = np.array([5.0, -2.0, 1.0])
    rotation = Rotation.from_rotvec(turn).as_matrix()
    moved = transformed(structure, scale, rotation, shift)
    assert np.allclose(projected_px(moved), projected_px(structure), atol=1e-5)
    assert np.allclose(moved.centres(), scale * structure.centres() @ rotation.T + shift)
    assert np.array_equal(observed_px(moved), observed_px(structure))


def test_upright_again_from_any_frame() -> None:
    """The ring's photos are level, so its own z is up."""
    true = known_structure()
    rotation = Rotation.from_rotvec((0.4, 1.1, -2.0)).as_matrix()
    tilted = transformed(true, 0.3, rotation, np.array([4.0, 1.0, -7.0]))
    found = oriented(tilted)
    assert found.level_deg < 0.05
    up = up_direction(tilted.cam_from_world[:, :, :3])
    assert np.allclose(up, rotation @ (0.0, 0.0, 1.0), atol=1e-3)
    spread = found.structure.points[:, 2] - true.points[:, 2] * (
        np.ptp(found.structure.points[:, 2]) / np.ptp(true.points[:, 2])
    )
    assert np.ptp(spread) < 0.02
    apart = (
        found.structure.points[found.structure.point_of]
        - found.structure.centres()[found.structure.image_of]
    )
    assert np.median(np.linalg.norm(apart, axis=1)) == pytest.approx(TYPICAL_DISTANCE)


def test_up_where_all_photos_look_one_way() -> None:
    """Their rows are parallel: what the columns say decides."""
    poses = [Pose((float(x), -9.0, 1.7), (float(x), 0.0, 1.7)) for x in range(4)]
    up = up_direction(np.array([pose.rotation for pose in poses]))
    assert np.allclose(up, (0.0, 0.0, 1.0), atol=1e-9)
