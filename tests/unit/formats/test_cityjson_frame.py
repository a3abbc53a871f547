"""What all CityJSON files have alike, against plain definitions and another library."""

from __future__ import annotations

import json

import numpy as np
import pytest
import trimesh

from veduta.formats import cityjson_frame as frame


@pytest.mark.parametrize(
    ("crs", "end"),
    [("EPSG:25832", "EPSG/0/25832"), ("OGC:CRS84", "OGC/0/CRS84"), ("25832", "EPSG/0/25832")],
)
def test_a_system_is_named_by_its_authority(crs: str, end: str) -> None:
    assert frame.reference_system(crs) == f"https://www.opengis.net/def/crs/{end}"


def test_what_is_not_known_is_not_said() -> None:
    whole = frame.document(1e-3, (1.0, 2.0, 3.0))
    assert whole["metadata"] == {}
    assert list(whole)[-2:] == ["CityObjects", "vertices"]
    told = frame.document(1e-3, (1.0, 2.0, 3.0), title="a", extent_m=range(6), crs="EPSG:25832")
    assert list(told["metadata"]) == ["title", "geographicalExtent", "referenceSystem"]


def test_a_number_that_is_none_is_not_written() -> None:
    with pytest.raises(ValueError, match="JSON"):
        frame.encoded(frame.document(1e-3, (float("nan"), 0.0, 0.0)))


def test_vertices_lie_within_half_a_step_and_are_there_once() -> None:
    random = np.random.default_rng(4)
    origin = np.array([500_000.0, 5_400_000.0, 100.0])
    points = origin + random.integers(0, 30, (200, 3)) * 1e-3 + random.uniform(-4e-4, 4e-4)
    vertices, number = frame.shared_vertices(points, origin, 1e-3)
    assert len({tuple(one) for one in vertices}) == len(vertices) < 200
    back = np.array(vertices)[number] * 1e-3 + origin
    assert np.abs(back - points).max() <= 5.1e-4
    growing = frame.Vertices()
    rows = growing.numbers(frame.steps_of(points, origin, 1e-3).tolist())
    assert len(growing) == len(vertices)
    assert np.array_equal(np.array(growing.told())[rows], np.array(vertices)[number])


@pytest.mark.parametrize("seed", range(6))
def test_a_volume_closes_where_trimesh_says_so(seed: int) -> None:
    """Of a ball: whole, without one triangle, and with one that is turned."""
    ball = trimesh.creation.icosphere(subdivisions=1)
    one = int(np.random.default_rng(seed).integers(0, len(ball.faces)))
    turned = ball.faces.copy()
    turned[one] = turned[one, ::-1]
    for faces in (ball.faces, np.delete(ball.faces, one, axis=0), turned):
        mesh = trimesh.Trimesh(ball.vertices, faces, process=False)
        expected = bool(mesh.is_watertight and mesh.is_winding_consistent)
        assert frame.closes_volume([[face] for face in faces.tolist()]) is expected
    assert not frame.closes_volume([])


def test_equal_corners_on_pictures_are_one_and_count_from_below() -> None:
    shown = frame.Shown()
    assert shown.told("a") == {}
    assert shown.ring(None, np.zeros((3, 2))) == [None]
    first = shown.ring("a.jpg", np.array([[0.0, 0.0], [1.0, 0.25], [0.0, 0.0]]))
    assert first == [0, 0, 1, 0]
    assert shown.ring("b.PNG", np.array([[1.0, 0.25]])) == [1, 1]
    told = json.loads(json.dumps(shown.told("a")))
    assert told["vertices-texture"] == [[0.0, 1.0], [1.0, 0.75]]
    assert [(one["type"], one["image"]) for one in told["textures"]] == [
        ("JPG", "a.jpg"),
        ("PNG", "b.PNG"),
    ]
