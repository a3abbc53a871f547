"""Photos of parts of rows, laid into a model from where GPS says; ends of walls and of views."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from registration_found import part_street
from registration_streets import SimulatedStreet

from veduta.photos.city.facades import facades_of
from veduta.photos.world.cut_ends import CutParameters, cut_ends
from veduta.photos.world.evidence import FacadeIndex
from veduta.photos.world.free_space import sight_lines, violations
from veduta.photos.world.gauss_newton import UP_SD_RAD
from veduta.photos.world.georeference import Georeference
from veduta.photos.world.gps_fit import gps_georeference
from veduta.photos.world.gps_positions import GpsPositions
from veduta.photos.world.pose import register_pose
from veduta.photos.world.prior import PlacementPrior, pose_placements
from veduta.photos.world.weighing import scene_of


@pytest.fixture(scope="module")
def part() -> SimulatedStreet:
    return part_street(2)


def prior_of(street: SimulatedStreet) -> PlacementPrior:
    places = street.centres_gps
    rows = np.arange(len(places))
    model = street.model
    positions = GpsPositions("EPSG:25832", model.origin_m, rows, places[:, :2], places[:, 2])
    prior = gps_georeference(street.structure, positions, 0)[1]
    assert prior is not None
    return prior


def laid(street: SimulatedStreet, prior: PlacementPrior, *, in_model: bool) -> Georeference:
    model = street.model if in_model else street.removed
    index = FacadeIndex(facades_of(model))
    return register_pose(
        scene_of(street.structure, street.walls, index, 0, UP_SD_RAD), model, prior
    )


def test_a_pose_is_refined_to_where_the_street_is(part: SimulatedStreet) -> None:
    found = laid(part, prior_of(part), in_model=True)
    assert found.accepted, found.why
    assert found.best is not None
    centres = part.structure.centres()
    true = part.world_from_model.moved(centres)
    apart = np.linalg.norm(found.best.world_from_model.moved(centres) - true, axis=1)
    assert 0.0 < apart.mean() < 0.25
    assert "from where GPS says" in found.why


def test_a_pose_elsewhere_or_in_another_model_is_refused(part: SimulatedStreet) -> None:
    prior = prior_of(part)
    missing = laid(part, prior, in_model=False)
    assert not missing.accepted
    assert missing.why.startswith(("where GPS says", "no placement"))
    for shift in (25.0, 25.0j):
        moved = laid(part, replace(prior, there=prior.there + shift), in_model=True)
        assert not moved.accepted, moved.why


def test_the_placements_of_a_pose_lie_about_it() -> None:
    prior = PlacementPrior(2.0 + 1.0j, 100.0 + 50.0j, 0.04, 0.05, 3.0)
    found = pose_placements(prior, 3.0 - 1.0j)
    there = found.turn * (3.0 - 1.0j) + found.shift - prior.there
    assert np.isclose(np.abs(there).max(), 2.0 * 3.0 / np.sqrt(2.0), atol=1.0)
    assert np.abs(np.angle(found.turn / prior.turn)).max() < 2.5 * 0.04 + np.deg2rad(1.0)
    assert np.isclose(np.abs(there).min(), 0.0)
    assert prior.allows(found, 3.0 - 1.0j).all()


def test_ends_are_cut_where_no_photo_shows_what_is_beyond(part: SimulatedStreet) -> None:
    """Against the projection of the same places into each photo, one by one."""
    structure, walls = part.structure, part.walls
    found = cut_ends(structure, walls)
    assert 0 < found.edges.sum() < found.edges.size
    assert found.tops.any()
    blind = cut_ends(structure, walls, CutParameters(fewest=len(structure.names) + 1))
    assert blind.edges.all()
    assert blind.tops.all()
    assert not cut_ends(structure, walls, CutParameters(fewest=0)).edges.any()


def test_cameras_are_inside_where_a_roof_is_above(part: SimulatedStreet) -> None:
    """Walls shorter than facades leave gaps in an outline: only a roof says what is inside."""
    facades = facades_of(part.model)
    world = part.world_from_model
    lines = sight_lines(part.structure, 0)
    assert not violations(lines, facades, world).inside.any()
    assert facades.roofs is not None
    middles = facades.roofs.mean(axis=1)[:40] - np.array([0.0, 0.0, 2.0])
    own = (middles - world.shift) @ world.rotation / world.scale
    assert violations(replace(lines, centres=own), facades, world).inside.all()
