"""What walls say for a placement, against sums and what it should not depend on."""

from __future__ import annotations

import numpy as np
import pytest

from veduta.photos.world.evidence import (
    EDGE_SD_M,
    EXACT_EDGE_SD_M,
    EXACT_PLANE_SD_M,
    EXACT_TOP_SD_M,
    PLANE_SD_M,
    TOP_SD_M,
    _behind,
    _evidence,
    _mixed,
)


@pytest.mark.parametrize(
    ("exact", "rough"),
    [
        (EXACT_PLANE_SD_M, PLANE_SD_M),
        (EXACT_EDGE_SD_M, EDGE_SD_M),
        (EXACT_TOP_SD_M, TOP_SD_M),
    ],
)
def test_the_density_of_both_deviations_is_one(exact: float, rough: float) -> None:
    places = np.arange(-5.0, 5.0, 0.001)
    assert _mixed(places, exact, rough).sum() * 0.001 == pytest.approx(1.0, abs=1e-6)
    assert _mixed(np.array([np.nan]), exact, rough)[0] == 0.0


def test_walls_lie_behind_by_their_median_and_one_wall_says_little_of_it() -> None:
    off = np.full((4, 5, 3), np.nan)
    off[0] = -0.15
    off[0, 4] = 2.0  # of another plane
    off[1, 0] = -0.15
    off[2] = 0.1
    found = _behind(off)
    assert found[0] == pytest.approx(0.15, abs=0.02)
    assert 0.05 < found[1] < 0.14
    assert found[2] == pytest.approx(-0.1, abs=0.02)
    assert found[3] == pytest.approx(0.05)  # what is usual
    by_hand = (0.05 / 0.1**2 + 4 * 0.15 / EXACT_PLANE_SD_M**2) / (
        1 / 0.1**2 + 4 / EXACT_PLANE_SD_M**2
    )
    assert found[0] == pytest.approx(by_hand)


def test_what_draws_all_walls_back_costs_little_and_what_draws_one_back_more() -> None:
    edges, tops = np.zeros((1, 6, 2)), np.zeros((1, 6))

    def nats(off_m: list[float]) -> float:
        off = np.broadcast_to(np.array(off_m)[None, :, None], (1, 6, 3))
        return float(_evidence(off + _behind(off)[:, None, None], edges, tops).sum())

    together, alone = nats([-0.2] * 6), nats([-0.05] * 5 + [-0.35])
    exact = nats([-0.05] * 6)
    assert exact - together < 1.0
    assert exact - alone > 1.5
