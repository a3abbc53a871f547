"""Parts whose models are written one by one, and places that only say where they lie."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from veduta.formats.gltf import glb_bytes
from veduta.place.builder import PartBuilder
from veduta.place.camera_path import CameraPath
from veduta.place.manifest import Bounds, PlacePart
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.place import UNMOVED, Cloud, ModelFile, Place, Standing
from veduta.place.semantics import Provenance, SemanticClass
from veduta.place.sunlight import Sunlight
from veduta.run.errors import InputError


def slab(name: str = "slab") -> Part:
    builder = PartBuilder(name)
    feature = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "slab")
    corners = np.array([[0, 0, 0], [2, 0, 0], [2, 0, 3], [0, 0, 3]], dtype=np.float64)
    builder.polygon([corners], feature, builder.material(Material("plain")))
    return builder.build()


def moved(x: float) -> np.ndarray:
    transform = np.eye(4)
    transform[0, 3] = x
    return transform


def test_parts_written_one_by_one_make_the_place_of_parts_written_together(tmp_path: Path) -> None:
    together, laid = Place(title="Two"), Place(title="Two")
    for number, name in enumerate(("a", "b")):
        standing = Standing(name.upper(), moved(3.0 * number), document=f"{name}.json")
        placed = together.add(slab(name), standing, ModelFile(f"models/{name}.glb"))
        laid.lay(placed.save(tmp_path / "laid"), tmp_path / "laid")
    together.save(tmp_path / "together")
    laid.save(tmp_path / "laid")
    for name in ("place.json", "models/a.glb", "models/b.glb"):
        assert (tmp_path / "laid" / name).read_bytes() == (
            tmp_path / "together" / name
        ).read_bytes()
    assert laid.parts["b"].content.positions_m[:, 0].max() == 2.0
    assert Place.load(tmp_path / "laid").parts["b"].triangles()[0][:, 0].max() == 5.0


def test_a_laid_model_need_not_be_there_yet(tmp_path: Path) -> None:
    bounds = Bounds(min=(0.0, 0.0, 0.0), max=(1.0, 1.0, 1.0))
    row = PlacePart(id="a", name="a", model="town/a.glb", arrangement="single", bounds=bounds)
    place = Place(tileset="tileset.json")
    place.lay(row, tmp_path)
    place.save(tmp_path / "out")
    told = json.loads((tmp_path / "out" / "place.json").read_text())
    assert [part["model"] for part in told["parts"]] == ["town/a.glb"]
    assert told["tileset"] == "tileset.json"
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"place.json"}
    with pytest.raises(InputError, match="two parts"):
        place.lay(row, tmp_path)


def test_a_model_shows_its_tours_and_its_sun(tmp_path: Path) -> None:
    ways = np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    path = CameraPath("tour", np.array([0.0, 1.0]), np.zeros((2, 3)), ways, 1.0)
    sun = Sunlight((0.0, 0.0, 1.0), (1.0, 1.0, 1.0), 1.0)
    place = Place()
    place.add(slab(), file=ModelFile("house.glb", (path,), sun))
    place.save(tmp_path)
    content = (tmp_path / "house.glb").read_bytes()
    (size,) = struct.unpack_from("<I", content, 12)
    root = json.loads(content[20 : 20 + size])
    assert len(root["cameras"]) == 1
    assert root["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] == "directional"
    assert content == glb_bytes(slab(), [path], sun)


def test_what_was_made_in_the_frame_of_the_place_says_no_transform(tmp_path: Path) -> None:
    place = Place()
    place.add(slab(), Standing(transform=UNMOVED), part_id="other")
    place.save(tmp_path)
    told = json.loads((tmp_path / "place.json").read_text())["parts"][0]
    assert told["id"] == "other"
    assert np.array_equal(np.reshape(told["transform"], (4, 4)), np.eye(4))
    assert np.array_equal(Place.load(tmp_path).parts["other"].standing.transform, np.eye(4))
    with pytest.raises(ValueError, match="read-only"):
        UNMOVED[0, 0] = 2.0


def test_a_cloud_is_looked_at_where_that_is_said(tmp_path: Path) -> None:
    points = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    seen = ((-1.0, -1.0, -1.0), (4.0, 4.0, 4.0))
    place = Place(clouds=[Cloud("points", points, np.zeros((2, 3), np.uint8), seen_m=seen)])
    place.save(tmp_path)
    told = json.loads((tmp_path / "place.json").read_text())["points"][0]
    assert told["bounds"] == {"min": list(seen[0]), "max": list(seen[1])}
    assert told["file"] == "points.ply"


def test_models_of_one_name_or_none_are_refused(tmp_path: Path) -> None:
    place = Place()
    first = place.add(slab("a"), file=ModelFile("x.glb"))
    place.add(slab("b"), file=ModelFile("X.glb"))
    with pytest.raises(InputError, match=r"b: has its model in X\.glb"):
        place.save(tmp_path / "out")
    assert not (tmp_path / "out").exists()
    outside = Place().add(slab("a"), file=ModelFile("../x.glb"))
    with pytest.raises(InputError, match="not a path below"):
        outside.save(tmp_path / "out")
    first.file = None
    with pytest.raises(InputError, match="no name"):
        first.save(tmp_path / "out")
