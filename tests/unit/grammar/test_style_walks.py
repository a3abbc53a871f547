"""Walks behind the arcades of styles: one goes through them from house to house."""

from __future__ import annotations

import numpy as np

from veduta import grammar


def _house(depth_m: float) -> grammar.Derivation:
    lot = [(0.0, 0.0), (14.0, 0.0), (14.0, depth_m), (0.0, depth_m)]
    return grammar.derive(grammar.parse("empire"), [lot], seed=3, attributes={"arcade": True})


def _corners(house: grammar.Derivation, name: str) -> list[np.ndarray]:
    found = [shape.polygons().corners_m for shape in house.shapes() if shape.name == name]
    return [corners for corners in found if len(corners)]


def test_the_walk_of_an_arcade_has_a_ceiling_and_is_open_at_both_ends() -> None:
    house = _house(12.0)
    ceiling = _corners(house, "WalkSoffit")[-1]
    np.testing.assert_allclose(np.ptp(ceiling, axis=0), [14.0, 3.1, 0.0], atol=1e-6)
    first, second, third = ceiling[:3]
    assert np.cross(second - first, third - first)[2] < 0, "it is seen from below"
    ends = _corners(house, "Through")
    assert {round(float(end[:, 0].mean()), 3) for end in ends} == {0.0, 14.0}
    for end in ends:
        assert end[:, 1].min() > 0.0
        assert end[:, 1].max() < 3.1, "within the walk"


def test_a_house_without_room_for_a_walk_has_none() -> None:
    house = _house(6.0)
    assert not _corners(house, "WalkSoffit")
    assert not _corners(house, "Through")
