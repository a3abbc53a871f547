"""Levels of detail of a mesh whose surface is known in closed form."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy.spatial import cKDTree

from veduta.dense.build.levels import LevelParameters, levels_of, vertex_colours
from veduta.dense.streaming import FOLDER, TILESET, part_of, write_tiles
from veduta.formats.place_json import read_place
from veduta.formats.tiles import contents
from veduta.place.material import Material, Texture
from veduta.place.mesh import Mesh
from veduta.place.place import Place, Standing
from veduta.run.options import Options
from veduta.run.progress import Progress
from veduta.run.verb import VerbCall, run_verb
from veduta.run.work import Work

SIDE = 60
RULE = LevelParameters(leaf_triangles=600)


def _hills(*, textured: bool = False) -> Mesh:
    """z = sin x cos y over 6 x 6 m: 7,200 triangles; red to the right."""
    axis = np.linspace(0.0, 6.0, SIDE + 1)
    x, y = np.meshgrid(axis, axis)
    points = np.stack([x.ravel(), y.ravel(), (np.sin(x) * np.cos(y)).ravel()], axis=1)
    corner = (np.arange(SIDE)[:, None] * (SIDE + 1) + np.arange(SIDE)).ravel()
    up, right = SIDE + 1, 1
    faces = np.concatenate(
        [
            np.stack([corner, corner + right, corner + up + right], axis=1),
            np.stack([corner, corner + up + right, corner + up], axis=1),
        ]
    )
    share = (x.ravel() / 6.0)[:, None]
    colours = np.round(255 * share * [1.0, 0.0, 0.0]).astype(np.uint8)
    if not textured:
        return Mesh.simple("hills", points, faces, colours=colours)
    pixels = np.zeros((64, 64, 3), dtype=np.uint8)
    pixels[..., 0] = np.linspace(0, 255, 64).astype(np.uint8)
    look = Material("surface", texture=Texture(pixels, np.zeros((64, 64), dtype=bool)))
    uv = np.stack([x.ravel() / 6.0, y.ravel() / 6.0], axis=1)
    return Mesh.simple("hills", points, faces, uv=uv, material=look)


@pytest.mark.parametrize("textured", [False, True])
def test_the_finest_pieces_are_the_mesh_and_plainer_ones_are_near_it(textured: bool) -> None:
    mesh = _hills(textured=textured)
    tree = levels_of(mesh, RULE)
    every = list(tree.all())
    finest = [one for one in every if not one.children]
    chosen = np.sort(np.concatenate([one.triangles for one in finest]))
    assert np.array_equal(chosen, np.arange(len(mesh.triangles)))
    truth = cKDTree(mesh.positions_m)
    for level in every:
        if level.plain is None:
            assert len(level.triangles) <= RULE.leaf_triangles
            assert level.error_m == 0.0
            continue
        assert len(level.plain.triangles) <= RULE.leaf_triangles
        assert all(child.error_m < level.error_m for child in level.children)
        off = np.abs(
            level.plain.positions_m[:, 2]
            - np.sin(level.plain.positions_m[:, 0]) * np.cos(level.plain.positions_m[:, 1])
        )
        assert np.quantile(off, 0.95) < 0.05
        _, nearest = truth.query(level.plain.positions_m)
        assert level.plain.colours is not None
        wanted = vertex_colours(mesh)[nearest].astype(float)
        assert np.abs(level.plain.colours - wanted).max() <= 8
        low, high = level.box
        points = level.plain.positions_m
        assert (points > low - 0.05).all()
        assert (points < high + 0.05).all()


def test_a_piece_has_its_own_vertices() -> None:
    mesh = _hills()
    piece = part_of(mesh, np.array([5, 900]))
    assert len(piece.positions_m) == 6
    own, whole = (m.positions_m[m.triangles[k]] for m, k in ((piece, 1), (mesh, 900)))
    assert np.array_equal(own, whole)


@pytest.mark.parametrize("textured", [False, True])
def test_tiles_are_named_in_the_place_and_complete(tmp_path: Path, textured: bool) -> None:
    place, shift = Place(title="hills"), np.eye(4)
    shift[:3, 3] = 10.0, 20.0, 1.5
    place.add(_hills(textured=textured), Standing(transform=shift))

    def make(work: Work) -> None:
        place.save(work.folder)
        write_tiles(work, next(iter(place.parts.values())))

    out = tmp_path / "out"
    call = VerbCall(command="dense", version="1", subject="a", options=Options(), inputs=[])
    assert run_verb(call, out, make, Progress(quiet=True)).exit_code == 0
    assert read_place(out / "place.json").tileset == f"{FOLDER}/{TILESET}"
    files = contents(out / FOLDER, TILESET)
    assert sum(name.endswith(".glb") for name in files) == 1  # 7,200 triangles are one piece
    assert textured == ("0.webp" in files)
    root = json.loads((out / FOLDER / TILESET).read_bytes())["root"]
    assert root["transform"][12:15] == [10.0, 20.0, 1.5]
    box = np.array(root["boundingVolume"]["box"])
    assert box[:3] == pytest.approx([3.0, 3.0, 0.0], abs=0.01)
    # The part is still there for exports.
    again = Place.load(out)
    assert len(again.untiled().parts) == 1
    again.write(tmp_path / "hills.obj")


def test_every_level_has_a_picture_of_its_own(tmp_path: Path) -> None:
    place = Place(title="hills")
    place.add(_hills(textured=True), Standing())
    rule = LevelParameters(leaf_triangles=2_000, picture_px=48)

    def make(work: Work) -> None:
        place.save(work.folder)
        write_tiles(work, next(iter(place.parts.values())), rule)

    out = tmp_path / "out"
    call = VerbCall(command="dense", version="1", subject="a", options=Options(), inputs=[])
    assert run_verb(call, out, make, Progress(quiet=True)).exit_code == 0
    files = contents(out / FOLDER, TILESET)
    tiles = sorted(Path(name).stem for name in files if name.endswith(".glb"))
    assert tiles == ["0", "00", "01", "02", "03"]
    for name in tiles:
        picture = np.asarray(Image.open(out / FOLDER / f"{name}.webp"))
        assert max(picture.shape) <= (48 if name == "0" else 64)
        red = picture[..., 0].astype(float)  # it grows to the right, as in the mesh's texture
        assert red[len(red) // 2, -6] > red[len(red) // 2, 6] + (180 if name == "0" else 60)
