"""Slivers beside drawn fronts: cut where they are another wall or sky, and only there."""

from __future__ import annotations

import numpy as np
import pytest
from sample_document import sample_document

from veduta.facade.evidence import gather
from veduta.facade.eyes import SeenElement
from veduta.facade.margins import end_of, width_doubt
from veduta.facade.party_signs import Fronts

HEIGHT, WIDTH, STOREY = 400, 460, 80
FIRST, LAST = 110.0, 350.0


def fronts(sliver: int, colour: tuple[int, int, int], roof: int) -> Fronts:
    """A front with three columns of windows; to its left, so many columns of something else."""
    picture = np.full((HEIGHT, WIDTH, 3), 235, np.uint8)
    kinds = np.zeros((6, HEIGHT, WIDTH), np.float32)
    kinds[4] = 1.0
    for left, right, own, top in ((sliver, WIDTH, (205, 180, 140), 50), (0, sliver, colour, roof)):
        picture[top:, left:right] = own
        kinds[4, top:, left:right] = 0.0
        picture[top : top + 10, left:right] //= 2
    windows = []
    for floor in range(4):
        for column in range(3):
            x, y = FIRST + 100 * column, 80 + STOREY * floor
            picture[y : y + 44, int(x) : int(x) + 40] = 40
            windows.append(SeenElement("window", x, y, x + 40, y + 44, 0.9))
    evidence = gather(picture, np.ones((HEIGHT, WIDTH), np.bool_))
    wall = 1.0 - kinds[4]
    outline = np.where(np.arange(WIDTH) < sliver, roof, 50).astype(np.float64)
    return Fronts(evidence, wall, kinds, outline, tuple(windows), float(STOREY))


@pytest.mark.parametrize("sliver", [30, 50, 70])
def test_another_wall_beside_the_front_is_cut_off(sliver: int) -> None:
    found = end_of(fronts(sliver, (120, 150, 170), 110), (0, FIRST))
    assert found == pytest.approx(sliver, abs=3)


def test_sky_beside_the_front_is_cut_off() -> None:
    found = end_of(fronts(60, (235, 235, 235), HEIGHT - 20), (0, FIRST))
    assert found == pytest.approx(60, abs=0.2 * STOREY)


def test_a_wall_that_goes_on_to_the_border_is_left() -> None:
    same = fronts(40, (205, 180, 140), 50)
    assert end_of(same, (0, FIRST)) is None
    assert end_of(same, (WIDTH, LAST)) is None


def test_a_margin_narrower_than_what_is_looked_at_is_left() -> None:
    assert end_of(fronts(30, (120, 150, 170), 110), (0, 4.0)) is None


def test_a_front_that_goes_on_far_beyond_its_windows_is_doubted() -> None:
    document = sample_document()
    assert width_doubt(document) == ""
    box = document.facade.model_copy(
        update={"width_px": document.facade.width_px + 300.0, "width_m": 19.5}
    )
    said = width_doubt(document.model_copy(update={"facade": box}))
    assert said.startswith("width: may be up to ")
    assert "on the right" in said
    assert "on the left" not in said
    none = document.model_copy(update={"facade": box, "elements": []})
    assert width_doubt(none) == ""
