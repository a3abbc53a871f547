"""City models with colours and pictures: as places, as written by Veduta and by others."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from place_sample import sample_place

import veduta
from veduta.formats.city_place import MOST_PICTURE_PIXELS, read_city_place
from veduta.place.part import Part
from veduta.place.semantics import SemanticClass

CORNERS = [[0, 0, 0], [4, 0, 0], [4, 0, 2], [0, 0, 2], [1, 0, 1], [2, 0, 1], [2, 0, 1.5]]
UV = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.25, 0.5], [0.5, 0.5], [0.5, 0.75]]
WALL = [[0, 1, 2, 3], [4, 6, 5]]


def city(**change: Any) -> dict[str, Any]:
    """A wall of 4 x 2 m with a triangular hole, of which each corner lies at its own place."""
    mapped = [[0, *ring] for ring in WALL]
    geometry = {
        "type": "MultiSurface", "lod": "2", "boundaries": [WALL],
        "semantics": {"surfaces": [{"type": "WallSurface"}], "values": [0]},
        "material": {"photos": {"value": 0}},
        "texture": {"other": {"values": [[[None], [None]]]}, "photos": {"values": [mapped]}},
    }  # fmt: skip
    return {
        "type": "CityJSON", "version": "2.0",
        "transform": {"scale": [1.0] * 3, "translate": [0.0] * 3},
        "CityObjects": {"house": {"type": "Building", "geometry": [geometry | change]}},
        "vertices": CORNERS,
        "appearance": {
            "default-theme-texture": "photos",
            "materials": [{"name": "red", "diffuseColor": [1.0, 0.5, 0.0], "transparency": 0.25}],
            "textures": [{"type": "PNG", "image": "pictures/wall.png"}],
            "vertices-texture": UV,
        },
    }  # fmt: skip


def read(folder: Path, told: dict[str, Any]) -> tuple[Part, list[str]]:
    (folder / "house.city.json").write_text(json.dumps(told))
    place = read_city_place(folder / "house.city.json")
    part = place.parts["house"].content
    assert isinstance(part, Part)
    return part, place.notes


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A picture whose left half is red, whose upper right is green and lower right blue."""
    pixels = np.zeros((4, 8, 3), dtype=np.uint8)
    pixels[:, :4, 0] = pixels[:2, 4:, 1] = pixels[2:, 4:, 2] = 255
    (tmp_path / "pictures").mkdir()
    Image.fromarray(pixels).save(tmp_path / "pictures" / "wall.png")
    return tmp_path


def test_a_picture_lies_on_its_wall(folder: Path) -> None:
    part, notes = read(folder, city())
    (material,) = part.materials
    assert notes == []
    assert material.texture is not None
    assert material.colour == (1.0, 1.0, 1.0)
    assert material.opacity == 0.75
    assert material.texture.pixels[3, 7].tolist() == [0, 0, 255]
    for (x, _, z), (u, v) in zip(part.positions_m.tolist(), part.uv.tolist(), strict=True):
        assert (4 * u, 2 * (1 - v)) == pytest.approx((x, z))  # of the part, from the upper left


def test_a_warped_wall_keeps_its_picture(folder: Path) -> None:
    told = city(boundaries=[WALL[:1]], texture={"photos": {"values": [[[0, 0, 1, 2, 3]]]}})
    told["vertices"] = [*CORNERS[:3], [0, 0.4, 2], *CORNERS[4:]]
    part, _ = read(folder, told)
    assert len(part.polygon_feature) == 2
    for (x, _, z), (u, v) in zip(part.positions_m.tolist(), part.uv.tolist(), strict=True):
        assert (4 * u, 2 * (1 - v)) == pytest.approx((x, z))


@pytest.mark.parametrize(
    ("image", "told"),
    [
        ("../secret.png", "outside of its folder"),
        ("/etc/hostname", "outside of its folder"),
        ("C:\\wall.png", "outside of its folder"),
        ("https://example.com/wall.png", "outside of its folder"),
        ("pictures/none.png", "cannot be read"),
        ("house.city.json", "cannot be read"),
        ("a\0.png", "cannot be read"),
        ("\udce9.png", "cannot be read"),
        ("n" * 900, "cannot be read"),
    ],
)
def test_a_picture_that_cannot_be_had_is_named(folder: Path, image: str, told: str) -> None:
    model = city()
    model["appearance"]["textures"][0]["image"] = image
    part, notes = read(folder, model)
    (material,) = part.materials
    assert (material.texture, material.colour) == (None, (1.0, 0.5, 0.0))
    assert [told in note for note in notes] == [True]


@pytest.mark.parametrize(
    "texture",
    [
        {"photos": {"values": [[[9, 0, 1, 2, 3], [0, 4, 6, 5]]]}},
        {"photos": {"values": [[[0, 0, 1, 2, 99], [0, 4, 6, 5]]]}},
        {"photos": {"values": [[[0, 0, 1, 2], [0, 4, 6, 5]]]}},
        {"photos": {"values": [[[0, 0, 1, 2, 3]]]}},
        {"photos": {"values": [[["a", 0, 1, 2, 3], [0, 4, 6, 5]]]}},
        {"photos": {"values": 3}},
        {"photos": {"values": [[None, None]]}},
        {"photos": {"values": [[0, 0, 1, 2, 3]]}},
        {"photos": {"values": [[[10**400, 0, 1, 2, 3], [0, 4, 6, 5]]]}},
        {"photos": []},
        {"photos": {"values": [[[0, 0, -1, 2, 3], [0, 4, 6, 5]]]}},
        [],
    ],
)
def test_a_texture_that_does_not_fit_leaves_the_colour(folder: Path, texture: Any) -> None:
    part, _ = read(folder, city(texture=texture))
    (material,) = part.materials
    assert (material.texture, material.colour) == (None, (1.0, 0.5, 0.0))


@pytest.mark.parametrize(
    "appearance",
    [
        None,
        [],
        {"materials": 3, "textures": 3, "vertices-texture": 3},
        {"materials": [3], "textures": [3], "vertices-texture": [3]},
        {"materials": [{"diffuseColor": ["a", 1, 2], "transparency": "b"}]},
        {"materials": [{"diffuseColor": [10**400, 0, 0], "transparency": 10**400}]},
        {"textures": [{"image": "a.png"}], "vertices-texture": [[10**400, 1]]},
        {"textures": [{"image": 3}], "vertices-texture": [[1], [2]]},
        {"textures": [{"image": "a.png"}], "vertices-texture": [[None, 1]] * 9},
    ],
)
def test_a_broken_appearance_leaves_the_wall(folder: Path, appearance: Any) -> None:
    part, _ = read(folder, city() | {"appearance": appearance})
    (material,) = part.materials
    assert material.texture is None
    assert material.colour in {(1.0, 1.0, 1.0), (1.0, 0.0, 0.0)}


def test_too_many_pixels_are_left_out(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("veduta.formats.city_place.MOST_PICTURE_PIXELS", 32)
    told = city()
    second = json.loads(json.dumps(told["CityObjects"]["house"]))
    second["geometry"][0]["texture"]["photos"]["values"] = [[[1, 0, 1, 2, 3], [1, 4, 6, 5]]]
    told["CityObjects"]["second"] = second
    told["appearance"]["textures"].append({"type": "PNG", "image": "pictures/other.png"})
    _, notes = read(folder, told)
    assert ["32 pixels" in note for note in notes] == [True]
    assert MOST_PICTURE_PIXELS > 32


def test_what_veduta_writes_has_its_pictures_back(tmp_path: Path) -> None:
    """The picture at the middle of each wall of the sample is what it was."""
    house = sample_place().parts["house"].content
    assert isinstance(house, Part)
    sample_place().write(tmp_path / "sample.city.json")
    back = veduta.load(tmp_path / "sample.city.json").parts["house"].content
    assert isinstance(back, Part)
    shown = [_seen(one, SemanticClass.WALL) for one in (house, back)]
    assert len(shown[0]) == len(shown[1]) > 5
    order = [np.lexsort(one.T) for one in shown]
    off = shown[0][order[0]] - shown[1][order[1]]
    assert np.abs(off).mean() < 6.0  # JPEG


def _seen(part: Part, semantic: SemanticClass) -> np.ndarray:
    """(n, 3) the colours at the corners of what has a picture and is of this class."""
    found = []
    for row, feature in enumerate(part.polygon_feature):
        material = part.materials[part.polygon_material[row]]
        if material.texture is None or part.features.semantic(int(feature)) is not semantic:
            continue
        ring = int(part.polygon_offsets[row])
        corners = part.uv[part.ring_offsets[ring] : part.ring_offsets[ring + 1]]
        height, width = material.texture.pixels.shape[:2]
        at = (np.clip(corners.mean(axis=0), 0, 0.9999) * (width, height)).astype(int)
        found.append(material.texture.pixels[at[1], at[0]])
    return np.array(found, dtype=np.float64)


def test_pictures_that_are_missing_are_counted(folder: Path) -> None:
    told = city()
    first = told["CityObjects"]["house"]
    for number in range(1, 30):
        one = json.loads(json.dumps(first))
        one["geometry"][0]["texture"]["photos"]["values"] = [
            [[number, 0, 1, 2, 3], [number, 4, 6, 5]]
        ]
        told["CityObjects"][f"house {number}"] = one
        told["appearance"]["textures"].append({"type": "PNG", "image": f"none-{number}.png"})
    _, notes = read(folder, told)
    assert notes == ["left out: 29 pictures that cannot be read, such as 'none-1.png'"]
