"""`veduta export` to files: what it refuses, what it says is not in them, and what it keeps."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import laspy
import numpy as np
import pytest

from veduta.cli.export import run
from veduta.formats.place_folder import save_place
from veduta.formats.ply import read_points
from veduta.place.builder import PartBuilder
from veduta.place.manifest import Tour
from veduta.place.material import Material, Texture
from veduta.place.mover import Mover
from veduta.place.place import Cloud, Place
from veduta.place.registry import formats
from veduta.place.semantics import Provenance, SemanticClass
from veduta.run.errors import InputError


def cloud() -> Cloud:
    return Cloud("points", np.eye(3), np.full((3, 3), 9, dtype=np.uint8))


def saved(place: Place, folder: Path) -> Path:
    folder.mkdir()
    save_place(place, folder)
    return folder


@pytest.fixture
def points(tmp_path: Path) -> Path:
    place = Place()
    place.clouds.append(cloud())
    return saved(place, tmp_path / "points")


@pytest.fixture
def wall(tmp_path: Path) -> Path:
    """A textured wall that is a door, points and a tour."""
    builder = PartBuilder("wall")
    feature = builder.feature(SemanticClass.WALL, Provenance.MEASURED, "wall")
    pixels = np.full((8, 8, 3), 128, dtype=np.uint8)
    material = builder.material(
        Material("photo", (1.0, 1.0, 1.0), texture=Texture(pixels, np.zeros((8, 8), dtype=bool)))
    )
    corners = [(0, 0, 0), (1, 0, 0), (1, 0, 2), (0, 0, 2)]
    builder.polygon([corners], feature, material)
    builder.mover(Mover("leaf", np.array([0]), (0.0, 0.0, 0.0), turn_rad=1.0))
    place = Place()
    place.add(builder.build())
    place.clouds.append(cloud())
    place.tours.append(
        Tour(
            id="t",
            name="t",
            times_s=[0.0, 1.0],
            eyes=[(0, 0, 0), (1, 0, 0)],
            directions=[(0, 1, 0)] * 2,
        )
    )
    return saved(place, tmp_path / "wall")


@pytest.mark.parametrize("suffix", sorted({*formats()} - {".ply", ".laz"}))
def test_a_place_of_points_alone_makes_no_empty_scene(
    suffix: str, points: Path, tmp_path: Path
) -> None:
    target = tmp_path / f"a{suffix}"
    with pytest.raises(InputError, match=r"has no parts, only points\. Write a \.ply") as told:
        run([str(points), str(target)])
    assert told.value.subject == str(target)
    with pytest.raises(InputError, match="only points"):
        Place.load(points).write(target)
    with pytest.raises(InputError, match="only points"):
        run([str(points), "--to", formats()[suffix].name, "-o", str(tmp_path / "all")])
    assert [one.name for one in tmp_path.iterdir()] == ["points"]


def test_points_alone_are_written_as_ply(
    points: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([str(points), str(tmp_path / "a.ply")]) == 0
    assert read_points(tmp_path / "a.ply")[0].tolist() == np.eye(3).tolist()
    assert "not in it" not in capsys.readouterr().out


def test_the_points_of_a_place_as_laz(
    points: Path, wall: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([str(points), str(tmp_path / "a.laz")]) == 0
    found = laspy.read(tmp_path / "a.laz")
    assert np.asarray(found.xyz) == pytest.approx(np.eye(3), abs=1e-6)
    assert np.asarray(found.red).tolist() == [9 * 257] * 3
    assert "not in it" not in capsys.readouterr().out
    assert run([str(wall), str(tmp_path / "wall.laz")]) == 0
    assert "all of a part but its outline" in capsys.readouterr().out
    place = Place.load(wall)
    # The same points in other colours are a layer of their own, and not written again.
    own = place.clouds[0]
    classes = np.array([2, 6, 6], dtype=np.uint8)
    place.clouds[:] = [replace(own, layer="distances"), replace(own, classes=classes)]
    place.write(tmp_path / "c.laz")
    assert np.asarray(laspy.read(tmp_path / "c.laz").classification).tolist() == [2, 6, 6]
    alone = Place()
    alone.clouds[:] = place.clouds
    alone.write(tmp_path / "c.ply")
    assert len(read_points(tmp_path / "c.ply")[0]) == 3
    place.clouds.clear()
    with pytest.raises(InputError, match=r"b\.laz: the place has no points"):
        place.write(tmp_path / "b.laz")


@pytest.mark.parametrize(
    ("suffix", "lacking"),
    [
        (".glb", "points"),
        (".obj", "what opens (doors), tours, points"),
        (".ply", "textures, what opens (doors), tours, points"),
        (".stl", "classes, colours, textures, what opens (doors), tours, points"),
        (".geojson", "all of a part but its outline and attributes, tours, points"),
    ],
)
def test_what_is_not_in_it_is_what_the_place_has(
    suffix: str, lacking: str, wall: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([str(wall), str(tmp_path / f"a{suffix}")]) == 0
    assert capsys.readouterr().out.rstrip().endswith(f"no word for them: {lacking}")


@pytest.mark.parametrize("suffix", [".obj", ".dae", ".usda", ".city.json"])
def test_files_beside_the_target_are_kept_without_force(
    suffix: str, wall: Path, tmp_path: Path
) -> None:
    trial, folder = tmp_path / "trial", tmp_path / "mine"
    for one in (trial, folder):
        one.mkdir()
    name = f"a{suffix}"
    run([str(wall), str(trial / name)])
    beside = sorted(one.name for one in trial.iterdir() if one.name != name)
    assert beside
    for other in beside:
        (folder / other).write_text("mine")
        with pytest.raises(InputError, match="is there already") as told:
            run([str(wall), str(folder / name)])
        assert told.value.subject == str(folder / other)
        assert [one.name for one in folder.iterdir()] == [other]
        assert (folder / other).read_text() == "mine"
        assert run([str(wall), str(folder / name), "--force"]) == 0
        made = {one.name: one.read_bytes() for one in folder.iterdir()}
        assert set(made) == {name, *beside}
        assert made[other] == (trial / other).read_bytes()
        for one in list(folder.iterdir()):
            one.unlink()


def test_of_several_formats_none_is_written_where_one_is_in_the_way(
    wall: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "all"
    folder.mkdir()
    (folder / "wall.mtl").write_text("mine")
    with pytest.raises(InputError, match=r"wall\.mtl: is there already"):
        run([str(wall), "--to", "stl,obj", "-o", str(folder)])
    assert [one.name for one in folder.iterdir()] == ["wall.mtl"]
    assert run([str(wall), "--to", "stl,obj", "-o", str(folder), "--force"]) == 0
    assert {"wall.stl", "wall.obj", "wall.mtl"} < {one.name for one in folder.iterdir()}
