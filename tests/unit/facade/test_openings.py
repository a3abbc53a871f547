"""The rows of a floor's windows against all rows, and its rectangles in drawn facades."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from drawn_facade import analysed, draw_facade, rectified_of
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from veduta.facade.appearance import Scores, class_scores, wall_colour
from veduta.facade.boxes import Box
from veduta.facade.document import Element
from veduta.facade.evidence import Evidence, gather
from veduta.facade.extent import Skyline
from veduta.facade.floors import Floors
from veduta.facade.opening_rows import gaps, read_floors
from veduta.facade.openings import only_seen

STOREY, WIDTH = 24, 30
STRIPE = (10, 8)
# In storeys, as the paper's labels are: a window's visible part and a railing.
WINDOW, RAILING = (0.2, 0.9), (0.12, 0.5)
rows_of = arrays(np.float32, STOREY, elements=st.floats(-1.5, 1.5, width=32))


def _read(window: NDArray[np.float32], railing: NDArray[np.float32]) -> tuple[int, int, int]:
    """The rows of one floor with one stripe, without edges; nothing shows beside the stripe."""
    inside = np.zeros(WIDTH, bool)
    inside[STRIPE[0] : sum(STRIPE)] = True
    fields = [np.where(inside, line[:, None], np.float32(-9)) for line in (window, railing)]
    flat = np.zeros((STOREY, WIDTH), np.float32)
    evidence = Evidence(1.0, np.zeros((STOREY, WIDTH, 3), np.float32), flat, flat, flat == 0)
    floors = Floors([0, STOREY], float(STOREY), 0.0, {}, 0)
    (floor,) = read_floors(evidence, floors, [STRIPE], Scores(fields[0], fields[1], fields[0]))
    return floor.rows


@given(rows_of, rows_of)
def test_rows_are_the_best_of_all(
    window: NDArray[np.float32], railing: NDArray[np.float32]
) -> None:
    """Window from t to k, railing from k to b or none: no rows have more evidence."""

    def evidence(t: int, k: int, b: int) -> float:
        return float(window[t:k].sum(dtype=np.float64) + railing[k:b].sum(dtype=np.float64))

    def allowed(t: int, k: int, b: int) -> bool:
        tall = WINDOW[0] * STOREY <= k - t <= WINDOW[1] * STOREY
        return tall and (b == k or RAILING[0] * STOREY <= b - k <= RAILING[1] * STOREY)

    found = _read(window, railing)
    choices = [c for c in itertools.product(range(STOREY + 1), repeat=3) if allowed(*c)]
    assert found in choices
    best = max(evidence(*choice) for choice in choices)
    assert evidence(*found) == pytest.approx(best, abs=1e-4)


@given(st.sets(st.integers(0, WIDTH), min_size=2, max_size=8).filter(lambda s: len(s) % 2 == 0))
def test_gaps_and_stripes_fill_the_width(cuts: set[int]) -> None:
    ends = sorted(cuts)
    stripes = [(a, b - a) for a, b in zip(ends[::2], ends[1::2], strict=True)]
    between = gaps(stripes, WIDTH)
    pieces = sorted([*between, *((x, x + w) for x, w in stripes)])
    assert [a for a, _ in pieces] == [0, *(b for _, b in pieces[:-1])]
    assert pieces[-1][1] == WIDTH
    assert len(between) == len(stripes) + 1


def _of(elements: list[Element], kind: str) -> list[Element]:
    return [e for e in elements if e.class_ == kind]


@pytest.mark.parametrize(
    "columns", [((0.2, 0.32), (0.62, 0.74)), ((0.1, 0.25), (0.45, 0.55), (0.75, 0.92))]
)
def test_few_columns_and_unlike_widths(columns: tuple[tuple[float, float], ...]) -> None:
    drawn = draw_facade(4, columns=columns, width=300)
    windows = [e for e in _of(analysed(drawn.pixels).elements, "window") if e.floor]
    assert len(windows) == len(drawn.windows)
    found = sorted((e.floor or 0, e.x_px, e.width_px) for e in windows)
    true = sorted((f, x, w) for f in range(1, 5) for x, w in drawn.stripes)
    assert np.abs(np.array(found) - np.array(true)).max() <= 5


def test_openings_lie_in_the_facade_and_windows_in_their_floors() -> None:
    drawn = draw_facade(5)
    document = analysed(drawn.pixels)
    facade, heights = document.facade, document.rules.facade.sizes_m
    floors = np.cumsum([0.0, *heights])
    assert {e.class_ for e in document.elements} <= {"window", "balcony", "door", "shop"}
    for element in document.elements:
        assert 0 <= element.score <= 1
        assert element.x_m >= -1e-6
        assert element.x_m + element.width_m <= facade.width_m + 1e-6
        if element.floor is not None:
            assert element.y_m >= floors[element.floor] - 1e-6
            assert element.y_m + element.height_m <= floors[element.floor + 1] + 1e-6
    boxes = [(e.x_px, e.y_px, e.width_px, e.height_px) for e in _of(document.elements, "window")]
    for a, b in itertools.combinations(boxes, 2):
        apart = [a[i] + a[i + 2] <= b[i] or b[i] + b[i + 2] <= a[i] for i in range(2)]
        assert any(apart), (a, b)


def test_the_ground_floor_is_a_shop() -> None:
    drawn = draw_facade(4)
    shops = _of(analysed(drawn.pixels).elements, "shop")
    width = sum(e.width_px for e in shops)
    assert width > 0.9 * drawn.pixels.shape[1]
    assert all(abs(e.y_px - drawn.boundaries[-1]) < 10 for e in shops)


def test_nothing_is_known_where_there_is_no_photo() -> None:
    rectified = rectified_of(draw_facade(5).pixels)
    rectified.valid[200:, :90] = False
    evidence = gather(rectified.pixels, rectified.valid)

    def skyline(row: int) -> Skyline:
        return Skyline(np.full(evidence.width, row), row)

    top, bottom, storey = 150, 400, 60.0
    wall = wall_colour(evidence, top, bottom, storey)
    scores = class_scores(evidence, wall, top, bottom, storey)
    for score in (scores.window, scores.railing):
        assert (score[50:, :90] == 0).all()
        assert (score[:50] != 0).mean() > 0.9
    inside, outside, across = (Box("window", x, 220, 40, 30, 1, 0, 0.9) for x in (100, 10, 69))
    assert only_seen([inside, outside, across], evidence, skyline(10)) == [inside]
    assert only_seen([inside, outside, across], whole(evidence), skyline(10)) == [
        inside,
        outside,
        across,
    ]
    assert only_seen([inside], evidence, skyline(230)) == [inside]
    assert only_seen([inside], evidence, skyline(240)) == []


def whole(evidence: Evidence) -> Evidence:
    """The same with all of it in the photo."""
    return replace(evidence, valid=np.ones_like(evidence.valid))
