"""`veduta carve` over a small folder: a ball in closed form, and every fault that is told."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh
from ring_of_a_ball import RADIUS, disc, write_ring

from veduta.cameras import ScaleOptions
from veduta.carve.command import run_carve
from veduta.carve.options import CarveOptions, ColourOptions, SilhouetteOptions, VolumeOptions
from veduta.place.place import Place
from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.run.verb import VerbResult

QUIET = Progress(quiet=True)
OPTIONS = CarveOptions(volume=VolumeOptions(levels=5), colour=ColourOptions(carve=False))


def _carve(folder: Path, out: Path, options: CarveOptions = OPTIONS) -> VerbResult:
    return run_carve(folder, out, options, QUIET)


@pytest.mark.parametrize("masks", [True, False])
def test_a_ball_comes_out_as_one(tmp_path: Path, masks: bool) -> None:
    write_ring(tmp_path / "ball", masks=masks)
    result = _carve(tmp_path / "ball", tmp_path / "out")
    assert result.failure is None
    assert result.measures["silhouette_iou_least"] > 0.97
    place = Place.load(tmp_path / "out")
    (part,) = place.parts.values()
    positions, _ = part.triangles()
    mesh = trimesh.load_mesh(tmp_path / "out/object.ply", process=False)
    assert result.measures["textured_share"] > 0.9
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    # The hull of a ring from above and no other side is the ball and a little at its poles.
    ball = 4 / 3 * np.pi * RADIUS**3
    assert ball * 0.97 < mesh.volume < ball * 1.25
    assert positions[:, 2].min() == pytest.approx(0.0, abs=1e-5), "it stands on the ground"
    assert len(place.cameras) == 12
    assert (tmp_path / "out/object.glb").is_file()
    assert (tmp_path / "out/object.ply").is_file()


def test_the_same_again_is_up_to_date_and_the_same_bytes(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball")
    _carve(tmp_path / "ball", tmp_path / "one")
    _carve(tmp_path / "ball", tmp_path / "two")
    assert _carve(tmp_path / "ball", tmp_path / "one").up_to_date
    for name in ("object.glb", "object.ply", "place.json"):
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()


def test_colours_that_agree_carve_nothing(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball")
    options = CarveOptions(volume=VolumeOptions(levels=5))
    whole = _carve(tmp_path / "ball", tmp_path / "whole")
    carved = _carve(tmp_path / "ball", tmp_path / "carved", options)
    assert carved.measures["triangles"] == whole.measures["triangles"]


def _masks(folder: Path, make: dict[int, np.ndarray] | np.ndarray) -> None:
    for number, path in enumerate(sorted((folder / "masks").iterdir())):
        mask = make if isinstance(make, np.ndarray) else make.get(number)
        if mask is not None:
            cv2.imwrite(str(path), mask.astype(np.uint8) * 255)


@pytest.mark.parametrize(("value", "said"), [(0, "are empty"), (1, "fill their photos")])
def test_silhouettes_without_an_object(tmp_path: Path, value: int, said: str) -> None:
    write_ring(tmp_path / "ball", masks=True)
    _masks(tmp_path / "ball", np.full((96, 96), value))
    result = _carve(tmp_path / "ball", tmp_path / "out")
    assert result.exit_code == 3
    assert result.failure is not None
    assert said in result.failure.reason


def test_one_inverted_silhouette_is_named(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball", masks=True)
    _masks(tmp_path / "ball", {3: ~disc()})
    with pytest.raises(InputError, match="inverted") as raised:
        _carve(tmp_path / "ball", tmp_path / "out")
    assert raised.value.subject == "ball03.png"
    assert raised.value.remedy == "Make it white on the object."


def test_all_inverted_silhouettes_are_told(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball", masks=True)
    _masks(tmp_path / "ball", ~disc())
    with pytest.raises(InputError, match="12 of 12 silhouettes are white along"):
        _carve(tmp_path / "ball", tmp_path / "out")


def test_cameras_that_do_not_look_at_one_place(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball", masks=True)
    path = tmp_path / "ball/ball_par.txt"
    lines = path.read_text().splitlines()
    words = lines[5].split()
    words[-3] = repr(float(words[-3]) + 2.0)
    lines[5] = " ".join(words)
    path.write_text("\n".join(lines))
    with pytest.raises(InputError, match="do not look at one place") as raised:
        _carve(tmp_path / "ball", tmp_path / "out")
    assert "ball04.png" in raised.value.subject


def test_cameras_without_photos(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball")
    for path in sorted((tmp_path / "ball").glob("*.png"))[1:]:
        path.unlink()
    with pytest.raises(InputError) as raised:
        _carve(tmp_path / "ball", tmp_path / "out")
    assert raised.value.remedy


def test_a_mask_of_another_size(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball", masks=True)
    _masks(tmp_path / "ball", {2: np.ones((50, 96), dtype=bool)})
    with pytest.raises(InputError, match="is 96 x 50 px, but its photo has 96 x 96 px") as raised:
        _carve(tmp_path / "ball", tmp_path / "out")
    assert raised.value.subject.endswith("ball02.png")


@pytest.mark.parametrize("size", [(90, 96), (192, 192)])
def test_a_photo_of_another_size_than_its_camera(tmp_path: Path, size: tuple[int, int]) -> None:
    write_ring(tmp_path / "ball")
    path = tmp_path / "ball/ball03.png"
    cv2.imwrite(str(path), cv2.resize(cv2.imread(str(path)), size))
    told = f"is {size[0]} x {size[1]} px, and the 11 others of its camera are 96 x 96 px"
    with pytest.raises(InputError, match=told) as raised:
        _carve(tmp_path / "ball", tmp_path / "out")
    assert raised.value.subject.endswith("ball03.png")


def test_masks_that_are_asked_for_and_missing(tmp_path: Path) -> None:
    write_ring(tmp_path / "ball")
    options = CarveOptions(silhouettes=SilhouetteOptions(background="masks"))
    with pytest.raises(InputError, match="has no folder masks"):
        _carve(tmp_path / "ball", tmp_path / "out", options)


def test_cameras_that_all_look_the_same_way(tmp_path: Path) -> None:
    cameras = write_ring(tmp_path / "ball", masks=True)
    path = tmp_path / "ball/ball_par.txt"
    line = path.read_text().splitlines()[1].split()
    same = [" ".join([camera.name, *line[1:]]) for camera in cameras]
    path.write_text("\n".join(["12", *same]))
    with pytest.raises(InputError, match="all cameras look the same way"):
        _carve(tmp_path / "ball", tmp_path / "out")


def test_no_such_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        _carve(tmp_path / "nothing", tmp_path / "out")


def test_a_known_length_gives_metres_and_a_row_of_a_catalogue(tmp_path: Path) -> None:
    import sqlite3

    from veduta.plan.furnish import catalogue

    write_ring(tmp_path / "ball")
    _carve(tmp_path / "ball", tmp_path / "before")
    assert "no scale" in (tmp_path / "before/object.sql").read_text()
    scale = ScaleOptions(metres_per_unit=0.1)
    _carve(tmp_path / "ball", tmp_path / "out", OPTIONS.model_copy(update={"scale": scale}))
    base = sqlite3.connect(":memory:")
    base.executescript((Path(catalogue.__file__).parent / "schema.sql").read_text())
    base.executescript((tmp_path / "out/object.sql").read_text())
    name, file, width, height = base.execute(
        "SELECT name, file, width_m, height_m FROM object"
    ).fetchone()
    assert (name, file) == ("ball", "object.glb")
    assert width == pytest.approx(0.2 * RADIUS, rel=0.05)
    assert height == pytest.approx(0.2 * RADIUS, rel=0.3)
    assert b"z up, metres" in (tmp_path / "out/object.ply").read_bytes()[:200]
    assert b"unit of length unknown" in (tmp_path / "before/object.ply").read_bytes()[:200]
