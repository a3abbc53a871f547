"""Models of other programs with pictures: the right corner of the picture is at each corner."""

from __future__ import annotations

import base64
import json
import math
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pictured_quads import (
    BLUE,
    GREEN,
    QUARTERS,
    RED,
    WHITE,
    png,
    write_dae,
    write_glb,
    write_obj,
)

import veduta
from veduta.formats.dae_read import read_dae_mesh
from veduta.formats.glb_mesh import read_glb_mesh
from veduta.formats.gltf_bin import glb_container
from veduta.formats.model_pictures import read_picture
from veduta.formats.mtl_read import read_mtl
from veduta.formats.obj_read import ReadMesh, read_obj
from veduta.place.material import Texture
from veduta.place.part import Part
from veduta.run.errors import InputError

WRITERS = {"obj": write_obj, "glb": write_glb, "dae": write_dae}


def read(path: Path) -> ReadMesh:
    match path.suffix:
        case ".obj":
            return read_obj(path, path.parent)
        case ".glb":
            return read_glb_mesh(path)
        case _:
            return read_dae_mesh(path)


def pixel(texture: Texture, u: float, v: float) -> tuple[int, ...]:
    """The colour at a place from the lower left; pictures repeat."""
    height, width = texture.pixels.shape[:2]
    column = math.floor((u - math.floor(u)) * width)
    row = math.floor((1.0 - (v - math.floor(v))) * height)
    return tuple(texture.pixels[min(row, height - 1), min(column, width - 1)].tolist())


def seen(mesh: ReadMesh) -> dict[tuple[int, int], tuple[int, ...]]:
    """The colour at each corner of the quad, a little inside of it."""
    (picture,) = {one for one in mesh.pictures if one is not None}
    assert mesh.uv is not None
    texture = read_picture(picture)
    middle = mesh.uv.mean(axis=0)
    found = {}
    for point, place in zip(mesh.points[mesh.corners], mesh.uv, strict=True):
        u, v = (place + 0.05 * (middle - place)).tolist()
        side = (1 if point[0] > 1.0 else -1, 1 if point[1] > 0.5 else -1)
        found[side] = pixel(texture, u, v)
    return found


@pytest.mark.parametrize("kind", WRITERS)
def test_each_corner_shows_its_corner_of_the_picture(tmp_path: Path, kind: str) -> None:
    mesh = read(WRITERS[kind](tmp_path))
    assert seen(mesh) == QUARTERS
    assert mesh.notes == ()


@pytest.mark.parametrize("kind", WRITERS)
def test_a_picture_that_is_mirrored_and_repeated(tmp_path: Path, kind: str) -> None:
    uv = [(1.0, 2.0), (0.0, 2.0), (0.0, 3.0), (1.0, 3.0)]
    mesh = read(WRITERS[kind](tmp_path, uv=uv))
    assert seen(mesh) == {(-1, 1): GREEN, (1, 1): RED, (-1, -1): WHITE, (1, -1): BLUE}


@pytest.mark.parametrize("kind", ["obj", "dae"])
def test_a_picture_that_is_not_there(tmp_path: Path, kind: str) -> None:
    mesh = read(WRITERS[kind](tmp_path, named="gone.png"))
    assert mesh.uv is None
    assert mesh.pictures == (None,)
    assert "gone.png" in mesh.notes[0]
    assert "skin" in mesh.notes[0]


def test_a_picture_outside_of_the_folder_is_not_taken(tmp_path: Path) -> None:
    (tmp_path / "four.png").write_bytes(png())
    (tmp_path / "in").mkdir()
    path = write_obj(tmp_path / "in", named="../four.png")
    # The one of the same name beside the file is meant where a path leads elsewhere.
    assert read(path).pictures == (str(tmp_path / "in/four.png"),)
    (tmp_path / "in/four.png").unlink()
    assert read(path).pictures == (None,)
    (tmp_path / "in/four.png").symlink_to(tmp_path / "four.png")
    assert read(path).pictures == (None,)


def test_whole_numbers_tell_places_too(tmp_path: Path) -> None:
    assert seen(read(write_glb(tmp_path, whole_numbers=True))) == QUARTERS


@pytest.mark.parametrize(
    ("told", "left_low"),
    [
        ({"offset": [0.5, 0.0]}, WHITE),
        ({"offset": [0.0, 0.5]}, RED),
        # A quarter turn of the places about the upper left, against the clock.
        ({"rotation": math.pi / 2}, WHITE),
    ],
)
def test_a_picture_that_the_material_moves(
    tmp_path: Path, told: dict[str, Any], left_low: tuple[int, int, int]
) -> None:
    texture = {"extensions": {"KHR_texture_transform": told}}
    assert seen(read(write_glb(tmp_path, texture=texture)))[-1, -1] == left_low


def test_the_coordinates_that_the_texture_names(tmp_path: Path) -> None:
    mesh = read(write_glb(tmp_path, texture={"texCoord": 1}))
    assert mesh.uv is not None
    assert np.isnan(mesh.uv).all()


def test_alpha_counts_where_the_material_says_so(tmp_path: Path) -> None:
    alpha = np.full((16, 16), 255, dtype=np.uint8)
    alpha[:8, :8] = 0
    path = write_glb(tmp_path, image=png(alpha))
    (picture,) = {one for one in read(path).pictures if one}
    assert not read_picture(picture).cut
    assert read_picture(picture).pixels[0, 0].tolist() == list(RED)
    path = write_glb(tmp_path, image=png(alpha), material={"alphaMode": "MASK"})
    texture = read_picture(picture)
    assert texture.cut
    assert texture.invented.sum() == 64
    assert texture.invented[:8, :8].all()
    # What is seen through has the mean of the rest: no red bleeds into the edges.
    assert texture.pixels[0, 0].tolist() == [85, 170, 170]


def test_options_of_material_files() -> None:
    text = """newmtl a
Kd 0 0 0
map_Kd -clamp on -s 2 3 1 -o 0.25 -bm 1 my bark.png
newmtl b
Kd 0 0 0
newmtl c
map_kd\tC:\\textures\\wood.jpg"""
    found = read_mtl(text.splitlines())
    assert found["a"].picture == "my bark.png"
    assert (found["a"].stretch, found["a"].shift) == ((2.0, 3.0), (0.25, 0.0))
    assert found["a"].colour is None  # black would hide it
    assert found["b"].colour == (0.0, 0.0, 0.0)
    assert found["c"].picture == "C:\\textures\\wood.jpg"


def test_a_path_of_another_machine_is_looked_for_by_its_name(tmp_path: Path) -> None:
    assert seen(read(write_obj(tmp_path, named="C:\\work\\four.png"))) == QUARTERS
    assert seen(read(write_dae(tmp_path, named="file:///D:/models/four.png"))) == QUARTERS


def test_options_move_the_picture(tmp_path: Path) -> None:
    mesh = read(write_obj(tmp_path, named="-o 0.5 0 0 four.png"))
    assert seen(mesh)[-1, -1] == WHITE


def test_pictures_that_are_none(tmp_path: Path) -> None:
    path = write_glb(tmp_path, image=b"GIF89a")
    (picture,) = {one for one in read(path).pictures if one}
    with pytest.raises(InputError, match=r"quad.glb#0"):
        read_picture(picture)
    with pytest.raises(InputError, match="has no image 7"):
        read_picture(f"{path}#7")


def test_an_image_in_the_document(tmp_path: Path) -> None:
    path = write_glb(tmp_path)
    data = path.read_bytes()
    (size,) = struct.unpack_from("<I", data, 12)
    root = json.loads(data[20 : 20 + size])
    inline = base64.b64encode(png()).decode()
    root["images"] = [{"uri": f"data:image/png;base64,{inline}"}]
    path.write_bytes(glb_container(root, data[28 + size :]))
    assert seen(read(path)) == QUARTERS


@pytest.mark.parametrize("kind", WRITERS)
def test_a_place_keeps_pictures(tmp_path: Path, kind: str) -> None:
    place = veduta.load(WRITERS[kind](tmp_path))
    (entry,) = place.parts.values()
    part = entry.content
    assert isinstance(part, Part)
    (material,) = {one for one in part.materials if one.texture is not None}
    assert material.texture is not None
    for (x, _, z), (u, v) in zip(part.positions_m.tolist(), part.uv.tolist(), strict=True):
        place_in = (0.95 * u + 0.025, 1.0 - (0.95 * v + 0.025))
        assert (
            pixel(material.texture, *place_in)
            == QUARTERS[(1 if x > 1.0 else -1, 1 if z > 0.5 else -1)]
        )


@pytest.mark.parametrize("suffix", ["glb", "obj"])
def test_a_place_gives_pictures_on(tmp_path: Path, suffix: str) -> None:
    place = veduta.load(write_obj(tmp_path))
    (tmp_path / "out").mkdir()
    place.write(tmp_path / f"out/again.{suffix}")
    again = read(tmp_path / f"out/again.{suffix}")
    found = seen(again)
    for side, colour in QUARTERS.items():
        assert np.abs(np.array(found[side]) - colour).max() < 40  # JPEG
