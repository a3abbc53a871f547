"""Texturing in lots, the buildings that no photo shows, and values that are kept while they fit."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from painted_wall import PaintedWall, box_part, painted_wall

from veduta.formats.gltf import read_glb
from veduta.photos.bounded import Bounded
from veduta.photos.city.model import CityBuilding, CityModel
from veduta.photos.options import TextureOptions
from veduta.photos.texture import plan as plans
from veduta.photos.texture import surroundings
from veduta.photos.texture.files import write_texture_files
from veduta.photos.texture.plan import lots_of, plan_of
from veduta.photos.texture.recipe import texture_model
from veduta.photos.texture.store import PictureStore
from veduta.photos.texture.surroundings import surroundings_of
from veduta.photos.texture.views import Blockers
from veduta.place.semantics import Provenance

OPTIONS = TextureOptions(texel_m=0.04)


def row_of_houses() -> PaintedWall:
    """The painted house, one beside it, one hidden behind both, and one behind the photos."""
    wall = painted_wall((1.0, 0.8, 1.2))
    more = {
        "beside": ((7.0, 0.0, 0.0), (9.0, 4.0, 3.0)),
        "behind": ((1.0, 6.0, 0.0), (5.0, 8.0, 1.5)),
        "back": ((0.0, -20.0, 0.0), (6.0, -15.0, 3.0)),
    }
    boxes = [
        CityBuilding(name, box_part(name, (0, 0, 0), tuple(np.subtract(high, low))), low)
        for name, (low, high) in more.items()
    ]
    noise = np.random.default_rng(1).integers(30, 200, (36, 48, 3)).astype(np.uint8)
    pixels = noise.repeat(10, axis=0).repeat(10, axis=1)
    views = [replace(view, pixels=lambda: pixels) for view in wall.views]
    city = replace(wall.city, buildings=(*wall.city.buildings, *boxes))
    return replace(wall, city=city, views=views)


def test_only_what_photos_may_show_is_planned() -> None:
    wall = row_of_houses()
    blockers = Blockers(wall.city)
    store = PictureStore(wall.views, blockers)
    plan = plan_of(wall.views, wall.city, blockers, store)
    assert {face.building for face in plan.faces} == {0, 1}
    fronts = [row for row, face in enumerate(plan.faces) if face.normal[1] < -0.9]
    shown = {plan.faces[row].building: plan.views[row].tolist() for row in fronts}
    assert shown[0] == [0, 1, 2]
    backs = [row for row, face in enumerate(plan.faces) if face.normal[1] > 0.9]
    assert all(not len(plan.views[row]) for row in backs)


def test_lots_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """A face at a time gives the textures that all at once give."""
    wall = row_of_houses()
    whole = list(texture_model(wall.views, wall.city, OPTIONS).buildings)
    monkeypatch.setattr(plans, "LOT_BYTES", 1)
    blockers = Blockers(wall.city)
    plan = plan_of(wall.views, wall.city, blockers, PictureStore(wall.views, blockers))
    assert len(lots_of(plan)) >= sum(len(views) > 0 for views in plan.views) >= 2
    single = list(texture_model(wall.views, wall.city, OPTIONS).buildings)
    assert [one.id for one in single] == [one.id for one in whole]
    assert len(whole) == 2
    for one, other in zip(single, whole, strict=True):
        for (_, first), (_, second) in zip(one.faces, other.faces, strict=True):
            assert (first is None) == (second is None)
            if first is not None and second is not None:
                np.testing.assert_array_equal(first.pixels, second.pixels)
                np.testing.assert_array_equal(first.invented, second.invented)


def test_buildings_that_no_photo_shows_share_a_file(tmp_path: Path) -> None:
    wall = row_of_houses()
    files = write_texture_files(texture_model(wall.views, wall.city, OPTIONS), tmp_path)
    assert [part.id for part in files.parts] == ["house", "beside", "surroundings-1"]
    assert files.plain == 2
    shared = read_glb(tmp_path / files.parts[2].model)
    names = {name.split(":")[0] for name in shared.features.name}
    assert names == {"behind", "back"}
    assert len(list((tmp_path / "parts").iterdir())) == 3


def test_surroundings_are_the_same_surfaces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(surroundings, "MOST_BUILDINGS", 3)
    rng = np.random.default_rng(2)
    boxes = tuple(
        CityBuilding(f"b{k}", box_part(f"b{k}", (0, 0, 0), (5.0, 4.0, 3.0 + k)), (x, y, 2.0))
        for k, (x, y) in enumerate(rng.uniform(-300, 300, (8, 2)).tolist())
    )
    city = CityModel((*boxes, replace(boxes[0], id="surroundings-1")), None, (0.0, 0.0, 0.0))
    found = surroundings_of(city, range(8))
    assert sorted(row for one in found for row in one.buildings) == list(range(8))
    assert max(len(one.buildings) for one in found) <= 3
    assert len({one.part.id for one in found} | {"surroundings-1"}) == len(found) + 1
    for one in found:
        own = [city.buildings[row] for row in one.buildings]
        world = np.concatenate([part.part.positions_m + part.offset_m for part in own])
        np.testing.assert_allclose(one.part.positions_m + one.offset_m, world, atol=1e-4)
        areas = np.concatenate([part.part.feature_area_m2 for part in own])
        np.testing.assert_allclose(one.part.feature_area_m2, areas, rtol=1e-5)
        assert len(set(one.part.features.id)) == len(one.part.features)
        provenances = {one.part.features.provenance(row) for row in range(len(areas))}
        assert provenances == {Provenance.INFERRED}


@given(st.lists(st.integers(0, 7), max_size=60), st.integers(0, 25))
def test_bounded_keeps_the_last_that_fit(keys: list[int], most: int) -> None:
    """Against the definition: the keys last used, as many as fit, and always the newest."""
    made: list[int] = []
    sizes = [1, 2, 3, 5, 8, 13, 4, 6]
    kept: Bounded[int, int] = Bounded(lambda key: made.append(key) or key, sizes.__getitem__, most)
    held: list[int] = []
    for key in keys:
        count = len(made)
        assert kept(key) == key
        assert (len(made) > count) == (key not in held)
        held = [*(one for one in held if one != key), key]
        while len(made) > count and len(held) > 1 and sum(sizes[one] for one in held) > most:
            held = held[1:]
