"""GLB: written, read back by our reader and by trimesh, and refused where it is not ours."""

from __future__ import annotations

import json
import struct
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from sample_document import sample_document, sample_photo

from veduta.facade.model import build_part
from veduta.formats.gltf import feature_columns, glb_bytes, read_glb, write_glb
from veduta.place.builder import PartBuilder
from veduta.place.material import Material
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError


@pytest.fixture(scope="module")
def part() -> Part:
    document = sample_document()
    return build_part(document, sample_photo(document), "sample")


@pytest.fixture(scope="module")
def root(part: Part) -> dict[str, Any]:
    data = glb_bytes(part)
    size = struct.unpack_from("<I", data, 12)[0]
    loaded: dict[str, Any] = json.loads(data[20 : 20 + size])
    return loaded


def test_read_back_features_and_areas(part: Part, tmp_path: Path) -> None:
    write_glb(part, tmp_path / "model.glb")
    back = read_glb(tmp_path / "model.glb")
    assert back.id == part.id
    assert back.features.id == part.features.id
    assert back.features.name == part.features.name
    for column in ("class_code", "provenance_code", "parent", "shell"):
        assert np.array_equal(getattr(back.features, column), getattr(part.features, column))
    for column in ("width_m", "height_m", "photo_px", "seen_height_m", "score"):
        np.testing.assert_allclose(
            getattr(back.features, column), getattr(part.features, column), atol=1e-4
        )
    np.testing.assert_allclose(back.feature_area_m2, part.feature_area_m2, rtol=1e-5)
    assert back.bounds_m == part.bounds_m
    assert back.attributes == part.attributes
    assert [path.name for path in tmp_path.iterdir()] == ["model.glb"]


def test_scores_are_written_where_something_has_one(part: Part) -> None:
    sure = np.full(len(part.features), np.nan)
    assert "score" not in feature_columns(
        replace(part, features=replace(part.features, score=sure))
    )
    sure[1] = 0.4321987
    column = feature_columns(replace(part, features=replace(part.features, score=sure)))["score"]
    assert (column[0], column[1]) == (None, 0.4322)
    assert np.isfinite(part.features.score).any(), "the sample's elements have scores"


def test_read_back_materials(part: Part, tmp_path: Path) -> None:
    write_glb(part, tmp_path / "model.glb")
    back = read_glb(tmp_path / "model.glb")
    used = [part.materials[number] for number in np.unique(part.polygon_material)]
    for wrote, got in zip(used, back.materials, strict=True):
        assert got.name == wrote.name
        np.testing.assert_allclose(got.colour, wrote.colour, atol=1e-3)
        assert (got.texture is None) == (wrote.texture is None)
        if got.texture is not None and wrote.texture is not None:
            assert np.array_equal(got.texture.invented, wrote.texture.invented)
            error = np.abs(got.texture.pixels.astype(int) - wrote.texture.pixels.astype(int))
            assert error.mean() < 6.0


def test_trimesh_sees_the_same_building_with_y_up(part: Part, tmp_path: Path) -> None:
    write_glb(part, tmp_path / "model.glb")
    scene = trimesh.load(tmp_path / "model.glb")
    low, high = part.bounds_m
    expected = [[low[0], low[2], -high[1]], [high[0], high[2], -low[1]]]
    np.testing.assert_allclose(scene.bounds, expected, atol=1e-6)
    assert scene.area == pytest.approx(float(part.feature_area_m2.sum()), rel=1e-5)


def test_no_vertex_is_shared_between_features(part: Part, root: dict[str, Any]) -> None:
    corners = part.polygon_feature[part.triangles.polygon]
    assert set(corners.tolist()) == set(range(len(part.features)))
    count = sum(
        root["accessors"][primitive["attributes"]["_FEATURE_ID_0"]]["count"]
        for primitive in root["meshes"][0]["primitives"]
    )
    assert count == len(part.positions_m)


def test_feature_table_columns_have_one_length(root: dict[str, Any]) -> None:
    columns = root["scenes"][0]["extras"]["veduta"]["features"]
    assert {
        "id",
        "class",
        "parent",
        "provenance",
        "name",
        "width_m",
        "height_m",
        "area_m2",
        "photo_px",
    } <= set(columns)
    assert len({len(column) for column in columns.values()}) == 1
    assert root["asset"]["generator"] == "veduta"


def test_same_part_same_bytes(part: Part) -> None:
    document = sample_document()
    again = build_part(document, sample_photo(document), "sample")
    assert glb_bytes(again) == glb_bytes(part)


@pytest.mark.parametrize("cut", [0, 3, 12, 19, 100, 4000])
def test_a_file_cut_short_is_refused(part: Part, tmp_path: Path, cut: int) -> None:
    path = tmp_path / "model.glb"
    path.write_bytes(glb_bytes(part)[:cut])
    with pytest.raises(InputError, match="not a GLB file of Veduta"):
        read_glb(path)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_glb(tmp_path / "nothing.glb")


def test_a_file_of_another_program_is_refused(part: Part, tmp_path: Path) -> None:
    path = tmp_path / "model.glb"
    path.write_bytes(glb_bytes(part).replace(b'"generator":"veduta"', b'"generator":"venice"'))
    with pytest.raises(InputError, match="another program"):
        read_glb(path)


@pytest.mark.parametrize(("colour", "glow"), [((0.0, 0.0, 0.0), 0.0), ((0.5, 0.25, 0.0), 0.4)])
def test_black_that_gives_off_light_is_read(
    tmp_path: Path, colour: tuple[float, float, float], glow: float
) -> None:
    """Another program may have written a black material with light of its own."""
    builder = PartBuilder("lamp")
    material = builder.material(Material("glass", (0.5, 0.25, 0.0), glow=0.4))
    feature = builder.feature(SemanticClass.OTHER, Provenance.INVENTED, "lamp")
    builder.polygon([[(0, 0, 0), (1, 0, 0), (0, 1, 0)]], feature, material)
    data = glb_bytes(builder.build())
    (size,) = struct.unpack_from("<I", data, 12)
    root = json.loads(data[20 : 20 + size])
    shading = root["materials"][0]["pbrMetallicRoughness"]
    if not any(colour):
        shading["baseColorFactor"][:3] = colour
    text = json.dumps(root, separators=(",", ":")).encode().ljust(size)[:size]
    path = tmp_path / "lamp.glb"
    path.write_bytes(data[:20] + text + data[20 + size :])
    assert read_glb(path).materials[0].glow == pytest.approx(glow, abs=1e-4)
