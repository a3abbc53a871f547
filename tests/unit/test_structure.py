"""The shape of the checkout: sizes and names of files, and words that do not belong in them."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest

SOURCES = {".py", ".pyi", ".rs", ".ts"}
TEXTS = SOURCES | {".md", ".toml", ".html", ".css", ".json", ".mjs", ".js", ".txt", ".yml", ""}
MAX_LINES = 450
MAX_BYTES = 1_500_000
LARGER = {"python/veduta/facade/eyes/eyes.onnx": 5_000_000}
"""Weights of a network, which its model card describes."""


@pytest.fixture(scope="module")
def tracked(repository: Path) -> list[Path]:
    """Return the files that git knows and that are still there, relative to the root."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=repository, capture_output=True, text=True, check=False
    )
    if listed.returncode != 0:
        pytest.skip("not a git checkout: the files of the project cannot be told from others")
    names = [Path(name) for name in listed.stdout.split("\0") if name]
    return [name for name in names if (repository / name).is_file()]


GENERATED = {Path("python/veduta/_core.pyi")}
RESOLVERS = {
    "python/veduta/run/names.py",
    "python/veduta/run/outputs.py",  # folders that are made and taken away, never named
    "python/veduta/grammar/layout.py",  # rewrites the file that a link stands for
    "python/veduta/studio/export.py",  # places that Veduta wrote: their names are UTF-8
    "python/veduta/studio/files.py",
    "python/veduta/cli/licences.py",  # a file of the package
}
"""Files that follow links by the system's own names, and why."""


def _sources(tracked: list[Path]) -> list[Path]:
    return [
        name
        for name in tracked
        if name.suffix in SOURCES and "generated" not in name.parts and name not in GENERATED
    ]


def _hits(repository: Path, names: list[Path], pattern: str) -> list[str]:
    found = []
    for name in names:
        for number, line in enumerate((repository / name).read_text("utf-8").splitlines(), 1):
            if re.search(pattern, line):
                found.append(f"{name}:{number}: {line.strip()[:100]}")
    return found


def test_source_files_are_one_thing_each(repository: Path, tracked: list[Path]) -> None:
    lengths = {
        str(name): len((repository / name).read_text("utf-8").splitlines())
        for name in _sources(tracked)
    }
    assert {name: lines for name, lines in lengths.items() if lines > MAX_LINES} == {}


def test_no_two_test_files_have_one_name(tracked: list[Path]) -> None:
    """pytest imports them by their plain names: of two, it would collect the first alone."""
    names = [name.name for name in tracked if name.parts[0] == "tests" and name.suffix == ".py"]
    twice = {name for name in names if names.count(name) > 1}
    assert twice - {"conftest.py", "__init__.py"} == set()


def test_no_file_is_a_dumping_ground(tracked: list[Path]) -> None:
    names = re.compile(r"(?:^|_)(?:utils?|helpers?|common|misc)(?:_|$)")
    grounds = [
        str(name)
        for name in _sources(tracked)
        if any(names.search(Path(p).stem) for p in name.parts)
    ]
    assert grounds == []


def test_no_data_in_the_repository(repository: Path, tracked: list[Path]) -> None:
    sizes = {str(name): (repository / name).stat().st_size for name in tracked}
    assert {n: size for n, size in sizes.items() if size > LARGER.get(n, MAX_BYTES)} == {}


def test_nothing_is_left_unfinished(repository: Path, tracked: list[Path]) -> None:
    words = r"\b(TO" + r"DO|FIX" + r"ME|NotImplemented" + r"Error)\b|(todo|unimplemented)!\("
    assert _hits(repository, _sources(tracked), words) == []


def test_no_path_of_a_developers_machine(repository: Path, tracked: list[Path]) -> None:
    paths = r"(?<![\w.])/(" + "|".join(["work", "root", r"home/\w+", r"Users/\w+"]) + r")/\w"
    texts = [name for name in tracked if name.suffix in TEXTS and name.name != "LICENSE"]
    assert _hits(repository, texts, paths) == []


def test_paths_are_resolved_by_names_that_are_utf8(repository: Path, tracked: list[Path]) -> None:
    """`real_path` gives a name that libraries and documents take, where the file's own is none."""
    library = [name for name in tracked if name.is_relative_to("python/veduta")]
    others = [name for name in library if name.suffix == ".py" and str(name) not in RESOLVERS]
    assert _hits(repository, others, r"\.resolve\(\)|\brealpath\(|\breadlink\(") == []
