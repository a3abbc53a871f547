"""The documents: links lead somewhere, and each command in a fence exists with its options."""

from __future__ import annotations

import functools
import json
import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from veduta.facade.document import Element

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = sorted(
    [
        *ROOT.glob("*.md"),
        *ROOT.glob("docs/**/*.md"),
        *ROOT.glob("benchmarks/**/*.md"),
        *ROOT.glob("python/veduta/*/README.md"),
    ]
)
SHELLS = {"bash", "sh", "shell", "console"}


def _anchor(heading: str) -> str:
    """Return the anchor that GitHub gives a heading."""
    kept = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return kept.replace(" ", "-")


def _without_fences(text: str) -> str:
    return re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)


def _commands(text: str) -> list[list[str]]:
    """Return the words of each command line in the shell fences of a document."""
    found = []
    for language, body in re.findall(r"^```(\w*)\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        if language not in SHELLS:
            continue
        for line in body.replace("\\\n", " ").splitlines():
            stripped = line.strip().removeprefix("$ ")
            if stripped:
                found.append(shlex.split(stripped, comments=True))
    return [words for words in found if words]


@functools.cache
def _verb_help(verb: str) -> str:
    env = os.environ | {"COLUMNS": "200", "NO_COLOR": "1"}
    command = [str(Path(sys.executable).parent / "veduta"), verb, "--help"]
    result = subprocess.run(command, capture_output=True, text=True, env=env, check=False)
    return result.stdout if result.returncode == 0 else ""


def test_terms_are_those_of_the_documents_and_of_the_reports() -> None:
    """Each is used where a user reads, and stands in its table in the order of the alphabet."""
    page = ROOT / "docs" / "terms.md"
    read = [path.read_text("utf-8") for path in DOCUMENTS if path != page]
    read += [path.read_text("utf-8") for path in (ROOT / "python/veduta").rglob("*.py")]
    text = "\n".join(read).lower()
    rows_of_a_table = re.compile(r"^\| Term .*\n\|[-|]+\n((?:\|.*\n)+)", re.MULTILINE)
    tables = rows_of_a_table.findall(page.read_text("utf-8"))
    assert len(tables) == 3
    for rows in tables:
        terms = [row.split("|")[1].strip().lower() for row in rows.splitlines()]
        assert terms == sorted(terms)
        words = [word.strip("`") for term in terms for word in term.split(", ")]
        assert [word for word in words if word.removesuffix(" off") not in text] == []


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_resolve(document: Path) -> None:
    broken = []
    text = _without_fences(document.read_text("utf-8"))
    for target in re.findall(r"\]\(([^)\s]+)\)|(?:src|href)=\"([^\"]+)\"", text):
        link = target[0] or target[1]
        if re.match(r"https?://|mailto:", link):
            continue
        name, _, anchor = link.partition("#")
        linked = (document.parent / name).resolve() if name else document
        if not linked.exists():
            broken.append(link)
        elif anchor and linked.suffix == ".md":
            headings = re.findall(r"^#+ (.*)$", linked.read_text("utf-8"), re.MULTILINE)
            if anchor not in map(_anchor, headings):
                broken.append(link)
    assert broken == []


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: str(path.relative_to(ROOT)))
def test_commands_exist(document: Path) -> None:
    makefile = (ROOT / "Makefile").read_text("utf-8")
    targets = set(re.findall(r"^([a-z][a-z-]*):", makefile, re.MULTILINE))
    wrong = []
    for words in _commands(document.read_text("utf-8")):
        program, *rest = words
        if program == "make":
            wrong += [f"make {word}" for word in rest if "=" not in word and word not in targets]
        elif Path(program).name == "veduta" and rest and not rest[0].startswith("-"):
            shown = _verb_help(rest[0])
            options = [word.partition("=")[0] for word in rest[1:] if re.match(r"--?[a-z]", word)]
            unknown = [
                option
                for option in options
                if not re.search(rf"(?<![\w-]){option}(?![\w-])", shown)
            ]
            if not shown:
                wrong.append(f"veduta {rest[0]}")
            wrong += [f"veduta {rest[0]} {option}" for option in unknown]
    assert wrong == []


def test_elements_of_the_example_are_elements() -> None:
    """What the page tells people to write is what the program reads."""
    fences = re.findall(
        r"^```json\n(.*?)^```", (ROOT / "docs" / "facade.md").read_text("utf-8"), re.M | re.S
    )
    before, after = (
        [Element.model_validate(item) for item in json.loads(f"[{f}]")] for f in fences
    )
    assert [item.class_ for item in before] == ["shop"]
    assert [item.class_ for item in after] == ["shop", "door"]
    shop, door = after
    assert shop.x_px + shop.width_px < door.x_px < before[0].x_px + before[0].width_px
