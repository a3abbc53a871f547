"""Pictures of labels that lie between the photos of a folder, as in sets for teaching a machine."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

from veduta.imaging.read import has_few_colours

MOST_COLOURS = 64
"""The labels of ECP and CMP have 3 to 12; photos have 13,000 and more, 196 shades as grey ones."""

_SHOWN = 3


def set_labels_apart(files: Sequence[Path]) -> tuple[list[Path], list[Path]]:
    """The photos, and the label pictures that have the name of one but for the suffix.

    Where no photo or several stay, all do: which of them is meant is for the user to say.
    """
    named: defaultdict[str, list[Path]] = defaultdict(list)
    for file in files:
        named[file.stem].append(file)
    apart: set[Path] = set()
    for same in named.values():
        labels = [file for file in same if has_few_colours(file, MOST_COLOURS)] if same[1:] else []
        if len(same) - len(labels) == 1:
            apart.update(labels)
    return [file for file in files if file not in apart], [file for file in files if file in apart]


def labels_note(left_out: Sequence[Path], *, whole: bool) -> str:
    """What was left out, in a line; `whole`: with every name."""
    shown = left_out if whole else left_out[:_SHOWN]
    more = len(left_out) - len(shown)
    names = ", ".join(file.name for file in shown) + (f" and {more} more" if more else "")
    if len(left_out) == 1:
        return f"left out as a picture of labels, beside the photo of the same name: {names}"
    return f"left out as pictures of labels, beside the photos of the same names: {names}"
