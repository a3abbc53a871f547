"""`labels.png` is the rasterisation of the document and nothing else."""

from __future__ import annotations

import io
import itertools
import tracemalloc
from collections.abc import Callable
from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from veduta.facade.document import CLASSES, FacadeDocument
from veduta.facade.outputs import COLOURS, coloured, label_png, rasterise

Make = Callable[..., FacadeDocument]
Points = list[tuple[float, float]]


def redrawn(document: FacadeDocument) -> np.ndarray:
    """The labels again, pixel by pixel, in exact arithmetic."""
    size = document.rectification
    labels = np.full((size.height_px, size.width_px), CLASSES.index("other"))
    for row in range(size.height_px):
        for column in range(size.width_px):
            x, y = Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2)
            for extent in document.extents:
                if holds(extent.polygon_px, x, y):
                    labels[row, column] = CLASSES.index(extent.class_)
            for e in document.elements:
                left, top = Fraction(e.x_px), Fraction(e.y_px)
                right, bottom = Fraction(e.x_px + e.width_px), Fraction(e.y_px + e.height_px)
                if left <= x < right and top <= y < bottom:
                    labels[row, column] = CLASSES.index(e.class_)
    return labels


def holds(polygon: Points, x: Fraction, y: Fraction) -> bool:
    """Even-odd: count the edges that a ray to the left crosses, its source included."""
    inside = False
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
        if (Fraction(y0) <= y) == (Fraction(y1) <= y):
            continue
        along = (y - Fraction(y0)) / (Fraction(y1) - Fraction(y0))
        if Fraction(x0) + along * (Fraction(x1) - Fraction(x0)) <= x:
            inside = not inside
    return inside


# Sixteenths, half pixels among them: borders that run through centres, without rounding.
coordinate = st.integers(-48, 400).map(lambda value: value / 16)
corner = st.tuples(coordinate, coordinate)
length = st.integers(0, 300).map(lambda value: value / 16)
name = st.sampled_from(CLASSES)


@given(
    extents=st.lists(st.tuples(name, st.lists(corner, min_size=3, max_size=7)), max_size=4),
    elements=st.lists(
        st.tuples(name, st.tuples(coordinate, coordinate, length, length)), max_size=4
    ),
)
def test_labels_are_redrawn_alike(make_document: Make, extents: list, elements: list) -> None:
    document = make_document((19, 17), (1, 1, 10, 10), extents, elements)
    assert (rasterise(document) == redrawn(document)).all()


def near(value: Fraction, parts: int) -> tuple[Fraction, ...]:
    return value - Fraction(1, parts), value, value + Fraction(1, parts)


free = st.floats(-40.0, 60.0) | st.floats(-1e6, 1e6)


@given(points=st.lists(st.tuples(free, free), min_size=3, max_size=9))
def test_a_polygon_anywhere(make_document: Make, points: Points) -> None:
    """Even-odd for each pixel's centre, whatever part of the polygon lies outside of the image."""
    painted = rasterise(make_document((19, 17), extents=[("sky", points)])) == CLASSES.index("sky")
    for row, column in np.ndindex(painted.shape):
        x, y = Fraction(2 * column + 1, 2), Fraction(2 * row + 1, 2)
        if painted[row, column] != holds(points, x, y):
            # Only a border that passes this near to the centre may be rounded across it.
            around = itertools.product(near(x, 10**6), near(y, 10**9))
            assert len({holds(points, *each) for each in around}) == 2


def test_a_small_polygon_takes_little_memory(make_document: Make) -> None:
    """A document may hold many polygons: each costs what it covers, not a whole image."""
    points = [(3000.2, 3000.2), (3090.7, 3000.2), (3090.7, 3095.3), (3000.2, 3095.3)]
    document = make_document((4000, 4000), extents=[("sky", points)])
    tracemalloc.start()
    try:
        labels = rasterise(document)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak - labels.nbytes < 200_000
    rows, columns = np.nonzero(labels == CLASSES.index("sky"))
    assert (rows.min(), rows.max()) == (3000, 3094)
    assert (columns.min(), columns.max()) == (3000, 3090)


@given(corners=st.lists(corner, min_size=4, max_size=4, unique=True))
def test_a_shared_edge_has_one_owner(make_document: Make, corners: Points) -> None:
    """Two triangles on both sides of a diagonal give the quadrilateral, by exclusive or."""
    a, b, c, d = corners

    def mask(*points: tuple[float, float]) -> np.ndarray:
        return rasterise(make_document((25, 25), extents=[("sky", list(points))])) == 6

    assert ((mask(a, b, c) ^ mask(c, d, a)) == mask(a, b, c, d)).all()


def test_borders_through_centres(make_document: Make) -> None:
    document = make_document((4, 3), extents=[], elements=[("window", (0.5, 0.5, 2.0, 1.0))])
    window = rasterise(document) == CLASSES.index("window")
    assert window.tolist() == [[True, True, False, False], [False] * 4, [False] * 4]


def test_label_png_is_an_indexed_image(make_document: Make) -> None:
    document = make_document(elements=[("window", (20, 50, 10, 20)), ("door", (60, 150, 15, 40))])
    labels = rasterise(document)
    image = Image.open(io.BytesIO(label_png(document, labels)))
    assert image.mode == "P"
    assert image.size == (120, 200)
    assert (np.asarray(image) == labels).all()
    assert (np.asarray(image.convert("RGB")) == coloured(document, labels)).all()
    assert {document.classes[index] for index in np.unique(labels)} == {
        "window", "door", "sky", "wall", "other",
    }  # fmt: skip


def test_colours_differ() -> None:
    assert set(COLOURS) == set(CLASSES)
    assert len(set(COLOURS.values())) == len(CLASSES)
