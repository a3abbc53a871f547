"""Stairs that turn, found on drawn sheets: against the treads that were drawn."""

from __future__ import annotations

import tracemalloc
from functools import cache

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Polygon, box

from veduta.plan import document
from veduta.plan.drawn import DrawnStairs
from veduta.plan.load_treads import walk_faults
from veduta.plan.stairs import course, fans
from veduta.plan.stairs.find import find_flights, without_flights
from veduta.plan.stairs.probe import probe_of
from veduta.synthetic.plans.house import Stairs, StairsKind
from veduta.synthetic.plans.stairs import StairPlan, stairs_in

PX_PER_M = 80.0
LINE = 2
SIZES: dict[StairsKind, tuple[int, int]] = {
    "quarter-winding": (6, 4), "quarter-landing": (8, 4), "half-winding": (4, 5),
    "half-landing": (6, 6), "spiral": (0, 0),
}  # fmt: skip


def true_stairs(kind: StairsKind, *, mirrored: bool) -> Stairs:
    plan = StairPlan(kind, mirrored, 0.95, 0.27, *SIZES[kind])
    wide, deep = plan.room_m
    return stairs_in(box(3.0, 3.0, 3.0 + wide, 3.0 + deep), plan)


def pixels(points: tuple[tuple[float, float], ...]) -> NDArray[np.float64]:
    """From a plan of 12 x 10 m, y up."""
    return np.array(points) * [PX_PER_M, -PX_PER_M] + [0.0, 10.0 * PX_PER_M]


def sheet(stairs: Stairs | None, *, arrow: bool = True) -> NDArray[np.uint8]:
    """The stairs in a house of solid walls."""
    grey = np.zeros((int(10 * PX_PER_M), int(12 * PX_PER_M)), np.uint8)
    cv2.rectangle(grey, (40, 40), (920, 760), 255, -1)
    cv2.rectangle(grey, (65, 65), (895, 735), 0, -1)
    for ring in stairs.steps_m if stairs else ():
        cv2.polylines(grey, [np.round(pixels(ring)).astype(np.int32)], True, 255, LINE)
    if stairs and arrow:
        line = pixels(stairs.path_m)
        tip, back = line[-1], line[-1] - line[-2]
        back = back / np.hypot(*back)
        line[-1] = tip = tip - 10.0 * back
        across = np.array([-back[1], back[0]])
        head = [tip - 16.0 * back + 10.0 * across, tip, tip - 16.0 * back - 10.0 * across]
        for one in (line, np.array(head)):
            cv2.polylines(grey, [np.round(one).astype(np.int32)], False, 255, LINE)
    return grey


@cache
def found(kind: StairsKind, *, mirrored: bool, arrow: bool = True) -> tuple[DrawnStairs, ...]:
    return find_flights(sheet(true_stairs(kind, mirrored=mirrored), arrow=arrow) > 0, LINE)


@pytest.mark.parametrize("kind", SIZES)
@pytest.mark.parametrize("mirrored", [False, True])
def test_each_tread_is_found_where_it_is_drawn(kind: StairsKind, mirrored: bool) -> None:
    true = true_stairs(kind, mirrored=mirrored)
    (one,) = found(kind, mirrored=mirrored)
    assert one.treads == len(one.steps_px) == true.treads
    for step, ring in zip(one.steps_px, true.steps_m, strict=True):
        here, there = Polygon(step), Polygon(pixels(ring))
        assert here.intersection(there).area > 0.8 * here.union(there).area
    # It rises along its arrow: the order above says so, too.
    assert np.hypot(*one.up_px) == pytest.approx(1.0)
    assert np.dot(one.up_px, np.array(true.up) * [1.0, -1.0]) > 0.95


@pytest.mark.parametrize("kind", SIZES)
def test_what_is_found_is_not_refused_when_it_is_read_again(kind: StairsKind) -> None:
    (one,) = found(kind, mirrored=False)
    assert one.path_px is not None
    stairs = document.Stairs(
        id="s1", outline_m=(one.outline_px / PX_PER_M).tolist(), treads=one.treads, up=one.up_px,
        steps_m=[(step / PX_PER_M).round(3).tolist() for step in one.steps_px],
        path_m=(one.path_px / PX_PER_M).round(3).tolist(), score=one.score,
    )  # fmt: skip
    assert walk_faults(stairs, "stairs[0]") == []


@pytest.mark.parametrize("kind", ["quarter-winding", "half-landing"])
def test_without_an_arrow_nothing_tells_which_way_they_rise(kind: StairsKind) -> None:
    (one,) = found(kind, mirrored=False, arrow=False)
    assert one.treads == true_stairs(kind, mirrored=False).treads
    assert one.up_px == (0.0, 0.0)


def test_what_lies_in_them_is_taken_out_and_nothing_around() -> None:
    true = true_stairs("quarter-winding", mirrored=False)
    ink = sheet(true) > 0
    cleared = without_flights(ink, found("quarter-winding", mirrored=False), LINE)
    inside = np.zeros(ink.shape, np.uint8)
    shape = Polygon(pixels(true.outline_m))
    cv2.fillPoly(inside, [np.array(shape.buffer(-8.0).exterior.coords, np.int32)], (1,))
    assert ink[inside > 0].any()
    assert not cleared[inside > 0].any()
    cv2.fillPoly(inside, [np.array(shape.buffer(8.0).exterior.coords, np.int32)], (1,))
    assert (cleared == ink)[inside == 0].all()


def test_many_lines_that_meet_take_little_memory() -> None:
    """160 of them meet by 12,000 pairs: all lists of their neighbours have 150 million entries."""
    turn = np.linspace(0.02, np.pi - 0.02, 160)
    ways = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    ends = np.stack([20.0 * ways, 100.0 * ways], axis=1) + 400.0
    probe = probe_of(np.zeros((800, 800), np.bool_), LINE, 800.0)
    tracemalloc.start()
    first, *_ = fans._meetings(ends, probe)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert first == pytest.approx([400.0, 400.0], abs=1e-6)
    assert most < 100e6


def test_ends_settle_only_where_their_neighbours_stay_treads() -> None:
    even = np.deg2rad([-3.0, 28.0, 59.0, 92.0])
    settled = fans._settled(even)
    assert settled is not None
    assert np.rad2deg(settled) == pytest.approx([0.0, 28.0, 59.0, 90.0])
    assert fans._settled(np.deg2rad([-12.0, -1.0, *range(10, 80, 11), 88.0])) is None


def test_a_wedge_is_the_largest_piece_of_its_bounds_or_nothing() -> None:
    newel = np.zeros(2)
    low, high = np.deg2rad([0.0, 45.0])
    split = Polygon([(10, -5), (50, -5), (50, 40), (10, 40), (10, 6), (45, 6), (45, 3), (10, 3)])
    cut = course._wedge(newel, low, high, split)
    truth = Polygon([(0, 0), (200, 0), (200, 200)]).intersection(split)
    pieces = getattr(truth, "geoms", [truth])
    assert cut is not None
    assert cut.area == pytest.approx(max(piece.area for piece in pieces), rel=1e-6)
    assert course._wedge(newel, low, high, box(-50, -50, -10, -10)) is None


def test_a_star_and_slanted_hatching_are_no_stairs() -> None:
    star = sheet(None)
    for angle in np.deg2rad([20.0, 80.0, 130.0, 200.0, 250.0, 320.0]):
        tip = np.array([480.0, 400.0]) + 60.0 * np.array([np.cos(angle), np.sin(angle)])
        cv2.line(star, (480, 400), tuple(np.round(tip).astype(int).tolist()), 255, LINE)
    hatched = sheet(None)
    for x in range(300, 420, 14):
        cv2.line(hatched, (x, 300), (x + 60, 360), 255, LINE)
    assert find_flights(star > 0, LINE) == ()
    assert find_flights(hatched > 0, LINE) == ()


@pytest.mark.parametrize("second", [slice(134, 136), slice(130, 136)])
def test_a_tread_ends_at_the_first_of_a_walls_two_lines(second: slice) -> None:
    """And a closet behind a thin wall, whose side lies on the second line, is no part of it."""
    ink = np.zeros((120, 300), np.bool_)
    ink[59:61, 20:120] = True
    ink[:, 120:122] = ink[:, second] = True
    probe = probe_of(ink, 2.0, 300.0)
    way = np.array([1.0, 0.0])
    assert probe.reach(np.array([20.0, 60.0]), way, 200.0, 16.0) == pytest.approx(102, abs=2)


def test_a_tread_goes_on_behind_an_arrow() -> None:
    ink = np.zeros((120, 300), np.bool_)
    ink[59:61, 20:60] = ink[59:61, 76:122] = True
    ink[20:100, 67:69] = ink[:, 120:122] = True
    probe = probe_of(ink, 2.0, 300.0)
    way = np.array([1.0, 0.0])
    assert probe.reach(np.array([20.0, 60.0]), way, 200.0, 10.0) == pytest.approx(102, abs=2)
