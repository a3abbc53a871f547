"""An animal that turns round: it is told, and both stretches beside the turn are used."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from veduta.fauna.document.plan import load_plan
from veduta.fauna.limbed_recipe import parted
from veduta.fauna.read.footage import Footage
from veduta.fauna.read.silhouettes import SilhouetteLooks, Silhouettes, silhouettes_of
from veduta.fauna.read.ways import WayLooks, stretches_of, ways_of
from veduta.fauna.read.windows import middles_of, windows_of
from veduta.run.options import Options
from veduta.run.progress import no_progress
from veduta.run.work import Work
from veduta.synthetic.animals import Filmed, film_quadruped, turned_round

FIRST, LAST = 20, 30


@lru_cache(maxsize=1)
def straight() -> Filmed:
    return film_quadruped(741, frames=52, cycle=18.0)


@lru_cache(maxsize=1)
def filmed() -> Filmed:
    return turned_round(straight(), FIRST, LAST)


def _silhouettes(film: Filmed) -> Silhouettes:
    return silhouettes_of(film.masks, SilhouetteLooks(), "film", with_cut=True)


def _footage() -> Footage:
    return Footage(filmed().frames, np.arange(len(filmed().frames)), 0.04, assumed=False)


def _work() -> Work:
    return Work(Path(), Path(), "fauna", "1", Options(), no_progress)


def marks(found: Silhouettes, joints: int) -> dict[str, NDArray[np.float64]]:
    return {f"joint_{number}": np.ones(len(found.rows)) for number in range(joints)}


def test_the_turn_is_found_and_which_way_it_looks_beside_it() -> None:
    found = _silhouettes(filmed())
    stretches = stretches_of(found, None, WayLooks(), {})
    assert stretches.right is not None
    np.testing.assert_array_equal(stretches.right[found.rows <= FIRST], 1.0)
    np.testing.assert_array_equal(stretches.right[found.rows >= LAST], -1.0)
    turning = found.rows[stretches.turning]
    assert len(turning)
    assert turning.min() > FIRST
    assert turning.max() < LAST


def test_one_that_walks_straight_or_backwards_does_not_turn() -> None:
    film = straight()
    middle = middles_of(film.masks)
    assert not ways_of(film.masks, middle, None, WayLooks()).turns
    # It goes back without ever being narrow.
    order = np.r_[0:26, 26:0:-1]
    back = ways_of(film.masks[order], middle[order], None, WayLooks())
    assert not back.turns
    assert not back.turning.any()


def test_marks_hold_an_animal_in_its_turn_only_where_no_cycle_is() -> None:
    found = _silhouettes(filmed())
    assert stretches_of(found, None, WayLooks(), marks(found, 5)).right is not None
    # Twenty frames hold less than a cycle and a half.
    fewer = found.of(np.flatnonzero((found.rows >= 15) & (found.rows < 36)))
    looks = WayLooks(back=0.08)
    assert stretches_of(fewer, None, looks, {}).right is not None
    held = stretches_of(fewer, None, looks, marks(fewer, 5))
    assert held.right is None
    assert held.turning.any()
    # Neither one joint in all frames nor all joints in one frame hold it.
    assert stretches_of(fewer, None, looks, marks(fewer, 1)).right is not None
    one = {joint: np.where(fewer.rows == 15, 1.0, 0.0) for joint in marks(fewer, 9)}
    assert stretches_of(fewer, None, looks, one).right is not None


def test_a_step_back_beside_a_turn_leaves_the_turn() -> None:
    film = filmed()
    rows = np.r_[0:51, 51:34:-1, 34:52]
    masks = film.masks[rows]
    ways = ways_of(masks, middles_of(masks), None, WayLooks())
    assert ways.turns
    np.testing.assert_array_equal(ways.right[:FIRST], 1.0)
    np.testing.assert_array_equal(ways.right[LAST:], -1.0)
    assert not ways.turning[LAST:].any()


def test_a_turn_beside_which_too_little_is_left_is_told_and_kept() -> None:
    found = _silhouettes(filmed())
    cut = replace(found, cut=found.rows >= 3)
    few = stretches_of(cut, None, WayLooks(), {})
    assert few.few
    assert few.turning.any()
    assert few.right is None
    work = _work()
    kept, ways, _ = parted(work, _footage(), cut, load_plan("quadruped"), [], {})
    assert len(kept.rows) == len(found.rows)
    assert ways is None
    (step,) = work.steps
    assert "too few" in step.rejected[0]


def test_a_frame_that_is_cut_and_turns_is_left_out_and_fitted_nowhere() -> None:
    found = _silhouettes(filmed())
    border = found.rows >= (FIRST + LAST) // 2
    cut = replace(found, cut=border)
    left_out: list[str] = []
    kept, _, used = parted(_work(), _footage(), cut, load_plan("quadruped"), left_out, {})
    gone = {int(one.split()[1].rstrip(":")) for one in left_out}
    assert gone & set(found.rows[border].tolist())
    assert not gone & set(used)
    assert set(used) <= set(kept.rows.tolist())


def test_windows_after_the_turn_are_mirrored_and_lead_back_to_the_same_pixels() -> None:
    film = filmed()
    rows = np.array([5, 45])
    masks = film.masks[rows]
    windows = windows_of(masks, 40, middles_of(film.masks)[rows])
    turned = windows.turned_where(np.array([1.0, -1.0]))
    np.testing.assert_array_equal(turned.shares[0], windows.shares[0])
    np.testing.assert_array_equal(turned.shares[1], windows.shares[1][:, ::-1])
    nose = np.stack([film.joints["nose"][rows], film.joints["hip"][rows]], axis=1)
    here = turned.from_picture(nose, 90.0)
    assert (here[:, 0, 0] > here[:, 1, 0]).all()
    np.testing.assert_allclose(turned.in_picture(here, 90.0), nose, atol=1e-9)
    other = turned.mirrored()
    np.testing.assert_array_equal(other.ways(), [-1.0, 1.0])
    np.testing.assert_array_equal(other.of(np.array([1])).ways(), [1.0])
    assert len(replace(windows, turned=np.zeros(0)).ways()) == 2
