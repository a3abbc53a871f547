"""The door of the library: what it has, that it is light, and that type checkers know it."""

from __future__ import annotations

import ast
import gc
import importlib
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import veduta
from veduta.facade.options import FacadeOptions
from veduta.grammar import parse
from veduta.place.place import Place
from veduta.run.errors import InputError
from veduta.run.flat import options_of
from veduta.walk.command import Sources

CACHE = Path(__file__).resolve().parents[2] / ".mypy_cache" / "script"
"""Kept, as all that numpy and pydantic declare is read."""
SCRIPT = """
from pathlib import Path

import veduta
from veduta import Mesh, Place, Provenance, SemanticClass, Standing, grammar

place: Place = veduta.load("out")
for part in place.parts.values():
    vertices, triangles = part.triangles()
    print(part.standing.name, vertices.shape, triangles.shape, part.content.features.id)
place.merge(veduta.read_facade("a.jpg", height_m=12.0)).write(Path("x.obj"))
house: Place = veduta.read_plan(["a.png"], "out")
town: Place = veduta.derive("haussmann", "lots.geojson", seed=3, attributes={"a": 1.0})
cameras = veduta.locate_photos("photos").cameras
made = grammar.derive(grammar.parse("Lot --> extrude(10)"), [[(0, 0), (1, 0), (1, 1)]])
made.place().save("out")
first: float = cameras[0].focal_px[0]
reveal_type(town)
"""


def test_what_is_named_is_there() -> None:
    for name in veduta.__all__:
        assert getattr(veduta, name) is not None
        assert name in dir(veduta)
    assert veduta.Place is Place
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = veduta.nothing


def test_each_late_name_is_told_to_type_checkers() -> None:
    """The two lists of `veduta/__init__.py` say the same."""
    tree = ast.parse(Path(veduta.__file__).read_text("utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    told = {
        alias.name: node.module
        for node in block.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    late = {
        name: f"veduta.{module}" if module else "veduta" for name, module in veduta._LATE.items()
    }
    assert told == late
    assert set(veduta.__all__) == {*late, "__version__"}


def test_importing_it_brings_nothing_heavy() -> None:
    code = "import sys, veduta; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    assert not loaded & {"numpy", "pydantic", "scipy", "veduta._core", "veduta.place"}


def test_a_strict_type_checker_passes_a_script_that_uses_it(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(CACHE), script.name],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert 'Revealed type is "veduta.place.place.Place"' in done.stdout
    assert (Path(veduta.__file__).parent / "py.typed").is_file()


def test_rules_are_read_from_text() -> None:
    rules = parse('Lot --> extrude(10) set(material.name, "wall")')
    assert rules.starts == ["Lot"]
    with pytest.raises(InputError, match=r"rules\.cga: has faults(?s:.*)rules\.cga:2:"):
        parse("Lot --> extrude(10)\nFloor --> Lot(")
    with pytest.raises(InputError, match="neither a file nor a style"):
        parse("nothing-of-the-kind")


def test_options_are_given_by_their_plain_names() -> None:
    options = options_of(FacadeOptions, {"height_m": 12.5, "rectified": True, "depth_m": 8.0})
    assert options.scale.height_m == 12.5
    assert options.rectify.rectified
    assert options.model.depth_m == 8.0
    with pytest.raises(InputError, match=r"hight_m: is no option .* Did you mean height_m\?"):
        options_of(FacadeOptions, {"hight_m": 3.0})
    with pytest.raises(InputError, match=r"height_m: .*greater than or equal to 2"):
        options_of(FacadeOptions, {"height_m": 0.5})


def test_a_result_without_a_folder_goes_with_its_place(tmp_path: Path) -> None:
    rules = tmp_path / "box.cga"
    rules.write_text('Lot --> extrude(10) set(material.name, "wall")')
    place = veduta.derive(rules, seed=1)
    folder = place.folder
    assert folder is not None
    assert folder.is_dir()
    assert len(place.parts) > 1
    del place
    gc.collect()
    assert not folder.exists()


def test_what_is_wrong_is_named(tmp_path: Path) -> None:
    (tmp_path / "photo.jpg").write_text("no picture")
    with pytest.raises(InputError, match=r"photo\.jpg"):
        veduta.read_facade(tmp_path / "photo.jpg")
    with pytest.raises(InputError, match=r"none\.png: does not exist"):
        veduta.read_plan(tmp_path / "none.png")
    with pytest.raises(InputError, match="there is no such folder"):
        veduta.load(tmp_path / "none")


@pytest.mark.parametrize(
    "name", ["carve_photos", "measure_photos", "read_animal", "read_drive", "read_walk"]
)
def test_records_that_are_not_there_are_named(name: str, tmp_path: Path) -> None:
    function = getattr(veduta, name)
    with pytest.raises(InputError) as told:
        function(tmp_path / "nowhere")
    assert "nowhere" in told.value.subject
    with pytest.raises(InputError, match="is no option of this verb"):
        function(tmp_path, no_such_option=1)


class _Reached(Exception):
    """What a run was called with."""


@pytest.mark.parametrize(
    ("function", "run", "given", "reached"),
    [
        ("read_walk", "walk.door:run_walk", {"calibration": "c"}, {"sources": Sources(Path("c"))}),
        ("measure_photos", "dense.door:run_dense", {"images": "i"}, {"images": Path("i")}),
        (
            "derive",
            "grammar.door:run_derive",
            {"edits": "e", "project": "p", "libraries": ["a", "b"]},
            {
                "edits_path": Path("e"),
                "project": Path("p"),
                "libraries": [Path("a"), Path("b")],
            },
        ),
    ],
)
def test_files_besides_the_record_reach_the_run(
    function: str,
    run: str,
    given: dict[str, Any],
    reached: dict[str, Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    module, name = run.split(":")

    def fake(*_: object, **named: object) -> None:
        raise _Reached(named)

    monkeypatch.setattr(importlib.import_module(f"veduta.{module}"), name, fake)
    with pytest.raises(_Reached) as told:
        getattr(veduta, function)("record", **given)
    (named,) = told.value.args
    assert reached.items() <= named.items()


def test_files_besides_the_footage_reach_the_run(monkeypatch: pytest.MonkeyPatch) -> None:
    door = importlib.import_module("veduta.fauna.door")

    def fake(record: object, *_: object, **__: object) -> None:
        raise _Reached(record)

    monkeypatch.setattr(door, "run_fauna", fake)
    with pytest.raises(_Reached) as told:
        veduta.read_animal("f", masks="m", background="b", place="p", path="w")
    assert told.value.args == (door.Record(*map(Path, ("f", "m", "b", "p", "w"))),)
