"""A place in memory: saved, loaded, joined with another."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import trimesh

from veduta.place.manifest import Start
from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, Place, Standing
from veduta.run.errors import InputError


def _box(name: str) -> Mesh:
    box = trimesh.creation.box((1.0, 2.0, 3.0))
    return Mesh.simple(name, np.asarray(box.vertices), np.asarray(box.faces))


def _moved(*shift: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = shift
    return matrix


def _place(name: str = "box") -> Place:
    place = Place(title="A box", licence="CC0-1.0", languages=("en",), crs="EPSG:25832")
    place.add(_box(name), Standing(transform=_moved(10.0, 0.0, 1.5)))
    points = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0]])
    colours = np.array([[1, 2, 3], [4, 5, 6]], np.uint8)
    place.clouds.append(Cloud(f"points of {name}", points, colours))
    return place


def test_a_saved_place_comes_back(tmp_path: Path) -> None:
    _place().save(tmp_path)
    again = Place.load(tmp_path)
    assert (again.title, again.licence, again.languages) == ("A box", "CC0-1.0", ("en",))
    vertices, triangles = again.parts["box"].triangles()
    solid = trimesh.Trimesh(vertices, triangles)
    assert solid.volume == pytest.approx(6.0)
    np.testing.assert_allclose(solid.bounds, [[9.5, -1.0, 0.0], [10.5, 1.0, 3.0]])
    np.testing.assert_array_equal(again.clouds[0].colours, [[1, 2, 3], [4, 5, 6]])
    np.testing.assert_allclose(again.clouds[0].points_m, [[0, 0, 0], [1, 2, 3]])


def test_what_is_hidden_at_first_is_kept_and_else_left_out_of_the_file(tmp_path: Path) -> None:
    place = _place()
    place.save(tmp_path)
    assert '"hidden"' not in (tmp_path / "place.json").read_text()
    place.hidden = ("points", "photos")
    place.save(tmp_path)
    assert Place.load(tmp_path).hidden == ("points", "photos")


def test_nothing_is_read_before_it_is_asked_for(tmp_path: Path) -> None:
    _place().save(tmp_path)
    (tmp_path / "parts/box.glb").write_bytes(b"broken")
    again = Place.load(tmp_path)
    with pytest.raises(InputError, match=r"box\.glb"):
        _ = again.parts["box"].content


def test_ids_that_are_no_file_names_get_files_of_their_own(tmp_path: Path) -> None:
    place = Place()
    for name in ("a/b", "a b", "../up", "ä"):
        place.add(_box(name))
    place.save(tmp_path)
    again = Place.load(tmp_path)
    assert sorted(again.parts) == sorted(("a/b", "a b", "../up", "ä"))
    assert all(len(one.content.triangles) == 12 for one in again.parts.values())  # type: ignore[arg-type]
    assert len(list((tmp_path / "parts").iterdir())) == 4


def test_a_start_is_chosen_that_sees_the_whole(tmp_path: Path) -> None:
    place = _place()
    place.save(tmp_path)
    start = Place.load(tmp_path).start
    assert start is not None
    low, high = place.bounds_m() or (np.zeros(3), np.zeros(3))
    np.testing.assert_allclose(start.target, (low + high) / 2.0)
    assert start.eye[2] > start.target[2]
    place.start = Start(eye=(0.0, 0.0, 1.7), target=(1.0, 0.0, 1.7))
    place.save(tmp_path)
    assert Place.load(tmp_path).start == place.start


def test_two_places_become_one_in_the_frame_of_the_first() -> None:
    first, second = _place("a"), _place("b")
    second.origin_m = (100.0, 50.0, 2.0)
    both = first.merge(second)
    assert list(both.parts) == ["a", "b"]
    one, _ = both.parts["a"].triangles()
    other, _ = both.parts["b"].triangles()
    np.testing.assert_allclose(other - one, np.tile([100.0, 50.0, 2.0], (8, 1)))
    np.testing.assert_allclose(both.clouds[1].points_m[0], [100.0, 50.0, 2.0])
    assert list(first.parts) == ["a"]


@pytest.mark.parametrize("fault", ["crs", "scale", "id"])
def test_places_that_do_not_fit_are_refused(fault: str) -> None:
    first, second = _place("a"), _place("b")
    if fault == "crs":
        second.crs = None
    elif fault == "scale":
        second.scale = "unknown"
    else:
        second.parts.clear()
        second.add(_box("a"), Standing(transform=_moved(10.0, 0.1, 1.5)))
    words = {"crs": "coordinate system", "scale": "no known scale", "id": "id of two parts"}
    with pytest.raises(InputError, match=words[fault]):
        first.merge(second)


def test_an_unknown_ending_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no ending of a format"):
        _place().write(tmp_path / "box.xyz")


def test_a_folder_without_a_place_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such folder"):
        Place.load(tmp_path / "none")
    with pytest.raises(InputError, match=r"place\.json"):
        Place.load(tmp_path)
