"""Ledges that a depth map has measured, beside the openings of the wall."""

from __future__ import annotations

import pytest
from sample_document import sample_document

from veduta.facade.document import FacadeDocument
from veduta.facade.ledges import plan_ledges
from veduta.facade.measured_depths import Ledge, MeasuredDepths
from veduta.facade.rectangles import Rectangle


def _document(height_px: float) -> FacadeDocument:
    """A ledge whose foot is 5 m above the ground."""
    document = sample_document()
    foot = document.facade.y_px + document.facade.height_px
    m = document.scale.metres_per_px
    ledge = Ledge(y_px=foot - 5.0 / m - height_px, height_px=height_px, out_m=0.2)
    depths = MeasuredDepths.model_construct(ledges=[ledge])
    return document.model_copy(update={"depths": depths})


@pytest.mark.parametrize(
    ("opening", "left", "said"),
    [
        (None, 1.0, ""),
        (Rectangle(1.0, 2.0, 2.0, 5.05), 0.95, ""),
        (Rectangle(1.0, 2.0, 2.0, 5.4), 0.6, "1.00 m high as measured, 0.60 m in the model"),
        (Rectangle(1.0, 2.0, 2.0, 7.0), 0.0, "left out"),
    ],
)
def test_what_an_opening_takes_of_a_ledge_is_said(
    opening: Rectangle | None, left: float, said: str
) -> None:
    scale = sample_document().scale.metres_per_px
    notes: list[str] = []
    found = plan_ledges(_document(1.0 / scale), [opening] if opening else [], 9.0, notes)
    assert sum(one.top_m - one.foot_m for one in found) == pytest.approx(left, abs=0.01)
    assert len(notes) == bool(said)
    assert said in "".join(notes)
