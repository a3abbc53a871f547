"""Projects of CityEngine: where their rule files find what they name, in whatever encoding."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from veduta import _core
from veduta.grammar.assets.library import Library
from veduta.grammar.assets.primitives import primitive
from veduta.grammar.encodings import decoded
from veduta.grammar.otherwise import otherwise
from veduta.grammar.project import SearchPath, find_project, search_path
from veduta.grammar.project_files import project_files
from veduta.grammar.rules import RuleFiles, check_rules, compile_rules, read_rules
from veduta.grammar.textures import find_textures, read_textures
from veduta.run.errors import InputError

WEDGE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n"
LOT = [[(0.0, 0.0, 0.0), (10.0, 0.0, 0.0), (10.0, 8.0, 0.0), (0.0, 8.0, 0.0)]]


def write(path: Path, text: str | bytes) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project as CityEngine has it, in a folder that is not named as the project is."""
    root = tmp_path / "checkout"
    write(root / "assets/mod/win.obj", WEDGE)
    (root / "assets/tex").mkdir()
    Image.new("RGB", (8, 4), "red").save(root / "assets/tex/wall.png")
    write(root / "assets/data/heights.csv", "name,height\nhouse,9.5\n")
    write(root / "rules/common.cga", "Body --> extrude(6) A.")
    write(root / "rules/deep/house.cga", 'import C : "common.cga"\n@StartRule\nLot --> C.Body')
    return root


def derived(rules: RuleFiles) -> object:
    """The engine's columns of one lot."""
    compiled = compile_rules(rules)
    library = Library(rules.search)
    library.add_written_to(compiled)
    project_files(rules.search, compiled).add_to(compiled)
    (house,) = compiled.derive([LOT], [0])
    assert not isinstance(house, str), house
    return house


def test_a_project_is_found_by_its_folders(project: Path, tmp_path: Path) -> None:
    assert find_project(project / "rules/deep/house.cga") == project
    alone = write(tmp_path / "alone/rules/a.cga", "Lot --> NIL")
    assert find_project(alone) is None
    assert search_path(alone).folders == (alone.parent,)


def test_imports_are_looked_for_beside_a_file_and_in_the_rules_of_its_project(
    project: Path,
) -> None:
    rules = read_rules(project / "rules/deep/house.cga")
    assert [Path(name).name for name, _ in rules.files] == ["house.cga", "common.cga"]
    assert check_rules(rules).told == ""
    derived(rules)


@pytest.mark.parametrize("path", ["/Anything/rules/common.cga", "../common.cga", "..\\common.cga"])
def test_imports_by_paths_of_the_workspace_and_upwards(project: Path, path: str) -> None:
    text = f'import C : "{path}"\n@StartRule\nLot --> C.Body'.replace("\\", "\\\\")
    rules = read_rules(write(project / "rules/deep/other.cga", text))
    assert len(rules.files) == 2, path
    derived(rules)


def test_imports_that_begin_with_rules_are_found_without_a_project(tmp_path: Path) -> None:
    write(tmp_path / "plain/rules/parts/body.cga", "Body --> extrude(6) A.")
    write(tmp_path / "plain/secret.cga", "Body --> NIL")
    text = 'import C : "rules/parts/body.cga"\n@StartRule\nLot --> C.Body'
    rules = read_rules(write(tmp_path / "plain/rules/deep/house.cga", text))
    assert [Path(name).name for name, _ in rules.files] == ["house.cga", "body.cga"]
    derived(rules)
    outside = 'import C : "../../secret.cga"\nLot --> C.Body'
    assert len(read_rules(write(tmp_path / "plain/rules/deep/bad.cga", outside)).files) == 1


@pytest.mark.parametrize("path", ["rules/parts/body.cga", "parts/body.cga"])
def test_imports_from_the_rules_folder_are_found_by_short_names_too(
    tmp_path: Path, path: str
) -> None:
    """Towns are derived with names that do not depend on where the folder is."""
    write(tmp_path / "city/assets/none.txt", "")
    write(tmp_path / "city/rules/parts/body.cga", "Body --> extrude(6) A.")
    text = f'import C : "{path}"\n@StartRule\nLot --> C.Body'
    rules = read_rules(write(tmp_path / "city/rules/parts/house.cga", text))
    assert len(rules.texts) == 2
    assert not any(str(tmp_path) in name for name, _ in rules.texts)
    _core.GrammarRules(rules.texts, None)


def test_a_library_is_looked_in_where_the_call_names_it(project: Path, tmp_path: Path) -> None:
    write(tmp_path / "lib/ESRI.lib/rules/Trees.cga", "Tree --> extrude(3) T.")
    text = 'import T : "/ESRI.lib/rules/Trees.cga"\n@StartRule\nLot --> T.Tree'
    path = write(project / "rules/tree.cga", text)
    assert check_rules(read_rules(path)).errors == 1
    derived(read_rules(path, libraries=[tmp_path / "lib/ESRI.lib"]))
    with pytest.raises(InputError, match="--library"):
        read_rules(path, libraries=[tmp_path / "none"])


def test_nothing_is_read_outside_of_the_project(project: Path, tmp_path: Path) -> None:
    write(tmp_path / "secret.cga", "Body --> NIL")
    (project / "rules/link.cga").symlink_to(tmp_path / "secret.cga")
    for path in ("link.cga", "../../../secret.cga", str(tmp_path / "secret.cga")):
        text = f'import C : "{path}"\n@StartRule\nLot --> C.Body'
        rules = read_rules(write(project / "rules/bad.cga", text))
        assert len(rules.files) == 1, path
        assert check_rules(rules).errors >= 1


def test_imports_in_a_circle_end(project: Path) -> None:
    write(project / "rules/b.cga", 'import A : "a.cga"\nGo --> NIL')
    rules = read_rules(write(project / "rules/a.cga", 'import B : "b.cga"\nLot --> B.Go'))
    assert [Path(name).name for name, _ in rules.files] == ["a.cga", "b.cga"]
    verdict = check_rules(rules)
    assert verdict.errors == 2
    for place in ("a.cga:1:12", "b.cga:1:12"):
        assert f"{place}: error: this import leads back to this file" in verdict.told
    with pytest.raises(InputError, match="leads back to this file"):
        compile_rules(rules)


def test_assets_and_pictures_of_the_project_are_found(project: Path) -> None:
    text = 'Lot --> extrude(6) comp(f) { front : i("mod/win.obj") | all : texture("tex/wall.png") }'
    rules = read_rules(write(project / "rules/deep/a.cga", text))
    assert otherwise(rules, compile_rules(rules)) == []
    found = find_textures(rules.path, [text for _, text in rules.files], rules.search)
    assert read_textures(found)["tex/wall.png"].pixels.shape == (4, 8, 3)
    derived(rules)


def test_a_missing_asset_leaves_a_box_and_is_named_with_its_line(project: Path) -> None:
    text = 'Lot --> extrude(6)\n  comp(f) { front : i("mod/door.obj") | all : A. }'
    rules = read_rules(write(project / "rules/a.cga", text))
    (told,) = otherwise(rules, compile_rules(rules))
    assert "a.cga:2: asset mod/door.obj does not exist" in told
    assert "a box stands for it. Check the name" in told
    derived(rules)


@pytest.mark.parametrize(
    ("content", "encoding", "text"),
    [
        ("Straße – x".encode(), None, "Straße – x"),
        (b"\xef\xbb\xbfabc", None, "abc"),
        ("Straße – x".encode("cp1252"), "cp1252", "Straße – x"),
        ("Straße".encode("utf-16"), "UTF-16", "Straße"),
        (b"a\x81\xe9", "Latin-1", "a\x81é"),
    ],
)
def test_texts_are_read_in_the_encodings_of_people(
    content: bytes, encoding: str | None, text: str
) -> None:
    assert decoded(content) == (text, encoding)


def test_another_encoding_is_said(project: Path) -> None:
    content = "// Gebäude\n@StartRule\nLot --> extrude(6) A.".encode("cp1252")
    rules = read_rules(write(project / "rules/a.cga", content))
    assert rules.notes[0].endswith("a.cga: is not UTF-8, and was read as cp1252")
    derived(rules)


def test_files_of_the_project_answer_the_rules(project: Path) -> None:
    text = """const t = readFloatTable("data/heights.csv")
Lot --> extrude(t[1, 1]) texture(fileRandom("tex/*.png")) print(imageInfo("tex/wall.png", sx)) A."""
    rules = read_rules(write(project / "rules/a.cga", text))
    compiled = compile_rules(rules)
    files = project_files(rules.search, compiled)
    assert "tex/wall.png" in files.names
    assert files.pictures["tex/wall.png"] == (8.0, 4.0)
    assert files.texts["data/heights.csv"].startswith("name,height")
    assert files.digest() == project_files(rules.search, compiled).digest()
    house = derived(rules)
    assert house.positions_m[:, 2].max() == pytest.approx(9.5)  # type: ignore[attr-defined]


def test_rules_that_ask_for_no_files_list_none(project: Path) -> None:
    rules = read_rules(project / "rules/common.cga")
    assert project_files(rules.search, compile_rules(rules)).names == []


@pytest.mark.parametrize("name", ["cube", "quad", "disk", "cylinder", "cone", "sphere"])
def test_plain_bodies_fill_their_box(name: str) -> None:
    body = primitive(f"builtin:{name}")
    assert body is not None
    low, high = body.box_m
    np.testing.assert_allclose(low, [0.0, 0.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(high[:2], [1.0, 1.0], atol=1e-9)
    volumes = {"cube": 1.0, "cylinder": np.pi / 4, "cone": np.pi / 12, "sphere": np.pi / 6}
    if name in volumes:
        indices, _, _ = body.triangles
        a, b, c = (body.points_m[body.corners[indices[:, k]]] for k in range(3))
        volume = float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)
        assert volume == pytest.approx(volumes[name], rel=0.04)


def test_names_that_are_no_plain_bodies() -> None:
    assert primitive("builtin:cube:notex") is not None
    assert primitive("builtin:teapot") is None
    assert primitive("mod/cube.obj") is None


def test_an_asset_as_thin_as_a_rounding_error_is_flat(tmp_path: Path) -> None:
    text = "v 0 0 0\nv 1 0 1e-11\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
    asset = Library(SearchPath.of(write(tmp_path / "pane.obj", text).parent))["pane.obj"]
    assert np.ptp(asset.points_m[:, 2]) == 0.0
