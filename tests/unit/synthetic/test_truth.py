"""The truth agrees with the photo that it goes with, in every style."""

from __future__ import annotations

import functools
import io

import cv2
import numpy as np
import pytest
from PIL import Image

from veduta.geometry import homography
from veduta.place.semantics import LABELS
from veduta.synthetic.facade import SyntheticFacade, make_facade
from veduta.synthetic.layout import STYLES, Style
from veduta.synthetic.options import SyntheticOptions

SMALL = {"long_side_px": 480, "samples": 1, "detached": True}


@functools.cache
def facade(style: Style, seed: int = 3) -> SyntheticFacade:
    return make_facade(seed, SyntheticOptions(style=style, **SMALL))


@pytest.mark.parametrize("style", STYLES)
def test_projected_rectangles_hold_their_label(style: Style) -> None:
    """What a true outline encloses (a little inside it) is mostly labelled as that element."""
    made = facade(style)
    for element in made.truth.elements:
        middle = element.quad_px.mean(axis=0)
        inner = middle + 0.7 * (element.quad_px - middle)
        mask = np.zeros(made.truth.labels.shape, np.uint8)
        cv2.fillPoly(mask, [np.rint(inner).astype(np.int32)], 1)
        labels = made.truth.labels[mask > 0]
        share = np.mean(labels == LABELS.index(element.label))
        assert share > 0.95, (element.label, element.floor, element.column, share)


@pytest.mark.parametrize("style", STYLES)
def test_labels_cover_no_more_than_the_elements(style: Style) -> None:
    """Each window and door pixel lies in the outline of such an element, widened by 2 px."""
    made = facade(style)
    for label in ("window", "door", "shop"):
        mask = np.zeros(made.truth.labels.shape, np.uint8)
        for element in made.truth.elements:
            if element.label == label:
                cv2.fillPoly(mask, [np.rint(element.quad_px).astype(np.int32)], 1)
        mask = cv2.dilate(mask, np.ones((5, 5), np.uint8))
        of_class = made.truth.labels == LABELS.index(label)
        if of_class.any():
            assert np.mean(mask[of_class] == 0) < 0.02


@pytest.mark.parametrize("style", STYLES)
def test_the_homography_takes_the_wall_to_where_it_is_seen(style: Style) -> None:
    made = facade(style)
    truth = made.truth
    wall = [[0.02, 0.02], [truth.width_m - 0.02, 0.02], [truth.width_m / 2, truth.height_m / 2]]
    points = np.array([[x, 0.0, z] for x, z in wall])
    by_camera, depth = made.camera.project(points)
    np.testing.assert_allclose(
        homography.apply(truth.photo_from_facade, np.array(wall)), by_camera, atol=1e-6
    )
    rows, columns = np.floor(by_camera[:2, 1]).astype(int), np.floor(by_camera[:2, 0]).astype(int)
    np.testing.assert_allclose(made.depth_m[rows, columns], depth[:2], rtol=0.02)


def test_the_whole_house_is_in_the_frame() -> None:
    for style in STYLES:
        made = facade(style)
        height, width = made.photo.shape[:2]
        for element in made.truth.elements:
            assert (element.quad_px > 0).all()
            assert (element.quad_px < [width, height]).all()


def test_the_same_seed_gives_the_same_bytes() -> None:
    options = SyntheticOptions(style="terrace", **SMALL)
    again = make_facade(3, options)
    assert again.jpeg == facade("terrace").jpeg
    np.testing.assert_array_equal(again.truth.labels, facade("terrace").truth.labels)
    assert make_facade(4, options).jpeg != again.jpeg


def test_the_file_states_the_focal_length() -> None:
    made = facade("modern")
    with Image.open(io.BytesIO(made.jpeg)) as image:
        stated = image.getexif().get_ifd(0x8769)[0xA405]
        assert image.size == (made.camera.width_px, made.camera.height_px)
    assert stated == pytest.approx(made.camera.focal_mm35)


def test_neighbours_and_occluders_are_other() -> None:
    options = SyntheticOptions(style="stucco", occluders=True, long_side_px=480, samples=1)
    made = make_facade(3, options)
    plain = facade("stucco")
    other = LABELS.index("other")
    assert np.sum(made.truth.labels == other) > np.sum(plain.truth.labels == other)
    assert made.layout == plain.layout


@pytest.mark.parametrize("style", STYLES)
def test_windows_behind_a_railing_are_cut_by_it(style: Style) -> None:
    truth = facade(style).truth
    for element in truth.elements:
        assert element.visible.top_m == element.rect.top_m
        if element.label != "window":
            assert element.visible == element.rect
    cut = [e for e in truth.elements if e.visible.height_m < e.rect.height_m - 0.1]
    assert bool(cut) == (style in ("haussmann", "stucco"))
