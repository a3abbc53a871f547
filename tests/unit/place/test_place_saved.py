"""What is refused and what is kept apart where a place is saved."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, Place, Standing
from veduta.run.errors import InputError


def _triangle(name: str, size: float = 1.0) -> Mesh:
    corners = size * np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    return Mesh.simple(name, corners, np.array([[0, 1, 2]]))


def _cloud(name: str, *heights: float) -> Cloud:
    points = np.array([[0.0, 0.0, height] for height in heights])
    return Cloud(name, points, np.zeros((len(points), 3), np.uint8))


def test_ids_that_look_alike_get_files_of_their_own(tmp_path: Path) -> None:
    place = Place()
    names = ("x", "b-1", "b.", "B-1", "b,")
    for number, name in enumerate(names):
        place.add(_triangle(name, 1.0 + number))
    place.clouds += [_cloud("c-1", 1.0), _cloud("C-1", 2.0, 2.0), _cloud("c.", 3.0)]
    place.save(tmp_path / "deep" / "new")
    again = Place.load(tmp_path / "deep" / "new")
    sizes = [float(again.parts[name].content.positions_m.max()) for name in names]
    assert sizes == [1.0, 2.0, 3.0, 4.0, 5.0]
    assert [float(one.points_m[0, 2]) for one in again.clouds] == [1.0, 2.0, 3.0]
    files = [path.name.casefold() for path in (tmp_path / "deep/new/parts").iterdir()]
    assert len(set(files)) == len(names)


def test_what_no_manifest_says_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    clouds = Place(clouds=[_cloud("c", 1.0), _cloud("c", 2.0)])
    with pytest.raises(InputError, match="two clouds have the id 'c'"):
        clouds.save(tmp_path / "out")
    far = Place()
    matrix = np.eye(4)
    matrix[0, 3] = 1e9
    far.add(_triangle("far"), Standing(transform=matrix))
    with pytest.raises(InputError, match="more than"):
        far.save(tmp_path / "out")
    empty = Place()
    empty.add(Mesh.simple("none", np.zeros((0, 3)), np.zeros((0, 3), np.uint32)))
    with pytest.raises(InputError, match="without a surface"):
        empty.save(tmp_path / "out")
    assert not (tmp_path / "out").exists()
