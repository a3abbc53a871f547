"""The record of a run with many files: changes in a journal are the same as the record itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from veduta.run import record as record_module
from veduta.run.errors import InputError
from veduta.run.outputs import open_out
from veduta.run.record import CALL, Change, Item, RunRecord, load_record


@pytest.fixture(autouse=True)
def _journal_from_the_first(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(record_module, "JOURNAL_FROM", 0)


def item(state: str) -> Item:
    return Item.model_validate({"key": "k", "state": state})


def changed(out: Path) -> RunRecord:
    """A record with three items of which the second is gone and the third is not done."""
    (out / ".veduta").mkdir(parents=True)
    record = RunRecord(command="c", key="k")
    record.save(out)
    record.change(out, Change(items={"a": item("done")}, files={"a/x": "1", "a/b/y": "2"}))
    record.change(out, Change(items={"b": item("done")}, files={"b/x": "3", "top": "4"}))
    record.change(out, Change(items={"b": None}, files={"b/x": None}))
    record.change(out, Change(items={"c": item("publishing")}, pending={"c/x": "5"}))
    return record


def test_the_journal_says_what_the_record_does(tmp_path: Path) -> None:
    record = changed(tmp_path)
    found = load_record(tmp_path)
    assert found is not None
    assert found.model_dump() == record.model_dump()
    assert found.files == {"a/x": "1", "a/b/y": "2", "top": "4"}
    for one in (record, found):
        assert one.files_of("a") == ["a/b/y", "a/x"]
        assert (one.files_of("a/b"), one.files_of("b"), one.files_of(CALL)) == (
            ["a/b/y"],
            [],
            ["top"],
        )


def test_a_line_that_was_cut_off_is_none(tmp_path: Path) -> None:
    changed(tmp_path)
    journal = tmp_path / ".veduta" / "run.jsonl"
    journal.write_bytes(journal.read_bytes()[:-20])
    found = load_record(tmp_path)
    assert found is not None
    assert (set(found.items), found.pending) == ({"a"}, {})


def test_a_journal_of_another_record_is_none(tmp_path: Path) -> None:
    record = changed(tmp_path)
    journal = tmp_path / ".veduta" / "run.jsonl"
    kept = journal.read_bytes()
    record.change(tmp_path, Change(items={"a": None}))
    record.save(tmp_path)
    assert not journal.exists()
    journal.write_bytes(kept)  # as if the process had ended before it was removed
    found = load_record(tmp_path)
    assert found is not None
    assert "a" not in found.items


def test_a_journal_cannot_reach_outside(tmp_path: Path) -> None:
    changed(tmp_path)
    journal = tmp_path / ".veduta" / "run.jsonl"
    journal.write_text(journal.read_text().replace("a/x", "../x"))
    with pytest.raises(InputError, match="run record"):
        load_record(tmp_path)


def test_no_journal_is_left_behind(tmp_path: Path) -> None:
    with open_out(tmp_path, "c", "k") as out:
        for name in ("a", "b"):
            work = out.work_folder(name)
            (work / "x.txt").write_text(name)
            out.publish(name, "k", work)
        out.forget("b")
        assert (tmp_path / ".veduta" / "run.jsonl").exists()
    assert {file.name for file in (tmp_path / ".veduta").iterdir()} == {"run.json", "lock"}
    found = load_record(tmp_path)
    assert found is not None
    assert (set(found.items), set(found.files)) == ({"a"}, {"a/x.txt", "b/x.txt"})


def test_what_was_done_in_another_order_is_the_same_record(tmp_path: Path) -> None:
    """Processes that work at once are not done in an order of theirs."""
    written = []
    for names in ("abc", "cab"):
        out = tmp_path / names
        (out / ".veduta").mkdir(parents=True)
        record = RunRecord(command="c", key="k")
        for name in names:
            record.apply(Change(items={name: item("done")}, files={f"{name}/x": name}))
        record.save(out)
        written.append((out / ".veduta" / "run.json").read_bytes())
    assert written[0] == written[1]
