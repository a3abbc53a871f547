"""How high the ground is: under photos, under a model that tells no heights, under GPS."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from known_structure import known_structure

from veduta.photos.city.facades import facades_of
from veduta.photos.city.lifted import lifted
from veduta.photos.city.model import CityModel
from veduta.photos.city.outlines import prism
from veduta.photos.city.parts import building_of
from veduta.photos.world.eye_height import Feet
from veduta.photos.world.georeference import Fit, Similarity
from veduta.photos.world.ground import ground_height, on_the_feet


@pytest.fixture
def model() -> CityModel:
    ring = np.array([[4.0, -3.0, 0.0], [9.0, -3.0, 0.0], [9.0, 3.0, 0.0], [4.0, 3.0, 0.0]])
    polygons, classes = prism([ring], 8.0)
    building, _ = building_of("b", polygons, classes, {}, solid=True)
    return CityModel((building,), "EPSG:25832", (500_000.0, 5_500_000.0, 0.0))


def test_the_ground_is_the_lowest_of_what_is_near() -> None:
    structure = known_structure()
    assert 0.0 <= ground_height(structure) < 0.2
    false = replace(structure, points=structure.points.copy())
    false.points[:3, 2] = -40.0
    assert ground_height(false) == pytest.approx(ground_height(structure), abs=0.1)


def test_a_model_without_heights_is_set_onto_it(model: CityModel) -> None:
    moved, note = lifted(model, facades_of(model), 120.5)
    assert facades_of(moved).bottom.tolist() == pytest.approx([120.5] * 4)
    assert "at 120.5 m" in note
    assert lifted(model, facades_of(model), 0.5) == (model, "")
    assert lifted(moved, facades_of(moved), 300.0) == (moved, "")


def test_gps_is_laid_onto_the_feet_of_the_model(model: CityModel) -> None:
    structure = known_structure()
    world = Similarity(2.0, np.eye(3), np.array([0.0, 0.0, 77.0]))
    fit = Fit(world, 0.01, np.zeros(3), np.full(3, 10.0), 1.0, 1.0, ())
    found = on_the_feet(fit, structure, Feet(facades_of(model)))
    there = found.world_from_model.moved(structure.points)[:, 2]
    assert np.quantile(there, 0.02) == pytest.approx(0.0, abs=0.2)
    assert found.shift_sd_m[2] < 1.0
    away = replace(world, shift=np.array([5000.0, 0.0, 77.0]))
    assert on_the_feet(replace(fit, world_from_model=away), structure, Feet(facades_of(model))) == (
        replace(fit, world_from_model=away)
    )
