"""The pictures that rule files name: found below their folder alone, and shown."""

from __future__ import annotations

from collections import OrderedDict
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta import _core
from veduta.formats.gltf import read_glb, write_glb
from veduta.grammar import textures
from veduta.grammar.building import build_part
from veduta.grammar.options import GrammarOptions, OutputOptions
from veduta.grammar.pipeline import run_derive
from veduta.grammar.textures import (
    find_textures,
    missing_textures,
    read_textures,
    textures_digests,
)
from veduta.run.errors import InputError
from veduta.run.progress import Progress

SQUARE = [[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 6.0, 0.0), (0.0, 6.0, 0.0)]]
RULES = """
Lot --> extrude(world.up, 5) comp(f) { front : Front | all : NIL }
Front --> setupProjection(0, scope.xy, 5, 5, 0, 0) projectUV(0) texture("brick.png")
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    rules = tmp_path / "rules"
    (rules / "deep").mkdir(parents=True)
    pixels = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)
    for path in ("brick.png", "deep/stone.png", "../outside.png"):
        Image.fromarray(pixels).save(rules / path)
    (rules / "link.png").symlink_to(tmp_path / "outside.png")
    return rules


def test_pictures_below_the_folder_are_found(folder: Path) -> None:
    outside = (folder.parent / "outside.png").as_posix()
    names = ["brick.png", "deep/stone.png", "../outside.png", "link.png", outside, "none.png"]
    texts = [f'const a = "{name}"' for name in names]
    assert list(find_textures(folder / "a.cga", texts)) == ["brick.png", "deep/stone.png"]


def test_pictures_that_are_not_there_are_told_with_their_line(folder: Path) -> None:
    text = """// texture("a.png")
/* texture("b.png")
*/ # texture("c.png")
Lot --> texture("brick.png") print("texture(") texture("") texture("builtin/textures/brick")
  texture( "none.png" ) texture("d" + ".png") X
X --> texture("deep/stone.png") texture("no picture")
"""
    told = missing_textures(folder / "a.cga", [("a.cga", text)])
    where = "lies where a.cga or its project has pictures"
    assert told == [
        f"a.cga:5: no picture `none.png` {where}",
        f"a.cga:6: no picture `no picture` {where}",
    ]


def test_deriving_tells_the_pictures_that_are_not_there(tmp_path: Path) -> None:
    rules = tmp_path / "a.cga"
    rules.write_text('Lot --> extrude(5)\n  texture("none.png") House.')
    options = GrammarOptions(output=OutputOptions(city=False))
    result = run_derive(str(rules), None, tmp_path / "out", options, Progress(quiet=True), jobs=1)
    assert result.exit_code == 0
    told = "a.cga:2: no picture `none.png` lies where a.cga or its project has pictures"
    assert f"{tmp_path / told}: the plain colour is seen" in result.notes


def test_too_many_pictures_are_refused(folder: Path) -> None:
    for number in range(257):
        (folder / f"{number}.png").touch()
    text = " ".join(f'"{number}.png"' for number in range(257))
    with pytest.raises(InputError, match="more than 256 pictures"):
        find_textures(folder / "a.cga", [text])


def test_a_picture_that_is_none_is_refused(folder: Path) -> None:
    (folder / "torn.jpg").write_bytes(b"no picture")
    with pytest.raises(InputError, match=r"torn\.jpg"):
        read_textures(find_textures(folder / "a.cga", ['"torn.jpg"']))


def test_pictures_are_kept_up_to_so_many_bytes(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each is 4 x 6 pixels of three colours and a mark: 96 bytes."""
    names = [f"{number}.png" for number in range(4)]
    for name in names:
        (folder / name).write_bytes((folder / "brick.png").read_bytes())
    files = find_textures(folder / "a.cga", [" ".join(f'"{name}"' for name in names)])
    monkeypatch.setattr(textures, "_KEPT", OrderedDict())
    monkeypatch.setattr(textures, "MAX_KEPT", 2 * 96)
    shown = read_textures(files)
    assert [Path(path).name for path, _, _ in textures._KEPT] == names[2:]
    assert shown["2.png"] is shown["2.png"]
    assert shown["0.png"].pixels.shape == (4, 6, 3)
    assert [Path(path).name for path, _, _ in textures._KEPT] == ["2.png", "0.png"]
    monkeypatch.setattr(textures, "MAX_KEPT", 1)
    assert shown["3.png"] is shown["3.png"]
    assert len(textures._KEPT) == 1


def test_a_mask_beside_a_picture_marks_what_is_invented(folder: Path) -> None:
    files = find_textures(folder / "a.cga", ['"deep/stone.png"'])
    assert not read_textures(files)["deep/stone.png"].invented.any()
    before = textures_digests(files)
    white = np.zeros((4, 6), dtype=np.uint8)
    white[1, 2:4] = 255
    mask = folder / "deep" / "stone.invented.png"
    Image.fromarray(white).save(mask)
    assert textures_digests(files) != before
    found = read_textures(files)["deep/stone.png"].invented
    assert np.array_equal(found, white > 0)


def test_a_mask_of_another_size_is_refused(folder: Path) -> None:
    Image.fromarray(np.zeros((2, 2), dtype=np.uint8)).save(folder / "brick.invented.png")
    with pytest.raises(InputError, match=r"brick\.invented\.png"):
        read_textures(find_textures(folder / "a.cga", ['"brick.png"']))


def test_a_texture_is_shown_from_its_lower_left(folder: Path, tmp_path: Path) -> None:
    (found,) = _core.GrammarRules([("a.cga", RULES)]).derive([SQUARE], [0])
    assert not isinstance(found, str)
    textures = read_textures(find_textures(folder / "a.cga", [RULES]))
    part = build_part(found, "lot", textures=textures)
    (material,) = part.materials
    assert material.texture is textures["brick.png"]
    assert part.notes == ()
    # Tiles of 5 m: u runs along the street, and glTF's v down from the top of the lowest tile.
    np.testing.assert_allclose(part.uv[:, 0], part.positions_m[:, 0] / 5.0, atol=1e-6)
    np.testing.assert_allclose(part.uv[:, 1], 1.0 - part.positions_m[:, 2] / 5.0, atol=1e-6)
    write_glb(part, tmp_path / "lot.glb")
    again = read_glb(tmp_path / "lot.glb")
    assert again.materials[0].texture is not None
    assert b'"wrapS":10497' in (tmp_path / "lot.glb").read_bytes()


def test_a_texture_that_is_not_there_is_told() -> None:
    (found,) = _core.GrammarRules([("a.cga", RULES)]).derive([SQUARE], [0])
    assert not isinstance(found, str)
    part = build_part(found, "lot")
    assert part.materials[0].texture is None
    assert any("brick.png" in note for note in part.notes)
