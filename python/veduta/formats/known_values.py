"""What is known of a part, as JSON, XML and tables can hold it: NaN is how people say "unknown"."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def plain(value: Any) -> Any:
    """A value in Python's own types; None where a number is none. Half characters become `?`."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value.encode("utf-8", "replace").decode() if isinstance(value, str) else value


def known(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """The attributes that say something, in Python's own types."""
    told = {name: plain(value) for name, value in attributes.items()}
    return {name: value for name, value in told.items() if value is not None}
