"""Gables and hipped roofs: as built, against closed forms; as read, in drawn outlines."""

from __future__ import annotations

import numpy as np
import pytest
from closed_shells import assert_closed, shells
from numpy.typing import NDArray
from sample_document import FACADE_M, ROOF_M, element, sample_document, sample_photo

from veduta.facade.extent import Skyline
from veduta.facade.gable import Gable, find_gable, is_wall
from veduta.facade.model import build_model

WINDOW = element("window", 5.4, 15.6, 1.2, 1.4)
ASIDE = element("window", 0.2, 16.5, 1.2, 1.4)
DEPTH_M = 10.0


def test_a_gable_closes_and_has_its_volume_and_window() -> None:
    document = sample_document([WINDOW, ASIDE]).model_copy(update={"roof": "gable"})
    model = build_model(document, sample_photo(document), "x")
    assert_closed(model.part)
    width, height = FACADE_M
    body = next(shells(model.part))
    whole = width * height * DEPTH_M + 0.5 * width * ROOF_M * DEPTH_M
    hole = 1.2 * 1.4 * 0.2 + 1.08 * 1.28 * 0.05
    assert body.volume == pytest.approx(whole - hole, rel=1e-4)
    areas = dict(zip(model.part.features.name, model.part.feature_area_m2.tolist(), strict=True))
    assert areas["front gable"] == pytest.approx(0.5 * width * ROOF_M - 1.2 * 1.4, rel=1e-3)
    assert [note for note in model.part.notes if "does not lie in the gable" in note]
    assert "roofGable" in model.rules


def test_a_hipped_roof_closes_and_has_no_windows() -> None:
    document = sample_document([WINDOW]).model_copy(update={"roof": "hip"})
    part = build_model(document, sample_photo(document), "x").part
    assert_closed(part)
    assert {f"slope {k}" for k in range(1, 5)} <= set(part.features.name)
    assert [note for note in part.notes if "lies in the roof" in note]


@pytest.mark.parametrize("kind", ["gable", "hip"])
def test_the_rules_that_repeat_have_the_same_roof(kind: str) -> None:
    items = [
        element("window", 1.1 + 2.9 * column, 0.9 + 3.0 * floor, 1.2, 1.7)
        for floor in range(1, 5)
        for column in range(4)
    ]
    document = sample_document(items).model_copy(update={"roof": kind})
    rules = build_model(document, sample_photo(document), "x").repeating
    assert {"gable": "roofGable", "hip": "roofHip"}[kind] in rules
    assert f"attr upperRoof = {ROOF_M:g}" in rules


def _outline(top: float, eaves: float, clipped: float = 0.0, seed: int = 0) -> Skyline:
    across = (np.arange(300) + 0.5) / 300
    shape = np.minimum(1.0 - 2.0 * np.abs(across - 0.5), 1.0 - clipped)
    rows = eaves + (top - eaves) * shape + np.random.default_rng(seed).normal(0, 2, 300)
    rows[60:68] -= 14  # a chimney
    found: NDArray[np.int64] = np.clip(np.round(rows), 0, None).astype(np.int64)
    return Skyline(found, int(np.median(found)))


@pytest.mark.parametrize("clipped", [0.0, 0.25])
@pytest.mark.parametrize("high", [60, 110, 200])
def test_two_slopes_are_a_gable(high: int, clipped: float) -> None:
    found = find_gable(_outline(40.0, 40.0 + high, clipped))
    assert found is not None
    assert found.eaves == pytest.approx(40.0 + high, abs=0.12 * high)
    assert found.top == pytest.approx(40.0, abs=0.2 * high)


@pytest.mark.parametrize("seed", range(4))
def test_level_stepped_and_leaning_outlines_are_none(seed: int) -> None:
    rng = np.random.default_rng(seed)
    level = np.full(300, 60) + rng.integers(-3, 4, 300)
    steps = np.where(np.arange(300) < 120, 60, 110) + rng.integers(-3, 4, 300)
    leaning = (40 + 0.3 * np.arange(300)).astype(np.int64)
    for rows in (level, steps, leaning):
        assert find_gable(Skyline(rows.astype(np.int64), 60)) is None


@pytest.mark.parametrize("wide", [50, 90, 150])
@pytest.mark.parametrize("off", [-30, 0, 20])
def test_a_block_on_a_flat_roof_is_no_gable(wide: int, off: int) -> None:
    places = np.arange(300)
    block = np.abs(places - 150 - off) < wide / 2
    noise = np.random.default_rng(wide).integers(-2, 3, 300)
    rows = (np.where(block, 40, 110) + noise).astype(np.int64)
    assert find_gable(Skyline(rows, 40)) is None


def test_no_sky_no_gable_and_slates_are_no_wall() -> None:
    outline = _outline(40.0, 150.0)
    assert find_gable(Skyline(outline.rows, outline.level, "no sky")) is None
    wall = np.ones((300, 300))
    gable = Gable(40.0, 150.0, 1.0)
    assert is_wall(gable, wall, outline, 0.45)
    assert not is_wall(gable, 0.1 * wall, outline, 0.45)
