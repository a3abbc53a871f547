"""`veduta grammar sample | tree | derive --edits` in processes of their own, and other lots."""

from __future__ import annotations

from pathlib import Path

import pytest
from command_line import read_json, tree, veduta
from PIL import Image
from rows_of_houses import write_row

RULES = """
attr height = 50% : 6 else : 9
@StartRule
Lot --> extrude(world.up, height) comp(f) { front : Front | all : Wall }
Front --> split(x) { { ~2 : Bay }* }
Bay --> 50% : Wall else : split(x) { ~1 : Wall | 1 : Window | ~1 : Wall }
Window --> set(material.name, "window")
Wall --> set(material.name, "wall")
style Low
attr height = 2
"""


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "house.cga"
    path.write_text(RULES)
    return path


@pytest.fixture
def lots(tmp_path: Path) -> Path:
    path = tmp_path / "lots.geojson"
    write_row(path, 3)
    return path


def test_a_sheet_of_samples(tmp_path: Path, rules: Path) -> None:
    sheet = tmp_path / "sheet.png"
    call = ["grammar", "sample", rules, "-n", "3", "--width", "120", "--rays", "1"]
    done = veduta(*call, "-o", sheet)
    assert done.returncode == 0, done.stderr
    assert [line.split(":")[0] for line in done.stdout.splitlines()[:3]] == [
        "seed 0",
        "seed 1",
        "seed 2",
    ]
    with Image.open(sheet) as image:
        assert image.width > 2 * 120
    first = sheet.read_bytes()
    assert veduta(*call, "-o", sheet, "--quiet").stdout == ""
    assert sheet.read_bytes() == first
    photo = tmp_path / "sheet.jpg"
    both = ["-n", "1", "--colours", "both", "--seed", "9"]
    assert veduta(*call, *both, "-o", photo).returncode == 0
    with Image.open(photo) as image:
        assert image.format == "JPEG"


def test_a_tree_as_text_and_drawing(tmp_path: Path, rules: Path, lots: Path) -> None:
    call = ["grammar", "tree", rules, "--lots", lots, "--lot", "house-1"]
    done = veduta(*call)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0].startswith("house on the lot house-1, seed 0: ")
    assert lines[1].startswith("attributes: height ")
    assert lines[3].split()[-1] == "/:Lot"
    assert any("of 2: 50 %]" in line for line in lines)
    part = veduta(*call, "--at", "/0", "--depth", "1").stdout.splitlines()[3:]
    assert part[0].split()[-1] == "/0:Front"
    drawing, text = tmp_path / "tree.svg", tmp_path / "tree.txt"
    assert veduta(*call, "-o", drawing).returncode == 0
    assert drawing.read_text("utf-8").startswith("<svg ")
    assert veduta(*call, "-o", text).returncode == 0
    assert text.read_text("utf-8") == done.stdout


def test_edits_change_one_lot_and_no_other(tmp_path: Path, rules: Path, lots: Path) -> None:
    plain, changed = tmp_path / "plain", tmp_path / "changed"
    call = ["grammar", "derive", rules, "--lots", lots]
    assert veduta(*call, "-o", plain).returncode == 0
    edits = tmp_path / "edits.txt"
    edits.write_text("house-1 /:Lot height = 30\nhouse-1 /0/1:Bay choice 1 = 2\n")
    done = veduta(*call, "-o", changed, "--edits", edits)
    assert done.returncode == 0, done.stderr
    bounds = {p["id"]: p["bounds"]["max"][2] for p in read_json(changed / "place.json")["parts"]}
    assert bounds["house-1"] == 30
    before, after = tree(plain), tree(changed)
    assert before["parts/00/house-0.glb"] == after["parts/00/house-0.glb"]
    assert before["parts/00/house-1.glb"] != after["parts/00/house-1.glb"]
    again = veduta(*call, "-o", changed, "--edits", edits)
    assert "up to date" in again.stdout
    told = veduta("grammar", "tree", rules, "--lots", lots, "--lot", "house-1", "--edits", edits)
    assert "[2 of 2: 50 %]" in told.stdout


def test_a_tree_sees_the_edits_of_the_lots_beside_it(tmp_path: Path) -> None:
    """The wall to the neighbour is hidden by it, unless an edit makes it lower than that wall."""
    rules, lots, edits = (tmp_path / name for name in ("a.cga", "lots.geojson", "edits.txt"))
    rules.write_text(
        """attr height = 6
        Lot --> extrude(height) comp(f) { side : Wall }
        Wall --> case inside(inter) : Party. else : Free."""
    )
    write_row(lots, 2, every_m=12)
    edits.write_text("house-1 /:Lot height = 2\n")
    call = ["grammar", "tree", rules, "--lots", lots, "--lot", "house-0"]
    plain = veduta(*call)
    assert plain.stdout.count(":Party") == 1, plain.stdout + plain.stderr
    assert veduta(*call, "--edits", edits).stdout.count(":Party") == 0


def test_edits_that_cannot_be_done_are_told(tmp_path: Path, rules: Path, lots: Path) -> None:
    edits = tmp_path / "edits.txt"
    edits.write_text("house-0 /0/77:Bay delete\nhouse-2 /0/0:Door delete\n")
    out = tmp_path / "out"
    call = ["grammar", "derive", rules, "--lots", lots, "-o", out, "--edits", edits]
    done = veduta(*call)
    assert done.returncode == 3
    assert f"{edits}:1: the edit of /0/77:Bay cannot be done: there is no such shape" in done.stderr
    assert f"{edits}:2: the edit of /0/0:Door cannot be done: it is no `Door`" in done.stderr
    assert [part["id"] for part in read_json(out / "place.json")["parts"]] == ["house-1"]
    edits.write_text("house-9 /0:Front delete\n")
    done = veduta(*call)
    assert done.returncode == 2
    assert "line 1 edits the lot `house-9`, which is not there. Did you mean" in done.stderr


def test_a_style_of_the_file(tmp_path: Path, rules: Path, lots: Path) -> None:
    out = tmp_path / "out"
    done = veduta("grammar", "derive", rules, "--lots", lots, "-o", out, "--style", "Low")
    assert done.returncode == 0, done.stderr
    assert {p["bounds"]["max"][2] for p in read_json(out / "place.json")["parts"]} == {2.0}
