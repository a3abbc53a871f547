"""Names that are not UTF-8: links with names that are, and how they are told."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from veduta.run.names import PlainNames, given_name, given_names, is_plain, plain, real_path, shown

E9, FF = os.fsdecode(b"\xe9"), os.fsdecode(b"\xff")


@pytest.fixture
def names() -> Iterator[PlainNames]:
    made = PlainNames()
    yield made
    made.end()


def test_names_are_escaped_and_shown() -> None:
    assert plain(f"caf{E9}.png") == "caf=E9.png"
    assert is_plain("école.png")
    assert not is_plain(f"é{E9}")
    assert shown("a b") == "a b"
    told = shown(f"it's {E9}\\")
    echoed = subprocess.run(["bash", "-c", f"printf %s {told}"], capture_output=True, check=True)
    assert os.fsdecode(echoed.stdout) == f"it's {E9}\\"


def test_plain_names_stay(names: PlainNames, tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"1")
    for path in (tmp_path, tmp_path / "a.png", tmp_path / "none"):
        assert names.reading(str(path)) == str(path)
        assert names.writing(str(path)) == str(path)
    assert names.shown == {}
    assert real_path(tmp_path / "x" / ".." / "a.png") == tmp_path / "a.png"


def test_a_file_is_seen_with_all_that_lies_beside_it(names: PlainNames, tmp_path: Path) -> None:
    folder = tmp_path / f"r{E9}"
    folder.mkdir()
    (folder / "beside.png").write_bytes(b"2")
    for name in (f"m{E9}.cga", "m=E9.cga", f"m{FF}.cga"):
        (folder / name).write_bytes(os.fsencode(name))
    seen = Path(names.reading(str(folder / f"m{E9}.cga")))
    plainly = Path(names.reading(str(folder / "beside.png")))
    names.keep()
    assert seen.read_bytes() == b"m\xe9.cga"
    assert is_plain(str(seen))
    assert (seen.parent / "m=E9.cga").read_bytes() == b"m=E9.cga"  # a name of its own stays
    assert (seen.parent / "beside.png").read_bytes() == plainly.read_bytes() == b"2"
    # What lies in a folder lies in it by every link.
    assert real_path(seen).parent == real_path(plainly).parent == real_path(seen.parent)
    assert names.tell(f"error: {seen}: bad") == f"error: {shown(str(folder / f'm{E9}.cga'))}: bad"
    assert given_name(plainly) == str(tmp_path / "r=E9" / "beside.png")
    assert given_names(f"<{seen}>") == f"<{tmp_path / 'r=E9' / 'm=E9.cga'}>"


def test_a_folder_with_such_names_is_mirrored(names: PlainNames, tmp_path: Path) -> None:
    folder = tmp_path / "photos"
    (folder / f"d{E9}" / "deep").mkdir(parents=True)
    (folder / "d=E9").mkdir()
    (folder / f"d{E9}" / "deep" / f"{FF}.jpg").write_bytes(b"1")
    (folder / "plain.jpg").write_bytes(b"2")
    os.symlink("/etc", folder / "away")
    seen = Path(names.reading(str(folder)))
    names.keep()
    found = sorted(str(path.relative_to(seen)) for path in seen.rglob("*.jpg"))
    assert found == ["=d=E9/deep/=FF.jpg", "plain.jpg"]
    assert (seen / "=d=E9" / "deep" / "=FF.jpg").read_bytes() == b"1"
    assert real_path(seen / "plain.jpg").is_relative_to(real_path(seen))
    assert real_path(seen / "=d=E9" / "deep" / "=FF.jpg").is_relative_to(real_path(seen))
    # A link that leads out of the folder still does.
    assert not real_path(seen / "away" / "passwd").is_relative_to(real_path(seen))


def test_what_is_written_lands_where_it_belongs(names: PlainNames, tmp_path: Path) -> None:
    out = Path(names.writing(str(tmp_path / f"new{E9}" / f"out{E9}")))
    assert not out.exists()
    Path(os.path.realpath(out)).mkdir()
    (out / "a.txt").write_text("a")
    file = Path(names.writing_file(str(tmp_path / f"s{E9}.obj")))
    file.write_text("mtllib s.mtl")
    file.with_name("s.mtl").write_text("x")
    (tmp_path / f"old{E9}.cga").write_text("old")
    old = Path(names.reading(str(tmp_path / f"old{E9}.cga")))
    old.with_name("new").write_text("new")
    os.replace(old.with_name("new"), old)  # as files are replaced whole
    names.keep()
    names.finish()
    assert (tmp_path / f"new{E9}" / f"out{E9}" / "a.txt").read_text() == "a"
    assert (tmp_path / f"s{E9}.obj").read_text() == "mtllib s.mtl"
    assert (tmp_path / "s.mtl").read_text() == "x"
    assert (tmp_path / f"old{E9}.cga").read_text() == "new"


def test_processes_of_the_run_know_the_links(names: PlainNames, tmp_path: Path) -> None:
    (tmp_path / E9).mkdir()
    seen = names.reading(str(tmp_path / E9))
    names.keep()
    code = "import sys; from pathlib import Path; from veduta.run.names import *;"
    code += " print(real_path(Path(sys.argv[1]) / 'a'))"
    line = [sys.executable, "-c", code, seen]
    told = subprocess.run(line, capture_output=True, text=True, check=True)
    assert Path(told.stdout.strip()) == real_path(Path(seen)) / "a" == Path(seen) / "a"
