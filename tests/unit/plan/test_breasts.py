"""Chimney breasts and other thickenings of walls, and walls of glass that are laid straight."""

from __future__ import annotations

import numpy as np

from veduta.plan.openings.along import changed_stretches
from veduta.plan.rooms.levelled import between_stubs, levelled
from veduta.plan.walls.axes import Axis
from veduta.plan.walls.breasts import without_breasts
from veduta.plan.walls.pieces import Piece
from veduta.plan.walls.solid import Thickness
from veduta.plan.walls.tracks import find_tracks

THICK = Thickness(8.0, 20.0)


def party_wall() -> np.ndarray:
    """A wall 20 px thick along y, from 50 to 70 across."""
    mask = np.zeros((400, 300), np.bool_)
    mask[20:380, 50:70] = True
    return mask


def test_a_breast_is_cut_off_at_the_face_of_its_wall() -> None:
    wall = party_wall()
    mask = wall.copy()
    mask[120:210, 70:96] = True
    found, count = without_breasts(mask, find_tracks(mask), THICK)
    assert count == 1
    assert np.array_equal(found, wall)


def test_breasts_on_both_sides_are_cut_off() -> None:
    wall = party_wall()
    mask = wall.copy()
    mask[120:210, 28:96] = True
    found, count = without_breasts(mask, find_tracks(mask), THICK)
    assert count == 1
    assert np.array_equal(found, wall)


def test_a_wall_that_stays_thicker_stays() -> None:
    mask = party_wall()
    mask[200:380, 70:96] = True
    found, count = without_breasts(mask, find_tracks(mask), THICK)
    assert count == 0
    assert found is mask


def test_a_stub_of_wall_beside_a_door_stays() -> None:
    mask = party_wall()
    mask[190:202, 70:95] = True
    found, count = without_breasts(mask, find_tracks(mask), THICK)
    assert count == 0
    assert found[195, 90]


def test_a_wall_that_joins_stays() -> None:
    mask = party_wall()
    mask[190:202, 70:280] = True
    found, count = without_breasts(mask, find_tracks(mask), THICK)
    assert count == 0
    assert found[195, 200]


def test_panes_beside_each_other_become_one_upright_wall() -> None:
    steps = np.array([[100.0, 53.0], [200.0, 52.0], [204.0, 47.0], [300.0, 46.0]])
    line = levelled(steps, [], 10.0)
    assert len(line) == 2
    assert line[0, 1] == line[1, 1]
    assert 46.0 <= line[0, 1] <= 53.0


def test_a_levelled_wall_goes_on_from_the_wall_beside_it() -> None:
    stub = Axis(Piece(np.array([305.0, 50.0]), np.array([340.0, 50.0]), 10.0), ())
    line = levelled(np.array([[100.0, 53.0], [300.0, 46.0]]), [stub], 10.0)
    assert line[:, 1].tolist() == [50.0, 50.0]


def test_slanted_walls_stay_slanted() -> None:
    slanted = np.array([[100.0, 50.0], [300.0, 90.0]])
    assert levelled(slanted, [], 10.0) is slanted


def test_a_wall_between_stubs_is_as_thick_as_they_are() -> None:
    solid = np.zeros((120, 400), np.bool_)
    solid[40:60, 80:100] = solid[40:60, 300:330] = True
    found = between_stubs(np.array([[101.0, 46.0], [299.0, 46.0]]), solid, (5.0, 40.0), 12.0)
    assert found is not None
    line, thick = found
    assert thick == 20.0
    assert line[:, 1].tolist() == [50.0, 50.0]


def test_stubs_that_disagree_say_nothing() -> None:
    solid = np.zeros((120, 400), np.bool_)
    solid[40:60, 80:100] = solid[48:60, 300:330] = True
    assert between_stubs(np.array([[101.0, 50.0], [299.0, 50.0]]), solid, (5.0, 40.0), 12.0) is None


def test_a_paler_stretch_of_a_rimmed_wall_is_wall() -> None:
    usual = np.array([0.8, 0.9, 0.85, 0.7, 0.6, 0.6, 0.6, 0.6, 0.6, 0.7, 0.85, 0.9, 0.8])
    own = np.repeat(usual[:, None], 200, axis=1)
    own[:, 60:140] *= 0.6
    assert changed_stretches(own, usual, 30.0) == []
    own[4:9, 60:140] = 0.0  # a pane between both faces
    assert changed_stretches(own, usual, 30.0) == [(60, 140)]


def test_a_stub_as_broad_as_thin_walls_is_no_pier_however_short() -> None:
    mask = np.zeros((400, 300), np.bool_)
    mask[20:380, 50:58] = mask[20:28, 50:280] = mask[372:380, 50:280] = True
    mask[190:199, 58:66] = True
    found, count = without_breasts(mask, find_tracks(mask), Thickness(6.0, 8.0))
    assert count == 0
    assert found[195, 64]
