"""The manifest of photos: its parts have names of their own."""

from __future__ import annotations

from known_structure import known_structure

from veduta.photos.placing import place_of
from veduta.photos.texture.step import Textured
from veduta.place.manifest import Bounds, PlacePart


def part(name: str, model: str) -> PlacePart:
    bounds = Bounds(min=(0.0, 0.0, 0.0), max=(1.0, 1.0, 1.0))
    return PlacePart(id=name, name=name, model=model, arrangement="single", bounds=bounds)


def test_a_building_may_be_called_walls() -> None:
    textured = Textured(parts=(part("walls", "parts/walls.glb"), part("b", "parts/b.glb")))
    place = place_of(known_structure(), (), part("walls", "walls/walls.glb"), None, textured)
    assert [one.id for one in place.parts] == ["walls", "b", "walls-found"]
