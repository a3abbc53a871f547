"""What is built otherwise than rule files say: the notes of a run, and the warnings of a check."""

from __future__ import annotations

from collections.abc import Collection

from veduta import _core
from veduta.grammar.assets.library import Library
from veduta.grammar.rules import RuleFiles
from veduta.grammar.textures import missing_textures
from veduta.run.errors import InputError

FIRST_TOLD = 3
MOST_TOLD = 40
"""Lines about what is missing; a project without its assets misses hundreds."""


def otherwise(rules: RuleFiles, compiled: _core.GrammarRules) -> list[str]:
    """A line each: encodings, operations that change nothing, missing assets and pictures."""
    told = [*rules.notes, *_underived(compiled.notes)]
    missing = _missing_assets(rules, compiled)
    pictures = missing_textures(rules.path, rules.files, rules.search)
    missing += [f"{one}: the plain colour is seen" for one in pictures]
    if len(missing) > MOST_TOLD:
        more = len(missing) - MOST_TOLD
        missing = [*missing[:MOST_TOLD], f"and {more} more assets and pictures are missing"]
    return [*told, *missing]


def unreached(compiled: _core.GrammarRules) -> list[str]:
    """What would be a fault of the rules where the start rule reached it: a line each."""
    return _underived(compiled.unreached)


def _underived(notes: str) -> list[str]:
    """The first line of each note: place and message, without the excerpt."""
    lines = [line for line in notes.splitlines() if line and not line.startswith(" ")]
    return [line.replace(": warning: ", ": ", 1) for line in lines]


def told_computed(missing: Collection[str]) -> list[str]:
    """For the terminal: how many assets with computed names are missing, and the first of them."""
    if not missing:
        return []
    first = sorted(missing)[:FIRST_TOLD]
    more = len(missing) - len(first)
    count = "1 asset" if len(missing) == 1 else f"{len(missing)} assets"
    told = [f"{count} of computed names cannot be had: a box stands for each"]
    told += [f"  {one}" for one in first]
    return told + ([f"  and {more} more"] if more else [])


def _missing_assets(rules: RuleFiles, compiled: _core.GrammarRules) -> list[str]:
    """Assets that stand in the rules and are not there, with file and line."""
    library = Library(rules.search)
    told = []
    for name in compiled.asset_names[0]:
        try:
            _ = library[name]
        except InputError as error:
            fault = f"asset {error.subject} {error.fault}: a box stands for it. {error.remedy}"
            told.append(f"{_place_of(rules, name)}: {fault}")
    return told


def _place_of(rules: RuleFiles, name: str) -> str:
    """The file and line that write a name."""
    for file, text in rules.files:
        at = text.find(f'"{name}"')
        if at >= 0:
            return f"{file}:{text.count(chr(10), 0, at) + 1}"
    return str(rules.path)
