"""Pictures in models: named by what they hold, and masks only where not all pixels are alike."""

from __future__ import annotations

import hashlib
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from veduta.formats.gltf import glb_bytes, read_glb, write_glb
from veduta.place.builder import PartBuilder
from veduta.place.material import Material, Texture
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass


def wall(invented: np.ndarray, identity: str = "wall") -> Part:
    """A square with a picture on it."""
    pixels = np.full((8, 8, 3), 120, dtype=np.uint8)
    builder = PartBuilder(identity)
    row = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall")
    material = builder.material(Material("photo", texture=Texture(pixels, invented)))
    corners = [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)]
    builder.polygon([corners], row, material, lambda points: points[:, [0, 2]])
    return builder.build()


def opened(part: Part) -> tuple[dict[str, Any], bytes]:
    data = glb_bytes(part)
    (size,) = struct.unpack_from("<I", data, 12)
    return json.loads(data[20 : 20 + size]), data[28 + size :]


def test_two_models_name_the_same_picture_alike() -> None:
    mask = np.zeros((8, 8), dtype=bool)
    (first, body), (second, _) = opened(wall(mask)), opened(wall(mask, "other"))
    assert [one["name"] for one in first["images"]] == [one["name"] for one in second["images"]]
    for image in first["images"]:
        view = first["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        data = body[start : start + view["byteLength"]]
        assert image["name"] == f"sha256-{hashlib.sha256(data).hexdigest()}"


def test_textures_made_apart_are_one_picture_in_the_file() -> None:
    builder = PartBuilder("wall")
    row = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall")
    for number, name in enumerate(("first", "second", "third")):
        pixels = np.full((8, 8, 3), 120 if number < 2 else 90, dtype=np.uint8)
        texture = Texture(pixels, np.zeros((8, 8), dtype=bool))
        material = builder.material(Material(name, texture=texture))
        corners = [(0, number, 0), (1, number, 0), (1, number, 1), (0, number, 1)]
        builder.polygon([corners], row, material, lambda points: points[:, [0, 2]])
    root, _ = opened(builder.build())
    assert len(root["images"]) == 2
    shown = [
        root["textures"][one["pbrMetallicRoughness"]["baseColorTexture"]["index"]]["source"]
        for one in root["materials"]
    ]
    assert shown == [0, 0, 1]


@pytest.mark.parametrize("white", ["none", "all", "some"])
def test_masks_come_back(white: str, tmp_path: Path) -> None:
    mask = np.full((8, 8), white == "all")
    mask[2:4] |= white == "some"
    root, _ = opened(wall(mask))
    assert len(root["images"]) == (2 if white == "some" else 1)
    write_glb(wall(mask), tmp_path / "model.glb")
    texture = read_glb(tmp_path / "model.glb").materials[0].texture
    assert texture is not None
    assert np.array_equal(texture.invented, mask)
