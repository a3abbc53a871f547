"""Which photos are compared: against brute force."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest

from veduta.imaging.shot import Position
from veduta.photos.intake.read import PhotoRecord
from veduta.photos.matching.pairs import EARTH_RADIUS_M, FEW, choose_pairs
from veduta.photos.options import MatchOptions
from veduta.run.errors import InputError


def photos(count: int) -> list[PhotoRecord]:
    return [
        PhotoRecord(
            image_id=number + 1,
            name=f"{number:04d}.jpg",
            path=Path(f"{number:04d}.jpg"),
            sha256="",
            width_px=100,
            height_px=100,
            focal_px=None,
            camera=None,
            time=None,
            position=None,
            group=1,
            notes=(),
        )
        for number in range(count)
    ]


def test_few_are_all_compared() -> None:
    found = choose_pairs(photos(FEW), MatchOptions())
    assert found.kind == "all"
    assert len(set(found.pairs)) == FEW * (FEW - 1) // 2
    assert all(first < second for first, second in found.pairs)


def test_many_that_say_nothing_are_looked_at() -> None:
    found = choose_pairs(photos(FEW + 1), MatchOptions(neighbours=2))
    assert found.kind == "retrieval"
    assert "no position and not all have a time" in found.how


def test_many_with_a_time_follow_it() -> None:
    timed = [replace(photo, time=datetime(2020, 1, photo.image_id % 28 + 1)) for photo in
        photos(FEW + 1)]  # fmt: skip
    assert choose_pairs(timed, MatchOptions()).kind == "sequence"


def test_a_sequence_follows_the_names() -> None:
    found = choose_pairs(photos(FEW + 1), MatchOptions(neighbours=2, pairs="sequence"))
    assert found.kind == "sequence"
    assert "name" in found.how
    steps = {second - first for first, second in found.pairs}
    assert steps == {1, 2, 4, 8, 16, 32}
    assert all(len([p for p in found.pairs if p[1] - p[0] == s]) == FEW + 1 - s for s in steps)


def test_the_order_of_time_goes_before_that_of_names() -> None:
    start = datetime(2020, 1, 1)
    given = photos(5)
    mixed = [3, 0, 4, 1, 2]
    taken = [
        replace(photo, time=start + timedelta(seconds=when))
        for photo, when in zip(given, mixed, strict=True)
    ]
    found = choose_pairs(taken, MatchOptions(pairs="sequence", neighbours=1))
    order = np.argsort(mixed) + 1
    near = {tuple(sorted(pair)) for pair in zip(order, order[1:], strict=False)}
    assert near <= set(found.pairs)
    assert "time" in found.how


def test_the_nearest_by_gps_are_those_of_brute_force() -> None:
    rng = np.random.default_rng(3)
    metres = rng.uniform(-200, 200, (70, 2))
    given = []
    for photo, (east, north) in zip(photos(70), metres, strict=True):
        latitude = 60 + np.rad2deg(north / EARTH_RADIUS_M)
        longitude = 24 + np.rad2deg(east / EARTH_RADIUS_M / np.cos(np.deg2rad(60)))
        given.append(replace(photo, position=Position(float(latitude), float(longitude))))
    found = choose_pairs(given, MatchOptions(neighbours=4))
    assert found.kind == "gps"
    apart = np.linalg.norm(metres[:, None] - metres[None], axis=2)
    wanted = {
        (min(row, int(other)) + 1, max(row, int(other)) + 1)
        for row in range(70)
        for other in np.argsort(apart[row])[1:5]
    }
    assert set(found.pairs) == wanted


def test_photos_without_a_position_are_not_lost() -> None:
    given = [
        replace(photo, position=Position(48.0, 2.0 + 1e-5 * photo.image_id)) for photo in photos(70)
    ]
    given[33] = replace(given[33], position=None)
    found = choose_pairs(given, MatchOptions(neighbours=3))
    assert found.kind == "gps"
    assert sum(34 in pair for pair in found.pairs) >= 6


def test_gps_that_nobody_has() -> None:
    with pytest.raises(InputError, match="0 of 4 photos"):
        choose_pairs(photos(4), MatchOptions(pairs="gps"))
