"""Rooms that are found on real plans."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.imaging.read import read_image
from veduta.plan.reading import read_storey

pytestmark = pytest.mark.regression


def test_a_hand_drawn_flat_is_closed_towards_its_balcony(veduta_data: Path) -> None:
    """Five rooms are drawn; the hall is one with the living room, as the front door is not seen."""
    path = veduta_data / "plans" / "cubicasa" / "7912.png.jpg"
    if not path.is_file():
        pytest.skip(f"no {path.name} in {veduta_data}")
    drawn = read_storey(read_image(path).pixels)
    assert 4 <= len(drawn.rooms) <= 5
    outer = {wall.id for wall in drawn.walls if wall.outer}
    assert sum(one.kind == "window" for one in drawn.openings if one.wall in outer) >= 4
    assert any(one.kind == "door" for one in drawn.openings if one.wall in outer)
