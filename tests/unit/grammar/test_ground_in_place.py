"""The ground of an uneven town as a part of its place, in its tiles and in CityJSON."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from veduta.formats.gltf import read_glb
from veduta.formats.place_json import read_place
from veduta.grammar.ground import SINK_M
from veduta.grammar.ground_margin import BELOW_M, MARGIN_M
from veduta.grammar.options import GrammarOptions, OutputOptions
from veduta.grammar.pipeline import run_derive
from veduta.place.manifest import PlacePart
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.progress import Progress

RULES = "Lot --> extrude(5) Mass\nMass --> comp(f) { top : Roof. | bottom : NIL | all : Wall. }\n"
BASE_M = 300.0
"""How high the lowest lot lies."""


def derived(
    folder: Path, count: int, height: Callable[[int], float], *, separate: bool = False
) -> Path:
    features = []
    for number in range(count):
        x, y, z = 14.0 * (number % 10), 25.0 * (number // 10), BASE_M + height(number)
        ring = [[x, y, z], [x + 12, y, z], [x + 12, y + 10, z], [x, y + 10, z], [x, y, z]]
        shape = {"type": "Polygon", "coordinates": [ring]}
        features.append({"type": "Feature", "id": "ground", "geometry": shape, "properties": {}})
    (folder / "rules.cga").write_text(RULES)
    lots, out = folder / "lots.geojson", folder / "out"
    lots.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    options = GrammarOptions(output=OutputOptions(separate=separate))
    quiet = Progress(quiet=True)
    result = run_derive(str(folder / "rules.cga"), lots, out, options, quiet, jobs=1)
    assert result.exit_code == 0
    return out


def stands(part: PlacePart) -> NDArray[np.float64]:
    return np.array(part.transform[12:15])


def test_a_few_uneven_lots_have_ground_that_is_a_part_of_the_place(tmp_path: Path) -> None:
    out = derived(tmp_path, 12, lambda number: 0.5 * (number % 10))
    place = read_place(out / "place.json")
    *houses, ground = place.parts
    assert len(houses) == 12
    assert [house.ground for house in houses] == [False] * 12
    assert ground.ground
    assert place.tileset == "tileset.json"  # twelve are shown by tiles, and have models, too
    assert place.origin[2] == pytest.approx(BASE_M, abs=1e-3)
    model = read_glb(out / ground.model)
    assert [model.features.semantic(row) for row in range(len(model.features))] == [
        SemanticClass.GROUND
    ]
    assert model.features.provenance(0) is Provenance.INVENTED
    assert np.allclose(model.bounds_m, [ground.bounds.min, ground.bounds.max], atol=1e-5)
    # Each lot's corners are there, at its height; around them it ends below the plane.
    points = model.positions_m + stands(ground)
    for house in houses:
        corner = stands(house) - (0.0, 0.0, SINK_M)
        assert np.linalg.norm(points - corner, axis=1).min() < 1e-3
    assert points[:, 0].min() == pytest.approx(-MARGIN_M, abs=0.1)
    assert points[:, 2].min() == pytest.approx(BELOW_M, abs=1e-5)
    assert (model.triangles.polygon_normal[:, 2] > 0).all()


def test_a_visitor_begins_on_the_ground(tmp_path: Path) -> None:
    """Straight south of a row of one height the ground has fallen as the cubic does."""
    out = derived(tmp_path, 20, lambda number: 6.0 if number < 10 else 0.0)
    eye = read_place(out / "place.json").start.eye
    share = -eye[1] / MARGIN_M
    assert 0.2 < share < 0.8
    assert eye[2] - 1.7 == pytest.approx(6.0 * (1 - 3 * share**2 + 2 * share**3), abs=0.15)


@pytest.mark.parametrize("separate", [False, True])
def test_a_streamed_town_names_its_ground_too(tmp_path: Path, separate: bool) -> None:
    out = derived(tmp_path, 70, lambda number: 0.3 * (number // 10), separate=separate)
    place = read_place(out / "place.json")
    grounds = [part for part in place.parts if part.ground]
    children = json.loads((out / "tileset.json").read_text())["root"]["children"]
    tiles = {child["content"]["uri"] for child in children}
    assert {part.model for part in grounds if not separate} <= tiles
    assert len(grounds) == len([name for name in tiles if name.startswith("ground/")]) == 4
    assert all((out / part.model).is_file() for part in grounds)
    if separate:
        classes = {read_glb(out / part.model).features.semantic(0) for part in grounds}
        assert classes == {SemanticClass.GROUND}


def test_level_lots_have_no_ground_but_the_plane(tmp_path: Path) -> None:
    out = derived(tmp_path, 12, lambda number: 0.7)
    place = read_place(out / "place.json")
    assert not any(part.ground for part in place.parts)
    assert not (out / "ground").exists()
    assert max(stands(part)[2] for part in place.parts) < 1e-3


def test_cityjson_has_the_ground_between_the_lots_alone(tmp_path: Path) -> None:
    out = derived(tmp_path, 70, lambda number: 0.3 * (number // 10))
    city = json.loads((out / "city.city.json").read_text())
    reliefs = [one for one in city["CityObjects"].values() if one["type"] == "TINRelief"]
    assert len(reliefs) == 4
    assert {one["attributes"]["provenance"] for one in reliefs} == {"invented"}
    vertices = np.array(city["vertices"]) * city["transform"]["scale"]
    area = 0.0
    for relief in reliefs:
        (surface,) = relief["geometry"]
        assert surface["type"] == "CompositeSurface"
        corners = vertices[np.array(surface["boundaries"])[:, 0]]
        (ux, uy), (vx, vy) = ((corners[:, k] - corners[:, 0])[:, :2].T for k in (1, 2))
        assert (ux * vy - uy * vx > 0).all()
        area += float((ux * vy - uy * vx).sum()) / 2
    lots = json.loads((tmp_path / "lots.geojson").read_text())["features"]
    outline = np.concatenate([one["geometry"]["coordinates"][0] for one in lots])[:, :2]
    assert area == pytest.approx(ConvexHull(outline).volume, rel=1e-4)
