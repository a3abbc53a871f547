"""A hollow that no silhouette shows is carved by its colours, and told apart from the hull."""

from __future__ import annotations

import numpy as np
import pytest
from painted_bowl import INNER, VOLUME, bowl_views

from veduta import _core
from veduta.carve.build.appearance import carved_triangles
from veduta.carve.build.bounds import find_bounds
from veduta.carve.build.consistency import carve_by_colour
from veduta.carve.build.hull import carve_hull, root_of
from veduta.carve.build.measures import measure_mesh, overlaps
from veduta.carve.options import ColourOptions
from veduta.run.card import choose_engine


def test_a_bowl_loses_its_lid_and_keeps_its_silhouettes() -> None:
    views = bowl_views(240, grain=0.24)
    hull = carve_hull(views, root_of(find_bounds(views), 6))
    filled = measure_mesh(*hull.surface(), views).volume
    assert filled > 1.9 * VOLUME, "the hull is filled to the rim"
    found = carve_by_colour(hull, views, ColourOptions(spread=20.0))
    positions, triangles = found.hull.surface()
    assert VOLUME < measure_mesh(positions, triangles, views).volume < 0.8 * filled
    assert overlaps(views, positions, triangles).min() > 0.93
    carved = carved_triangles(positions, triangles, found)
    middles = positions[triangles].mean(axis=1)
    # One voxel around the true hollow.
    near = np.linalg.norm(middles[carved], axis=1) < INNER + 2.0 * found.root.voxel_m
    assert near.mean() > 0.95
    outside = np.linalg.norm(middles, axis=1) > INNER + 3.0 * found.root.voxel_m
    assert not carved[outside].any()


@pytest.mark.skipif(
    not hasattr(_core, "GraphicsCard"), reason="built without graphics cards: make gpu"
)
def test_a_card_carves_the_same_hollow() -> None:
    engine = choose_engine("gpu", software=True)
    views = bowl_views(160, grain=0.24)
    hull = carve_hull(views, root_of(find_bounds(views), 6))
    options = ColourOptions(spread=20.0)
    wanted = carve_by_colour(hull, views, options)
    found = carve_by_colour(hull, views, options, engine=engine)
    assert wanted.carved.sum() > 300
    assert found.typical == pytest.approx(wanted.typical, abs=0.02)
    # Single precision: a voxel on the threshold may fall on either side, then its neighbours.
    assert (found.carved != wanted.carved).sum() < 0.02 * wanted.carved.sum()
