"""The last refinement ends where the points say, wherever it began."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from registration_streets import SimulatedStreet, simulated_street
from scipy.spatial.transform import Rotation

from veduta.photos.city.facades import facades_of
from veduta.photos.world.columns import wall_columns
from veduta.photos.world.corners import wall_corners
from veduta.photos.world.evidence import FacadeIndex
from veduta.photos.world.gauss_newton import BEHIND_M, GATE, Pose, Rows, stepped
from veduta.photos.world.georeference import Similarity
from veduta.photos.world.refine import Refined
from veduta.photos.world.refine_points import refine_by_points

_NOTHING = np.zeros(0, dtype=np.int64)


@pytest.fixture(scope="module")
def street() -> SimulatedStreet:
    return simulated_street(31, streets=2, sides=2)


def near_the_truth(street: SimulatedStreet, seed: int) -> Similarity:
    """Off by a decimetre or two, a quarter of a degree and half a percent."""
    draw = np.random.default_rng(seed)
    true = street.world_from_model
    middle = street.structure.centres().mean(axis=0)
    scale = true.scale * float(np.exp(draw.normal(0.0, 0.005)))
    turn = Rotation.from_rotvec(draw.normal(0.0, np.deg2rad(0.25), 3)).as_matrix() @ true.rotation
    there = true.moved(middle[None])[0] + draw.normal(0.0, 0.15, 3)
    return Similarity(scale, turn, there - scale * turn @ middle)


def refined(
    street: SimulatedStreet, begin: Similarity, points: NDArray[np.float64] | None = None
) -> Refined:
    structure = street.structure
    first = Refined(Pose(begin), np.eye(7), _NOTHING, _NOTHING, np.zeros(0), np.zeros(0))
    return refine_by_points(
        first,
        wall_columns(street.walls),
        wall_corners(street.walls, structure.points),
        FacadeIndex(facades_of(street.model)),
        structure.points if points is None else points,
        structure.centres().mean(axis=0),
    )


def test_all_ways_lead_to_one_place(street: SimulatedStreet) -> None:
    centres = street.structure.centres()
    ends = [
        refined(street, near_the_truth(street, seed)).world_from_model.moved(centres)
        for seed in range(4)
    ]
    for end in ends:
        assert np.linalg.norm(end - ends[0], axis=1).max() < 0.03
    true = street.world_from_model.moved(centres)
    begins = near_the_truth(street, 0).moved(centres)
    assert np.linalg.norm(ends[0] - true, axis=1).mean() < 0.15
    assert np.linalg.norm(begins - true, axis=1).mean() > 0.15


def test_what_stands_back_on_all_facades_does_not_move_the_place(street: SimulatedStreet) -> None:
    begin = near_the_truth(street, 1)
    points = street.structure.points.copy()
    back = 0.15
    for wall in street.walls:
        points[wall.point_rows, :2] -= back / street.world_from_model.scale * wall.outward
    flush, set_back = refined(street, begin), refined(street, begin, points)
    assert set_back.pose.behind_m - flush.pose.behind_m > 0.5 * back
    centres = street.structure.centres()
    moved = set_back.world_from_model.moved(centres) - flush.world_from_model.moved(centres)
    assert np.linalg.norm(moved, axis=1).mean() < 0.5 * back


def test_points_on_no_facade_change_nothing(street: SimulatedStreet) -> None:
    begin = near_the_truth(street, 2)
    far = street.structure.points + 1e4
    found = refined(street, begin, far)
    assert found.pose == Pose(begin, BEHIND_M)


@pytest.mark.parametrize("up_sd_deg", [1.5, 0.25])
def test_what_is_known_of_up_is_weighed_against_walls_that_lean(up_sd_deg: float) -> None:
    """A facade whose upper half stands out by 4 cm, the lower back, against the mean of both."""
    height = np.repeat([2.0, -2.0], 4)
    place = np.column_stack([np.zeros(8), np.tile([-3.0, -1.0, 1.0, 3.0], 2), height])
    rows = Rows(
        place,
        np.tile([1.0, 0.0, 0.0], (8, 1)),
        0.04 * np.sign(height) + BEHIND_M,
        np.ones(8, dtype=bool),
        np.ones(8),
        np.zeros(8, dtype=np.int64),
    )
    now = Pose(Similarity(1.0, np.eye(3), np.zeros(3)))
    sd, up_sd = 0.05, np.deg2rad(up_sd_deg)
    turn = stepped(now, rows, np.full(8, sd), np.zeros(3), up_sd).pose.similarity.rotation
    said = (1.0 - (0.04 / (GATE * sd)) ** 2) ** 2 * (height**2).sum() / sd**2
    wanted = 0.04 / 2.0 * said / (said + 1.0 / up_sd**2)
    assert Rotation.from_matrix(turn).as_rotvec() == pytest.approx([0.0, wanted, 0.0], abs=1e-6)
