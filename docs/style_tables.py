"""The attributes of a style as a table of the docs, read from the annotations of its rule file."""

from __future__ import annotations

import re
from pathlib import Path

STYLES = Path(__file__).resolve().parents[1] / "python/veduta/grammar/styles"
_ATTRIBUTE = re.compile(r"((?:^@[^\n]*\n)+)^attr (\w+) = ((?:[^\n]+\n)+)", re.MULTILINE)
_ANNOTATION = re.compile(r'@(\w+)(?:\(((?:"[^"]*"|[^")])*)\))?')


def attribute_rows(style: str) -> list[tuple[str, str, str, str]]:
    """A row per attribute: its name, what it takes, its default as the rules have it, its text."""
    text = (STYLES / f"{style}.cga").read_text("utf-8")
    rows = []
    for above, name, default in _ATTRIBUTE.findall(text):
        notes = dict(_ANNOTATION.findall(above))
        if "Hidden" in notes:
            continue
        shown = f"`{' '.join(default.split())}`"
        rows.append((f"`{name}`", _takes(notes, default), shown, _unquoted(notes["Description"])))
    return rows


def _takes(notes: dict[str, str], default: str) -> str:
    if "Range" in notes:
        bounds = dict(re.findall(r"(\w+)=([-\d.]+)", notes["Range"]))
        return f"{bounds['min']} to {bounds['max']}"
    if "Enum" in notes:
        return ", ".join(f"`{_unquoted(word)}`" for word in notes["Enum"].split(","))
    if "Color" in notes:
        return "colour"
    return "`true`, `false`" if re.search(r"\b(true|false)\b", default) else "text"


def _unquoted(word: str) -> str:
    return word.strip().strip('"')
