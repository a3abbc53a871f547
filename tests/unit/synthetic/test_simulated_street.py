"""Simulated structure against the street that it was made of."""

from __future__ import annotations

import numpy as np
import pytest
from simulated_street import simulated_street

from veduta.photos.structure import errors_px
from veduta.synthetic.streets.outlines import any_overlap
from veduta.synthetic.streets.plan import plan_street
from veduta.synthetic.streets.simulated import Frame, Simulation


@pytest.mark.parametrize("seed", range(8))
def test_houses_stand_apart_and_differ(seed: int) -> None:
    """A street has at least six houses, of different widths, that do not stand in each other."""
    street = plan_street(seed)
    assert len(street.houses) >= 6
    assert not any_overlap([h.outline_m for h in (*street.houses, *street.others)])
    shapes = {(round(h.width_m, 1), round(h.top_m - h.base_m, 1)) for h in street.houses}
    assert len(shapes) == len(street.houses)
    assert min(house.top_m - house.base_m for house in street.houses) > 4.0


@pytest.mark.parametrize("frame", ["world", "upright", "any"])
def test_points_lie_on_the_walls_that_they_are_said_to_be_of(frame: Frame) -> None:
    """The known similarity takes the points back; what is left is noise, relief and drift."""
    street, simulated, structure = simulated_street(3, Simulation(frame=frame))
    scale, turn, shift = simulated.world_from_model
    places = scale * structure.points @ turn.T + shift
    on_wall = simulated.wall_of >= 0
    walls = [simulated.walls[row] for row in simulated.wall_of[on_wall]]
    starts = np.array([wall.start_m for wall in walls])
    outward = np.array([wall.outward for wall in walls])
    off = np.sum((places[on_wall, :2] - starts) * outward, axis=1)
    assert abs(float(np.median(off))) < 0.05
    # Seven of ten lie in the plane, the others on what stands out of it or lies behind it.
    assert 0.5 < float((np.abs(off) < 0.1).mean()) < 0.85
    assert {wall.house for wall in walls} <= {house.id for house in street.houses}


def test_observations_agree_with_poses_and_points() -> None:
    """As after an adjustment: errors of about a pixel; a few points are none."""
    _, simulated, structure = simulated_street(1)
    error = errors_px(structure)
    assert 0.4 < float(np.median(error)) < 1.4
    assert float(np.sqrt(np.mean(error**2) / 2)) < 1.2
    lengths = np.bincount(structure.point_of, minlength=len(structure.points))
    true = simulated.wall_of >= 0
    assert int(lengths[true].min()) >= 2
    pairs = np.stack([structure.image_of, structure.point_of])
    assert np.unique(pairs, axis=1).shape == pairs.shape


def test_same_seed_same_structure() -> None:
    """All that is random takes the seed."""
    first, second, other = (simulated_street(seed, photos=12)[2] for seed in (2, 2, 4))
    assert np.array_equal(first.points, second.points)
    assert first.points.shape != other.points.shape


def test_seen_walls_face_the_street() -> None:
    """Fronts along the walk are seen, backs are not."""
    street, simulated, _ = simulated_street(4)
    backs = [wall for wall in simulated.walls if wall.id.endswith("/2")]
    fronts = [wall for wall in simulated.walls if wall.id.endswith("/0")]
    assert max(wall.seen_m for wall in backs) == 0.0
    assert sum(wall.seen_m > 4.0 for wall in fronts) >= 6
    for wall in simulated.walls:
        assert 0.0 <= wall.seen_from_m <= wall.seen_to_m <= wall.width_m + 1e-9
        assert wall.seen_m <= wall.seen_to_m - wall.seen_from_m + 1e-9
    assert street.houses[0].id == simulated.walls[0].house
