"""Fronts of glass, drawn: storeys, mullions and panes are those that were drawn."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.evidence import Evidence, Float, gather
from veduta.facade.eyes import SeenElement
from veduta.facade.glass import beat, glass_note, glass_of, with_panes
from veduta.facade.houses import PartyWall, PartyWalls

HEIGHT, WIDTH, STOREY, PANE, BAR = 660, 400, 60, 25, 3
LEFT, RIGHT, TOP = 50, 350, 30


def front(*, storeys: int = 10, pane: int = PANE, spandrel: int = 20) -> tuple[Evidence, Float]:
    """Bands of glass between spandrels, with a mullion every `pane` pixels (0: none)."""
    picture = np.full((HEIGHT, WIDTH, 3), 200, np.uint8)
    chance = np.full((HEIGHT, WIDTH), 0.02, np.float32)
    for floor in range(storeys):
        rows = slice(TOP + floor * STOREY, TOP + (floor + 1) * STOREY - spandrel)
        picture[rows, LEFT:RIGHT] = (60, 80, 100)
        chance[rows, LEFT:RIGHT] = 0.9
        if pane:
            for x in range(LEFT, RIGHT, pane):
                picture[rows, x : x + BAR] = 220
    return gather(picture, np.ones((HEIGHT, WIDTH), np.bool_)), chance


def test_panes_lie_between_the_mullions_of_each_floor() -> None:
    glass = glass_of(*front())
    assert glass is not None
    assert (glass.floors, len(glass.panes)) == (10, 120)
    assert glass.storey == pytest.approx(STOREY, abs=0.5)
    assert glass.pane == pytest.approx(PANE, abs=0.2)
    for one in glass.panes:
        column = (0.5 * (one.x0 + one.x1) - LEFT - 0.5 * BAR) / PANE
        assert column % 1.0 == pytest.approx(0.5, abs=0.12), "the middle between two mullions"
        row = (one.y0 - TOP) / STOREY
        assert row == pytest.approx(round(row), abs=0.1)
        assert one.y1 - one.y0 == pytest.approx(40, abs=4)


def test_bands_without_mullions_are_openings_of_their_own() -> None:
    glass = glass_of(*front(pane=0))
    assert glass is not None
    assert (glass.pane, len(glass.panes)) == (0.0, 10)
    assert all((one.x0, one.x1) == (LEFT, RIGHT) for one in glass.panes)
    assert "each band is one opening" in glass_note(glass, 0.05)


def windows(gap: int) -> tuple[Evidence, Float]:
    picture = np.full((HEIGHT, WIDTH, 3), 200, np.uint8)
    chance = np.full((HEIGHT, WIDTH), 0.02, np.float32)
    for y in range(TOP, 600, STOREY):
        for x in range(LEFT, RIGHT - 24, 24 + gap):
            picture[y : y + 40, x : x + 24] = 60
            chance[y : y + 40, x : x + 24] = 0.9
    return gather(picture, np.ones((HEIGHT, WIDTH), np.bool_)), chance


@pytest.mark.parametrize("gap", [20, 30])
def test_windows_in_a_wall_are_no_glass(gap: int) -> None:
    assert glass_of(*windows(gap)) is None


def test_neither_is_one_band_nor_a_bare_wall() -> None:
    assert glass_of(*front(storeys=1)) is None
    evidence, chance = front()
    assert glass_of(evidence, np.zeros_like(chance)) is None


def test_panes_take_the_place_of_what_was_seen_of_them() -> None:
    glass = glass_of(*front())
    assert glass is not None
    part = SeenElement("window", 200, 80, 300, 190, 0.8)
    door = SeenElement("door", 200, 580, 240, 640, 0.8)
    aside = SeenElement("window", 0, 80, 60, 120, 0.8)
    found = with_panes([part, door, aside], glass, 0.5)
    assert len(found) == 122
    assert part not in found
    assert found[0].x0 == pytest.approx(2.0 * glass.panes[0].x0)
    assert with_panes([part], None, 0.5) == [part]
    assert glass_note(glass, 0.05).endswith("120 panes between mullions 1.3 m apart")
    assert glass_note(None, 0.05) == ""


def test_no_house_ends_where_the_glass_goes_on() -> None:
    glass = glass_of(*front())
    assert glass is not None
    walls = PartyWalls((PartyWall(20, 0.9), PartyWall(200, 0.9)), PartyWall(210, 0.6))
    assert walls.without(glass.goes_on) == PartyWalls((PartyWall(20, 0.9),), None)


def saw(length: int, period: float) -> NDArray[np.float64]:
    return np.asarray(np.sin(2.0 * np.pi * np.arange(length) / period))


@pytest.mark.parametrize("period", [11.3, 20.0, 37.6])
def test_the_beat_of_a_wave_is_its_period(period: float) -> None:
    assert beat(saw(400, period), (5.0, 60.0), 0.25) == pytest.approx(period, rel=0.02)


def test_noise_has_no_beat() -> None:
    noise = np.random.default_rng(3).normal(size=2000)
    assert beat(noise, (5.0, 60.0), 0.25) is None
