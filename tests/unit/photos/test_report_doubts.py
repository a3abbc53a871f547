"""What the report calls components, and which pairs it lists."""

from __future__ import annotations

import io
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from veduta.photos.cameras.component import component_name
from veduta.photos.mapping.doubt import Doubt
from veduta.photos.matching.match import PairRecord
from veduta.photos.report_doubts import components_note, doubts_table
from veduta.photos.report_pictures import CAMERA, match_picture


@pytest.mark.parametrize(
    ("number", "name"), [(0, "A"), (1, "B"), (25, "Z"), (26, "AA"), (51, "AZ"), (52, "BA")]
)
def test_components_are_named_as_columns_of_a_sheet(number: int, name: str) -> None:
    assert component_name(number) == name


def test_the_note_names_each_component() -> None:
    note = components_note([9, 4])
    assert "A (sparse/0, 9 photos), B (sparse/1, 4 photos)" in note
    assert "is not known" in note
    assert "is not known" in components_note([9, 4], [True, False])
    assert "not known" not in components_note([9, 4], [True, True])
    assert "known of A, C alone" in components_note([9, 4, 3], [True, False, True])


def test_pairs_with_most_features_come_first() -> None:
    doubts = [Doubt(1, 2, 20, "few"), Doubt(1, 3, 90, "many")]
    (table,) = doubts_table(doubts, {1: "a", 2: "b", 3: "c"})
    assert [list(row) for row in table.rows] == [["a", "c", 90, "many"], ["a", "b", 20, "few"]]
    assert doubts_table([], {}) == []


def test_doubtful_pairs_are_red_in_the_matrix() -> None:
    pairs = [PairRecord(1, 2, 100, 90, planar=False), PairRecord(1, 3, 100, 90, planar=False)]
    picture = match_picture([1, 2, 3], pairs, [(1, 3)])
    pixels = np.asarray(Image.open(io.BytesIO(picture.data)))
    cell = len(pixels) // 3
    first = pixels[cell // 2, [cell + cell // 2, 2 * cell + cell // 2]]
    assert first[1].tolist() == list(CAMERA)
    assert first[0].max() < 60
    assert "1 doubtful" in picture.note


def test_a_png_is_written_whatever_is_imported_first() -> None:
    """pycolmap before Pillow, and the heap is corrupt."""
    program = (
        "import veduta.photos.matching.match, io, numpy, PIL.Image as Image;"
        "noise = numpy.random.default_rng(0).integers(0, 255, (896, 896, 3), dtype=numpy.uint8);"
        "Image.fromarray(noise).save(io.BytesIO(), format='PNG', optimize=True)"
    )
    subprocess.run([sys.executable, "-c", program], check=True, capture_output=True)
