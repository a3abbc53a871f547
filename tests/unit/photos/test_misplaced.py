"""A photo whose place is one that only a small part of it agrees with is taken out."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from simulated_street import simulated_street

from veduta.photos.cameras.misplaced import (
    MISPLACED,
    empty_shares,
    expected,
    without_misplaced,
)
from veduta.photos.mapping.conflicts import GRID, cells_of
from veduta.photos.structure import Structure

MOVED, TO = 6, 18


def misplaced(street: Structure) -> Structure:
    """The photo MOVED lies beside TO, and shows but a strip of what is seen from there."""
    poses = street.cam_from_world.copy()
    poses[MOVED] = poses[TO]
    moved = replace(street, cam_from_world=poses).observed(street.image_of != MOVED)
    seen = expected(moved, moved.centres(), MOVED)
    cells = [cells_of(moved, np.array([point]), MOVED)[0] for point in seen]
    inside = {int(cell[0]) % GRID for cell in cells if len(cell)}
    strip = [
        int(point)
        for point, cell in zip(seen, cells, strict=True)
        if len(cell) and cell[0] % GRID == min(inside)
    ]
    return replace(
        moved,
        image_of=np.concatenate([moved.image_of, np.full(len(strip), MOVED)]),
        point_of=np.concatenate([moved.point_of, strip]),
        keypoint_of=np.concatenate([moved.keypoint_of, np.arange(len(strip))]),
    )


def test_honest_photos_stay() -> None:
    for seed in (1, 2):
        _, _, street = simulated_street(seed)
        assert empty_shares(street).max() < MISPLACED
        assert without_misplaced(street)[0] is street


def test_a_photo_that_agrees_in_a_strip_alone_goes() -> None:
    _, _, street = simulated_street(1)
    torn = misplaced(street)
    shares = empty_shares(torn)
    assert shares[MOVED] >= MISPLACED
    assert np.delete(shares, MOVED).max() < MISPLACED
    kept, unsure = without_misplaced(torn)
    assert unsure == ()
    assert kept.names == tuple(np.delete(np.array(torn.names), MOVED))


def test_where_fewer_than_two_would_be_left_the_misplaced_are_named() -> None:
    _, _, street = simulated_street(1)
    doubtful = np.ones(len(street.names), dtype=bool)
    doubtful[TO] = False
    found, kept = street.without_doubtful(doubtful)
    assert found is street
    assert kept == tuple(np.delete(np.array(street.names), TO))
    doubtful[MOVED] = False
    found, kept = street.without_doubtful(doubtful)
    assert (found.names, kept) == ((street.names[MOVED], street.names[TO]), ())


def test_two_photos_are_left_as_they_are() -> None:
    _, _, street = simulated_street(1)
    away = np.ones(len(street.names), dtype=bool)
    away[[MOVED, TO]] = False
    two = misplaced(street).without_photos(away)
    assert without_misplaced(two)[0] is two


def test_what_is_expected_is_what_others_see_alike() -> None:
    _, _, street = simulated_street(1)
    centres = street.centres()
    found = set(expected(street, centres, TO).tolist())
    for point in range(0, len(street.points), 97):
        others = street.image_of[(street.point_of == point) & (street.image_of != TO)]
        own = street.points[point] - centres[TO]
        alike = False
        for other in others:
            theirs = street.points[point] - centres[other]
            lengths = np.linalg.norm(own), np.linalg.norm(theirs)
            angle = np.rad2deg(np.arccos(own @ theirs / (lengths[0] * lengths[1])))
            alike |= bool(angle <= 20.0 and max(lengths) <= 1.6 * min(lengths))
        assert (point in found) == alike
