"""The four-sided tower: its sides are the same, and what stands around it fills the photos."""

from __future__ import annotations

import numpy as np

from veduta.synthetic.streets.coarse import ray_scene
from veduta.synthetic.streets.outlines import any_overlap
from veduta.synthetic.streets.plan import TOWER_WALK_M, plan_block, plan_tower
from veduta.synthetic.streets.walk import walk, walk_round


def test_surroundings_fill_the_photos() -> None:
    """Of each photo at least 15 % shows other houses, without counting the ground."""
    place = plan_tower(0)
    assert place.houses[0].four_sided
    assert not any_overlap([house.outline_m for house in place.houses])
    scene = ray_scene(place.houses)
    first_other = scene.first_feature[1]
    ground = scene.first_feature[-1]
    grid = np.stack(np.meshgrid(np.arange(5.0, 1000.0, 10), np.arange(5.0, 750.0, 10)), axis=-1)
    for camera in walk_round(TOWER_WALK_M):
        rays = camera.rays(grid.reshape(-1, 2)).astype(np.float32)
        origins = np.tile(camera.position_m.astype(np.float32), (len(rays), 1))
        seen = scene.feature[scene.cast(origins, rays).triangle]
        others = ((seen >= first_other) & (seen < ground)).sum() / len(rays)
        tower = (seen < first_other).sum() / len(rays)
        assert others > 0.15
        assert tower > 0.15


def test_fewer_photos_of_a_block_are_the_first_ones() -> None:
    """The walk goes twice round, and ends near where it began."""
    block = plan_block(3)
    assert block.is_round
    assert len(block.houses) > 20
    assert not any_overlap([house.outline_m for house in (*block.houses, *block.others)])
    places = np.array([camera.position_m for camera in walk(block, 300)])
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    assert float(np.median(steps)) < 2.5
    assert float(np.linalg.norm(places[149] - places[0])) < 6.0
