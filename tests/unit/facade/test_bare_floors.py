"""Floors whose railings are none: they do not look more like railings than the windows do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from veduta.facade.appearance import LIMIT, Scores
from veduta.facade.bare_floors import bare_floors, doubt_railings, without_railings
from veduta.facade.boxes import Box
from veduta.facade.evidence import Evidence, Float, gather
from veduta.facade.floors import Floors

FLOORS = Floors([20, 60, 100, 140], 40.0, -0.5, {}, 100)
HEIGHT, WIDTH = 200, 120


def boxes() -> list[Box]:
    """Two windows on each of three floors, each with what may be a railing."""
    found = []
    for number, top in ((3, 20), (2, 60), (1, 100)):
        for x in (20, 70):
            found.append(Box("window", x, top + 6, 20, 18, number, x // 50, 0.9))
            found.append(Box("balcony", x - 4, top + 24, 28, 12, number, None, 0.9))
    return found


def picture(gains: dict[int, float], lines: dict[int, float]) -> tuple[Evidence, Scores]:
    """Railings of each floor, better than its windows by `gains`, their level edges by `lines`."""
    railing: Float = np.zeros((FLOORS.ground_top - FLOORS.eaves, WIDTH), np.float32)
    evidence = gather(np.zeros((HEIGHT, WIDTH, 3), np.uint8), np.ones((HEIGHT, WIDTH), bool))
    gy: Float = np.full((HEIGHT, WIDTH), 10.0, np.float32)
    for box in boxes():
        if box.kind == "balcony" and box.floor is not None:
            railing[box.part(FLOORS.eaves)] = gains[box.floor]
            gy[box.part()] = 10.0 * lines[box.floor]
    return replace(evidence, gy=gy), Scores(railing * 0, railing, railing * 0)


@pytest.mark.parametrize(
    ("gains", "lines", "bare"),
    [
        ({1: 0.6, 2: 0.6, 3: 0.6}, {1: 1.0, 2: 1.0, 3: 1.0}, set()),
        ({1: 0.1, 2: 0.1, 3: 0.1}, {1: 2.0, 2: 2.0, 3: 2.0}, set()),
        ({1: 0.1, 2: 0.1, 3: 0.1}, {1: 0.8, 2: 0.8, 3: 0.8}, {1, 2, 3}),
        ({1: -0.2, 2: -0.2, 3: -0.2}, {1: 2.0, 2: 2.0, 3: 2.0}, {1, 2, 3}),
        ({1: 0.6, 2: -0.4, 3: 0.6}, {1: 1.0, 2: 1.0, 3: 1.0}, {2}),
        ({1: -0.4, 2: 0.3, 3: -0.4}, {1: 1.0, 2: 1.0, 3: 1.0}, {1, 2, 3}),
    ],
)
def test_which_floors_are_bare(
    gains: dict[int, float], lines: dict[int, float], bare: set[int]
) -> None:
    evidence, scores = picture(gains, lines)
    assert bare_floors(boxes(), evidence, FLOORS, scores) == bare


def test_no_railings_no_bare_floors() -> None:
    evidence, scores = picture({1: 0.0, 2: 0.0, 3: 0.0}, {1: 1.0, 2: 1.0, 3: 1.0})
    windows = [box for box in boxes() if box.kind == "window"]
    assert bare_floors(windows, evidence, FLOORS, scores) == frozenset()
    railings = [box for box in boxes() if box.kind == "balcony"]
    assert bare_floors(railings, evidence, FLOORS, scores) == frozenset()


def test_railings_are_as_sure_as_they_stand_out() -> None:
    _, scores = picture({1: -0.3, 2: 0.1, 3: 2.0}, {1: 1.0, 2: 1.0, 3: 1.0})
    doubted = doubt_railings(boxes(), scores, FLOORS)
    assert [box.score for box in doubted if box.kind == "window"] == [0.9] * 6
    sure = {box.floor: box.score for box in doubted if box.kind == "balcony"}
    assert sure[1] < 0.5 < sure[2] < sure[3] == 0.9
    alone = [box for box in boxes() if box.kind == "balcony"]
    assert doubt_railings(alone, scores, FLOORS) == alone


def test_only_bare_floors_lose_their_railings() -> None:
    _, scores = picture({1: 0.5, 2: 0.5, 3: 0.5}, {1: 1.0, 2: 1.0, 3: 1.0})
    left = without_railings(scores, FLOORS, frozenset({2}))
    assert (left.railing[40:80] == -LIMIT).all()
    assert (left.railing[:40] == scores.railing[:40]).all()
    assert (left.railing[80:] == scores.railing[80:]).all()
    assert left.window is scores.window
