"""What is refused and what is kept apart where a place is saved."""

from __future__ import annotations

import gc
from pathlib import Path

import numpy as np
import pytest

from veduta.place.manifest import (
    IDENTITY,
    AnimalClip,
    PlaceAnimal,
    PlaceCamera,
    Tour,
    Walk,
    WalkKey,
    WalkTransition,
)
from veduta.place.mesh import Mesh
from veduta.place.place import Cloud, Place, Standing
from veduta.run.errors import InputError
from veduta.run.scratch import goes_with, scratch_folder


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


def _walk(name: str) -> Walk:
    shot = {"width_px": 4, "height_px": 3, "focal_px": (2.0, 2.0), "centre_px": (2.0, 1.5)}
    key = WalkKey(id="k", picture="walk/key.jpg", transform=IDENTITY, **shot)
    ways = [WalkTransition(start=0, end=0, kind="morph", forth="walk/f.glb", back="walk/b.glb")]
    return Walk(id=name, name=name, document="walk.json", keys=[key], transitions=ways)


def _camera(name: str) -> PlaceCamera:
    return PlaceCamera(
        id=name, name=name, picture="s/0.jpg", width_px=4, height_px=3,
        focal_px=(2.0, 2.0), centre_px=(2.0, 1.5), transform=IDENTITY,
    )  # fmt: skip


def _full(folder: Path, name: str = "one", words: str = "1") -> Place:
    """A loaded place with one of each thing, and all files that it names."""
    place = Place()
    place.add(_triangle(name), Standing(document="d.json", photo="p.jpg", city_model="c.json"))
    place.clouds.append(_cloud(f"cloud of {name}", 1.0, 2.0))
    place.cameras.append(_camera(name))
    place.tours.append(
        Tour(id=name, name=name, times_s=[0, 1], eyes=[(0, 0, 0)] * 2, directions=[(1, 0, 0)] * 2)
    )
    clips = [AnimalClip(name="go", seconds=1.0, stride=1.0)]
    path = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)]
    place.animals.append(
        PlaceAnimal(id=name, name=name, part=name, length=1.0, clips=clips, path=path)
    )
    place.walks.append(_walk(name))
    for file in sorted(place.names()):
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(f"{file} {words}")
    place.save(folder)
    return Place.load(folder)


def _counts(place: Place) -> list[int]:
    kinds = (place.parts, place.clouds, place.cameras, place.tours, place.animals, place.walks)
    return [len(kind) for kind in kinds]


def test_a_place_joined_with_itself_is_the_same(tmp_path: Path) -> None:
    place = _full(tmp_path / "a")
    for other in (place, Place.load(tmp_path / "a")):
        both = place.merge(other)
        assert _counts(both) == [1] * 6
        both.save(tmp_path / "b")
        told = [(tmp_path / one / "place.json").read_text() for one in "ab"]
        assert told[0] == told[1]


@pytest.mark.parametrize("kind", ["part", "cloud", "camera", "tour", "animal", "walk"])
def test_two_of_one_id_that_differ_are_refused(tmp_path: Path, kind: str) -> None:
    place, other = _full(tmp_path / "a"), Place.load(tmp_path / "a")
    if kind == "part":
        other.parts.clear()
        other.add(_triangle("one", 2.0), place.parts["one"].standing)
    elif kind == "cloud":
        other.clouds = [_cloud("cloud of one", 1.0, 2.5)]
    else:
        items = getattr(other, f"{kind}s")
        items[0] = items[0].model_copy(update={"name": "another"})
    with pytest.raises(InputError, match=f"{kind}.*the two differ"):
        place.merge(other)


def test_all_files_that_a_place_names_go_where_it_is_saved(tmp_path: Path) -> None:
    place = _full(tmp_path / "a")
    place.save(tmp_path / "b")
    for file in place.names():
        assert (tmp_path / "b" / file).read_text() == f"{file} 1"


def test_each_keeps_its_own_files_where_both_name_them_alike(tmp_path: Path) -> None:
    first, second = _full(tmp_path / "a", "one", "1"), _full(tmp_path / "b", "two", "2")
    for target in (tmp_path / "c", tmp_path / "b"):
        first.merge(second).save(target)
        again = Place.load(target)
        assert _counts(again) == [2] * 6
        told = [(target / one.picture).read_text() for one in again.cameras]
        assert told == ["s/0.jpg 1", "s/0.jpg 2"]
        told = [(target / str(one.standing.document)).read_text() for one in again.parts.values()]
        assert told == ["d.json 1", "d.json 2"]
        told = [(target / one.keys[0].picture).read_text() for one in again.walks]
        assert told == ["walk/key.jpg 1", "walk/key.jpg 2"]


def test_files_that_are_missing_are_named_and_links_refused(tmp_path: Path) -> None:
    place = _full(tmp_path / "a")
    (tmp_path / "a/s/0.jpg").unlink()
    with pytest.raises(InputError, match=r"not there \(s/0\.jpg\)"):
        place.save(tmp_path / "b")
    (tmp_path / "secret").write_text("secret")
    (tmp_path / "a/s/0.jpg").symlink_to(tmp_path / "secret")
    with pytest.raises(InputError, match="link to a file outside"):
        place.save(tmp_path / "b")
    assert not (tmp_path / "b").exists()


def test_a_folder_without_a_name_stays_as_long_as_a_part_reads_from_it() -> None:
    folder, scratch = scratch_folder()
    made = _full(folder)
    goes_with(made, scratch)
    joined = Place().merge(made)
    kept = made.parts["one"]
    del made, scratch
    gc.collect()
    assert len(kept.content.positions_m) == 3
    del kept
    gc.collect()
    assert len(joined.parts["one"].passing().positions_m) == 3
    joined.save(folder.parent / "second")
    del joined
    gc.collect()
    assert not folder.exists()
