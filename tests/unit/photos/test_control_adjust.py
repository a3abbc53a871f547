"""Bundle adjustment with control points against truth: a long walk, which bends without them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from known_structure import structure_seen
from numpy.typing import NDArray
from photos_truth import centre_errors
from scipy.spatial.transform import Rotation

from veduta.photos.structure import Structure, adjusted, errors_px
from veduta.photos.world.control_adjust import adjusted_to_control
from veduta.photos.world.control_file import ControlPoint, ControlPoints
from veduta.photos.world.control_fit import SURVEY_SD_M, control_georeference

PHOTOS, STEP_M, AWAY_M, POINTS = 30, 2.5, 10.0, 300
LENGTH_M = STEP_M * (PHOTOS - 1)
FOCAL_PX, WIDTH_PX, HEIGHT_PX = 900.0, 800, 600
ORIGIN_M = np.array([500_000.0, 5_500_000.0, 100.0])
LOOK = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def walk(noise_px: float) -> Structure:
    """Photos along a front, which look at it to the left and to the right in turn: all true."""
    rng = np.random.default_rng(4)
    points = np.column_stack([
        rng.uniform(-3.0, LENGTH_M + 3.0, POINTS), AWAY_M + rng.uniform(-0.5, 0.5, POINTS),
        rng.uniform(0.0, 6.0, POINTS),
    ])  # fmt: skip
    camera = pycolmap.Camera(
        camera_id=1, model="SIMPLE_RADIAL", width=WIDTH_PX, height=HEIGHT_PX,
        params=[FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2, 0.0],
    )  # fmt: skip
    poses, keypoints, numbers = [], [], []
    for photo in range(PHOTOS):
        eye = np.array([STEP_M * photo, 0.2 * (photo % 2), 2.0 + 0.3 * (photo % 3)])
        look = (
            LOOK @ Rotation.from_euler("z", (-8.0, 0.0, 8.0)[photo % 3], degrees=True).as_matrix()
        )
        pose = np.column_stack([look, -look @ eye])
        seen = camera.img_from_cam(points @ look.T + pose[:, 3])
        inside = ((seen > 0) & (seen < (WIDTH_PX, HEIGHT_PX))).all(axis=1)
        poses.append(pose)
        keypoints.append(seen + noise_px * rng.standard_normal(seen.shape))
        numbers.append(np.flatnonzero(inside))
    found = structure_seen([camera] * PHOTOS, poses, points, keypoints, numbers)
    return found.with_points(np.bincount(found.point_of, minlength=len(points)) >= 3)


def control(truth: Structure, error_m: float) -> ControlPoints:
    """Every so many metres a point, surveyed with an error, marked in all photos that show it."""
    rng = np.random.default_rng(5)
    along = np.linspace(0.0, LENGTH_M, 6)
    places = np.array([[x, AWAY_M + 0.3, z] for x in along for z in (1.0, 4.0)])
    points = []
    for number, place in enumerate(places):
        seen = []
        for row, name in enumerate(truth.names):
            pose = truth.cam_from_world[row]
            x, y = truth.cameras[1].img_from_cam((pose[:, :3] @ place + pose[:, 3])[None])[0]
            if 0.0 < x < WIDTH_PX and 0.0 < y < HEIGHT_PX:
                seen.append((name, (x + 0.5 * rng.normal(), y + 0.5 * rng.normal())))
        told = place + ORIGIN_M + error_m * rng.standard_normal(3)
        points.append(ControlPoint(f"p{number}", told, tuple(seen)))
    return ControlPoints(Path("gcp.txt"), "EPSG:25832", tuple(points))


def errors_m(found: Structure, truth: Structure) -> NDArray[np.float64]:
    """Of the photos' places after the best similarity: what is left is bent."""
    named = dict(zip(found.names, found.centres(), strict=True))
    return centre_errors(named, dict(zip(truth.names, truth.centres(), strict=True)))


@pytest.fixture(scope="module")
def truth() -> Structure:
    return walk(0.8)


@pytest.fixture(scope="module")
def bent(truth: Structure) -> Structure:
    """What the photos alone say."""
    return adjusted(truth, free_principal_point=False)


def test_control_points_take_the_bend_out(truth: Structure, bent: Structure) -> None:
    """A similarity alone would refuse them: they contradict the model as it is."""
    points = control(truth, 0.01)
    assert "contradict" in control_georeference(bent, points).why
    found = adjusted_to_control(bent, points, free_principal_point=False)
    assert found is not None
    assert found.is_adjusted, found.note
    before, after = errors_m(bent, truth).mean(), errors_m(found.structure, truth).mean()
    assert before > 0.2, "there is a bend"
    assert 0.0 < after < 0.6 * before
    assert control_georeference(found.structure, points).accepted
    # The photos are as they were, and believed as before; so is the frame.
    assert found.structure.names == bent.names
    assert np.array_equal(found.structure.point_of, bent.point_of)
    assert errors_px(found.structure).mean() < 1.05 * errors_px(bent).mean()
    moved = np.linalg.norm(found.structure.centres() - bent.centres(), axis=1)
    assert 0.0 < moved.max() < 0.1 * np.ptp(bent.centres(), axis=0).max()
    assert "adjusted to 12 control points" in found.note


def test_a_survey_of_centimetres_bends_by_no_more(truth: Structure) -> None:
    """Photos that know far better than the survey, as none do, lose no more than its deviation."""
    sharp = adjusted(walk(0.03), free_principal_point=False)
    alone = errors_m(sharp, truth).mean()
    assert alone < 0.02
    found = adjusted_to_control(sharp, control(truth, SURVEY_SD_M), free_principal_point=False)
    assert found is not None
    assert found.is_adjusted, found.note
    assert errors_m(found.structure, truth).mean() < alone + SURVEY_SD_M


@pytest.mark.parametrize("wrong_m", [1.0, 5.0])
def test_a_wrong_point_does_not_bend_the_model(
    truth: Structure, bent: Structure, wrong_m: float
) -> None:
    """It is left out, and named; where the bend hides which it is, nothing is adjusted."""
    good = control(truth, 0.01)
    wrong = replace(good.points[5], place_m=good.points[5].place_m + np.array([wrong_m, 0, 0]))
    bad = replace(good, points=(*good.points[:5], wrong, *good.points[6:]))
    found = adjusted_to_control(bent, bad, free_principal_point=False)
    assert found is not None
    if wrong_m > 1.0:
        assert found.is_adjusted
        assert "without p5" in found.note
        assert errors_m(found.structure, truth).mean() < 0.6 * errors_m(bent, truth).mean()
    else:
        assert found.is_adjusted or found.structure is bent
        assert "p5" in found.note


def test_too_few_points_change_nothing(truth: Structure, bent: Structure) -> None:
    points = control(truth, 0.01)
    few = replace(points, points=points.points[:2])
    assert adjusted_to_control(bent, few, free_principal_point=False) is None
