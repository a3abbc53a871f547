"""Animals filmed by code: what is known of them agrees with the pictures."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from veduta.synthetic.animals import Filmed, film_limbless, film_lizard, film_quadruped


@pytest.fixture(scope="module", params=["quadruped", "lizard"])
def walker(request: pytest.FixtureRequest) -> Filmed:
    make = film_quadruped if request.param == "quadruped" else film_lizard
    return make(5, frames=24)


def test_joints_lie_in_the_silhouette(walker: Filmed) -> None:
    for name, places in walker.joints.items():
        rows = np.clip(np.floor(places[:, 1]).astype(int), 0, 359)
        columns = np.clip(np.floor(places[:, 0]).astype(int), 0, 639)
        inside = walker.masks[np.arange(len(rows)), rows, columns]
        assert inside.mean() > 0.9, name


def test_a_standing_foot_stays_where_it_is(walker: Filmed) -> None:
    for name, stands in walker.down.items():
        part, side = name.split("_leg_")
        toe = walker.joints[f"{part}_toe_{side}"]
        both = stands[1:] & stands[:-1]
        moved = np.linalg.norm(np.diff(toe, axis=0), axis=1)
        # A new stand begins where both frames stand, but not the same one.
        assert np.median(moved[both]) < 0.01 * walker.length_px


def test_the_same_seed_films_the_same_animal() -> None:
    first, again = (film_limbless("fish", 3, frames=6) for _ in range(2))
    np.testing.assert_array_equal(first.frames, again.frames)
    other = film_limbless("fish", 4, frames=6)
    assert (first.frames != other.frames).any()


def test_a_snake_covers_what_its_axis_and_width_say() -> None:
    film = film_limbless("snake", 1, frames=4)
    area = film.masks.sum(axis=(1, 2))
    wide = 2.0 * film.halves["middle"] * film.lengths["body"]
    assert (area > 0.6 * wide).all()
    assert (area < 1.1 * wide).all()


@pytest.mark.parametrize("kind", ["snake", "fish"])
def test_a_body_is_as_wide_as_it_is_told_and_its_shadow_is_beside_it(kind: str) -> None:
    plain = film_limbless(kind, 1, frames=3)  # type: ignore[arg-type]
    film = film_limbless(kind, 1, frames=3, shadow=True)  # type: ignore[arg-type]
    np.testing.assert_array_equal(film.masks, plain.masks)
    axis = film.joints["axis"].reshape(3, -1, 2)
    middle = axis[:, axis.shape[1] // 2]
    deep = [cv2.distanceTransform(mask.astype(np.uint8), cv2.DIST_L2, 5) for mask in film.masks]
    for (x, y), away in zip(middle, deep, strict=True):
        around = away[int(y) - 2 : int(y) + 3, int(x) - 2 : int(x) + 3]
        assert abs(around.max() - film.halves["middle"]) < 0.8
    light = film.frames.astype(int).sum(axis=3) - plain.frames.astype(int).sum(axis=3)
    shaded = (light < -60) & ~film.masks
    assert (shaded.sum(axis=(1, 2)) > 0.2 * film.masks.sum(axis=(1, 2))).all()
    assert (light[:, :60] == 0).all()
