"""Doubtful pairs, on a made-up building with two sides that are folded onto each other."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from known_structure import structure_seen

from veduta.photos.mapping.conflicts import close_pairs
from veduta.photos.mapping.doubt import (
    Doubt,
    doubtful_pairs,
    read_doubts,
    write_doubts,
)
from veduta.photos.mapping.votes import Matched, chain, vote
from veduta.photos.structure import Structure

SIDE, WIDTH_PX, HEIGHT_PX, FOCAL_PX = 4, 800, 600, 600.0
"""Photos of a side; photos 1 to 4 show the first, 5 to 8 the second."""
LEFT, RIGHT = range(1, SIDE + 1), range(SIDE + 1, 2 * SIDE + 1)


def folded(*, equal: bool = False, seed: int = 0) -> Structure:
    """All photos before one facade, 10 m off, with a metre between them.

    The facade is seen by all; what stands beside it is seen by the photos of a side alone.
    equal: what stands beside it is the same on both sides, so that nothing is folded.
    """
    rng = np.random.default_rng(seed)
    facade = rng.uniform((-3.0, -3.0, 9.8), (3.0, 3.0, 10.2), (300, 3))
    beside = [
        np.concatenate(
            [rng.uniform((x, -4.0, 9.0), (x + 3.5, 4.0, 11.0), (150, 3)) for x in (-7.0, 3.5)]
        )
        for _ in range(2)
    ]
    points = np.concatenate([facade, *beside])
    owner = np.repeat([0, 1, 2], [len(facade), *map(len, beside)])
    camera = pycolmap.Camera(
        camera_id=1, model="SIMPLE_PINHOLE", width=WIDTH_PX, height=HEIGHT_PX,
        params=[FOCAL_PX, WIDTH_PX / 2, HEIGHT_PX / 2],
    )  # fmt: skip
    poses, keypoints, numbers, places = [], [], [], []
    for photo in range(2 * SIDE):
        side = photo // SIDE + 1
        pose = np.column_stack([np.eye(3), [1.5 - photo % SIDE - 0.1 * side, 0.0, 0.0]])
        seen = camera.img_from_cam(points + pose[:, 3])
        inside = ((seen > 0) & (seen < (WIDTH_PX, HEIGHT_PX))).all(axis=1)
        shown = np.flatnonzero(inside & ((owner == 0) | (owner == (1 if equal else side))))
        poses.append(pose)
        keypoints.append(seen[shown])
        places.append(np.arange(len(shown)))
        numbers.append(shown)
    return structure_seen([camera] * len(poses), poses, points, keypoints, numbers, places)


def matched(structure: Structure) -> Matched:
    """All matches of the photos of a structure."""
    point_of = [structure.point_of[structure.image_of == row] for row in range(2 * SIDE)]
    matches = {}
    for first, second in combinations(range(2 * SIDE), 2):
        rows = np.intersect1d(point_of[first], point_of[second], return_indices=True)[1:]
        matches[first + 1, second + 1] = np.column_stack(rows).astype(np.int64)
    return Matched(dict(zip(structure.image_ids, structure.keypoints_px, strict=True)), matches)


def across(pair: tuple[int, int]) -> bool:
    return (pair[0] in LEFT) != (pair[1] in LEFT)


def test_photos_of_two_sides_conflict() -> None:
    found = close_pairs(folded())
    assert len(found) > SIDE
    for pair in found:
        assert (pair.share > 0.3) == across((pair.first, pair.second)), pair
        assert pair.share < 0.9, "the facade agrees"
    one = next(pair for pair in found if (pair.first, pair.second) == (1, 2))
    # Two cameras a metre from each other, 10 m from what they see.
    assert one.apart_deg == pytest.approx(np.rad2deg(np.arctan(0.1)), abs=1.0)


def test_what_two_sides_share_is_no_conflict() -> None:
    assert all(pair.conflicting == 0 for pair in close_pairs(folded(equal=True)))


def test_only_pairs_of_two_sides_are_dropped() -> None:
    structure = folded()
    doubts = doubtful_pairs(close_pairs(structure), matched(structure))
    found = {(doubt.first, doubt.second) for doubt in doubts}
    assert found == {(a, b) for a in LEFT for b in RIGHT}
    assert all(doubt.verified > 0 and doubt.reason for doubt in doubts)
    assert any("each shows what the other lacks" in doubt.reason for doubt in doubts)


def test_nothing_is_dropped_of_photos_that_agree() -> None:
    structure = folded(equal=True)
    assert doubtful_pairs(close_pairs(structure), matched(structure)) == ()


def test_earlier_doubts_stay_and_are_not_counted_again() -> None:
    structure = folded()
    close, known = close_pairs(structure), matched(structure)
    first = doubtful_pairs(close, known)
    assert doubtful_pairs(close, known, first) == first


def test_votes_against_counting_by_hand() -> None:
    """A row of six things seen by three photos; a fourth match shifts it by one, as windows do."""
    places = np.column_stack([np.arange(6.0) * 50, np.zeros(6)])
    own = np.column_stack([np.arange(6), np.arange(6)])
    shifted = np.column_stack([np.arange(5), np.arange(1, 6)])
    known = Matched(dict.fromkeys((1, 2, 3), places), {(1, 2): own, (2, 3): own, (1, 3): own})
    tracks = chain(known, [(1, 2), (2, 3)])
    assert tracks.voting.sum() == 6
    right, wrong = vote(tracks, (1, 3), own), vote(tracks, (1, 3), shifted)
    assert (right.confirmed, right.contradicted) == (6, 0)
    assert (wrong.confirmed, wrong.contradicted) == (0, 5)
    nothing = vote(chain(known, []), (1, 3), own)
    assert (nothing.confirmed, nothing.contradicted) == (0, 0)


def test_a_track_that_sees_itself_twice_does_not_vote() -> None:
    places = np.array([[0.0, 0.0], [50.0, 0.0], [51.0, 0.0]])
    known = Matched(
        dict.fromkeys((1, 2, 3), places),
        {(1, 2): np.array([[0, 0], [1, 1]]), (2, 3): np.array([[0, 0], [1, 1]]),
         (1, 3): np.array([[0, 1], [1, 2]])},
    )  # fmt: skip
    # 1.0 - 2.0 - 3.0 is joined with 3.1 through 1.0 - 3.1, and 3.1 is 50 px from 3.0.
    tracks = chain(known, known.matches)
    assert not tracks.voting[tracks.track_of].any()


def test_doubts_are_kept_as_they_are(tmp_path: Path) -> None:
    doubts = (Doubt(1, 5, 30, "so"), Doubt(2, 7, 15, "and so"))
    write_doubts(tmp_path / "doubts.json", doubts)
    assert read_doubts(tmp_path / "doubts.json") == doubts
