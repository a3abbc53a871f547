"""COLMAP's files, read by us and by COLMAP itself; and files that somebody has damaged."""

from __future__ import annotations

import shutil
from contextlib import suppress
from pathlib import Path

import numpy as np
import pycolmap
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from known_structure import known_structure

from veduta.formats import colmap_binary, colmap_model, colmap_text
from veduta.formats.colmap_folder import models_in, read_model
from veduta.formats.colmap_model import MODELS
from veduta.photos.structure import model_of
from veduta.run.errors import InputError

FILES = ("cameras", "images", "points3D")


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    found = {}
    params = (1400.0, 1390.0, 801.0, 600.5, -0.05, 0.01, 0.001, -0.002)
    model = model_of(known_structure("OPENCV", params, points=60, photos=6))
    for kind in ("bin", "txt"):
        found[kind] = tmp_path_factory.mktemp(kind)
        (model.write_binary if kind == "bin" else model.write_text)(found[kind])
    return found


@pytest.mark.parametrize("kind", ["bin", "txt"])
def test_as_colmap_reads_it(folders: dict[str, Path], kind: str) -> None:
    ours = read_model(models_in(folders[kind])[0])
    theirs = pycolmap.Reconstruction(folders[kind])
    assert set(ours.cameras) == set(theirs.cameras)
    for number, camera in theirs.cameras.items():
        mine = ours.cameras[number]
        assert (mine.model, mine.width_px, mine.height_px) == (
            "OPENCV",
            camera.width,
            camera.height,
        )
        assert np.allclose(mine.params, camera.params, rtol=1e-12)
    assert {image.number for image in ours.images} == set(theirs.images)
    for image in ours.images:
        other = theirs.images[image.number]
        assert image.name == other.name
        assert image.camera == other.camera_id
        assert np.allclose(image.cam_from_world, other.cam_from_world().matrix(), atol=1e-12)
        assert np.allclose(image.places_px, [point.xy for point in other.points2D], atol=1e-9)
        ids = [int(p.point3D_id) if p.has_point3D() else -1 for p in other.points2D]
        assert image.points.tolist() == ids
    assert ours.points.numbers.tolist() == sorted(theirs.points3D)
    for row, number in enumerate(ours.points.numbers.tolist()):
        assert np.allclose(ours.points.places[row], theirs.points3D[number].xyz, rtol=1e-12)
        assert ours.points.colours[row].tolist() == theirs.points3D[number].color.tolist()


def test_the_lens_models_are_colmaps() -> None:
    for number, (name, size) in enumerate(MODELS):
        assert int(pycolmap.CameraModelId.__members__[name]) == number
        camera = pycolmap.Camera.create_from_model_name(1, name, 1000.0, 800, 600)
        assert len(camera.params) == size


def test_names_with_spaces_and_empty_lines() -> None:
    """COLMAP writes an empty line for an image that sees nothing."""
    text = b"# a comment\n\n1 1 0 0 0 0 0 0 1 one photo.jpg\n\n2 0 0 0 2 1 2 3 1 b.jpg\n4 5 -1\n"
    first, second = colmap_text.read_images(Path("images.txt"), text)
    assert (first.name, len(first.points)) == ("one photo.jpg", 0)
    assert (second.name, second.points.tolist()) == ("b.jpg", [-1])
    assert np.allclose(second.cam_from_world[:, :3], np.diag([-1.0, -1.0, 1.0]))


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("share", [0.0, 0.02, 0.5, 0.99])
def test_a_truncated_binary_file(folders: dict[str, Path], name: str, share: float) -> None:
    path = folders["bin"] / f"{name}.bin"
    data = path.read_bytes()
    reader = {
        "cameras": colmap_binary.read_cameras,
        "images": colmap_binary.read_images,
        "points3D": colmap_binary.read_points,
    }[name]
    with pytest.raises(InputError, match="truncated or damaged"):
        reader(path, data[: int(share * len(data))])


@pytest.mark.parametrize("name", FILES)
def test_a_count_that_no_file_could_hold(folders: dict[str, Path], name: str) -> None:
    path = folders["bin"] / f"{name}.bin"
    data = (2**40).to_bytes(8, "little") + path.read_bytes()[8:]
    reader = getattr(
        colmap_binary, {"cameras": "read_cameras", "images": "read_images"}.get(name, "read_points")
    )
    with pytest.raises(InputError, match="truncated or damaged"):
        reader(path, data)


@pytest.mark.parametrize("kind", ["bin", "txt"])
@pytest.mark.parametrize("name", ["cameras", "images"])
def test_more_records_than_are_read(
    folders: dict[str, Path], monkeypatch: pytest.MonkeyPatch, kind: str, name: str
) -> None:
    """A file may be as large as it says: each record costs far more memory than its bytes."""
    path = folders[kind] / f"{name}.{kind}"
    reader = getattr(colmap_binary if kind == "bin" else colmap_text, f"read_{name}")
    count = len(reader(path, path.read_bytes()))
    monkeypatch.setattr(colmap_model, "MOST_RECORDS", count)
    assert len(reader(path, path.read_bytes())) == count
    monkeypatch.setattr(colmap_model, "MOST_RECORDS", count - 1)
    with pytest.raises(InputError, match=f"has {count} {name}, more than {count - 1}"):
        reader(path, path.read_bytes())


def test_points_are_the_same_in_many_pieces(
    folders: dict[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = folders["bin"] / "points3D.bin"
    whole = colmap_binary.read_points(path, path.read_bytes())
    monkeypatch.setattr(colmap_binary, "_AT_ONCE", 7)
    pieces = colmap_binary.read_points(path, path.read_bytes())
    assert len(whole.numbers) > 14
    for name in ("numbers", "places", "colours"):
        assert np.array_equal(getattr(whole, name), getattr(pieces, name))


def test_files_too_large_to_be_read_whole(folders: dict[str, Path], tmp_path: Path) -> None:
    for file in FILES:
        (tmp_path / f"{file}.bin").write_bytes((folders["bin"] / f"{file}.bin").read_bytes())
    with (tmp_path / "images.bin").open("r+b") as images:
        images.truncate(5_000_000_000)  # a hole: it takes no room
    with pytest.raises(InputError, match=r"images\.bin: is 5 GB large, more than 4 GB"):
        models_in(tmp_path)


@pytest.mark.parametrize("number", [-1, 2**40])
def test_numbers_of_cameras_that_the_engine_cannot_hold(
    folders: dict[str, Path], tmp_path: Path, number: int
) -> None:
    shutil.copytree(folders["txt"], tmp_path, dirs_exist_ok=True)
    cameras = tmp_path / "cameras.txt"
    lines = [line for line in cameras.read_text().splitlines() if not line.startswith("#")]
    more = f"{number} {lines[0].partition(' ')[2]}"
    cameras.write_text("\n".join([*lines, more]))
    with pytest.raises(InputError, match=r"cameras\.txt: has a camera of no valid number"):
        read_model(models_in(tmp_path)[0])


@settings(max_examples=150, deadline=None)
@given(data=st.data())
def test_damage_is_an_input_error(
    folders: dict[str, Path], tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    """Some bytes of a file are others: it is read, or refused in our words."""
    kind = data.draw(st.sampled_from(["bin", "txt"]))
    name = data.draw(st.sampled_from(FILES))
    folder = tmp_path_factory.mktemp("damaged")
    for file in FILES:
        content = bytearray((folders[kind] / f"{file}.{kind}").read_bytes())
        if file == name:
            for _ in range(data.draw(st.integers(1, 4))):
                content[data.draw(st.integers(0, len(content) - 1))] = data.draw(
                    st.integers(0, 255)
                )
        (folder / f"{file}.{kind}").write_bytes(content)
    with suppress(InputError):
        assert len(read_model(models_in(folder)[0]).images) <= 6


@pytest.mark.parametrize("kind", ["bin", "txt"])
@pytest.mark.parametrize("name", FILES)
def test_a_missing_file_is_named(
    folders: dict[str, Path], tmp_path: Path, kind: str, name: str
) -> None:
    for file in FILES:
        if file != name:
            path = folders[kind] / f"{file}.{kind}"
            (tmp_path / path.name).write_bytes(path.read_bytes())
    with pytest.raises(InputError, match="is missing") as caught:
        models_in(tmp_path)
    assert Path(caught.value.subject).name == f"{name}.{kind}"


def test_folders_that_hold_models(folders: dict[str, Path], tmp_path: Path) -> None:
    for number in ("0", "1", "10"):
        (tmp_path / "sparse" / number).mkdir(parents=True)
        for file in FILES:
            source = folders["bin"] / f"{file}.bin"
            (tmp_path / "sparse" / number / source.name).write_bytes(source.read_bytes())
    numbered = [files.paths[0].parent.name for files in models_in(tmp_path)]
    assert numbered == ["0", "1", "10"]
    assert models_in(tmp_path / "sparse") == models_in(tmp_path)
    assert len(models_in(tmp_path / "sparse" / "1")) == 1
    with pytest.raises(InputError, match="does not exist"):
        models_in(tmp_path / "none")
    with pytest.raises(InputError, match="is a file"):
        models_in(folders["bin"] / "images.bin")
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="no COLMAP model"):
        models_in(tmp_path / "empty")


def test_files_that_do_not_belong_together(folders: dict[str, Path], tmp_path: Path) -> None:
    for file in FILES:
        (tmp_path / f"{file}.txt").write_bytes((folders["txt"] / f"{file}.txt").read_bytes())
    lines = (tmp_path / "points3D.txt").read_text().splitlines()
    (tmp_path / "points3D.txt").write_text("\n".join(lines[:-1]))
    with pytest.raises(InputError, match="points do not have"):
        read_model(models_in(tmp_path)[0])
    (tmp_path / "cameras.txt").write_text("77 PINHOLE 1600 1200 1400 1400 800 600\n")
    with pytest.raises(InputError, match="cameras do not have"):
        read_model(models_in(tmp_path)[0])
