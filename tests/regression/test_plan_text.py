"""What is read on real plans: their printed sizes, their words, and the scale that follows."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from veduta.imaging.read import read_image
from veduta.plan.names.vocabulary import meanings
from veduta.plan.reading import read_storey
from veduta.plan.scale.estimate import DrawnSizes, find_voters
from veduta.plan.scale.quantities import read_quantities
from veduta.plan.scale.vote import take_vote
from veduta.plan.text.sheet_text import SheetText, read_sheet

pytestmark = pytest.mark.regression

METRES = {
    "45719584": [(2.55, 2.50), (4.76, 3.79), (2.55, 2.23), (3.72, 3.00), (3.97, 3.61)],
    "47541863": [
        (4.81, 3.06), (3.82, 2.45), (4.94, 4.53), (4.35, 2.45), (3.67, 3.39), (3.06, 2.62),
    ],
}  # fmt: skip
"""Sizes as one reads them on the plans."""


@cache
def _sheet(path: Path) -> SheetText:
    return read_sheet(read_image(path).pixels)


def _path(data: Path, name: str) -> Path:
    path = data / "plans" / name
    if not path.is_file():
        pytest.skip(f"no {name} in {data}")
    return path


@pytest.mark.parametrize("name", sorted(METRES))
def test_all_printed_sizes_are_read(veduta_data: Path, name: str) -> None:
    sheet = _sheet(_path(veduta_data, f"uk-dimensions/{name}.jpg"))
    assert sheet.position.is_upright
    read = [one.values for text in sheet.texts for one in read_quantities(text.text)]
    for sides in METRES[name]:
        assert any(np.allclose(values, sides) for values in read if len(values) == 2), sides
    words = [text for text in sheet.texts if re.search("[A-Za-z]{4}", text.text)]
    assert sum(text.score > 0.9 for text in words) >= 4


@pytest.mark.parametrize("name", sorted(METRES))
def test_each_size_agrees_with_the_scale_of_the_others(veduta_data: Path, name: str) -> None:
    """Within 3 % of all rooms but one, within 1 % for half of them.

    Which side of which room disagrees, and why, is not known.
    """
    sheet = _sheet(_path(veduta_data, f"uk-dimensions/{name}.jpg"))
    drawn = read_storey(sheet.pixels, sheet.texts)
    sizes = DrawnSizes(
        rooms=[room.outline_px for room in drawn.rooms],
        doors=[],
        walls=[wall.thickness_px for wall in drawn.walls],
        ink=drawn.cleaned.ink,
        texts=drawn.texts,
    )
    voters = [one for one in find_voters(sizes) if one.kind == "dimension"]
    places = sorted({voter.place for voter in voters})
    assert len(places) == len(METRES[name])
    errors = []
    for place in places:
        others = take_vote([voter for voter in voters if voter.place != place])
        scale = math.log(others.metres_per_px)
        own = [one.log_mpp - scale for v in voters if v.place == place for one in v.hypotheses]
        errors.append(min(abs(error) for error in own))
    assert sorted(errors)[-2] < 0.03
    assert np.median(errors) < 0.01


def test_a_scan_in_a_mirror_that_lies_on_its_side(veduta_data: Path) -> None:
    sheet = _sheet(_path(veduta_data, "cubicasa/7108.png.jpg"))
    assert (sheet.position.mirrored, sheet.position.quarter_turns) == (True, 3)
    uses = [meanings(text.text)[0].use for text in sheet.texts if meanings(text.text)]
    assert uses.count("bedroom") == 4
    assert {"living", "kitchen", "bathroom", "wardrobe", "hall", "balcony"} <= set(uses)
