"""The derivation as indented text: what `veduta grammar tree` prints."""

from __future__ import annotations

from collections.abc import Sequence

from veduta.grammar.derivation import Choice, Derivation
from veduta.grammar.edits import path_text
from veduta.grammar.sampling import prior_text
from veduta.grammar.sheet import shown
from veduta.grammar.tree_rows import Row


def tree_text(rows: Sequence[Row]) -> str:
    """A line for each row: what it is on the left, its path in a column on the right."""
    left = [f"{_stem(row)}{label(row)}" for row in rows]
    width = min(max(len(line) for line in left), 96)
    lines = [
        f"{line:<{width}}  {path_text(row.path, row.name)}"
        for line, row in zip(left, rows, strict=True)
    ]
    return "\n".join(lines) + "\n"


def heading(subject: str, seed: int, derivation: Derivation) -> str:
    """What was derived, and the attributes that it has."""
    values = ", ".join(f"{name} {shown(value)}" for name, value in derivation.attributes.items())
    prior = prior_text(derivation.log_prior)
    head = f"{subject}, seed {seed}: {len(derivation):,} shapes, {prior}\n"
    return head + (f"attributes: {values}\n" if values else "")


def label(row: Row) -> str:
    """A row in words: name, parameters, how many, size, class, choices, what is hidden."""
    given = f"({parameters_text(row)})" if row.parameters else ""
    words = [row.name + ("." if row.is_leaf else "") + given]
    if row.count > 1:
        words.append(f"×{row.count}")
    words.append(size_text(row))
    if row.surface_class:
        words.append(row.surface_class)
    words += [choice_text(choice) for choice in row.choices]
    if row.hidden:
        words.append(f"+{row.hidden} below")
    return "  ".join(word for word in words if word)


def parameters_text(row: Row) -> str:
    """What the rule was given: `i=2, n=5`."""
    return ", ".join(f"{name}={shown(value)}" for name, value in row.parameters.items())


def size_text(row: Row) -> str:
    """The size of the scope (m), without directions that have no extent."""
    sides = [f"{side:.2f}" for side in row.size_m if side > 1e-6]
    return " × ".join(sides) + " m" if sides else ""


def choice_text(choice: Choice) -> str:
    """`2 of 4 (30 %)`: the alternative that was taken, from 1, and its chance."""
    return f"[{choice.index + 1} of {choice.of}: {100 * choice.chance:.3g} %]"


def _stem(row: Row) -> str:
    if not row.last:
        return ""
    above = "".join("   " if last else "│  " for last in row.last[:-1])
    return above + ("└─ " if row.last[-1] else "├─ ")
