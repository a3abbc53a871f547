"""`veduta demo` from the command line: what it prints, leaves behind and refuses."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from command_line import read_json, refused, tree, veduta
from PIL import Image

SMALL = ("--long-side-px", 560, "--samples", 1, "--corners")


@pytest.fixture(scope="module")
def demo(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """A finished demo and what it printed."""
    out = tmp_path_factory.mktemp("demo") / "out"
    done = veduta("demo", "-o", out, *SMALL)
    assert done.returncode == 0, done.stderr
    return out, done.stdout


def test_it_says_how_well_the_house_was_found_and_where_to_look(demo: tuple[Path, str]) -> None:
    out, printed = demo
    record = read_json(out / "comparison" / "comparison.json")
    windows = record["comparison"]["windows"]
    assert f"{windows['matched']} of {windows['true']} found" in printed
    assert f"veduta view {out}/place" in printed
    for name in ("truth/street.jpg", "place/street/report.html", "comparison/comparison.png"):
        assert f"{out}/{name}" in printed
        assert (out / name).is_file()


def test_the_truth_is_written_beside_the_photo(demo: tuple[Path, str]) -> None:
    out, _ = demo
    truth = read_json(out / "truth" / "truth.json")
    with (
        Image.open(out / "truth" / "labels.png") as labels,
        Image.open(out / "truth" / "street.jpg") as photo,
    ):
        assert labels.size == photo.size
        assert np.asarray(labels).max() <= 8
    assert truth["storeys"] == 6
    assert sum(e["class"] == "window" for e in truth["elements"]) == 18


def test_the_verb_was_told_only_what_is_printed(demo: tuple[Path, str]) -> None:
    out, printed = demo
    truth = read_json(out / "truth" / "truth.json")
    used = read_json(out / "place" / "street" / "report.json")["options"]
    assert used["scale"]["height_m"] == round(truth["height_m"], 1)
    assert all(value == round(value) for value in used["rectify"]["corners"])
    assert used["rectify"]["focal_mm35"] is None
    assert "to 0.1 m" in printed


def test_the_same_call_is_up_to_date_and_another_is_refused(demo: tuple[Path, str]) -> None:
    out, printed = demo
    before = tree(out)
    again = veduta("demo", "-o", out, *SMALL)
    assert again.returncode == 0
    assert "was done" in again.stdout
    assert printed.splitlines()[5:] == again.stdout.splitlines()[5:]
    other = veduta("demo", "-o", out, *SMALL, "--seed", 3)
    assert other.returncode == 2
    assert "--force" in other.stderr
    assert tree(out) == before


def test_the_same_seed_gives_the_same_bytes(demo: tuple[Path, str], tmp_path: Path) -> None:
    out, _ = demo
    assert veduta("demo", "-o", tmp_path / "again", *SMALL).returncode == 0
    first, second = tree(out), tree(tmp_path / "again")
    timed = "comparison/comparison.json"
    assert (
        read_json(out / timed)["comparison"]
        == (read_json(tmp_path / "again" / timed)["comparison"])
    )
    del first[timed], second[timed]
    assert first == second


@pytest.mark.slow
def test_an_edited_document_is_compared_as_it_is_now(
    demo: tuple[Path, str], tmp_path: Path
) -> None:
    out, printed = tmp_path / "out", demo[1]
    shutil.copytree(demo[0], out)
    path = out / "place" / "street" / "facade.json"
    before = read_json(path)
    windows = [item for item in before["elements"] if item["class"] == "window"]
    others = [item for item in before["elements"] if item["class"] != "window"]
    path.write_text(json.dumps({**before, "elements": [*windows[:4], *others]}))
    assert veduta("facade", path, "-o", out / "place").returncode == 0

    again = veduta("demo", "-o", out, *SMALL)
    assert again.returncode == 0, again.stderr
    assert f"edited    {path}: it is compared as it is now" in again.stdout
    record = read_json(out / "comparison" / "comparison.json")
    known = read_json(demo[0] / "comparison" / "comparison.json")
    assert record["comparison"]["windows"]["found"] == 4
    assert known["comparison"]["windows"]["found"] == len(windows) > 4
    picture = (out / "comparison" / "comparison.png").read_bytes()
    assert picture != (demo[0] / "comparison" / "comparison.png").read_bytes()
    assert veduta("demo", "-o", out, *SMALL).stdout == again.stdout

    path.write_text("{")
    broken = refused("demo", "-o", out, *SMALL)
    assert broken.returncode == 2
    assert f"{path}: line 1" in broken.stderr
    path.unlink()
    anew = veduta("demo", "-o", out, *SMALL)
    assert anew.returncode == 0, anew.stderr
    assert read_json(path) == before
    assert "as it is now" not in anew.stdout
    assert printed.splitlines()[5:-4] == anew.stdout.splitlines()[5:-4]


def test_bad_use_is_refused(tmp_path: Path) -> None:
    wrong = refused("demo", "-o", tmp_path / "x", "--style", "baroque")
    assert wrong.returncode == 2
    assert not (tmp_path / "x").exists()
