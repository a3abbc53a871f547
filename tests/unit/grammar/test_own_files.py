"""Imported rule files that name their pictures and assets alike: each wears its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta.formats.gltf import read_glb
from veduta.grammar.options import GrammarOptions, OutputOptions
from veduta.grammar.pipeline import run_derive
from veduta.grammar.rules import read_rules
from veduta.grammar.textures import missing_textures
from veduta.run.progress import Progress

COLOURS = {"left": (200, 20, 20), "right": (20, 200, 20)}
FACADE = """
Lot --> extrude(4) comp(f) { front : Front | all : NIL }
Front --> setupProjection(0, scope.xy, '1, '1) projectUV(0) texture("pictures/wall.png") Sign
Sign --> [ Wall. ] [ t('0.4, '0.4, 1) s(2, 1, 0.5) i("sign.obj") Sign. ] // "pictures/wall.png"
"""
TOWN = """
import left : "left/facade.cga"
import right : "right/facade.cga"
Lot --> split(x) { '0.5 : left.Lot | '0.5 : right.Lot }
"""
PYRAMID = "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"
QUAD = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


@pytest.fixture
def town(tmp_path: Path) -> Path:
    for side, colour in COLOURS.items():
        (tmp_path / side / "pictures").mkdir(parents=True)
        (tmp_path / side / "facade.cga").write_text(FACADE)
        pixels = np.full((8, 8, 3), colour, dtype=np.uint8)
        Image.fromarray(pixels).save(tmp_path / side / "pictures" / "wall.png")
        (tmp_path / side / "sign.obj").write_text(PYRAMID if side == "left" else QUAD)
    rules = tmp_path / "town.cga"
    rules.write_text(TOWN)
    return rules


def test_each_facade_wears_its_own_picture_and_sign(town: Path) -> None:
    options = GrammarOptions(output=OutputOptions(separate=True))
    out = town.parent / "out"
    result = run_derive(str(town), None, out, options, Progress(quiet=True), jobs=1)
    assert result.exit_code == 0
    part = read_glb(sorted(out.glob("parts/**/*.glb"))[0])
    seen = [one.texture.pixels[0, 0] for one in part.materials if one.texture is not None]
    assert len(seen) == 2
    for colour in COLOURS.values():
        assert any(np.abs(one.astype(int) - colour).max() <= 6 for one in seen), seen


def test_names_lead_to_what_lies_beside_the_file_that_writes_them(town: Path) -> None:
    rules = read_rules(town)
    texts = {Path(name).parent.name: text for name, text in rules.files}
    for side in COLOURS:
        search = rules.search
        written = {"left": "pictures/wall.png", "right": "right/pictures/wall.png"}[side]
        assert f'texture("{written}")' in texts[side]
        assert search.find(written) == town.parent / side / "pictures" / "wall.png"
    assert '// "pictures/wall.png"' in texts["right"]  # a comment stays as it is


def test_what_only_the_main_file_has_is_found_there(town: Path) -> None:
    (town.parent / "pictures").mkdir()
    (town.parent / "right/pictures/wall.png").rename(town.parent / "pictures/wall.png")
    texts = {Path(name).parent.name: text for name, text in read_rules(town).files}
    assert 'texture("pictures/wall.png")' in texts["right"]
    assert 'texture("left/pictures/wall.png")' in texts["left"]


def test_a_link_out_of_the_folders_is_not_followed(
    town: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    outside = tmp_path_factory.mktemp("outside") / "wall.png"
    (town.parent / "right/pictures/wall.png").rename(outside)
    (town.parent / "right/pictures/wall.png").symlink_to(outside)
    rules = read_rules(town)
    assert 'texture("right/pictures/wall.png")' in dict(rules.texts)["right/facade.cga"]
    assert rules.search.find("right/pictures/wall.png") is None


def test_a_facade_without_its_picture_does_not_wear_another(town: Path) -> None:
    (town.parent / "right/pictures/wall.png").unlink()
    rules = read_rules(town)
    texts = {Path(name).parent.name: text for name, text in rules.files}
    assert 'texture("right/pictures/wall.png")' in texts["right"]
    assert rules.search.find("right/pictures/wall.png") is None
    (told,) = missing_textures(rules.path, rules.files, rules.search)
    assert "right/facade.cga:3: no picture `right/pictures/wall.png`" in told


def test_what_lies_beside_files_that_a_file_imports_is_seen(town: Path) -> None:
    facade = town.parent / "right/facade.cga"
    facade.write_text('import other : "../left/facade.cga"\n' + facade.read_text())
    (town.parent / "right/pictures/wall.png").unlink()
    texts = {Path(name).parent.name: text for name, text in read_rules(town).files}
    assert 'texture("pictures/wall.png")' in texts["right"]
