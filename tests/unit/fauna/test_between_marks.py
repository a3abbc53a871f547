"""Joints between marked frames, against drawn animals whose joints are known."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest

from veduta.fauna.read.between_marks import CarriedMarks, CarryLooks, carried_marks
from veduta.fauna.read.joints import read_joints, written_joints
from veduta.synthetic.animals import Filmed, film_quadruped

EVERY = 8
FRAMES = 17
NEAR = ("hind_toe_right", "front_toe_right", "hock_right")
"""What nothing hides: the animal goes to the right."""


@lru_cache(maxsize=1)
def filmed() -> Filmed:
    return film_quadruped(711, frames=FRAMES, cycle=20.0, mottled=True)


@lru_cache(maxsize=1)
def carried() -> CarriedMarks:
    film = filmed()
    marked = np.arange(FRAMES) % EVERY == 0
    pins = {name: np.where(marked[:, None], film.joints[name], np.nan) for name in NEAR}
    return carried_marks(film.frames, film.masks, pins, CarryLooks())


def test_joints_are_found_between_marked_frames_where_straight_lines_miss_them() -> None:
    film, rows = filmed(), np.arange(FRAMES)
    marked = rows[rows % EVERY == 0]
    inner = (rows % EVERY != 0) & (rows < marked[-1])
    off, straight = [], []
    for name in NEAR:
        true = film.joints[name][inner]
        line = np.stack([np.interp(rows, marked, film.joints[name][marked, k]) for k in (0, 1)], 1)
        off.append(np.linalg.norm(carried().px[name][inner] - true, axis=1) / film.length_px)
        straight.append(np.linalg.norm(line[inner] - true, axis=1) / film.length_px)
    assert np.mean(np.concatenate(off) < 0.03) > 0.9
    assert np.mean(np.concatenate(straight) < 0.03) < 0.7


def test_a_mark_leads_some_frames_beyond_the_last_one_and_no_farther() -> None:
    film = filmed()
    pins = {"nose": np.full((FRAMES, 2), np.nan)}
    pins["nose"][9] = film.joints["nose"][9]
    found = carried_marks(film.frames, film.masks, pins, CarryLooks(alone=4))
    there = np.flatnonzero(np.isfinite(found.px["nose"][:, 0]))
    np.testing.assert_array_equal(there, np.arange(5, 14))
    off = np.linalg.norm(found.px["nose"][there] - film.joints["nose"][there], axis=1)
    assert off.max() < 0.03 * film.length_px


def test_marks_stay_as_they_are_and_are_trusted_most() -> None:
    marked = np.arange(FRAMES) % EVERY == 0
    for name in NEAR:
        np.testing.assert_array_equal(carried().px[name][marked], filmed().joints[name][marked])
        trust = carried().trust[name]
        np.testing.assert_array_equal(trust[marked], 1.0)
        assert (trust[~marked] < 1.0).all()


def test_what_is_carried_over_equal_frames_is_not_read_back_as_marked(tmp_path: Path) -> None:
    film = filmed()
    pictures, masks = (np.repeat(one[:1], 7, axis=0) for one in (film.frames, film.masks))
    pins = {"nose": np.full((7, 2), np.nan)}
    pins["nose"][[0, 6]] = film.joints["nose"][0]
    found = carried_marks(pictures, masks, pins, CarryLooks())
    assert np.isfinite(found.px["nose"]).all()
    path = tmp_path / "joints.csv"
    path.write_text(written_joints(found.px, found.trust, np.arange(7)))
    again = read_joints(path, 7, ("nose",), [])
    there = np.isfinite(again.px["nose"][:, 0])
    np.testing.assert_array_equal(np.flatnonzero(there), [0, 6])


def test_a_place_that_looks_otherwise_than_both_marks_is_trusted_little() -> None:
    film = filmed()
    pictures = film.frames[:9].copy()
    pictures[3:6] = 255 - pictures[3:6]
    pins = {"nose": np.full((9, 2), np.nan)}
    pins["nose"][[0, 8]] = film.joints["nose"][[0, 8]]
    clean = carried_marks(film.frames[:9], film.masks[:9], pins, CarryLooks())
    spoilt = carried_marks(pictures, film.masks[:9], pins, CarryLooks())
    assert spoilt.trust["nose"][4] < 0.3
    assert clean.trust["nose"][4] > 0.8


@pytest.mark.parametrize("gap", [1, 30])
def test_without_a_gap_or_over_too_long_a_one_nothing_is_carried_between(gap: int) -> None:
    pictures = np.zeros((gap + 1, 40, 60, 3), np.uint8)
    masks = np.zeros((gap + 1, 40, 60), dtype=np.bool_)
    pins = {"nose": np.full((gap + 1, 2), np.nan)}
    pins["nose"][[0, gap]] = [20.0, 20.0]
    found = carried_marks(pictures, masks, pins, CarryLooks(longest=10, alone=2))
    there = np.isfinite(found.px["nose"][:, 0]).sum()
    assert there == min(gap + 1, 2 + 2 * 2)
