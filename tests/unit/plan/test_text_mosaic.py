"""Cutouts of a sheet, against the sheet itself: each pixel of a box is found where it is said."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from veduta.plan.text.mosaic import GAP_PX, STEP_PX, Box, boxes_of_marks, mosaics

SIDE = 256
PAPER = np.array([255, 250, 240], np.uint8)


def _sheet(width: int, height: int) -> np.ndarray:
    """Each pixel says where it is."""
    y, x = np.mgrid[0:height, 0:width]
    return np.stack([x % 251, y % 241, (x // 251 + y // 241) % 200], axis=-1).astype(np.uint8)


boxes = st.builds(
    lambda x, y, w, h: Box((x, y), (x + w, y + h), 5),
    st.integers(0, 700), st.integers(0, 400), st.integers(1, SIDE), st.integers(1, SIDE),
)  # fmt: skip


@given(st.lists(boxes, max_size=12))
@settings(max_examples=60, deadline=None)
def test_every_box_lies_in_a_mosaic_as_it_is_in_the_sheet(given_boxes: list[Box]) -> None:
    sheet = _sheet(960, 660)
    pictures = mosaics(sheet, given_boxes, SIDE, PAPER)
    laid = [(picture, one) for picture in pictures for one in picture.cutouts]
    assert sorted((one.source, one.size) for _, one in laid) == sorted(
        (box.low, box.size) for box in given_boxes
    )
    for picture, one in laid:
        (x, y), (left, top), (wide, tall) = one.source, one.target, one.size
        shown = picture.pixels[top : top + tall, left : left + wide]
        assert np.array_equal(shown, sheet[y : y + tall, x : x + wide])


@given(st.lists(boxes, min_size=1, max_size=12))
@settings(max_examples=60, deadline=None)
def test_cutouts_keep_apart_and_pictures_small(given_boxes: list[Box]) -> None:
    for picture in mosaics(_sheet(960, 660), given_boxes, SIDE, PAPER):
        height, width = picture.pixels.shape[:2]
        assert height % STEP_PX == width % STEP_PX == 0
        assert max(height, width) <= SIDE
        taken = np.zeros((height + GAP_PX, width + GAP_PX), int)
        for one in picture.cutouts:
            (left, top), (wide, tall) = one.target, one.size
            taken[top : top + tall + GAP_PX, left : left + wide + GAP_PX] += 1
        assert taken.max() == 1
        inside = np.zeros((height, width), bool)
        for one in picture.cutouts:
            (left, top), (wide, tall) = one.target, one.size
            inside[top : top + tall, left : left + wide] = True
        assert (picture.pixels[~inside] == PAPER).all()


def test_what_is_found_in_a_mosaic_is_told_in_pixels_of_the_sheet() -> None:
    given_boxes = [Box((100, 50), (200, 90), 9), Box((600, 300), (680, 340), 4)]
    (picture,) = mosaics(_sheet(960, 660), given_boxes, SIDE, PAPER)
    rectangle = np.array([(0, 0), (30, 0), (30, 12), (0, 12)], float)
    (one, two) = sorted(picture.cutouts, key=lambda each: each.source)
    found = np.stack([
        rectangle + one.target + np.array([10, 20]),
        rectangle + two.target + np.array([60, 5]),
        rectangle + one.target + np.array([0, one.size[1] + 8]),
    ])  # fmt: skip
    moved = picture.in_sheet(found)
    # The second reaches over its cutout's border, and the third is in no cutout.
    assert sorted(map(np.ndarray.tolist, moved)) == [
        [[110, 70], [140, 70], [140, 82], [110, 82]],
        [[660, 305], [680, 305], [680, 317], [660, 317]],
    ]


def test_marks_that_stand_together_are_one_block() -> None:
    word = np.array([(100.0 + 12 * step, 100.0) for step in range(6)])
    far = np.array([(700.0, 500.0), (712.0, 500.0)])
    found = boxes_of_marks(np.concatenate([word, far]), (960, 660), 40.0, 2, 400, 340)
    assert [box.marks for box in found] == [6, 2]
    for box, marks in zip(found, (word, far), strict=True):
        assert box.low == tuple(marks.min(axis=0) - 40.0)
        assert box.high == tuple(marks.max(axis=0) + 40.0)
    (most,) = boxes_of_marks(np.concatenate([word, far]), (960, 660), 40.0, 3, 400, 340)
    assert most == found[0]


def test_blocks_are_one_where_that_is_less_to_look_at() -> None:
    """Side by side they share most of what is around them; across a corner they do not."""
    first = np.array([(200.0, 200.0), (212.0, 200.0)])
    beside, across = first + np.array([90.0, 0.0]), first + np.array([140.0, 140.0])
    (both,) = boxes_of_marks(np.concatenate([first, beside]), (960, 660), 80.0, 2, 400, 340)
    assert (both.low, both.high) == ((120, 120), (382, 280))
    two = boxes_of_marks(np.concatenate([first, across]), (960, 660), 80.0, 2, 400, 340)
    assert [box.low for box in two] == [(120, 120), (260, 260)]


@given(
    st.lists(st.tuples(st.floats(0, 1499.0), st.floats(0, 999.0)), min_size=1, max_size=60),
    st.floats(4, 80),
)
@settings(max_examples=60, deadline=None)
def test_all_marks_are_in_boxes_of_the_size_that_is_allowed(
    places: list[tuple[float, float]], margin_px: float
) -> None:
    marks = np.array(places)
    found = boxes_of_marks(marks, (1500, 1000), margin_px, 1, 300, 250)
    held = np.any([box.holds(marks) for box in found], axis=0)
    assert held.all()
    for box in found:
        assert 0 < min(box.size) <= max(box.size) <= 300
        assert np.all(np.array(box.high) <= (1500, 1000))


def test_no_marks_are_no_boxes_and_no_mosaics() -> None:
    assert boxes_of_marks(np.zeros((0, 2)), (500, 300), 40.0, 2, 300, 250) == []
    assert mosaics(_sheet(500, 300), [], SIDE, PAPER) == []
