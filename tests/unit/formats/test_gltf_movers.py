"""What moves in a part: nodes that stand as the part says, and animations to the open pose."""

from __future__ import annotations

import json
import math
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from veduta.formats.gltf import glb_bytes, read_glb, write_glb
from veduta.formats.gltf_bin import glb_container
from veduta.place.builder import PartBuilder
from veduta.place.material import Material
from veduta.place.mover import Mover
from veduta.place.part import Part
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError

SQUARE = [(1.0, 2.0, 0.0), (2.0, 2.0, 0.0), (2.0, 2.0, 2.0), (1.0, 2.0, 2.0)]


def part_of(opened: float) -> Part:
    """A still square at y = 0, and a leaf at y = 2 that hangs at (1, 2) and opens by 90 degrees."""
    builder = PartBuilder("door")
    feature = builder.feature(SemanticClass.DOOR, Provenance.INFERRED, "door")
    glass = builder.material(Material("glass", opacity=0.25))
    builder.polygon([[(x, 0.0, z) for x, _, z in SQUARE]], feature, glass)
    builder.polygon([SQUARE], feature, glass)
    builder.mover(
        Mover(
            "leaf", np.array([1]), (1.0, 2.0, 0.0),
            turn_rad=math.pi / 2, shift_m=(0.0, 0.5, 0.0), opened=opened,
        )
    )  # fmt: skip
    return builder.build()


def read(content: bytes) -> tuple[dict[str, Any], bytes]:
    """The two chunks of a file."""
    size = struct.unpack_from("<I", content, 12)[0]
    return json.loads(content[20 : 20 + size]), content[28 + size :]


def array(root: dict[str, Any], data: bytes, number: int, width: int) -> np.ndarray:
    accessor = root["accessors"][number]
    start = root["bufferViews"][accessor["bufferView"]]["byteOffset"]
    count = accessor["count"] * width
    return np.frombuffer(data, np.float32, count, start).reshape(-1, width)


def placed(points: np.ndarray, turn: list[float], place: list[float]) -> np.ndarray:
    """glTF's points moved by a node, z up again."""
    moved = Rotation.from_quat(turn).apply(points) + place
    return np.stack([moved[:, 0], -moved[:, 2], moved[:, 1]], axis=1)


@pytest.mark.parametrize("opened", [0.0, 1.0])
def test_a_leaf_is_a_node_that_stands_as_it_is_said(opened: float) -> None:
    root, data = read(glb_bytes(part_of(opened)))
    node = root["nodes"][1]
    assert node["name"] == "leaf"
    assert root["scenes"][0]["nodes"] == [0, 1]
    (primitive,) = root["meshes"][node["mesh"]]["primitives"]
    points = array(root, data, primitive["attributes"]["POSITION"], 3)
    found = placed(points, node["rotation"], node["translation"])
    closed = np.array(SQUARE)
    # A quarter turn counter-clockwise about (1, 2): what was east of it is north of it.
    opens = np.array([(1.0, 2.5 + x - 1.0, z) for x, _, z in SQUARE])
    expected = closed if opened == 0.0 else opens
    assert np.abs(np.sort(found, axis=0) - np.sort(expected, axis=0)).max() < 1e-5


def test_the_animation_goes_from_closed_to_open() -> None:
    root, data = read(glb_bytes(part_of(0.3)))
    (animation,) = root["animations"]
    of = {channel["target"]["path"]: channel for channel in animation["channels"]}
    assert all(channel["target"]["node"] == 1 for channel in animation["channels"])
    turn = animation["samplers"][of["rotation"]["sampler"]]
    times = array(root, data, turn["input"], 1)
    assert (times[0], times[-1]) == (0.0, 1.0)
    angles = Rotation.from_quat(array(root, data, turn["output"], 4)).magnitude()
    assert angles == pytest.approx(np.linspace(0.0, math.pi / 2, len(angles)), abs=1e-6)
    move = animation["samplers"][of["translation"]["sampler"]]
    assert array(root, data, move["output"], 3)[-1] == pytest.approx([1.0, 0.0, -2.5])


def test_still_polygons_are_not_in_the_leaf_and_glass_is_seen_through() -> None:
    root, data = read(glb_bytes(part_of(0.0)))
    (still,) = root["meshes"][root["nodes"][0]["mesh"]]["primitives"]
    points = array(root, data, still["attributes"]["POSITION"], 3)
    assert (points[:, 2] == 0.0).all()
    (glass,) = root["materials"]
    assert glass["alphaMode"] == "BLEND"
    assert glass["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.25


@pytest.mark.parametrize("opened", [0.0, 0.4])
def test_what_moves_is_read_back(opened: float, tmp_path: Path) -> None:
    part = part_of(opened)
    write_glb(part, tmp_path / "door.glb")
    back = read_glb(tmp_path / "door.glb")
    assert back.bounds_m == part.bounds_m
    np.testing.assert_allclose(back.feature_area_m2, part.feature_area_m2, rtol=1e-6)
    (wrote,), (mover,) = part.movers, back.movers
    assert (mover.name, mover.opened) == (wrote.name, opened)
    for name in ("pivot_m", "axis", "turn_rad", "shift_m"):
        np.testing.assert_allclose(getattr(mover, name), getattr(wrote, name), atol=1e-5)
    assert mover.polygons.tolist() == [2, 3]
    assert back.positions_m[6:, 1].min() == pytest.approx(2.0)


def test_a_mover_without_an_animation_is_refused(tmp_path: Path) -> None:
    root, content = read(glb_bytes(part_of(0.0)))
    del root["animations"]
    (tmp_path / "door.glb").write_bytes(glb_container(root, content))
    with pytest.raises(InputError, match=r"door\.glb: not a GLB .* no animation says how"):
        read_glb(tmp_path / "door.glb")
