"""Images near a segment: all of a few, and of many each n-th, the same ones for all segments."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.drive.build.near_images import NearImages
from veduta.drive.document.model import DriveSegment
from veduta.drive.record import Shot


class _Rows(NearImages):
    def _one(self, row: int) -> Any:
        return row


def _images(spacing_m: float) -> _Rows:
    shots = []
    for number in range(int(300.0 / spacing_m)):
        pose = np.column_stack([np.eye(3), [0.0, spacing_m * number, 2.0]])
        name = f"{number}.png"
        shots.append(Shot(name, Path(name), float(number), 8, 6, (5.0, 5.0), (4.0, 3.0), pose))
    return _Rows(shots, [])


def _segment(start_m: float) -> DriveSegment:
    line = [(0.0, start_m + y, 2.0) for y in np.arange(0.0, 31.0).tolist()]
    return DriveSegment(id="left-001", side="left", line=line, reason="all")


def test_few_images_are_all_taken() -> None:
    # 100 m to 130 m, and 45 m to both sides.
    assert _images(5.0).near(_segment(100.0)) == list(range(12, 35))


@pytest.mark.parametrize("spacing_m", [1.0, 0.25])
def test_of_many_each_nth_is_taken(spacing_m: float) -> None:
    images = _images(spacing_m)
    one, other = images.near(_segment(100.0)), images.near(_segment(131.0))
    assert 20 < len(one) <= 40
    assert len(set(np.diff(one))) == 1
    shared = set(one) & set(other)
    assert shared == {row for row in one if row * spacing_m > 86.0}
