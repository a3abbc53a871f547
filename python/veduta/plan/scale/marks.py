"""Marks of doors and windows on plans in feet: `3068` is 3'0" wide and 6'8" high, not 3068 mm."""

from __future__ import annotations

import re
from collections.abc import Sequence

from veduta.plan.document import Text

_MARK = re.compile(r"^\W*[1-9](\d|1[01])[1-9](\d|1[01])\W*$")
_FEET = re.compile(r"\d\s*(['’‘′`´]|ft\b)", re.IGNORECASE)
_METRIC = re.compile(r"\d\s*[.,]\s*\d{1,2}(\D|$)|\d\s*[mc]?m\b", re.IGNORECASE)
_LEAST = 3
"""So many texts in feet make a sheet one in feet, if fewer than half as many are metric."""


def without_marks(texts: Sequence[Text]) -> list[Text]:
    """The texts that may say a size; a sheet in feet has no whole numbers in millimetres."""
    feet = [one for one in texts if _FEET.search(one.text)]
    metric = [one for one in texts if _METRIC.search(one.text) and not _FEET.search(one.text)]
    if len(feet) < _LEAST or 2 * len(metric) >= len(feet):
        return list(texts)
    return [one for one in texts if not _MARK.match(one.text)]
