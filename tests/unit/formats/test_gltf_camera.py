"""A camera that moves: a node with a camera, and keys that put it where the path says."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation, Slerp
from test_gltf_movers import array, part_of, read

from veduta.formats.gltf import glb_bytes
from veduta.place.camera_path import CameraPath

YAW = np.linspace(0.0, 3.0 * math.pi, 25)
PITCH = 0.3 * np.sin(YAW)


def path() -> CameraPath:
    """One and a half turns, uphill and looking up and down."""
    directions = np.stack(
        [np.cos(YAW) * np.cos(PITCH), np.sin(YAW) * np.cos(PITCH), np.sin(PITCH)], axis=1
    )
    eyes = np.stack([YAW, 2.0 * YAW, 1.7 + 0.1 * YAW], axis=1)
    return CameraPath("tour", 0.5 * np.arange(25.0), eyes, directions, math.radians(60.0))


def keys(name: str) -> tuple[np.ndarray, np.ndarray]:
    root, data = read(glb_bytes(part_of(0.0), [path()]))
    (animation,) = [one for one in root["animations"] if one["name"] == "tour"]
    (channel,) = [one for one in animation["channels"] if one["target"]["path"] == name]
    sampler = animation["samplers"][channel["sampler"]]
    times = array(root, data, sampler["input"], 1)
    return times[:, 0], array(root, data, sampler["output"], 4 if name == "rotation" else 3)


def test_the_node_has_a_camera_and_stands_where_the_path_begins() -> None:
    root, _ = read(glb_bytes(part_of(0.0), [path()]))
    node = root["nodes"][-1]
    assert root["scenes"][0]["nodes"][-1] == len(root["nodes"]) - 1
    assert node["translation"] == pytest.approx([0.0, 1.7, 0.0])
    camera = root["cameras"][node["camera"]]
    assert camera["type"] == "perspective"
    assert camera["perspective"]["yfov"] == pytest.approx(math.pi / 3)


def test_no_camera_without_a_path() -> None:
    root, _ = read(glb_bytes(part_of(0.0)))
    assert "cameras" not in root
    assert len(root["animations"]) == 1


def test_places_are_those_of_the_path_with_y_up() -> None:
    times, places = keys("translation")
    eyes = path().eyes_m
    assert times == pytest.approx(path().times_s)
    assert places == pytest.approx(np.stack([eyes[:, 0], eyes[:, 2], -eyes[:, 1]], axis=1))


def test_the_camera_looks_along_its_directions_and_stands_upright() -> None:
    _, turns = keys("rotation")
    rotations = Rotation.from_quat(turns)
    ahead = rotations.apply([0.0, 0.0, -1.0])
    found = np.stack([ahead[:, 0], -ahead[:, 2], ahead[:, 1]], axis=1)
    assert found == pytest.approx(path().directions, abs=1e-6)
    right = rotations.apply([1.0, 0.0, 0.0])
    assert right[:, 1] == pytest.approx(np.zeros(25), abs=1e-6)
    assert (rotations.apply([0.0, 1.0, 0.0])[:, 1] > 0.9).all()


def test_between_keys_it_turns_the_short_way() -> None:
    times, turns = keys("rotation")
    assert ((turns[1:] * turns[:-1]).sum(axis=1) > 0.0).all()
    # Players mix neighbours; halfway the view is between the two.
    half = Slerp(times, Rotation.from_quat(turns))((times[1:] + times[:-1]) / 2.0)
    ahead = half.apply([0.0, 0.0, -1.0])
    yaw = np.unwrap(np.arctan2(-ahead[:, 2], ahead[:, 0]))
    assert yaw == pytest.approx((YAW[1:] + YAW[:-1]) / 2.0, abs=0.02)


@pytest.mark.parametrize(
    ("column", "value", "fault"),
    [
        ("times_s", np.arange(1.0, 26.0), "ascend"),
        ("times_s", np.arange(24.0), "belong"),
        ("directions", np.ones((25, 3)), "unit"),
        ("directions", np.tile([0.0, 0.0, 1.0], (25, 1)), "straight up"),
    ],
)
def test_what_is_no_path_is_refused(column: str, value: np.ndarray, fault: str) -> None:
    fields: dict[str, Any] = vars(path()) | {column: value}
    with pytest.raises(ValueError, match=fault):
        CameraPath(**fields)
