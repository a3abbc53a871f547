"""Every layout is a facade that could stand: openings in the wall, apart, on their floors."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from veduta.synthetic.layout import STYLES, Layout, Rect, Style
from veduta.synthetic.styles import design

layouts = st.builds(
    design,
    st.sampled_from(STYLES),
    st.integers(0, 2**31 - 1),
    st.none() | st.integers(1, 12),
    st.none() | st.integers(1, 12),
)


def _overlap(a: Rect, b: Rect) -> bool:
    return a.x_m < b.right_m and b.x_m < a.right_m and a.y_m < b.top_m and b.y_m < a.top_m


@given(layouts)
def test_openings_lie_apart_in_the_wall(layout: Layout) -> None:
    rects = [opening.rect for opening in layout.openings]
    for rect in rects:
        assert rect.width_m > 0.3
        assert rect.height_m > 0.3
        assert rect.x_m >= 0.0
        assert rect.right_m <= layout.width_m
        assert rect.y_m >= 0.0
        assert rect.top_m < layout.height_m
    for i, a in enumerate(rects):
        assert not any(_overlap(a, b) for b in rects[i + 1 :])


@given(layouts)
def test_openings_stand_on_the_floor_that_they_name(layout: Layout) -> None:
    for opening in layout.openings:
        low = sum(layout.floors_m[: opening.floor])
        assert low <= opening.rect.y_m
        assert opening.rect.top_m <= low + layout.floors_m[opening.floor]


@given(layouts)
def test_every_floor_above_the_ground_has_a_window_on_each_axis(layout: Layout) -> None:
    found = {(o.floor, o.column) for o in layout.openings if o.class_ == "window"}
    wanted = {(f, c) for f in range(1, layout.storeys) for c in range(layout.columns)}
    assert wanted <= found


@pytest.mark.parametrize("style", STYLES)
def test_floors_and_columns_can_be_fixed(style: Style) -> None:
    layout = design(style, 7, floors=4, columns=6)
    assert (layout.storeys, layout.columns) == (4, 6)
    assert design(style, 7, 4, 6) == layout
    assert design(style, 8, 4, 6) != layout
