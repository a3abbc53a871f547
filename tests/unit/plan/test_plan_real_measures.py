"""The measures of the real plans, on cases made by hand and against brute force."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from plan_cubicasa import adjacency_f1
from plan_scores import Hits
from plan_truth import Gap, Layout, Space
from plan_uk import leave_one_out
from plan_zind import _once, measures
from shapely.geometry import Polygon, box

from veduta.plan.document import ScaleEvidence


def said(text: str, metres_per_px: float, kind: str = "dimension") -> ScaleEvidence:
    return ScaleEvidence.model_validate(
        {"kind": kind, "text": text, "metres_per_px": metres_per_px, "sigma": 0.01, "agrees": True}
    )


def test_a_room_is_predicted_by_the_others_alone() -> None:
    printed = (("2.55 x 2.50", "8'4 x 8'2"), ("4.76 x 3.79", "15'7 x 12'5"), ("3.0 x 2.0", ""))
    evidence = [
        said("2.55x2.50", 0.02), said("8'4\" x 8'2\"", 0.022),
        said("4.76 x 3.79", 0.03), said("12.3 m", 0.5, "line"),
    ]  # fmt: skip
    errors = leave_one_out(evidence, printed)
    # The first room says 0.021 by itself, the others 0.03; the second 0.03, the others 0.021.
    assert errors == pytest.approx([0.03 / 0.021 - 1, 1 - 0.021 / 0.03])
    assert leave_one_out(evidence[:2], printed) == []


@pytest.mark.parametrize("seed", range(4))
def test_adjacency_is_that_of_the_best_pairing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    sizes = (5, 5 + seed % 2)
    graphs = []
    for size in sizes:
        upper = np.triu(rng.random((size, size)) < 0.45, 1)
        graphs.append(upper | upper.T)
    found, true = graphs
    whole = np.zeros((sizes[1],) * 2, bool)
    whole[: sizes[0], : sizes[0]] = found
    best = max(
        int((whole & true[np.ix_(order, order)]).sum()) // 2
        for order in permutations(range(sizes[1]))
    )
    expected = 2 * best / (int(found.sum() + true.sum()) // 2)
    blank = ["Other"] * sizes[0], ["Bath"] * sizes[1]
    assert adjacency_f1(found, true, *blank) == pytest.approx(expected)


def test_the_same_rooms_in_another_order_are_the_same() -> None:
    true = np.zeros((6, 6), bool)
    for i, j in ((0, 1), (0, 2), (0, 3), (3, 4), (4, 5)):
        true[i, j] = true[j, i] = True
    order = np.array([3, 5, 1, 0, 2, 4])
    found = true[np.ix_(order, order)]
    names = [f"c{i}" for i in range(6)]
    assert adjacency_f1(found, true, [names[i] for i in order], names) == 1.0
    found[0, 3] = found[3, 0] = False  # rooms 3 and 0 of the truth
    assert adjacency_f1(found, true, [names[i] for i in order], names) == pytest.approx(8 / 9)


def test_a_door_on_both_faces_of_a_wall_is_one() -> None:
    doors = [
        np.array([[0.0, 0.0], [0.9, 0.0]]),
        np.array([[0.9, 0.12], [0.0, 0.12]]),
        np.array([[3.0, 0.0], [3.9, 0.0]]),
    ]
    single = _once(doors)
    assert len(single) == 2
    assert single[0] == pytest.approx(np.array([[0.0, 0.06], [0.9, 0.06]]))


def test_areas_are_those_of_the_scale_that_was_found() -> None:
    """Shapes are compared in the truth's metres; areas with the error of the scale."""
    door = Gap("door", "unknown", np.array([[1.0, 0.0], [1.9, 0.0]]), 0.1)
    gap = Gap("gap", "plain", door.ends_m, 0.1)
    space = Space("", box(0, 0, 4, 3))
    true = Layout(Polygon(), Polygon(), (door,), (space,), 0.01)
    found = Layout(Polygon(), Polygon(), (gap,), (space,), 0.0102)
    row = measures(found, true)
    assert row["rooms F1"] == row["doors F1"] == row["windows F1"] == 1.0
    assert row["scale error"] == pytest.approx(0.02)
    assert row["area error (median)"] == pytest.approx(0.02 * 2.02)
    assert Hits(1, 1, 1).f1 == row["openings F1"]
