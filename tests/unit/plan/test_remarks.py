"""What is said of plans that are cut off, of two on a sheet, and of rooms without doors."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from test_reading import two_rooms

from veduta.plan.reading import read_storey
from veduta.plan.remarks import remarks

Image = NDArray[np.uint8]


def said(image: Image, metres_per_px: float = 0.01) -> list[str]:
    drawn = read_storey(image)
    finer = image.shape[1] / drawn.cleaned.pixels.shape[1]
    return remarks(drawn, image.shape[:2], metres_per_px * finer)


def without_door(image: Image) -> Image:
    closed = image.copy()
    cv2.rectangle(closed, (707, 400), (830, 520), (255, 255, 255), -1)
    cv2.rectangle(closed, (694, 400), (705, 520), (0, 0, 0), -1)
    return closed


def test_a_whole_plan_needs_no_remark() -> None:
    assert said(two_rooms()) == []


@pytest.mark.parametrize(
    ("rows", "columns", "edge"),
    [
        (slice(None), slice(0, 1000), "right"),
        (slice(0, 600), slice(None), "lower"),
    ],
)
def test_a_plan_that_is_cut_off_is_told_with_its_edge(
    rows: slice, columns: slice, edge: str
) -> None:
    notes = said(np.ascontiguousarray(two_rooms()[rows, columns]))
    assert len([note for note in notes if "the plan may be cut off" in note]) == 1
    assert any(f"run into the {edge} edge of the sheet" in note for note in notes)


def test_a_cut_is_found_on_a_skewed_scan() -> None:
    turn = cv2.getRotationMatrix2D((500, 500), 3.0, 1.0)
    image = cv2.warpAffine(two_rooms(), turn, (1400, 1000), borderValue=(255, 255, 255))
    notes = said(np.ascontiguousarray(np.asarray(image, np.uint8)[:, :1000]))
    assert any("run into the right edge" in note for note in notes)


def test_two_plans_on_a_sheet_are_told_with_their_sizes() -> None:
    image = np.full((1000, 2800, 3), 255, np.uint8)
    image[:, :1400] = image[:, 1400:] = two_rooms()
    (note,) = said(image)
    assert note.startswith("2 plans lie apart on this sheet (10.0 x 6.0 m, 10.0 x 6.0 m)")


def test_a_shed_beside_the_house_is_no_second_plan() -> None:
    image = np.full((1000, 1900, 3), 255, np.uint8)
    image[:, :1400] = two_rooms()
    cv2.rectangle(image, (1500, 300), (1700, 500), (0, 0, 0), 24)
    assert not [note for note in said(image) if "lie apart" in note]


def test_rooms_without_doors_are_named_with_their_areas() -> None:
    (note,) = said(without_door(two_rooms()))
    assert note.startswith("2 rooms have no door that was found: r1 (25.9 m²), r2 (25.9 m²).")
