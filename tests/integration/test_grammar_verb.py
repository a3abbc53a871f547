"""`veduta grammar` in a process of its own: what it makes, says and refuses."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from pathlib import Path
from typing import Any

import pytest
from command_line import command, items_done, read_json, refused, tree, veduta
from test_validators import validate_city, validate_gltf

from veduta.formats.tiles import contents

RULES = """
attr height = 6
@StartRule
Lot --> extrude(world.up, height + rand(2)) comp(f) { front : Front | all : Wall }
Front --> split(x) { { ~2 : Bay }* }
Bay --> split(x) { ~1 : Wall | 1 : set(material.name, "window") Window. | ~1 : Wall }
Wall --> set(material.name, "wall")
"""
ALL_FILES = {
    "place.json",
    "tileset.json",
    "city.city.json",
    "report.json",
    "report.html",
    "parts",
    ".veduta",
}


def lots_json(count: int, *, bad: bool = False) -> dict[str, Any]:
    features = []
    for number in range(count):
        x, y = 84_000.0 + 15 * (number % 20), 446_000.0 + 20 * (number // 20)
        ring = [[x, y], [x + 12, y], [x + 12, y + 10], [x, y + 10], [x, y]]
        if bad and number == 1:
            ring[1], ring[2] = ring[2], [x + 12, y - 4]
            ring[1] = [x - 5, y + 10]
        shape = {"type": "Polygon", "coordinates": [ring]}
        more = {"id": f"house {number}", "properties": {"height": 5 + number % 3}}
        features.append({"type": "Feature", "geometry": shape} | more)
    crs = {"type": "name", "properties": {"name": "EPSG:28992"}}
    return {"type": "FeatureCollection", "crs": crs, "features": features}


@pytest.fixture
def rules(tmp_path: Path) -> Path:
    path = tmp_path / "house.cga"
    path.write_text(RULES)
    return path


@pytest.fixture
def lots(tmp_path: Path) -> Path:
    path = tmp_path / "lots.geojson"
    path.write_text(json.dumps(lots_json(70)))
    return path


def test_one_command_makes_a_street(tmp_path: Path) -> None:
    out = tmp_path / "street"
    done = veduta("grammar", "derive", "haussmann", "-o", out)
    assert done.returncode == 0, done.stderr
    assert {path.name for path in out.iterdir()} == ALL_FILES | {"textures", "streets"}
    place = read_json(out / "place.json")
    assert len(place["parts"]) == 14 + 1  # the houses and the street
    for part in place["parts"]:
        issues = validate_gltf(out / part["model"])
        assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    report = read_json(out / "report.json")
    assert report["measures"]["built"] == 14
    assert report["measures"]["classes"]["door"] == 14
    for tile in contents(out):
        if tile.endswith(".glb"):
            issues = validate_gltf(out / tile)
            assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    city = validate_city(out / "city.city.json")
    assert (city["valid"], city["has_warnings"]) == (True, False), city["checks"]
    assert any("synthetic" in note for note in report["notes"])
    again = veduta("grammar", "derive", "haussmann", "-o", out).stdout
    assert "up to date" in again
    assert "earlier call" not in again  # its textures and ground are of this one


def test_lots_keep_their_place(tmp_path: Path, rules: Path, lots: Path) -> None:
    out = tmp_path / "out"
    call = ["grammar", "derive", rules, "--lots", lots, "--separate"]
    assert veduta(*call, "-o", out).returncode == 0
    place = read_json(out / "place.json")
    assert (place["crs"], place["origin"]) == ("EPSG:28992", [84_000.0, 446_000.0, 0.0])
    by_name = {part["name"]: part for part in place["parts"]}
    assert len(by_name) == 70
    part = by_name["house 45"]
    corner = [place["origin"][axis] + part["transform"][12 + axis] for axis in range(3)]
    assert corner == [84_000.0 + 15 * 5, 446_000.0 + 40, 0.0]
    assert part["bounds"]["min"] == [0.0, 0.0, 0.0]
    height = part["bounds"]["max"][2]
    assert 5 <= height <= 7  # its own height, 5, and up to 2


def test_the_same_on_one_core_and_two(tmp_path: Path, rules: Path, lots: Path) -> None:
    one, two = tmp_path / "one", tmp_path / "two"
    call = ["grammar", "derive", rules, "--lots", lots, "--seed", "7"]
    assert veduta(*call, "-o", one, "--jobs", "1").returncode == 0
    assert veduta(*call, "-o", two, "--jobs", "2").returncode == 0
    assert tree(one) == tree(two)
    other = tmp_path / "other"
    call[-1] = "8"
    assert veduta(*call, "-o", other).returncode == 0
    assert tree(other) != tree(one)


def test_out_that_exists(tmp_path: Path, rules: Path, lots: Path) -> None:
    out = tmp_path / "out"
    call = ["grammar", "derive", rules, "--lots", lots, "--separate", "-o", out]
    assert veduta(*call).returncode == 0
    before = tree(out)
    again = veduta(*call)
    assert (again.returncode, "up to date" in again.stdout) == (0, True)
    refused = veduta(*call, "--attr", "height=9")
    assert refused.returncode == 2
    assert "--force" in refused.stderr
    assert tree(out) == before
    edited = out / "parts" / "00" / "house-3.glb"
    edited.write_bytes(b"mine")
    forced = veduta(*call, "--attr", "height=9", "--force")
    assert forced.returncode == 0
    assert f"{edited}: was edited and is left as it is" in forced.stdout
    assert edited.read_bytes() == b"mine"
    assert tree(out)["parts/01/house-15.glb"] != before["parts/01/house-15.glb"]


def test_lots_that_fail_are_named(tmp_path: Path, rules: Path) -> None:
    lots = tmp_path / "lots.geojson"
    lots.write_text(json.dumps(lots_json(3, bad=True)))
    out = tmp_path / "out"
    done = veduta("grammar", "derive", rules, "--lots", lots, "-o", out)
    assert done.returncode == 3
    assert f"error: {lots}: feature 2 (house 1): its outline crosses itself" in done.stderr
    assert [part["id"] for part in read_json(out / "place.json")["parts"]] == ["house-0", "house-2"]
    (failure,) = read_json(out / "report.json")["failures"]
    assert "house 1" in failure["subject"]


def test_rules_that_run_away_are_stopped(tmp_path: Path, lots: Path) -> None:
    endless = tmp_path / "endless.cga"
    endless.write_text("Lot --> [ Lot ] Lot\n")
    lots.write_text(json.dumps(lots_json(2)))
    out = tmp_path / "out"
    done = veduta("grammar", "derive", endless, "--lots", lots, "-o", out, "--seconds", "1")
    assert done.returncode == 2
    assert "2 lots (house 0, house 1): " in done.stderr
    assert "deep" in done.stderr or "longer" in done.stderr
    assert not (out / "place.json").exists()


def bad_calls(folder: Path) -> dict[str, tuple[list[object], str]]:
    (folder / "good.cga").write_text(RULES)
    (folder / "bad.cga").write_text("Lot --> extrud(3)")
    (folder / "empty.geojson").write_text('{"type": "FeatureCollection", "features": []}')
    good = folder / "good.cga"
    derive: list[object] = ["derive", good, "-o", folder / "out"]
    return {
        "action": (["derve"], "Did you mean `derive`?"),
        "no rules": (["derive", folder / "none.cga", "-o", folder / "out"], "Check its name."),
        "style": (["derive", "hausman", "-o", folder / "out"], "Did you mean `haussmann`?"),
        "fault": (["derive", folder / "bad.cga", "-o", folder / "out"], "did you mean `extrude`?"),
        "no lots": ([*derive, "--lots", folder / "none.geojson"], "Check its name."),
        "empty": ([*derive, "--lots", folder / "empty.geojson"], "Give it polygons."),
        "rules as lots": ([*derive, "--lots", good], "It has rules: name it before --lots"),
        "attribute": ([*derive, "--attr", "heigth=3"], "Did you mean `height`?"),
        "value": ([*derive, "--attr", "height=high"], "Give a number"),
        "start": ([*derive, "--start", "Lott"], "Did you mean `Lot`?"),
        "seed": ([*derive, "--seed", "x"], "Give a whole number"),
        "jobs": ([*derive, "--jobs", "0"], "Give 1 or more."),
        "format": (["format", folder / "bad2.cga"], "Check its name."),
        "several": (["format", good, good], "Give one, or --write."),
    }


def test_bad_use_is_told_with_a_remedy(tmp_path: Path) -> None:
    for name, (arguments, remedy) in bad_calls(tmp_path).items():
        done = refused("grammar", *arguments)
        assert done.returncode == 2, (name, done.stderr)
        assert remedy in done.stderr, (name, done.stderr)
        assert "Traceback" not in done.stderr
        assert not (tmp_path / "out").exists(), name


def test_check_shows_all_faults(tmp_path: Path, rules: Path) -> None:
    good = veduta("grammar", "check", rules)
    assert (good.returncode, good.stdout) == (0, f"{rules}: 0 errors, 0 warnings\n")
    rules.write_text("Lot --> extrud(3) A\nA --> splt(x) { 1 : NIL }\n")
    bad = veduta("grammar", "check", rules)
    assert bad.returncode == 2
    assert bad.stdout.count(": error: there is no operation") == 2
    assert f"{rules}: 2 errors" in bad.stdout
    assert veduta("grammar", "check", "haussmann").returncode == 0


def test_format_prints_and_rewrites(tmp_path: Path) -> None:
    path = tmp_path / "a.cga"
    path.write_text("Lot-->extrude( 3 )  A.\n")
    assert veduta("grammar", "format", path).stdout == "Lot --> extrude(3) A.\n"
    assert path.read_text() == "Lot-->extrude( 3 )  A.\n"
    assert "rewritten" in veduta("grammar", "format", path, "--write").stdout
    assert path.read_text() == "Lot --> extrude(3) A.\n"
    assert veduta("grammar", "format", path, "--write").stdout == ""
    path.write_text("Lot --> extrude(")
    assert veduta("grammar", "format", path, "--write").returncode == 2


@pytest.fixture(scope="module")
def long_call(tmp_path_factory: pytest.TempPathFactory) -> list[object]:
    """What works for some seconds, but for its OUT."""
    lots = tmp_path_factory.mktemp("long") / "lots.geojson"
    lots.write_text(json.dumps(lots_json(96)))
    return ["grammar", "derive", "haussmann", "--lots", lots, "--separate", "-o"]


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory: pytest.TempPathFactory, long_call: list[object]) -> dict[str, bytes]:
    """What it makes where nobody stops it."""
    out = tmp_path_factory.mktemp("unbroken") / "out"
    assert veduta(*long_call, out).returncode == 0
    return tree(out)


@pytest.mark.slow
def test_killed_in_the_middle(
    tmp_path: Path, long_call: list[object], unbroken: dict[str, bytes]
) -> None:
    """Of a signal that is heard, the one way for all verbs is tested in `test_interrupted.py`."""
    out = tmp_path / "out"
    run = subprocess.Popen(command(*long_call, out), stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + 120
        while not items_done(out):
            assert time.monotonic() < deadline
            time.sleep(0.02)
        run.send_signal(signal.SIGKILL)
        _, error = run.communicate(timeout=60)
    finally:
        run.kill()
        run.wait()
    assert run.returncode == -signal.SIGKILL
    assert "Traceback" not in error
    there = {path: path.stat().st_mtime_ns for path in out.glob("parts/*/*.glb")}
    assert there
    # Whole blocks, or nothing of them.
    assert all((path.parent / "tiles" / "tileset.json").is_file() for path in there)
    # A block that was in place but not yet in the record is the work in hand, and made again.
    recorded = {out / name for name in items_done(out)}
    done = {path: stamp for path, stamp in there.items() if path.parent in recorded}
    assert done
    again = veduta(*long_call, out)
    assert again.returncode == 0, again.stderr
    assert done.items() <= {p: p.stat().st_mtime_ns for p in out.glob("parts/*/*.glb")}.items()
    assert tree(out) == unbroken
    assert set(os.listdir(out / ".veduta")) == {"run.json", "lock"}
