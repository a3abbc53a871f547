"""Lots that memory does not hold: the same results from the disk, and what is bounded."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_neighbours import row_of

from veduta.grammar import failures, spool, squares
from veduta.grammar import lots as lots_module
from veduta.grammar.failures import Failures
from veduta.grammar.frames import Survey
from veduta.grammar.lots import read_lots
from veduta.grammar.options import GrammarOptions
from veduta.grammar.pipeline import run_derive
from veduta.grammar.spool import Spool
from veduta.grammar.taken_names import TakenNames
from veduta.run.errors import InputError
from veduta.run.progress import Progress
from veduta.run.record import load_record
from veduta.run.report import Failure

BOXES = 'Lot --> extrude(6) comp(f) { side : set(material.name, "wall") W. | all : NIL }'


def contents(out: Path) -> dict[str, bytes]:
    files = [path for path in out.rglob("*") if path.is_file() and ".veduta" not in path.parts]
    return {
        str(path.relative_to(out)): path.read_bytes() for path in files if path.stem != "report"
    }


def written(block: Path) -> int:
    """When the boxes of a block were written."""
    return (block / "tiles" / "boxes.glb").stat().st_mtime_ns


def inputs(folder: Path, lots: dict[str, Any], rules: str = BOXES) -> tuple[str, Path]:
    (folder / "boxes.cga").write_text(rules)
    (folder / "lots.geojson").write_text(json.dumps(lots))
    return str(folder / "boxes.cga"), folder / "lots.geojson"


def test_lots_are_the_same_from_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    rules, lots = inputs(tmp_path, row_of(90, [6.0]))
    quiet = Progress(quiet=True)
    run_derive(rules, lots, tmp_path / "memory", GrammarOptions(), quiet, jobs=1)
    monkeypatch.setattr(spool, "IN_MEMORY", 1000)
    monkeypatch.setattr(lots_module, "MAX_BYTES", 1000)
    run_derive(rules, lots, tmp_path / "disk", GrammarOptions(), quiet, jobs=1)
    assert contents(tmp_path / "memory") == contents(tmp_path / "disk")
    assert not list(tmp_path.glob("tmp*"))


def test_blocks_have_an_end(tmp_path: Path) -> None:
    _, path = inputs(tmp_path, row_of(300, [6.0]))
    lots = read_lots(path)
    found = squares.squares_of(lots.lots, ask_beside=True, most=50)
    rows = np.concatenate([square.rows for square in found.every])
    assert sorted(rows.tolist()) == list(range(300))
    assert max(len(square.rows) for square in found.every) <= 50
    block = found.block(found.every[0])
    assert [lot.id for lot in block.lots] == [lots.lots[row].id for row in found.every[0].rows]
    ends = {lot.id for near in block.beside.values() for lot in near} - {
        lot.id for lot in block.lots
    }
    assert len(ends) == 1  # the first square of a row has one neighbour in the next


def test_records_are_read_in_any_order(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(spool, "IN_MEMORY", 64)
    store = Spool()
    records = [(f"ä{number}", number / 3, {"k": [True, b"x" * number]}) for number in range(50)]
    for record in records:
        store.append(record)
    assert [store[row] for row in (49, 0, 17)] == [records[row] for row in (49, 0, 17)]
    assert list(store) == records
    store.close()


@given(st.lists(st.sampled_from(["a", "A", "a-2", "b c", "b-c", "", "lot", "a-3"]), max_size=40))
def test_names_are_as_if_all_were_remembered(names: list[str]) -> None:
    """The oracle keeps every name and tries all numbers from 2 on."""
    taken = TakenNames()
    known: set[str] = set()
    for name in names:
        slug = name.replace(" ", "-") or "lot"
        unique, number = slug, 2
        while unique.lower() in known:
            unique, number = f"{slug}-{number}", number + 1
        known.add(unique.lower())
        assert taken.own(name) == unique


def test_many_names_grow_the_table() -> None:
    taken = TakenNames()
    assert len({taken.own(f"lot {number}") for number in range(5000)}) == 5000
    assert len({taken.own("same") for _ in range(5000)}) == 5000
    assert taken.own("LOT-4999") == "LOT-4999-2"


@given(
    st.lists(st.tuples(st.floats(-180, 180), st.floats(-90, 90)), min_size=3, max_size=40),
)
def test_the_middle_lies_in_the_zone_of_the_median(points: list[tuple[float, float]]) -> None:
    survey = Survey()
    survey.add(np.array([(x, y, 0.0) for x, y in points]))
    x, y = np.median(np.array(points), axis=0)
    longitude, latitude = survey.middle
    assert (longitude + 180) // 6 == (x + 180) // 6
    assert (latitude < 0, latitude < -80, latitude > 84) == (y < 0, y < -80, y > 84)


def test_failures_are_counted_beyond_those_that_are_named(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(failures, "MOST_NAMED", 3)
    every = [Failure(subject=str(k), kind="input", reason="bad") for k in range(5)]
    found = Failures(every)
    found.add(Failure(subject="block", kind="bug", reason="worse"))
    assert (len(found), found.untold, found.kinds) == (6, 2, {"input", "bug"})
    assert [failure.subject for failure in found] == ["0", "1", "2", "block"]
    other = Failures([*every[:4], Failure(subject="9", kind="input", reason="bad")])
    assert Failures(every).told() != other.told()
    whole = Failures()
    whole.add_all(found, found.untold)
    assert (len(whole), whole.untold) == (6, 2)


def test_the_report_counts_what_it_does_not_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(failures, "MOST_NAMED", 3)
    lots = row_of(12, [6.0])
    for feature in lots["features"][:8]:
        feature["geometry"]["coordinates"] = [[[0, 0], [1, 1]]]
    rules, path = inputs(tmp_path, lots)
    result = run_derive(
        rules, path, tmp_path / "out", GrammarOptions(), Progress(quiet=True), jobs=1
    )
    assert (result.exit_code, result.total, result.built.count) == (3, 12, 4)
    report = json.loads((tmp_path / "out" / "report.json").read_text())
    (failure,) = report["failures"]
    assert report["measures"]["lots"] == 12
    assert ": 3 lots (" in failure["subject"]
    assert "5 more failed, and are not named" in report["notes"]


def test_a_file_for_each_of_very_many_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from veduta.grammar import pipeline

    monkeypatch.setattr(pipeline, "MOST_SEPARATE", 5)
    rules, path = inputs(tmp_path, row_of(6, [6.0]))
    options = GrammarOptions.model_validate({"output": {"separate": True}})
    with pytest.raises(InputError, match="--separate: is for up to 5 lots, and here are 6"):
        run_derive(rules, path, tmp_path / "out", options, Progress(quiet=True))


def feature(number: int) -> str:
    x = 20 * number
    ring = [[x, 0], [x + 9, 0], [x + 9, 9], [x, 9], [x, 0]]
    shape = {"type": "Polygon", "coordinates": [ring]}
    return json.dumps({"type": "Feature", "geometry": shape, "properties": {"a": 1.5}})


@pytest.fixture
def streamed(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(lots_module, "MAX_BYTES", 10)
    return None


@pytest.mark.parametrize(
    ("broken", "told"),
    [
        (feature(1).replace("1.5", "NaN"), "NaN is not a number"),
        (feature(1).replace("1.5", "01.5"), "is no JSON"),
        (feature(1).replace('"a":', '"a"'), "is no JSON"),
        (feature(1).replace("1.5", '"\\x"'), "is no JSON"),
        ("nonsense", "is no JSON"),
        (feature(1).replace("1.5", '"\udcff"'), "no UTF-8"),
        ("17", "is no object"),
    ],
)
def test_a_broken_feature_is_a_failure_of_its_own(
    tmp_path: Path, streamed: None, broken: str, told: str
) -> None:
    path = tmp_path / "lots.geojson"
    features = ",\n".join([feature(0), broken, feature(2)])
    text = f'{{"type": "FeatureCollection", "features": [{features}]}}'
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    found = read_lots(path)
    assert [lot.name for lot in found.lots] == ["lot-1", "lot-3"]
    (failure,) = found.failures
    assert failure.subject == f"{path}: feature 2"
    assert told in failure.reason


@pytest.mark.parametrize(
    ("cut", "place"),
    [
        (lambda text: text[: text.index("9", 200)], "line 2, letter 1: the file ends within"),
        (lambda text: text[:-2], "the file ends, the end of the list is missing"),
        (lambda text: text.replace("]]]}", "]}", 1), "line 1, letter 44: brackets do not match"),
    ],
)
def test_a_torn_file_is_an_error_that_names_the_place(
    tmp_path: Path, streamed: None, cut: Any, place: str
) -> None:
    path = tmp_path / "lots.geojson"
    features = ",\n".join(feature(number) for number in range(3))
    path.write_text(cut(f'{{"type": "FeatureCollection", "features": [{features}]}}'))
    with pytest.raises(InputError, match=place):
        read_lots(path)


def test_a_killed_run_of_many_blocks_goes_on(tmp_path: Path) -> None:
    """Killed while blocks are derived, with the journal in use: the result is that of one run."""
    rules, lots = inputs(tmp_path, row_of(150, [6.0]))
    code = (
        "import sys; from pathlib import Path\n"
        "from veduta.run import record; record.JOURNAL_FROM = 3\n"
        "from veduta.grammar.options import GrammarOptions\n"
        "from veduta.grammar.pipeline import run_derive\n"
        "from veduta.run.progress import Progress\n"
        "run_derive(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]), GrammarOptions(),"
        " Progress(quiet=True), jobs=1)"
    )
    command = [sys.executable, "-c", code, rules, str(lots), str(tmp_path / "out")]
    process = subprocess.Popen(command)
    journal = tmp_path / "out" / ".veduta" / "run.jsonl"
    while process.poll() is None and not (journal.exists() and journal.read_text().count("\n") > 2):
        time.sleep(0.002)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    record = load_record(tmp_path / "out")
    assert record is not None
    done = {name for name, item in record.items.items() if item.state == "done"}
    assert done
    before = {name: written(tmp_path / "out" / name) for name in done}
    subprocess.run(command, check=True)
    assert before == {name: written(tmp_path / "out" / name) for name in done}
    assert not journal.exists()
    run_derive(rules, lots, tmp_path / "once", GrammarOptions(), Progress(quiet=True), jobs=1)
    assert contents(tmp_path / "out") == contents(tmp_path / "once")
