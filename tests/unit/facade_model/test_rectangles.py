"""Carving rectangles clear of each other, against brute force on a lattice."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from veduta.facade.rectangles import Rectangle, carve

corners = st.integers(0, 8)


@st.composite
def rectangles(draw: st.DrawFn) -> Rectangle:
    x0, z0 = draw(corners), draw(corners)
    return Rectangle(x0, z0, x0 + draw(st.integers(1, 6)), z0 + draw(st.integers(1, 6)))


def cells(rectangle: Rectangle) -> set[tuple[int, int]]:
    return {
        (x, z)
        for x in range(round(rectangle.x0), round(rectangle.x1))
        for z in range(round(rectangle.z0), round(rectangle.z1))
    }


@given(rectangles(), st.lists(rectangles(), max_size=6), st.integers(0, 2))
def test_what_is_left_lies_inside_and_clear(
    whole: Rectangle, obstacles: list[Rectangle], gap: int
) -> None:
    left = carve(whole, obstacles, float(gap))
    assert cells(left) <= cells(whole)
    for obstacle in obstacles:
        assert not cells(left) & cells(obstacle.grown(gap))


@given(rectangles(), rectangles())
def test_one_obstacle_leaves_the_largest_rectangle(whole: Rectangle, obstacle: Rectangle) -> None:
    free = cells(whole) - cells(obstacle)
    best = max(
        (
            (x1 - x0) * (z1 - z0)
            for x0 in range(round(whole.x0), round(whole.x1))
            for x1 in range(x0 + 1, round(whole.x1) + 1)
            for z0 in range(round(whole.z0), round(whole.z1))
            for z1 in range(z0 + 1, round(whole.z1) + 1)
            if cells(Rectangle(x0, z0, x1, z1)) <= free
        ),
        default=0,
    )
    assert round(carve(whole, [obstacle], 0.0).area) == best
