"""A polygon as a file of lots has it, before it is known where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Attribute = bool | float | str


@dataclass(frozen=True)
class Outline:
    """A polygon as the file has it: rings of (n, 3) in the file's own frame."""

    subject: str
    name: str
    rings: list[NDArray[np.float64]]
    attributes: dict[str, Attribute]


def plain_attributes(properties: Any) -> dict[str, Attribute]:
    """The properties that a rule file can take: truth values, numbers, texts."""
    if not isinstance(properties, dict):
        return {}
    found: dict[str, Attribute] = {}
    for name, value in properties.items():
        if isinstance(value, bool | str):
            found[name] = value
        elif isinstance(value, int | float) and abs(value) < 1e300:
            found[name] = float(value)
    return found
