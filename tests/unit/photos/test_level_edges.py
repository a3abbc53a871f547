"""A wall goes as the level edges on it do, on streets of known truth."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from simulated_street import simulated_street

from veduta.imaging.segments import Segments
from veduta.photos.cameras.orient import oriented
from veduta.photos.cameras.upright import upright
from veduta.photos.options import WallOptions
from veduta.photos.structure import Structure
from veduta.photos.walls.find_walls import find_walls
from veduta.photos.walls.level_edges import turned_to_edges
from veduta.photos.walls.wall import Wall


@cache
def _street() -> tuple[Structure, Wall]:
    _, _, structure = simulated_street(1)
    structure = upright(oriented(structure).structure)[0]
    return structure, find_walls(structure, WallOptions(), 0)[0]


def _askew(wall: Wall, turn_rad: float) -> Wall:
    """Turned about its middle; its points lie as far off its plane as they do."""
    middle = (wall.start + wall.end) / 2
    c, s = np.cos(turn_rad), np.sin(turn_rad)
    turn = np.array([[c, -s], [s, c]])
    ends = [middle + turn @ (end - middle) for end in (wall.start, wall.end)]
    return replace(wall, start=ends[0], end=ends[1], rms=wall.rms)


def _seen(structure: Structure, lines: NDArray[np.float64], row: int) -> Segments:
    """(n, 2, 3) lines as a photo shows them, those before it."""
    pose = structure.cam_from_world[row]
    local = lines @ pose[:, :3].T + pose[:, 3]
    kept = local[(local[..., 2] > 0.1).all(axis=1)]
    pixels = np.asarray(structure.camera(row).img_from_cam(kept.reshape(-1, 3))).reshape(-1, 2, 2)
    return Segments(pixels[:, 0], pixels[:, 1])


def _courses(wall: Wall, count: int = 30) -> NDArray[np.float64]:
    """(n, 2, 3) level lines on a wall, some of which stand out of it."""
    rng = np.random.default_rng(4)
    left = rng.uniform(0.1, 0.5, count) * wall.width
    right = left + rng.uniform(0.2, 0.4, count) * wall.width
    out = np.where(rng.random(count) < 0.4, 0.05 * wall.width, 0.0)
    z = rng.uniform(wall.bottom, wall.top, count)
    ends = []
    for along in (left, right):
        flat = wall.start + along[:, None] * wall.along + out[:, None] * wall.outward
        ends.append(np.column_stack([flat, z]))
    return np.stack(ends, axis=1)


@pytest.mark.parametrize("turn_deg", [-4.0, -1.0, 2.5])
def test_a_wall_is_turned_to_its_courses(turn_deg: float) -> None:
    structure, wall = _street()
    askew = _askew(wall, np.deg2rad(turn_deg))
    courses = _courses(wall)
    (found,) = turned_to_edges([askew], structure, lambda row: _seen(structure, courses, row))
    off = np.rad2deg(np.arccos(np.clip(found.along @ wall.along, -1.0, 1.0)))
    assert off < 0.1
    assert found.width == pytest.approx(askew.width)
    assert found.rms < 1.2 * wall.rms
    assert abs((found.start - wall.start) @ wall.outward) < 0.01 * wall.width
    assert found.outward @ wall.outward > 0.99


def test_a_wall_is_not_turned_away_from_its_points() -> None:
    structure, wall = _street()
    askew = replace(_askew(wall, 0.05), rms=0.0061 * wall.width)  # said to lie near them
    courses = _courses(wall)
    (found,) = turned_to_edges([askew], structure, lambda row: _seen(structure, courses, row))
    assert found is askew


def test_corners_that_were_closed_stay_closed() -> None:
    structure, wall = _street()
    aside = replace(
        wall, id="w001", start=wall.end, end=wall.end - 0.5 * wall.width * wall.outward, rms=0.0
    )
    askew = _askew(wall, np.deg2rad(1.0))
    corner = askew.end
    both = [askew, replace(aside, start=corner, end=corner + (aside.end - aside.start))]
    courses = _courses(wall)
    found = turned_to_edges(both, structure, lambda row: _seen(structure, courses, row))
    assert found[0].along @ wall.along > 0.9999
    assert found[1].start == pytest.approx(found[0].end)


def test_lines_every_way_turn_nothing() -> None:
    structure, wall = _street()
    rng = np.random.default_rng(5)
    askew = _askew(wall, 0.03)
    middle = np.append((wall.start + wall.end) / 2, (wall.bottom + wall.top) / 2)
    lines = middle + 0.3 * wall.width * rng.normal(size=(80, 2, 3))
    (found,) = turned_to_edges([askew], structure, lambda row: _seen(structure, lines, row))
    assert found is askew


def test_a_wall_whose_points_are_flat_stays() -> None:
    structure, wall = _street()
    sure = replace(_askew(wall, 0.03), rms=0.001 * wall.width)
    courses = _courses(wall)
    found = turned_to_edges([sure], structure, lambda row: _seen(structure, courses, row))
    assert found == (sure,)
