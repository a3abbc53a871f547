"""Rules that repeat: on the photo's own lot as read, elsewhere as many floors as fit."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from sample_document import FACADE_M, element, sample_document, sample_elements, sample_photo

from veduta import _core
from veduta.facade.document import FacadeDocument
from veduta.facade.measured_depths import ClassDepth, MeasuredDepths
from veduta.facade.model import build_model
from veduta.facade.plan import plan_building
from veduta.facade.rectangles import Rectangle
from veduta.facade.repeat.find import find_columns, find_pattern
from veduta.facade.repeat.pattern import Tolerances
from veduta.facade.repeat.series import Run, series
from veduta.facade.rule_head import SHALLOW_M
from veduta.facade.style.elevation import Elevation, elevation
from veduta.grammar.derivation import derive, parse

WIDTH_M, EAVES_M = FACADE_M


def built(
    folder: Path,
    document: FacadeDocument,
    width_m: float,
    attributes: Mapping[str, float] | None = None,
) -> Elevation:
    """What the repeating rules of a document make of a lot of this width."""
    path = folder / "rules.cga"
    path.write_text(build_model(document, sample_photo(document), "sample").repeating)
    rules = parse(path)
    depth = document.model.depth_m
    lot = [[(0.0, 0.0), (width_m, 0.0), (width_m, depth), (0.0, depth)]]
    columns = derive(rules, lot, attributes=dict(attributes or {})).columns()
    return elevation(columns, rules.library.assets_of(columns))


def upper(found: Elevation, kind: str = "window") -> np.ndarray:
    """The boxes between the ground floor and the eaves."""
    boxes = found.of(kind)
    return boxes[(boxes[:, 1] > 3.2) & (boxes[:, 3] < EAVES_M + 0.01)]


def test_the_own_lot_gives_back_what_was_read(tmp_path: Path) -> None:
    document = sample_document()
    found = built(tmp_path, document, WIDTH_M)
    plan = plan_building(document)
    read = [
        (o.rectangle.x0, o.rectangle.z0, o.rectangle.x1, o.rectangle.z1)
        for band in plan.bands[1:]
        for o in band.openings
    ]
    own = upper(found)
    assert len(own) == len(read)
    order = np.lexsort((np.array(read)[:, 1], np.array(read)[:, 0]))
    np.testing.assert_allclose(own, np.array(read)[order], atol=0.12)
    shops, doors = found.of("shop"), found.of("door")
    assert len(shops) == 1
    assert len(doors) == 1
    assert shops[0] == pytest.approx((0.6, 0.0, 8.0, 3.0), abs=0.25)
    assert set(found.said) <= {"measured", ""}


def test_a_wider_lot_has_more_columns_and_a_higher_house_more_floors(tmp_path: Path) -> None:
    document = sample_document()
    own = upper(built(tmp_path, document, WIDTH_M))
    wide = built(tmp_path, document, 2 * WIDTH_M)
    assert len(np.unique(upper(wide)[:, 0].round(2))) > len(np.unique(own[:, 0].round(2)))
    assert set(wide.said) <= {"inferred", ""}
    top = plan_building(document).top_m
    high = built(tmp_path, document, WIDTH_M, {"height": top + 6.0})
    rows = np.unique(high.of("window")[:, 1].round(2))
    assert len(rows) == len(np.unique(built(tmp_path, document, WIDTH_M).of("window")[:, 1])) + 2


def test_a_window_that_was_not_read_follows_the_others_and_is_inferred(tmp_path: Path) -> None:
    elements = [e for e in sample_elements() if e.class_ not in ("balcony",)]
    windows = [e for e in elements if e.class_ == "window" and 3.2 < e.y_m < EAVES_M]
    hidden = windows[1]
    found = built(tmp_path, sample_document([e for e in elements if e is not hidden]), WIDTH_M)
    boxes = [
        (box, said)
        for box, said, kind in zip(found.boxes, found.said, found.classes, strict=True)
        if kind == "window" and box[1] > 3.2 and box[3] < EAVES_M
    ]
    assert len(boxes) == len(windows)
    inferred = [box for box, said in boxes if said == "inferred"]
    assert len(inferred) >= 1
    assert any(abs(box[0] - hidden.x_m) < 0.15 for box in inferred)


def test_the_rules_have_no_faults_and_fit_two_screens() -> None:
    document = sample_document()
    text = build_model(document, sample_photo(document), "sample").repeating
    assert text.count("\n") < 220
    assert _core.grammar_format("rules.cga", text) == text


@pytest.mark.parametrize(("median_m", "shallow"), [(0.9, 0.9), (0.0, SHALLOW_M), (-0.3, SHALLOW_M)])
def test_balconies_are_as_deep_as_measured_where_they_stand_out(
    median_m: float, shallow: float
) -> None:
    one = ClassDepth(kind="balcony", measured=3, found=4, median_m=median_m, spread_m=0.1)
    depths = MeasuredDepths(wall="w", known=0.9, wall_spread_m=0.05, classes=(one,))
    document = sample_document().model_copy(update={"depths": depths})
    rules = build_model(document, sample_photo(document), "sample").repeating
    assert f"attr shallow = {shallow:g}\n" in rules


def test_without_windows_above_the_ground_floor_nothing_repeats() -> None:
    document = sample_document([element("door", 5.0, 0.0, 1.2, 2.5)])
    assert find_pattern(plan_building(document)) is None
    model = build_model(document, sample_photo(document), "sample")
    assert model.repeating == model.rules


def test_columns_that_drift_are_no_single_rule() -> None:
    """Each is like the next, but evenly spaced ones would soon stand beside them."""
    left, spans = 0.5, []
    for gap in (1.6, 1.5, 1.4, 1.3, 1.2, 1.1):
        spans.append(Rectangle(left, 4.0, left + 0.8, 5.5))
        left += 0.8 + gap
    columns = find_columns(spans, left, Tolerances())
    assert columns is not None
    assert len(columns.runs) > 1
    np.testing.assert_allclose(columns.centres_m, [0.5 * (s.x0 + s.x1) for s in spans])


def test_the_longest_run_repeats_and_of_equals_the_middle_one() -> None:
    same = lambda some: len(set(some)) == 1  # noqa: E731
    first = lambda some: some[0]  # noqa: E731
    assert series("abbc", same, first) == (Run("a", 1), Run("b", 2, True), Run("c", 1))
    assert series("abc", same, first) == (Run("a", 1), Run("b", 1, True), Run("c", 1))
    assert series("ad", same, first, lambda item: item != "d") == (Run("a", 1, True), Run("d", 1))
    assert series("d", same, first, lambda item: item != "d") == (Run("d", 1),)
