"""The place of photos: its parts have names of their own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from known_structure import known_structure

from veduta.formats.place_json import read_place
from veduta.photos.placing import place_of
from veduta.photos.texture.step import Textured
from veduta.place.builder import PartBuilder
from veduta.place.manifest import Bounds, PlacePart
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass


def building(name: str, model: str) -> PlacePart:
    bounds = Bounds(min=(0.0, 0.0, 0.0), max=(1.0, 1.0, 1.0))
    return PlacePart(id=name, name=name, model=model, arrangement="single", bounds=bounds)


def walls() -> Part:
    builder = PartBuilder("walls")
    feature = builder.feature(SemanticClass.WALL, Provenance.INFERRED, "wall")
    corners = np.array([[0, 0, 0], [2, 0, 0], [2, 0, 3], [0, 0, 3]], dtype=np.float64)
    builder.polygon([corners], feature, builder.material(Material("plain")))
    return builder.build()


def test_a_building_may_be_called_walls(tmp_path: Path) -> None:
    made = (building("walls", "parts/walls.glb"), building("b", "parts/b.glb"))
    structure = known_structure()
    place = place_of(structure, (), walls(), None, Textured(parts=made, folder=tmp_path))
    place.save(tmp_path)
    told = read_place(tmp_path / "place.json")
    assert [(one.id, one.model) for one in told.parts] == [
        ("walls", "parts/walls.glb"), ("b", "parts/b.glb"), ("walls-found", "walls/walls.glb")
    ]  # fmt: skip
    assert (tmp_path / "walls" / "walls.glb").is_file()
    assert (told.scale, told.points[0].file) == ("unknown", "points.ply")
    assert told.points[0].bounds.max == tuple(structure.seen_box()[1].tolist())
