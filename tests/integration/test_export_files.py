"""`veduta export OUT FILE` and `--to`: what it writes, says and refuses."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from command_line import command, refused
from test_validators import validate_gltf

from veduta.place.registry import formats


def test_every_format_of_a_house(one_house: Path, tmp_path: Path) -> None:
    # It has no points, which is all that LAZ holds.
    suffixes = [suffix for suffix in formats() if suffix != ".laz"]
    names = ",".join(formats()[suffix].name for suffix in suffixes)
    done = refused("export", one_house, "--to", names, "-o", tmp_path / "all")
    assert done.returncode == 0, done.stderr
    # Of a house without doors that open, lamps or tours: CityGML, PLY, STL and maps.
    assert done.stdout.count("not in it") == 6
    made = {file.name for file in (tmp_path / "all").iterdir()}
    assert {f"out{suffix}" for suffix in suffixes} <= made
    issues = validate_gltf(tmp_path / "all" / "out.glb")
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_a_file_that_is_there_is_kept(one_house: Path, tmp_path: Path) -> None:
    target = tmp_path / "house.stl"
    target.write_text("mine")
    done = refused("export", one_house, target)
    assert (done.returncode, target.read_text()) == (2, "mine")
    assert "house.stl: is there already. Use --force" in done.stderr
    assert refused("export", one_house, target, "--force").returncode == 0
    assert target.stat().st_size > 1000


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "nothing says what to write"),
        (["x.obj", "--to", "stl", "-o", "y"], "asks for several things"),
        (["--to", "stl"], "go together"),
        (["x.doc"], "has no ending of a format"),
        (["--to", "stl,word", "-o", "y"], "word: is no format"),
        (["nowhere/x.obj"], "there is no such folder"),
    ],
)
def test_what_cannot_be_written(
    words: list[str], said: str, one_house: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = refused("export", one_house, *words)
    assert done.returncode == 2
    assert said in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_formats_are_listed() -> None:
    done = refused("export", "any", "--to", "list")
    assert done.returncode == 0
    assert all(suffix in done.stdout for suffix in formats())


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no /dev/full")
def test_a_full_output_is_no_bug() -> None:
    for words in (["--help"], ["export", "any", "--to", "list"]):
        with Path("/dev/full").open("w") as full:
            done = subprocess.run(
                command(*words), stdout=full, stderr=subprocess.PIPE, text=True, check=False
            )
        assert done.returncode == 2
        assert done.stderr.startswith("error: the output: cannot be written (No space left")
        assert done.stderr.count("\n") == 1


def test_a_closed_output_is_no_bug() -> None:
    line = " ".join([*command("export", "any", "--to", "list"), ">&-"])
    done = subprocess.run(["/bin/sh", "-c", line], stderr=subprocess.PIPE, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
