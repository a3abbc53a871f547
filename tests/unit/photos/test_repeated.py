"""Photos that stand in one place but show different ones, and what they share by mistake."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np
import pycolmap
import pytest
from known_structure import structure_seen

from veduta.photos.mapping.conflicts import ClosePair
from veduta.photos.mapping.doubt import doubtful_pairs
from veduta.photos.mapping.repeated import there_once
from veduta.photos.mapping.same_place import AHEAD, different_places
from veduta.photos.mapping.votes import Matched
from veduta.photos.structure import Structure

WIDTH_PX, HEIGHT_PX = 800, 600
FACADE, AROUND = 200, 160


def photos(
    sides: tuple[int, ...], step_px: float = 0.0, yaw_deg: float = 0.0
) -> tuple[Structure, Matched]:
    """Photos of a facade that all sides of a building have, and of what is beside each side.

    sides: which side each photo shows. step_px: what the content moves from photo to photo.
    yaw_deg: what the camera turns from photo to photo; the features move with it.
    """
    rng = np.random.default_rng(7)
    facade = rng.uniform((300.0, 50.0), (560.0, 500.0), (FACADE, 2))
    beside = {
        side: np.concatenate(
            [rng.uniform((x, 50.0), (x + 190.0, 450.0), (AROUND // 2, 2)) for x in (60.0, 590.0)]
        )
        for side in sorted(set(sides))
    }
    camera = pycolmap.Camera(
        camera_id=1, model="SIMPLE_PINHOLE", width=WIDTH_PX, height=HEIGHT_PX,
        params=[600.0, WIDTH_PX / 2, HEIGHT_PX / 2],
    )  # fmt: skip
    keypoints, poses = [], []
    for photo, side in enumerate(sides):
        turn = np.deg2rad(yaw_deg * photo)
        rotation = np.array(
            [[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]]
        )
        seen = np.concatenate([facade, beside[side]]) + np.array([step_px * photo, 0.0])
        rays = np.column_stack([np.asarray(camera.cam_from_img(seen)), np.ones(len(seen))])
        keypoints.append(np.asarray(camera.img_from_cam(rays @ rotation.T)))
        poses.append(np.column_stack([rotation, np.zeros(3)]))
    ids = tuple(range(1, len(sides) + 1))
    rows = np.arange(FACADE + AROUND)
    matches = {
        (first, second): np.column_stack(
            [rows, rows]
            if sides[first - 1] == sides[second - 1]
            else [rows[:FACADE], rows[:FACADE]]
        )
        for first, second in combinations(ids, 2)
    }
    nothing = [np.empty(0, dtype=np.int64)] * len(sides)
    structure = structure_seen([camera] * len(sides), poses, np.empty((0, 3)), keypoints, nothing)
    return structure, Matched(dict(zip(ids, keypoints, strict=True)), matches)


def close(*pairs: tuple[int, int], apart_deg: float = 1.0) -> list[ClosePair]:
    """Pairs in which the points of a model contradict nothing."""
    return [ClosePair(first, second, apart_deg, 20, 0) for first, second in pairs]


@pytest.mark.parametrize("yaw_deg", [0.0, 2.0])
def test_what_is_around_tells_two_sides_apart(yaw_deg: float) -> None:
    structure, matched = photos((0, 0, 1, 1), yaw_deg=yaw_deg)
    pairs = close(*combinations((1, 2, 3, 4), 2))
    found = different_places(structure, pairs, matched)
    assert found == {(1, 3), (1, 4), (2, 3), (2, 4)}


def test_photos_that_do_not_stand_in_one_place_are_not_compared() -> None:
    structure, matched = photos((0, 0, 1, 1))
    assert different_places(structure, close((1, 3), apart_deg=10.0), matched) == frozenset()
    structure, matched = photos((0, 0, 1, 1), step_px=40.0)  # whatever the model says
    assert different_places(structure, close((1, 3)), matched) == frozenset()


@pytest.mark.parametrize(
    "steps_m", [(0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.2, 0.2), (0.0, 0.2, 0.4, 0.4)]
)
def test_photos_ahead_of_each_other_are_not_compared(steps_m: tuple[float, ...]) -> None:
    """Against each pair by itself; observations lie in no order, and photos see different much."""
    structure, matched = photos((0, 0, 1, 1))
    rng = np.random.default_rng(5)
    points = np.column_stack([rng.uniform(-2, 2, (90, 2)), rng.uniform(3.0, 9.0, 90)])
    seen = [rng.choice(90, 20 + 15 * photo, replace=False) for photo in range(4)]
    order = rng.permutation(sum(map(len, seen)))
    poses = structure.cam_from_world.copy()
    poses[:, 2, 3] = -np.array(steps_m)
    moved = replace(
        structure,
        cam_from_world=poses,
        points=points,
        image_of=np.repeat(np.arange(4), [len(own) for own in seen])[order],
        point_of=np.concatenate(seen)[order],
    )

    def is_ahead(first: int, second: int) -> bool:
        place = np.array([0.0, 0.0, steps_m[first - 1]])
        both = sorted(set(seen[first - 1].tolist()) & set(seen[second - 1].tolist()))
        off = np.median([np.linalg.norm(points[point] - place) for point in both])
        return abs(steps_m[second - 1] - steps_m[first - 1]) > AHEAD * off

    pairs = close(*combinations((1, 2, 3, 4), 2))
    apart = ((1, 3), (1, 4), (2, 3), (2, 4))
    assert different_places(moved, pairs, matched) == {
        pair for pair in apart if not is_ahead(*pair)
    }
    # Around a building photos go to the side: there all that differ are told.
    turned = poses.copy()
    turned[:, :, :3] = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
    turned[:, :, 3] = 0.0
    turned[:, 0, 3] = np.array(steps_m)
    around = replace(moved, cam_from_world=turned)
    assert different_places(around, pairs, matched) == different_places(
        replace(structure, cam_from_world=turned), pairs, matched
    )


def test_what_matches_between_different_places_is_there_twice() -> None:
    _, matched = photos((0, 0, 1, 1))
    once = there_once(matched, {(1, 3)})
    assert once[1, 2].count == AROUND
    assert once[1, 2].share == pytest.approx(AROUND / (AROUND + FACADE))
    assert once[1, 2].shows_one_place
    assert once[2, 4].count == 0  # by way of 1 and 3
    assert once[2, 4].is_ambiguous


def test_pairs_of_different_places_are_dropped() -> None:
    """Two of them were not compared: they have nothing that is there once."""
    structure, matched = photos((0, 0, 1, 1))
    pairs = close((1, 2), (1, 3), (2, 4), (3, 4))
    apart = different_places(structure, pairs, matched)
    assert apart == {(1, 3), (2, 4)}
    doubts = doubtful_pairs(pairs, matched, apart=apart)
    assert [(doubt.first, doubt.second) for doubt in doubts] == [(1, 3), (1, 4), (2, 3), (2, 4)]
    assert doubtful_pairs(pairs, matched) == ()


def test_what_still_holds_different_places_together_is_dropped() -> None:
    """Without two of the four false pairs the map is folded as before."""
    structure, matched = photos((0, 0, 1, 1))
    pairs = close((1, 2), (1, 3), (2, 4), (3, 4))
    apart = different_places(structure, pairs, matched)
    found = doubtful_pairs(pairs, matched, apart=apart)
    earlier = tuple(doubt for doubt in found if (doubt.first, doubt.second) in {(1, 3), (2, 4)})
    assert doubtful_pairs(pairs, matched, earlier, apart) == found
    assert doubtful_pairs(pairs, matched, earlier) == earlier


def test_another_building_is_torn_as_before() -> None:
    """Nothing of it repeats in what was compared: that says nothing of it."""
    structure, matched = photos((0, 0, 1, 1))
    rows = np.arange(200)
    px = np.random.default_rng(1).uniform((0.0, 0.0), (WIDTH_PX, HEIGHT_PX), (200, 2))
    both = Matched(
        {**matched.keypoints_px, 5: px, 6: px},
        {**matched.matches, (5, 6): np.column_stack([rows, rows])},
    )
    pairs = close((1, 2), (1, 3), (2, 4), (3, 4))
    apart = different_places(structure, pairs, both)
    doubts = doubtful_pairs([*pairs, ClosePair(5, 6, 1.0, 20, 10)], both, apart=apart)
    assert (5, 6) in {(doubt.first, doubt.second) for doubt in doubts}


def test_false_matches_do_not_make_all_repeat() -> None:
    """Three in a hundred of long tracks: over many links they join everything."""
    rng = np.random.default_rng(3)
    sides = (0,) * 12
    _, matched = photos(sides)
    stirred = {}
    for pair, matches in matched.matches.items():
        false = rng.random(len(matches)) < 0.03
        other = matches.copy()
        other[false, 1] = rng.integers(0, FACADE + AROUND, int(false.sum()))
        stirred[pair] = other
    stirred[1, 12] = np.column_stack([np.arange(30), np.arange(30)])
    once = there_once(Matched(matched.keypoints_px, stirred), {(1, 12)})
    assert min(found.share for pair, found in once.items() if pair != (1, 12)) > 0.8
