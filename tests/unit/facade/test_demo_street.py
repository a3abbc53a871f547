"""The lots around the house of the demo."""

from __future__ import annotations

import json

import numpy as np
import pytest
from sample_document import sample_document

from veduta.facade.demo_street import BESIDE, RULES, street_lots
from veduta.grammar.rules import style_names
from veduta.synthetic.layout import STYLES


def test_each_style_of_house_has_a_style_of_street() -> None:
    assert set(RULES) == set(STYLES)
    assert set(RULES.values()) <= set(style_names())


@pytest.mark.parametrize("style", STYLES)
def test_lots_stand_side_by_side_with_their_fronts_on_one_line(style: str) -> None:
    document = sample_document()
    features = json.loads(street_lots(document, style, 3))["features"]
    assert len(features) == 2 * BESIDE
    spans = [(0.0, document.facade.width_m)]
    for feature in features:
        ring = np.array(feature["geometry"]["coordinates"][0])
        assert ring[0].tolist() == ring[-1].tolist()
        assert ring[:2, 1].tolist() == [0.0, 0.0]  # the first edge lies along the street
        x, y = ring[:-1].T
        assert 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 80.0  # counter-clockwise
        assert y.min() == 0.0
        spans.append((float(x.min()), float(x.max())))
    spans.sort()
    for (_, end), (start, _) in zip(spans[:-1], spans[1:], strict=True):
        assert start == pytest.approx(end, abs=0.002)
