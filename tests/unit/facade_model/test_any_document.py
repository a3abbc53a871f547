"""Whatever rectangles a document holds, the building closes and its openings stay apart."""

from __future__ import annotations

import numpy as np
import pytest
from closed_shells import assert_closed
from hypothesis import given, settings
from hypothesis import strategies as st
from sample_document import element, sample_document, sample_photo

from veduta.facade.document import Element, FacadeClass
from veduta.facade.layout import GAP_M, Opening, lay_out
from veduta.facade.model import build_part
from veduta.facade.options import ModelSizes

PHOTO = sample_photo(sample_document())
KINDS: list[FacadeClass] = ["window", "window", "window", "door", "shop", "balcony", "chimney"]

# Coordinates on a coarse lattice touch and coincide often; free ones do not.
positions = st.one_of(st.integers(-4, 80).map(lambda k: 0.25 * k), st.floats(-5.0, 25.0, width=32))
sizes = st.one_of(st.integers(0, 24).map(lambda k: 0.25 * k), st.floats(0.0, 12.0, width=32))
elements = st.builds(element, st.sampled_from(KINDS), positions, positions, sizes, sizes)


@st.composite
def model_sizes(draw: st.DrawFn) -> ModelSizes:
    return ModelSizes(
        depth_m=draw(st.sampled_from([0.5, 3.0, 10.0, 12.0, 40.0])),
        setback_m=draw(st.sampled_from([0.0, 0.05, 0.2, 1.0])),
    )


@settings(max_examples=30)
@given(
    items=st.lists(elements, max_size=24),
    roof_m=st.sampled_from([-1.0, 0.0, 0.4, 0.6, 3.6, 9.0]),
    facade_m=st.tuples(st.floats(0.5, 40.0), st.floats(0.5, 40.0)),
    chosen=model_sizes(),
)
def test_every_document_closes(
    items: list[Element], roof_m: float, facade_m: tuple[float, float], chosen: ModelSizes
) -> None:
    document = sample_document(items, roof_m, facade_m, chosen)
    part = build_part(document, PHOTO, "any")
    assert_closed(part)
    assert np.isfinite(part.uv).all()
    assert part.uv.min() >= 0.0
    assert part.uv.max() <= 1.0


@given(items=st.lists(elements, max_size=24), facade_m=st.tuples(*[st.floats(0.5, 40.0)] * 2))
def test_openings_keep_their_distance(items: list[Element], facade_m: tuple[float, float]) -> None:
    layout = lay_out(sample_document(items, 3.0, facade_m))
    _assert_apart(list(layout.openings), (0.0, 0.0, *facade_m))


def _assert_apart(openings: list[Opening], border: tuple[float, float, float, float]) -> None:
    """All pairs by brute force; and each lies within the border with a gap around it."""
    slack = GAP_M - 1e-9
    for k, one in enumerate(openings):
        box = one.rectangle
        assert box.x0 >= border[0] + slack
        assert box.z0 >= border[1] + slack
        assert box.x1 <= border[2] - slack
        assert box.z1 <= border[3] - slack
        for other in openings[:k]:
            away = other.rectangle
            across = max(box.x0 - away.x1, away.x0 - box.x1)
            along = max(box.z0 - away.z1, away.z0 - box.z1)
            assert max(across, along) >= slack
        _assert_apart(list(one.children), (box.x0, box.z0, box.x1, box.z1))


@pytest.mark.parametrize(("depth_m", "roof_m"), [(0.5, 9.0), (1.0, 3.6), (2.0, 3.6), (10.0, 9.0)])
def test_dormers_of_steep_slopes_close(depth_m: float, roof_m: float) -> None:
    """Where a slope is steeper than some 77 degrees, it leans too little to be told by leaning."""
    chosen = ModelSizes(depth_m=depth_m, setback_m=0.1)
    window = element("window", 2.0, 1.2, 1.2, 0.75)
    part = build_part(sample_document([window], roof_m, (8.0, 1.0), chosen), PHOTO, "steep")
    assert any("dormer" in name for name in part.features.name)
    assert_closed(part)
