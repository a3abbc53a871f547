"""CityJSON: read back with json alone, its solids closed by counting edges."""

from __future__ import annotations

import json
from collections import Counter
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sample_document import sample_document, sample_photo

from veduta.facade.model import WALL_TEXTURE, build_model, build_part
from veduta.formats.cityjson import write_cityjson
from veduta.place.part import Part


@pytest.fixture(scope="module")
def part() -> Part:
    document = sample_document()
    return build_part(document, sample_photo(document), "sample")


@pytest.fixture(scope="module")
def city(part: Part, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    path = tmp_path_factory.mktemp("city") / "model.city.json"
    write_cityjson(part, path)
    loaded: dict[str, Any] = json.loads(path.read_text())
    return loaded


def test_every_solid_is_closed(city: dict[str, Any]) -> None:
    for name, item in city["CityObjects"].items():
        edges: Counter[tuple[int, int]] = Counter()
        for surface in item["geometry"][0]["boundaries"][0]:
            for ring in surface:
                edges.update(pairwise([*ring, ring[0]]))
        assert all(edges[edge] == edges[edge[::-1]] == 1 for edge in edges), name


def test_vertices_come_back_in_metres(city: dict[str, Any], part: Part) -> None:
    scale, move = city["transform"]["scale"], city["transform"]["translate"]
    points = np.array(city["vertices"]) * scale + move
    low, high = part.bounds_m
    np.testing.assert_allclose(points.min(axis=0), low, atol=1e-4)
    np.testing.assert_allclose(points.max(axis=0), high, atol=1e-4)
    assert city["version"] == "2.0"


def test_windows_and_doors_name_their_walls(city: dict[str, Any]) -> None:
    surfaces = city["CityObjects"]["sample"]["geometry"][0]["semantics"]["surfaces"]
    openings = [row for row, item in enumerate(surfaces) if item["type"] in ("Window", "Door")]
    document = sample_document()
    wanted = [e for e in document.elements if e.class_ in ("window", "door", "shop")]
    assert len(openings) == len(wanted)
    for row in openings:
        wall = surfaces[surfaces[row]["parent"]]
        assert wall["type"] == "WallSurface"
        assert row in wall["children"]
    assert {item["type"] for item in surfaces} == {
        "WallSurface",
        "RoofSurface",
        "GroundSurface",
        "Window",
        "Door",
    }
    assert {item["provenance"] for item in surfaces} == {"measured", "inferred", "invented"}


def test_a_window_behind_a_railing_says_how_much_was_seen(city: dict[str, Any]) -> None:
    surfaces = city["CityObjects"]["sample"]["geometry"][0]["semantics"]["surfaces"]
    partly = [item for item in surfaces if "seen_height_m" in item]
    assert len(partly) == 8  # on the two floors with balconies
    assert {item["class"] for item in partly} == {"window"}
    assert {item["provenance"] for item in partly} == {"inferred"}
    assert all(item["seen_height_m"] == pytest.approx(1.7) for item in partly)
    assert all(item["height_m"] > 1.7 for item in partly)


def test_balconies_are_installations_of_the_building(city: dict[str, Any]) -> None:
    objects = city["CityObjects"]
    balconies = [k for k, v in objects.items() if v["attributes"].get("class") == "balcony"]
    assert len(balconies) == 5
    assert set(balconies) <= set(objects["sample"]["children"])
    assert all(objects[name]["type"] == "BuildingInstallation" for name in balconies)
    assert all(objects[name]["parents"] == ["sample"] for name in balconies)


def test_ground_lies_on_the_ground(city: dict[str, Any]) -> None:
    geometry = city["CityObjects"]["sample"]["geometry"][0]
    surfaces, values = geometry["semantics"]["surfaces"], geometry["semantics"]["values"][0]
    heights = {
        city["vertices"][vertex][2]
        for boundary, value in zip(geometry["boundaries"][0], values, strict=True)
        if surfaces[value]["type"] == "GroundSurface"
        for vertex in boundary[0]
    }
    assert heights == {0}


def test_surfaces_show_what_lies_behind_them_in_the_picture(tmp_path: Path) -> None:
    document = sample_document()
    model = build_model(document, sample_photo(document), "sample")
    pictures = {texture: name for name, texture in model.textures.items()}
    write_cityjson(model.part, tmp_path / "model.city.json", pictures)
    city = json.loads((tmp_path / "model.city.json").read_text())
    look = city["appearance"]
    named = [image["image"] for image in look["textures"]]
    assert set(named) <= set(model.textures)
    points = (
        np.array(city["vertices"]) * city["transform"]["scale"] + city["transform"]["translate"]
    )
    corners = np.array(look["vertices-texture"])
    assert corners.min() >= 0.0
    assert corners.max() <= 1.0
    geometry = city["CityObjects"]["sample"]["geometry"][0]
    rings = zip(
        chain.from_iterable(geometry["boundaries"][0]),
        chain.from_iterable(geometry["texture"]["veduta"]["values"][0]),
        strict=True,
    )
    places, seen = [], []
    for ring, shown in rings:
        if shown == [None] or named[shown[0]] != WALL_TEXTURE:
            continue
        assert len(shown) == len(ring) + 1
        if np.ptp(points[ring, 1]) < 1e-6:  # parallel to the front
            places.append(points[ring][:, [0, 2]])
            seen.append(corners[shown[1:]])
    x, z = np.concatenate(places).T
    u, v = np.concatenate(seen).T
    # The picture is upright on the wall: to the right and up in both.
    for along, across in ((x, u), (z, v)):
        slope, start = np.polyfit(along, across, 1)
        assert slope > 0.0
        np.testing.assert_allclose(slope * along + start, across, atol=2e-3)
