"""Which texts say that a room is here: its name or its size, a label each."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from veduta.plan.document import Text
from veduta.plan.names.vocabulary import meanings, names_open_air
from veduta.plan.scale.quantities import read_quantities

WINDOWS = 4
"""So many sizes without a name, all as high, beside as many names, are those of windows ..."""

WINDOW_HIGH_M = 2.0
"""... where they can be read as lower than this: bedrooms alike in a row are as deep as each other,
too, and deeper."""

WINDOWS_NOTE = (
    "{} sizes without a name that are all as high are taken for those of windows, not of rooms"
)

LINE_GAP = 1.2
"""Heights of text between two lines of one label."""

Label = list[tuple[NDArray[np.float64], Text]]
"""Texts with their boxes (4, 2)."""


def room_labels(texts: Sequence[Text], *, indoors: bool = False) -> list[NDArray[np.float64]]:
    """The middles (2,) of labels, in pixels of the texts; lines over each other are one label.

    `indoors`: without those that name a terrace or a balcony.
    """
    groups = _grouped(texts)
    windows = _windows(groups)
    kept = [
        group
        for group in groups
        if id(group) not in windows
        and not (indoors and any(names_open_air(text.text) for _, text in group))
    ]
    return [np.asarray(np.concatenate([box for box, _ in group]).mean(axis=0)) for group in kept]


def window_notes(texts: Sequence[Text]) -> list[str]:
    """What is said where sizes are taken for those of windows."""
    count = len(_windows(_grouped(texts)))
    return [WINDOWS_NOTE.format(count)] if count else []


def _grouped(texts: Sequence[Text]) -> list[Label]:
    """Texts that say a room, in labels: lines over each other are one."""
    said = [(np.array(one.box_px, dtype=float), one) for one in texts if _says_room(one)]
    groups: list[Label] = []
    for box, text in sorted(said, key=lambda one: float(one[0][:, 1].min())):
        home = next((group for group in groups if any(_one_label(box, x) for x, _ in group)), None)
        if home is None:
            groups.append([(box, text)])
        else:
            home.append((box, text))
    return groups


def without_printed(texts: Sequence[Text], within: NDArray[np.bool_] | None) -> list[Text]:
    """Texts without those that say a room in a letterhead: `Kitchen & Bath Ltd` is none.

    within: (h, w) in the pixels of the texts, where the letterhead is; None without one.
    """
    if within is None:
        return list(texts)
    return [one for one in texts if not (_says_room(one) and _lies_in(one, within))]


def _lies_in(text: Text, within: NDArray[np.bool_]) -> bool:
    column, row = np.mean(text.box_px, axis=0).astype(int)
    height, width = within.shape
    return bool(within[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)])


def _windows(groups: Sequence[Label]) -> set[int]:
    """The identities of labels that are sizes of windows: many without a name, all as high.

    Where most rooms have no name, such sizes are those of rooms.
    """
    bare = [group for group in groups if not any(meanings(text.text) for _, text in group)]
    if len(groups) - len(bare) < WINDOWS:
        return set()
    seconds = [_second_side(group[0][1].text) if len(group) == 1 else None for group in bare]
    often = Counter(one for one in seconds if one is not None)
    return {
        id(group)
        for group, second in zip(bare, seconds, strict=True)
        if second is not None and often[second] >= WINDOWS and _is_low(group[0][1].text)
    }


def _is_low(text: str) -> bool:
    """Whether a size can be read as one whose second side is no higher than a window."""
    sizes = [one for one in read_quantities(text) if one.kind == "size"]
    return any(one.values[1] <= WINDOW_HIGH_M for one in sizes)


def _second_side(text: str) -> str | None:
    """What stands behind the sign between two sides, as it is written."""
    parts = re.split(r"[x×X]", text.replace(" ", ""))
    return parts[1] if len(parts) == 2 and parts[1] else None


def _says_room(text: Text) -> bool:
    if any(one.kind in ("size", "area") for one in read_quantities(text.text)):
        return True
    return bool(meanings(text.text))


def _one_label(first: NDArray[np.float64], second: NDArray[np.float64]) -> bool:
    """Whether two upright boxes stand over each other, or touch side by side."""
    low, high = (
        np.maximum(first.min(axis=0), second.min(axis=0)),
        np.minimum(first.max(axis=0), second.max(axis=0)),
    )
    height = min(float(np.ptp(one[:, 1])) for one in (first, second))
    apart = low - high
    return bool(
        (apart[0] < 0 and apart[1] < LINE_GAP * height)
        or (apart[1] < -0.4 * height and apart[0] < LINE_GAP * height)
    )
