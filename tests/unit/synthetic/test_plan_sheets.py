"""Drawn sheets show what their truth says, also after they were damaged."""

from __future__ import annotations

import json

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from veduta.synthetic.plans.bodies import solid_walls
from veduta.synthetic.plans.degrade import DEGRADATIONS, Degradation
from veduta.synthetic.plans.house import Room
from veduta.synthetic.plans.labels import size_text
from veduta.synthetic.plans.sets import FIRST_TEST_SEED, choice, sheets_of
from veduta.synthetic.plans.styles import BY_NAME, STYLES
from veduta.synthetic.plans.truth_file import SheetTruth, from_json, to_json

CLEAN = DEGRADATIONS[0]


def _mask(area: BaseGeometry, truth: SheetTruth, shape: tuple[int, int]) -> NDArray[np.bool_]:
    """The area's pixels, drawn with integer vertices: an oracle apart from the canvas."""
    mask = np.zeros(shape, np.uint8)
    parts = [area] if isinstance(area, Polygon) else list(area.geoms)
    affine = truth.px_from_m
    for part in parts:
        for ring, value in ((part.exterior, 1), *((inner, 0) for inner in part.interiors)):
            px = np.asarray(ring.coords) @ affine[:2, :2].T + affine[:2, 2]
            cv2.fillPoly(mask, [np.floor(px).astype(np.int32)], value)
    return mask > 0


@pytest.mark.parametrize("name", ["clean", "skew", "mirrored", "low-resolution"])
def test_walls_are_dark_where_the_truth_says(name: str) -> None:
    fault = next(fault for fault in DEGRADATIONS if fault.name == name)
    for picture, truth in sheets_of(5, BY_NAME["plain"], fault):
        assert truth.mirrored == (name == "mirrored")
        dark = picture.mean(axis=2) < 128
        pixel = truth.metres_per_px
        sure = _mask(solid_walls(truth.storey).buffer(-1.5 * pixel), truth, dark.shape)
        assert dark[sure].mean() > 0.99
        for room in truth.storey.rooms:
            floor = _mask(Polygon(room.outline_m).buffer(-2 * pixel), truth, dark.shape)
            assert dark[floor].mean() < 0.15  # names, doors, stairs


@pytest.mark.parametrize("fault", DEGRADATIONS, ids=lambda fault: fault.name)
def test_a_damaged_sheet_is_where_its_affine_says(fault: Degradation) -> None:
    """Three large dots on a white sheet, found again by their centres."""
    sheet = np.full((700, 900, 3), 255, np.uint8)
    dots = np.array([[150, 140], [750, 180], [300, 560]])
    for x, y in dots:
        cv2.circle(sheet, (int(x), int(y)), 24, (0, 0, 0), -1, cv2.LINE_AA)
    picture, affine = fault.apply(np.random.default_rng(3), sheet, (255, 255, 255))
    grey = cv2.GaussianBlur(picture, (0, 0), 1.5).mean(axis=2)
    for x, y in (dots + 0.5) @ affine[:2, :2].T + affine[:2, 2]:
        reach = 40
        left, top = max(0, round(x) - reach), max(0, round(y) - reach)
        part = grey[top : top + 2 * reach, left : left + 2 * reach]
        ink = np.clip(np.median(part) - part - 60.0, 0.0, None)
        rows, columns = np.indices(part.shape) + 0.5
        found = np.array([(columns * ink).sum(), (rows * ink).sum()]) / ink.sum() + [left, top]
        assert np.hypot(*(found - [x, y])) < 1.0


@pytest.mark.parametrize("style", STYLES, ids=lambda style: style.name)
def test_every_style_draws(style: object) -> None:
    picture, truth = next(sheets_of(9, BY_NAME[style.name], CLEAN))  # type: ignore[attr-defined]
    assert picture.dtype == np.uint8
    assert 300 < min(picture.shape[:2]) < 3000
    back = from_json(json.loads(json.dumps(to_json(truth))))
    assert back.storey == truth.storey
    assert np.allclose(back.px_from_m, truth.px_from_m)
    assert back.unseen == ((style.name,) if style.split == "unseen" else ())  # type: ignore[attr-defined]


def test_development_never_sees_what_is_kept_back() -> None:
    early = [item for seed in range(1000) for item in choice(seed)]
    assert {item.split for item in early} == {"development"}
    late = [choice(FIRST_TEST_SEED + seed) for seed in range(200)]
    known = [all(item.split == "development" for item in pair) for pair in late]
    assert 50 < sum(known) < 150
    assert {style.name for style, _ in late} == {style.name for style in STYLES}
    assert {fault.name for _, fault in late} == {fault.name for fault in DEGRADATIONS}


def test_sizes_are_printed_as_people_write_them() -> None:
    outline = ((0.0, 0.0), (4.94, 0.0), (4.94, 3.06), (0.0, 3.06))
    room = Room("r", "living", outline, 4.94 * 3.06)
    area = Polygon(outline)
    assert size_text("metres", room, area) == "4.94 x 3.06"
    assert size_text("comma", room, area) == "4,94 x 3,06"
    assert size_text("feet", room, area) == "16'2 x 10'0"
    assert size_text("feet-inches", room, area) == "16'2\" x 10'0\""
    assert size_text("area", room, area) == "15,1 m²"
    assert size_text("area-feet", room, area) == "163 sq ft"
