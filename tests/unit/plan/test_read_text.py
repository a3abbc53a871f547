"""Text that was drawn is read: small, upwards, in all eight positions of a sheet."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from veduta.plan.clean.straighten import laid_straight
from veduta.plan.document import Sheet, Text
from veduta.plan.text import regions
from veduta.plan.text.engine import LINE_PX, read_line, side_by_side
from veduta.plan.text.orientation import Position, find_position, right_from_scan, set_right
from veduta.plan.text.reading import read_texts
from veduta.plan.text.regions import without_duplicates
from veduta.plan.text.sheet_text import SheetText, moved_texts, read_sheet, sheet_of_file
from veduta.synthetic.plans.sets import sheets_of

WORDS = {
    "KITCHEN": (150, 80),
    "4.94 x 3.06": (150, 110),
    "Bedroom": (420, 90),
    "17,4 m2": (420, 300),
}
POSITIONS = [(mirrored, turns) for mirrored in (False, True) for turns in range(4)]


@lru_cache(maxsize=1)
def _sheet() -> NDArray[np.uint8]:
    """A plan of two rooms, 560 x 400, with text 20 px high and one word that runs upwards."""
    page = Image.new("RGB", (560, 400), "white")
    pen = ImageDraw.Draw(page)
    pen.rectangle((10, 10, 550, 390), outline="black", width=8)
    pen.rectangle((270, 10, 276, 390), fill="black")
    font = ImageFont.load_default(20)
    for words, at in WORDS.items():
        pen.text(at, words, fill="black", font=font, anchor="mm")
    side = Image.new("RGB", (120, 30), "white")
    ImageDraw.Draw(side).text((60, 15), "CLOSET", fill="black", font=font, anchor="mm")
    page.paste(side.rotate(90, expand=True), (60, 200))
    return np.asarray(page)


def _plain(text: Text) -> str:
    """What is the same in print: signs of multiplication, and the raised 2."""
    return text.text.replace("×", "x").replace("²", "2")


def _centre(text: Text) -> NDArray[np.float64]:
    return np.mean(text.box_px, axis=0)


def test_words_and_their_places() -> None:
    found = {_plain(text): text for text in read_texts(_sheet())}
    assert set(found) == {*WORDS, "CLOSET"}
    for words, at in WORDS.items():
        assert _centre(found[words]) == pytest.approx(at, abs=4)
    upper_left, upper_right = found["CLOSET"].box_px[:2]
    assert upper_right[1] < upper_left[1] - 50  # it is read upwards


def test_a_sheet_that_lies_wrong_is_set_right() -> None:
    """It was mirrored, then turned by a quarter; `test_pixels_go` has the other positions."""
    wrong = np.ascontiguousarray(np.rot90(np.fliplr(_sheet()), -1))
    read = read_sheet(wrong)
    assert np.array_equal(read.pixels, _sheet())
    assert {"KITCHEN", "Bedroom"} <= {text.text for text in read.texts}
    back = moved_texts(read.texts, np.linalg.inv(read.right_from_scan))
    there = moved_texts(back, read.right_from_scan)
    assert np.allclose([_centre(a) - _centre(b) for a, b in zip(there, read.texts, strict=True)], 0)


@pytest.mark.parametrize(("mirrored", "turns"), POSITIONS)
def test_pixels_go_where_the_matrix_says(mirrored: bool, turns: int) -> None:
    """A marked pixel of a sheet of 5 x 3 is found where its centre is taken to."""
    scan = np.zeros((3, 5, 3), dtype=np.uint8)
    scan[1, 3] = 255
    position = Position(mirrored, turns, 1.0, 0.0)
    row, column = np.argwhere(set_right(scan, position)[:, :, 0])[0]
    taken = right_from_scan(position, (5, 3)) @ (3.5, 1.5, 1.0)
    assert taken == pytest.approx((column + 0.5, row + 0.5, 1.0))


@pytest.mark.parametrize("skew_rad", [0.0, 0.05])
@pytest.mark.parametrize(("mirrored", "turns"), POSITIONS)
def test_how_a_scan_lay_is_what_its_matrix_does(
    mirrored: bool, turns: int, skew_rad: float
) -> None:
    """To turn by `rotation_rad`, then to mirror, is the linear part of `clean_from_scan`."""
    position = Position(mirrored, turns, 1.0, 0.0)
    pixels = np.zeros((30, 50, 3), dtype=np.uint8)
    _, clean_from_right = laid_straight(set_right(pixels, position), skew_rad, 2.0)
    read = SheetText(pixels, right_from_scan(position, (50, 30)), position, [])
    sheet = Sheet(
        file="a.png", sha256="0", width_px=1, height_px=1, metres_per_px=0.01,
        rotation_rad=skew_rad, clean_from_scan=clean_from_right.tolist(), origin_px=(0.0, 0.0),
    )  # fmt: skip
    found = sheet_of_file(sheet, read)
    assert found.mirrored == mirrored
    cos, sin = np.cos(found.rotation_rad), np.sin(found.rotation_rad)
    turned = np.array([[cos, sin], [-sin, cos]])  # counter-clockwise, where y points down
    expected = 2.0 * (np.diag([-1.0, 1.0]) @ turned if mirrored else turned)
    assert np.array(found.clean_from_scan)[:2, :2] == pytest.approx(expected, abs=1e-9)


def test_a_blank_sheet_and_a_tiny_one_say_nothing() -> None:
    for size in ((60, 80), (30, 30), (1, 1)):
        read = read_sheet(np.full((*size, 3), 255, dtype=np.uint8))
        assert read.texts == []
        assert read.position.is_upright


def test_a_region_in_another_is_the_same_text() -> None:
    large = np.array([(0, 0), (100, 0), (100, 20), (0, 20)], dtype=float)
    inside, beside = large * 0.9 + 2.0, large + np.array([150.0, 0.0])
    kept = without_duplicates(np.array([inside, large, beside]))
    assert np.array_equal(kept, [large, beside])


def test_small_text_of_a_large_sheet_is_found_closer(monkeypatch: pytest.MonkeyPatch) -> None:
    large = np.full((1500, 2400, 3), 255, dtype=np.uint8)
    large[1000:1400, 1700:2260] = _sheet()
    monkeypatch.setattr(regions, "OVERVIEW_PX", 420)
    monkeypatch.setattr(regions, "TILE_PX", 640)
    closer = read_texts(large)
    monkeypatch.setattr(regions, "MOST_TILES", 0)
    at_once = read_texts(large)
    assert "Bedroom" in {_plain(text) for text in closer}
    assert "Bedroom" not in {_plain(text) for text in at_once}


def test_a_line_of_joined_letters_is_looked_at_closer_as_a_whole(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It is no row of marks, but the overview saw it, too small to be read."""
    large = np.full((1500, 2400, 3), 255, dtype=np.uint8)
    large[700:712, 900:1500] = 0
    line = np.array([(900.0, 700.0), (1500.0, 700.0), (1500.0, 712.0), (900.0, 712.0)])
    looked_at: list[tuple[int, ...]] = []

    def nothing(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
        looked_at.append(pixels.shape)
        return np.zeros((0, 4, 2))

    monkeypatch.setattr(regions, "find_lines", nothing)
    assert not len(regions.find_regions(large, line[None]))
    ((height, width, _),) = looked_at
    assert width >= 600
    assert height < 400


def test_words_of_narrow_letters_are_marks_and_rows_of_dashes_are_none() -> None:
    page = Image.new("RGB", (900, 700), "white")
    pen = ImageDraw.Draw(page)
    pen.text((300, 200), "Hall", fill="black", font=ImageFont.load_default(26))
    for step in range(20):
        pen.rectangle((100 + 30 * step, 500, 118 + 30 * step, 502), fill="black")
    marks = regions._letter_like(np.asarray(page), np.zeros((0, 4, 2)))
    assert len(marks) == 4
    assert (marks[:, 1] < 300).all()


def test_the_closer_look_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks of marks all over a sheet: what is looked at is no more than is allowed."""
    sheet = np.full((6000, 6000, 3), 255, dtype=np.uint8)
    for y in range(100, 5900, 400):
        for x in range(100, 5900, 400):
            for step in range(8):
                sheet[y : y + 16, x + 20 * step : x + 20 * step + 12] = 0
    looked_at = list[int]()

    def nothing(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
        looked_at.append(pixels.shape[0] * pixels.shape[1])
        return np.zeros((0, 4, 2))

    monkeypatch.setattr(regions, "find_lines", nothing)
    monkeypatch.setattr(regions, "MOST_TILES", 3)
    regions.find_regions(sheet, np.zeros((0, 4, 2)))
    whole = regions.TILE_PX**2
    assert 1.5 * whole < sum(looked_at) <= 4 * whole


def test_lines_read_side_by_side_are_those_read_one_by_one() -> None:
    strips = []
    for words in ("OLOHUONE", "4.94 x 3.06", "", "Bedroom 12", "17,4 m2", "KITCHEN", "WC"):
        strip = Image.new("RGB", (240, LINE_PX), "white")
        pen, font = ImageDraw.Draw(strip), ImageFont.load_default(28)
        pen.text((120, LINE_PX // 2), words, fill="black", font=font, anchor="mm")
        strips.append(np.asarray(strip))
    lines = side_by_side(read_line, strips)
    assert lines == [read_line(strip) for strip in strips]
    assert [line.text for line in lines[::3]] == ["OLOHUONE", "Bedroom 12", "WC"]
    assert side_by_side(read_line, []) == []


def test_sizes_that_look_like_sizes_in_a_mirror_do_not_hide_it() -> None:
    # Its 2,78 x 3,64 reads as a size from letters that look like digits, and its 3 as an E.
    picture, truth = list(sheets_of(5043))[1]
    assert truth.degradation == "mirrored"
    found = find_position(picture)
    assert (found.mirrored, found.quarter_turns) == (True, 0)
