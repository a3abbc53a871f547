"""Elements of other shapes than rectangles: as cut, as painted, as counted."""

from __future__ import annotations

import numpy as np
import pytest
from closed_shells import assert_closed
from sample_document import METRES_PER_PX, element, sample_document, sample_photo
from shapely.geometry import Polygon

from veduta.facade.boxes import Box
from veduta.facade.document import Element
from veduta.facade.heads import arched
from veduta.facade.load import _faults
from veduta.facade.model import build_model
from veduta.facade.outputs import rasterise
from veduta.facade.quantities import quantities_csv
from veduta.facade.reconcile import reconciled
from veduta.facade.shape import area_share, cuts_of, fitted_outline, head_rise_m


def _arched(item: Element, rise: float) -> Element:
    box = Box("window", 0, 0, round(item.width_px), round(item.height_px), None, None, 1.0)
    outline = [(x + item.x_px, y + item.y_px) for x, y in arched(box, rise * box.width)]
    return item.model_copy(update={"outline_px": outline})


def _shaped(item: Element, shape: list[tuple[float, float]]) -> Element:
    """`shape` in shares of the rectangle, y down."""
    outline = [(item.x_px + x * item.width_px, item.y_px + y * item.height_px) for x, y in shape]
    return item.model_copy(update={"outline_px": outline})


WINDOWS = [element("window", 1.0 + 3 * k, 6.0, 1.2, 2.0) for k in range(3)]
DIAMOND = [(0.5, 0.0), (1.0, 0.5), (0.5, 1.0), (0.0, 0.5)]
POINTED = [(0.0, 1.0), (0.0, 0.4), (0.5, 0.0), (1.0, 0.4), (1.0, 1.0)]


def _area_m2(item: Element) -> float:
    return float(Polygon(np.array(item.outline_px) * METRES_PER_PX).area)


@pytest.mark.parametrize("roof_m", [0.0, 3.6])
def test_shapes_are_cut_out_of_a_wall_that_stays_closed(roof_m: float) -> None:
    items = [_arched(WINDOWS[0], 0.5), _shaped(WINDOWS[1], DIAMOND), _shaped(WINDOWS[2], POINTED)]
    door = _arched(element("door", 10.0, 0.05, 1.4, 2.6), 0.3)
    document = sample_document([*items, door], roof_m)
    part = build_model(document, sample_photo(document), "x").part
    assert_closed(part)
    areas = dict(zip(part.features.name, part.feature_area_m2.tolist(), strict=True))
    for number, item in enumerate(items, start=1):
        # The frame's inner edge has a pane behind it: its reveal is counted with the window.
        assert areas[f"window {number}"] == pytest.approx(_area_m2(item), rel=0.05)
    wall = 12.0 * 15.0 - sum(areas[f"window {k}"] for k in (1, 2, 3)) - areas["door 1"]
    assert areas["front wall"] == pytest.approx(wall, abs=0.1)


def test_cuts_leave_the_convex_shape() -> None:
    item = _shaped(WINDOWS[1], [(0.0, 0.0), (0.5, 0.3), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
    place = sample_document([item])
    assert place.elements[0].outline_px
    from veduta.facade.layout import rectangle_of

    assert cuts_of(item, rectangle_of(item)) == []
    assert cuts_of(WINDOWS[0], rectangle_of(WINDOWS[0])) == []
    assert len(cuts_of(_shaped(WINDOWS[0], DIAMOND), rectangle_of(WINDOWS[0]))) == 4


def test_labels_and_quantities_have_the_shape() -> None:
    item = _shaped(WINDOWS[0], DIAMOND)
    document = sample_document([item])
    painted = (rasterise(document) == document.classes.index("window")).sum() * METRES_PER_PX**2
    assert painted == pytest.approx(0.5 * 1.2 * 2.0, rel=0.02)
    assert area_share(item) == pytest.approx(0.5)
    part = build_model(document, sample_photo(document), "x").part
    row = next(
        line
        for line in quantities_csv(document, part).splitlines()
        if line.startswith("window,all")
    )
    assert float(row.split(",")[3]) == pytest.approx(1.2)


def test_an_outline_follows_its_rectangle() -> None:
    item = _arched(WINDOWS[0], 0.5)
    assert fitted_outline(item) == item.outline_px
    moved = item.model_copy(update={"x_px": item.x_px + 30, "width_px": 2 * item.width_px})
    outline = np.array(fitted_outline(moved))
    assert outline[:, 0].min() == pytest.approx(moved.x_px, abs=0.01)
    assert outline[:, 0].max() == pytest.approx(moved.x_px + moved.width_px, abs=0.01)
    document = reconciled(sample_document([moved]))
    assert document.elements[0].outline_px == fitted_outline(moved)
    assert head_rise_m(item) == pytest.approx(0.6, abs=0.02)
    assert head_rise_m(WINDOWS[0]) == 0.0


def test_an_outline_needs_three_points() -> None:
    item = WINDOWS[0].model_copy(update={"outline_px": [(1.0, 2.0), (3.0, 4.0)]})
    assert _faults(sample_document([item]))[:1] == [
        "elements[0].outline_px: needs at least three points"
    ]


def test_arched_floors_are_arched_in_the_rules_that_repeat() -> None:
    items = [
        element("window", 1.0 + 3 * k, 0.9 + 3.0 * floor, 1.2, 1.8)
        for k in range(4)
        for floor in range(1, 5)
    ]
    items = [_arched(item, 0.5) if 3.5 < item.y_m < 5.0 else item for item in items]
    document = sample_document(items, 0.0)
    rules = build_model(document, sample_photo(document), "x").repeating
    assert 'Columns("windows", 0.9, 1.8, 0.6, "")' in rules
    assert 'Columns("windows", 0.9, 1.8, 0, "")' in rules
