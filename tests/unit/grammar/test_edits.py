"""Edits as a file: what is read, what is refused with its line, and that writing is reading."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from veduta.grammar.edits import (
    Edit,
    EditFault,
    edits_text,
    fault_told,
    parse_line,
    parse_path,
    path_text,
    read_edits,
)
from veduta.run.errors import InputError

names = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,8}", fullmatch=True)
paths = st.lists(st.integers(0, 2**32 - 1), max_size=6).map(tuple)
values = st.one_of(st.booleans(), st.floats(-1e299, 1e299), st.text('aé "\\#=\n/', max_size=6))
changes = st.builds(
    Edit,
    path=paths,
    name=st.none() | names,
    choices=st.lists(st.none() | st.integers(0, 20), max_size=4).map(tuple),
    values=st.dictionaries(names, values, max_size=3).map(lambda d: tuple(sorted(d.items()))),
).filter(lambda edit: not edit.is_empty)
deletions = st.builds(Edit, path=paths, name=st.none() | names, delete=st.just(True))


def read(folder: Path, text: str) -> dict[str, tuple[Edit, ...]]:
    path = folder / "edits.txt"
    path.write_text(text, "utf-8")
    return read_edits(path)


def test_each_kind_of_edit(tmp_path: Path) -> None:
    text = """# of a street
    north-1 /          storeys = 6

    north-1 /0/2:Floor delete
    north-1 /0/3:Bay   choice 2 = 1
    north-1 /0/3       color = "#aabbcc"
    south-1 /:Lot      withShops = false
    """
    found = read(tmp_path, text)
    assert found["north-1"] == (
        Edit((), values=(("storeys", 6.0),)),
        Edit((0, 2), "Floor", delete=True),
        Edit((0, 3), "Bay", choices=(None, 0), values=(("color", "#aabbcc"),)),
    )
    assert found["south-1"] == (Edit((), "Lot", values=(("withShops", False),)),)
    assert found["north-1"][1].where == f"{tmp_path / 'edits.txt'}:4"


@settings(max_examples=50)
@given(st.lists(changes | deletions, max_size=5, unique_by=lambda edit: edit.path))
def test_writing_is_reading(edits: list[Edit]) -> None:
    text = edits_text({"lot": edits})
    by_path: dict[tuple[int, ...], list[Edit]] = {}
    for line in text.splitlines()[1:]:
        lot, edit = parse_line(line)
        assert lot == "lot"
        by_path.setdefault(edit.path, []).append(edit)
    for edit in edits:
        parts = by_path.pop(edit.path)
        assert {part.name for part in parts} == {edit.name}
        assert any(part.delete for part in parts) == edit.delete
        assert tuple(value for part in parts for value in part.values) == edit.values
        taken = {len(p.choices) - 1: p.choices[-1] for p in parts if p.choices}
        assert taken == {k: c for k, c in enumerate(edit.choices) if c is not None}
    assert by_path == {}


def test_the_file_does_not_depend_on_the_order_of_edits(tmp_path: Path) -> None:
    one, other = Edit((1,), "A", delete=True), Edit((0, 5), "B", choices=(None, 3))
    text = edits_text({"b": [one, other], "a": [other]})
    assert text == edits_text({"a": [other], "b": [other, one]})
    assert read(tmp_path, text) == {"a": (other,), "b": (other, one)}


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("lot", "is not LOT, PATH and EDIT"),
        ("lot 0/1 delete", "is not LOT, PATH and EDIT"),
        ("lot /0/x delete", "is no path"),
        ("lot /0//1 delete", "is no path"),
        ("lot /4294967296 delete", "is no path"),
        ("lot /0: delete", "is no path"),
        ("lot /0 remove", "neither delete"),
        ("lot /0 choice 0 = 1", "counted from 1"),
        ("lot /0 height = tall", "no number, true, false"),
        ("lot /0 height = NaN", "no number, true, false"),
        ("lot /0 height = [1]", "no number, true, false"),
        ("lot /0 a = 1\nlot /0 a = 2", "the same value is set twice"),
        ("lot /0 choice 1 = 1\nlot /0 choice 1 = 2", "the same choice is set twice"),
        ("lot /0 a = 1\nlot /0 delete", "is deleted, and edited"),
        ("lot /0:A a = 1\nlot /0:B b = 1", "another line"),
    ],
)
def test_what_is_refused_names_its_line(tmp_path: Path, line: str, told: str) -> None:
    with pytest.raises(InputError) as caught:
        read(tmp_path, f"# first\n{line}\n")
    message = str(caught.value)
    assert told in message
    assert f"line {2 + line.count(chr(10))}:" in message
    assert message.startswith(str(tmp_path / "edits.txt"))


def test_files_that_are_none(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        read_edits(tmp_path / "none.txt")
    (tmp_path / "binary.txt").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="UTF-8"):
        read_edits(tmp_path / "binary.txt")


@given(paths, st.none() | names)
def test_paths_are_read_as_they_are_written(path: tuple[int, ...], name: str | None) -> None:
    assert parse_path(path_text(path, name)) == (path, name)


@given(st.text(max_size=40))
def test_no_line_does_worse_than_being_refused(line: str) -> None:
    try:
        lot, edit = parse_line(line.strip())
    except EditFault:
        return
    assert lot
    assert not edit.is_empty


def test_faults_name_file_line_and_remedy() -> None:
    edits = (Edit((0,), "Bay", delete=True, where="e.txt:3"), Edit((1,), delete=True))
    assert fault_told(edits, []) is None
    told = fault_told(edits, [([0], "there is no such shape")])
    assert told is not None
    assert told.startswith("e.txt:3: the edit of /0:Bay cannot be done: there is no such shape")
    assert "veduta grammar tree" in told
