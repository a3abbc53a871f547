"""A finished town of which files have gone: only they are made again."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from test_neighbours import row_of

from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import FEW, DeriveResult, run_derive
from veduta.run.progress import Progress

BOXES = 'Lot --> extrude(6) comp(f) { side : set(material.name, "wall") W. | all : NIL }'


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("inputs")
    rules, lots = folder / "boxes.cga", folder / "lots.geojson"
    rules.write_text(BOXES)
    lots.write_text(json.dumps(row_of(FEW + 20, [6.0])))
    return rules, lots


def run(inputs: tuple[Path, Path], out: Path) -> DeriveResult:
    rules, lots = inputs
    result = run_derive(str(rules), lots, out, GrammarOptions(), Progress(quiet=True), jobs=1)
    assert result.exit_code == 0
    return result


def written(out: Path) -> dict[str, tuple[int, bytes]]:
    """When each file was written, and what it holds, by its path; reports tell times."""
    files = [path for path in out.rglob("*") if path.is_file() and ".veduta" not in path.parts]
    kept = [path for path in files if path.stem != "report"]
    return {
        str(path.relative_to(out)): (path.stat().st_mtime_ns, path.read_bytes()) for path in kept
    }


def test_a_block_that_lost_a_file_is_derived_alone(
    tmp_path: Path, inputs: tuple[Path, Path]
) -> None:
    out = tmp_path / "out"
    run(inputs, out)
    before = written(out)
    lost = next(name for name in sorted(before) if name.startswith("parts/00/tiles/"))
    (out / lost).unlink()
    assert not run(inputs, out).up_to_date
    after = written(out)
    assert {name: content for name, (_, content) in after.items()} == {
        name: content for name, (_, content) in before.items()
    }
    again = {name.split("/")[1] for name in after if after[name] != before[name] and "/" in name}
    assert again == {"00"}
    assert after["city.city.json"] == before["city.city.json"]
    assert run(inputs, out).up_to_date


def test_cityjson_that_is_lost_is_made_again(tmp_path: Path, inputs: tuple[Path, Path]) -> None:
    out = tmp_path / "out"
    run(inputs, out)
    city = (out / "city.city.json").read_bytes()
    (out / "city.city.json").unlink()
    run(inputs, out)
    assert (out / "city.city.json").read_bytes() == city


def test_cityjson_that_was_edited_stays(tmp_path: Path, inputs: tuple[Path, Path]) -> None:
    out = tmp_path / "out"
    run(inputs, out)
    (out / "city.city.json").write_text("mine")
    (out / "tileset.json").unlink()
    assert run(inputs, out).edited == ["city.city.json"]
    assert (out / "city.city.json").read_text() == "mine"
    assert (out / "tileset.json").exists()
