"""Edges of a surface model: of houses that stand across its cells, below ragged eaves, of trees."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.drive.read.rivals import RivalParameters, fits_of
from veduta.drive.read.surface_model import SurfaceModel, read_surface_model
from veduta.synthetic.drives.surface import write_surface

Floats = NDArray[np.float64]
SIDE, HIGH_M, DEEP_M = 80, 18.0, 12.0
SCANNER_M = 3.6
WALL = np.column_stack([np.linspace(-18.0, 18.0, 145), np.zeros(145)])
"""Points of the wall in the house's frame: x along it, y into the house."""


def _cells() -> Floats:
    """(SIDE, SIDE, 2) middles of the cells, the first at 0.5, 0.5."""
    y, x = np.mgrid[0:SIDE, 0:SIDE] + 0.5
    return np.stack([x, y], axis=2)


def _world(points: Floats, degrees: float) -> Floats:
    """From the house's frame to the map's, in whose middle the wall's middle is."""
    cosine, sine = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return points @ np.array([[cosine, sine], [-sine, cosine]]) + SIDE / 2


def _house(degrees: float, eaves_m: float, ragged: float = 0.0) -> Floats:
    """Heights of a house that stands so turned; of the cells of its eaves a share is missing."""
    cosine, sine = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    own = (_cells() - SIDE / 2) @ np.array([[cosine, -sine], [sine, cosine]])
    inside = (np.abs(own[..., 0]) < 20.0) & (own[..., 1] > -eaves_m) & (own[..., 1] < DEEP_M)
    missing = np.random.default_rng(3).uniform(size=inside.shape) < ragged
    inside &= ~((own[..., 1] < 0.0) & missing)
    return np.where(inside, HIGH_M, 0.0)


def _read(heights: Floats, path: Path) -> SurfaceModel:
    write_surface(heights.astype(np.float32), (0.0, 0.0), path)
    return read_surface_model(path, SCANNER_M)


def _off(model: SurfaceModel, points: Floats) -> Floats:
    """(n,) distances of points (n, 2) to edges."""
    at = np.floor(points / model.cell_m).astype(int)
    return model.distance_m[at[:, 1], at[:, 0]].astype(np.float64)


@pytest.mark.parametrize("degrees", [0.0, 20.0, 33.0, 45.0, 70.0])
def test_a_tall_house_across_the_cells_keeps_its_edges(degrees: float, tmp_path: Path) -> None:
    model = _read(_house(degrees, 0.8, 0.4), tmp_path / "a.tif")
    off = _off(model, _world(WALL, degrees))
    assert np.mean(np.abs(off) < 0.9) > 0.9


def test_a_wall_is_as_far_behind_ragged_eaves_as_behind_even_ones(tmp_path: Path) -> None:
    even = _off(_read(_house(0.0, 1.0), tmp_path / "a.tif"), _world(WALL, 0.0))
    ragged = _off(_read(_house(0.0, 1.0, 0.3), tmp_path / "b.tif"), _world(WALL, 0.0))
    assert np.mean(np.abs(even) < 0.8) > 0.9
    assert np.mean(np.abs(ragged) < 0.8) > 0.9


def _crown(random: np.random.Generator) -> Floats:
    """Heights of a crown of 7 m: leaves at all heights of it."""
    away = np.linalg.norm(_cells() - SIDE / 2, axis=2)
    return np.where(away < 7.0, random.uniform(4.0, 11.0, away.shape), 0.0)


def test_a_crown_has_no_edges_and_lets_beams_through(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    model = _read(_crown(random), tmp_path / "a.tif")
    assert model.edges < 0.03
    inside = SIDE / 2 + random.uniform(-3.0, 3.0, (200, 2))
    beams = np.stack([inside, inside])
    assert fits_of(np.zeros((1, 2)), beams, model, RivalParameters())[0] > -0.05
