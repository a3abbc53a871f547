"""`check` and `derive` say the same of a rule file, with the same exit code."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.cli.main import main

REFUSED = {
    "text": ('Lot --> extrude("high")', "main.cga:1:17: a number is needed"),
    "nothing": ("Lot --> NIL", "the rules leave nothing on it"),
    "late": ("Lot --> extrude(3) comp(f) { side : Wall(\"wide\") | all : A. }\n"
             "Wall(n) --> split(x) { n : A. }", "main.cga:2:"),
    "reached": ("Lot --> boxx(3)", "there is no operation or rule `boxx`"),
    "branch": ("Lot --> case 1 < 2 : boxx(3) else : A.", "there is no operation or rule `boxx`"),
}  # fmt: skip
TAKEN = {
    "unreached": ("Lot --> extrude(3)\nOld --> boxx(3)", "main.cga:2:9: "),
    "import": ('import old : "old.cga"\nLot --> extrude(3)\nOld --> old.Lot', "main.cga:1:14: "),
    "constant": ('import old : "old.cga"\nconst h = old.h\nLot --> extrude(3)', "main.cga:1:14: "),
    "branch": ("Lot --> case 1 > 2 : boxx(3) else : extrude(3)", "main.cga:1:22: "),
    "computed": ('Lot --> extrude(3) comp(f) { side : i("win" + "dow.obj") | all : A. }',
                 "window.obj"),
}  # fmt: skip


def both(text: str, folder: Path, *more: str) -> tuple[int, int]:
    """The exit codes of `check` and `derive`."""
    path = folder / "main.cga"
    path.write_text(text + "\n")
    words = [str(path), *more]
    checked = main(["grammar", "check", *words])
    return checked, main(["grammar", "derive", *words, "-o", str(folder / "out"), "--jobs", "1"])


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_derived_is_refused(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, told = REFUSED[name]
    assert both(text, tmp_path) == (2, 2)
    said = capsys.readouterr()
    assert told in said.out, said.out  # check
    assert told in said.err, said.err  # derive


@pytest.mark.parametrize("name", TAKEN)
def test_what_nothing_reaches_is_told(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text, told = TAKEN[name]
    assert both(text, tmp_path) == (0, 0)
    checked, derived = capsys.readouterr().out.split("main.cga: 0 errors, ")
    assert told in checked
    assert told in derived


def test_a_library_is_checked_and_begins_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its rules are fine, each with arguments for who imports it: only deriving needs a start."""
    assert both("Wall(h) --> extrude(h)", tmp_path) == (0, 2)
    said = capsys.readouterr()
    assert "nothing was derived: its rules are checked alone" in said.out
    assert 'write --start "Wall(' in said.err
    assert both("Wall(h) --> boxx(h)", tmp_path)[0] == 2
    assert both("/* older:\nWall --> old */\nWall(h) --> extrude(h)", tmp_path)[0] == 0
    assert both("// to be written", tmp_path) == (2, 2)


def test_a_start_rule_with_arguments_is_tried_with_them(tmp_path: Path) -> None:
    text = "Lot(h) --> extrude(h)\nBad --> boxx(3)\nTwo(n) --> boxx(n)"
    for start, code in (("Lot(3)", 0), ("Bad", 2), ("Two(3)", 2), ("Lot", 2)):
        assert both(text, tmp_path, "--start", start) == (code, code), start


def test_rules_of_other_lots_are_tried_on_those(tmp_path: Path) -> None:
    lots = tmp_path / "lots.geojson"
    ring = "[[2.0,48.0],[2.0001,48.0],[2.0001,48.0001],[2.0,48.0001],[2.0,48.0]]"
    lots.write_text(
        '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":"tall"},'
        f'"geometry":{{"type":"Polygon","coordinates":[{ring}]}}}}]}}'
    )
    text = "attr height = 3\nLot --> extrude(height)"
    assert both(text, tmp_path) == (0, 0)
    (tmp_path / "other").mkdir()
    assert both(text, tmp_path / "other", "--lots", str(lots)) == (2, 2)


def test_a_tree_begins_where_it_is_told_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A fault that the rule asked for never reaches refuses none of the three."""
    path = tmp_path / "main.cga"
    path.write_text("Lot --> boxx(3)\nGood --> extrude(3) A.\n")
    assert main(["grammar", "check", str(path), "--start", "Good"]) == 0
    assert main(["grammar", "tree", str(path), "--start", "Good"]) == 0
    assert "A" in capsys.readouterr().out
    assert main(["grammar", "tree", str(path)]) == 2
