"""Towns in tiles, written from the city model that lies beside the tiles."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import trimesh

from veduta.formats.place_json import write_place
from veduta.formats.tiled_town import untiled
from veduta.place import manifest
from veduta.place.manifest import Bounds, PlacePart, Start
from veduta.place.place import Place
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

ORIGIN = (500_000.0, 5_500_000.0, 10.0)
SIZE_M = np.array([4.0, 6.0, 3.0])
FACES = ([0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5])


def write_city(path: Path, told: str | None) -> None:
    """A box with its lower corner at (12, 13, 10) m from `ORIGIN`, in whole centimetres."""
    corners = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    vertices = ((np.array(corners) * SIZE_M + [12.0, 13.0, 10.0]) * 100).round().astype(int)
    faces = [[face] for face in FACES]
    kinds = [{"type": name} for name in ("GroundSurface", "RoofSurface", "WallSurface")]
    solid = {
        "type": "Solid", "lod": "3", "boundaries": [faces],
        "semantics": {"surfaces": kinds, "values": [[0, 1, 2, 2, 2, 2]]},
    }  # fmt: skip
    attributes = {"name": "A house"} | ({} if told is None else {"provenance": told})
    city = {
        "type": "CityJSON", "version": "2.0",
        "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
        "transform": {"scale": [0.01] * 3, "translate": list(ORIGIN)},
        "CityObjects": {
            "house": {"type": "Building", "attributes": attributes, "geometry": [solid]}
        },
        "vertices": vertices.tolist(),
    }  # fmt: skip
    path.write_text(json.dumps(city))


@pytest.fixture
def town(tmp_path: Path) -> Path:
    """The folder of a place whose only part is a tile that is no part of its own."""
    (tmp_path / "tile.glb").write_bytes(b"glTF, but of many")
    bounds = Bounds(min=(0.0, 0.0, 0.0), max=(1.0, 1.0, 1.0))
    row = PlacePart(
        id="t", name="9 buildings", model="tile.glb", arrangement="single", bounds=bounds
    )
    told = manifest.Place(
        crs="EPSG:25832", origin=ORIGIN, parts=[row], tileset="tileset.json", title="Town",
        start=Start(eye=(0.0, 0.0, 1.7), target=(1.0, 0.0, 1.7)),
    )  # fmt: skip
    write_place(told, tmp_path / "place.json")
    return tmp_path


@pytest.mark.parametrize("told", ["invented", None, "a rumour"])
def test_buildings_stand_where_the_city_model_has_them(town: Path, told: str | None) -> None:
    write_city(town / "city.city.json", told)
    place = untiled(Place.load(town))
    assert (place.title, place.crs, place.origin_m, place.tileset) == (
        "Town", "EPSG:25832", ORIGIN, None
    )  # fmt: skip
    assert list(place.parts) == ["house"]
    points = place.parts["house"].triangles()[0]
    assert points.min(axis=0) == pytest.approx([12.0, 13.0, 10.0])
    assert np.ptp(points, axis=0) == pytest.approx(SIZE_M)
    features = place.parts["house"].content.features
    wanted = Provenance.INVENTED if told == "invented" else Provenance.MEASURED
    assert {features.provenance(row) for row in range(len(features))} == {wanted}
    assert {features.semantic(row) for row in range(len(features))} == {
        SemanticClass.GROUND, SemanticClass.ROOF, SemanticClass.WALL
    }  # fmt: skip


def test_any_format_is_written_of_it(town: Path) -> None:
    write_city(town / "city.city.json", "invented")
    Place.load(town).write(town / "town.stl")
    mesh = trimesh.load_mesh(town / "town.stl")
    assert mesh.volume == pytest.approx(SIZE_M.prod(), rel=1e-5)


def test_without_a_city_model_the_remedy_is_told(town: Path) -> None:
    with pytest.raises(InputError, match=r"without a city model.* --separate"):
        Place.load(town).write(town / "town.obj")


def test_surfaces_keep_their_colours_classes_and_rules(town: Path) -> None:
    """A derived town in tiles, as its city model has it: one material for each semantic surface."""
    write_city(town / "city.city.json", "invented")
    city = json.loads((town / "city.city.json").read_text())
    house = city["CityObjects"]["house"]
    told = [
        {"type": "GroundSurface"},
        {"type": "RoofSurface", "class": "roof", "rule": "Tiles", "colour": "#800000"},
        {"type": "WallSurface", "class": "shop", "rule": "Shop", "colour": "#00ff33"},
        {"type": "WallSurface", "class": "shop", "rule": "Shop", "colour": "#00ff33"},
    ]
    house["geometry"][0]["semantics"]["values"] = [[0, 1, 2, 2, 3, 3]]
    house["geometry"][0]["semantics"]["surfaces"] = told
    about = {"class": "cornice", "rule": "Ledge", "colour": "#0000ff"}
    ledge = {"type": "MultiSurface", "lod": "3", "boundaries": [[[0, 1, 5]]]}
    city["CityObjects"]["house/0"] = {
        "type": "BuildingInstallation", "parents": ["house"], "attributes": about,
        "geometry": [ledge],
    }  # fmt: skip
    (town / "city.city.json").write_text(json.dumps(city))
    part = untiled(Place.load(town)).parts["house"].content
    seen = {}
    for row in range(len(part.polygon_feature)):
        feature = int(part.polygon_feature[row])
        material = part.materials[int(part.polygon_material[row])]
        colour = tuple(round(255 * share) for share in material.colour)
        seen[part.features.name[feature]] = (part.features.semantic(feature).value, colour)
    assert seen == {
        "ground": ("ground", (255, 255, 255)),
        "Tiles": ("roof", (128, 0, 0)),
        "Shop": ("shop", (0, 255, 51)),
        "Shop 2": ("shop", (0, 255, 51)),
        "Ledge": ("cornice", (0, 0, 255)),
    }
