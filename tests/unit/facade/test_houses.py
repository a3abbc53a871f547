"""Party walls between drawn houses, and how several houses of a photo are told and placed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from veduta.facade.arrangement import GAP_M, Placed, arrange
from veduta.facade.evidence import Evidence, gather
from veduta.facade.extent import Skyline
from veduta.facade.eyes import SeenElement
from veduta.facade.house_folders import Beside, beside_line, beside_of
from veduta.facade.houses import find_party_walls

HEIGHT, WIDE = 400, 240
COLOURS = [(205, 180, 140), (150, 190, 160), (180, 120, 90)]


class Row:
    """Houses beside each other: wall colours, windows, a roof line each."""

    def __init__(self, colours: list[int], shifts: list[int], roofs: list[int]) -> None:
        picture = np.zeros((HEIGHT, WIDE * len(colours), 3), np.uint8)
        rows = np.zeros(WIDE * len(colours), np.int64)
        self.elements: list[SeenElement] = []
        for k, (colour, shift, roof) in enumerate(zip(colours, shifts, roofs, strict=True)):
            span = slice(k * WIDE, (k + 1) * WIDE)
            picture[:, span] = COLOURS[colour]
            rows[span] = roof
            for floor in range(4):
                for column in range(3):
                    x, y = k * WIDE + 30 + 70 * column, 60 + 80 * floor + shift
                    picture[y : y + 44, x : x + 30] = 40
                    self.elements.append(SeenElement("window", x, y, x + 30, y + 44, 0.9))
        noise = np.random.default_rng(1).normal(0, 6, picture.shape)
        pixels = np.clip(picture + noise, 0, 255).astype(np.uint8)
        self.evidence: Evidence = gather(pixels, np.ones(pixels.shape[:2], np.bool_))
        scale = self.evidence.px_per_rectified
        self.elements = [
            SeenElement(e.kind, e.x0 * scale, e.y0 * scale, e.x1 * scale, e.y1 * scale, e.score)
            for e in self.elements
        ]
        self.wall: NDArray[np.float64] = np.ones((self.evidence.height, self.evidence.width))
        for e in self.elements:
            self.wall[round(e.y0) : round(e.y1), round(e.x0) : round(e.x1)] = 0.0
        places = np.linspace(0, len(rows) - 1, self.evidence.width).round().astype(int)
        self.skyline = Skyline(np.round(rows[places] * scale).astype(np.int64), 0)
        self.scale = scale

    def found(self) -> list[float]:
        """Where walls are found, in pixels of the picture."""
        walls = find_party_walls(self.evidence, self.skyline, self.elements, self.wall)
        return [wall.x / self.scale for wall in walls]


@pytest.mark.parametrize(
    ("colours", "shifts", "roofs"),
    [
        ([0, 1], [0, 30], [20, 20]),
        ([0, 1], [0, 0], [10, 90]),
        ([0, 0], [0, 30], [10, 90]),
        ([0, 1, 2], [0, 30, 5], [20, 20, 60]),
    ],
)
def test_two_signs_of_three_are_a_party_wall(
    colours: list[int], shifts: list[int], roofs: list[int]
) -> None:
    found = Row(colours, shifts, roofs).found()
    assert found == pytest.approx([WIDE * k for k in range(1, len(colours))], abs=25)


@pytest.mark.parametrize(
    ("colours", "shifts", "roofs"),
    [
        ([0, 0], [0, 0], [20, 20]),
        ([0, 1], [0, 0], [20, 20]),  # one house in two colours
        ([0, 0], [0, 30], [20, 20]),  # a stairwell
        ([0, 0], [0, 0], [10, 90]),  # a lower wing
    ],
)
def test_one_sign_alone_is_none(colours: list[int], shifts: list[int], roofs: list[int]) -> None:
    assert Row(colours, shifts, roofs).found() == []


def test_few_windows_are_no_houses() -> None:
    row = Row([0, 1], [0, 30], [10, 90])
    row.elements = row.elements[:6]
    assert row.found() == []


def test_houses_of_one_photo_stand_wall_to_wall() -> None:
    right = Beside("house-2", (0.0, -0.6, 0.0), (6.0, 10.0, 9.0), 8.0)
    left = Beside("house-1", (0.0, -0.6, 0.0), (5.0, 10.0, 9.0), -5.0)
    main = Placed("a", (0.0, -0.6, 0.0), (8.0, 10.0, 12.0), beside=(left, right))
    other = Placed("b", (-0.1, -0.6, 0.0), (7.0, 10.0, 12.0))
    place = arrange([main, other], Path())
    rows = {p.row.id: p.row for p in place.parts.values() if p.row is not None}
    assert list(rows) == ["a", "a-house-1", "a-house-2", "b"]
    assert rows["a-house-2"].model == "a/house-2/model.glb"
    shifts = {name: row.transform[12] for name, row in rows.items()}
    assert shifts["a-house-2"] - shifts["a"] == 8.0
    assert shifts["a-house-1"] - shifts["a"] == -5.0
    assert shifts["b"] - 0.1 == pytest.approx(shifts["a"] + 14.0 + GAP_M)


def test_what_a_summary_says_of_the_others_comes_back() -> None:
    told = {
        "beside": [
            {
                "folder": "house-2",
                "storeys": 4,
                "offset_m": 8.0,
                "bounds_min": [0.0, 0.0, 0.0],
                "bounds_max": [6.0, 10.0, 9.0],
            }
        ]
    }
    assert beside_of(told) == (Beside("house-2", (0.0, 0.0, 0.0), (6.0, 10.0, 9.0), 8.0),)
    assert beside_line(told) == "1 more house of the photo: house-2"
    assert (beside_of({}), beside_line({})) == ((), "")


def test_a_photo_that_is_called_as_a_house_keeps_its_id() -> None:
    box = (0.0, -0.6, 0.0), (8.0, 10.0, 12.0)
    main = Placed("a", *box, beside=(Beside("house-2", *box, 8.0),))
    place = arrange([main, Placed("a-house-2", *box), Placed("a-house-2-2", *box)], Path())
    models = {p.row.id: p.row.model for p in place.parts.values() if p.row is not None}
    assert models == {
        "a": "a/model.glb",
        "a-house-2-3": "a/house-2/model.glb",
        "a-house-2": "a-house-2/model.glb",
        "a-house-2-2": "a-house-2-2/model.glb",
    }
