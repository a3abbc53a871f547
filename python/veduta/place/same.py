"""Whether two things of a place say the same: arrays, records and all that they are made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
from pydantic import BaseModel


def same(one: Any, two: Any) -> bool:
    """Equal in every field and number; NaN is equal to NaN, a list to a tuple of the same."""
    if one is two:
        return True
    if isinstance(one, np.ndarray):
        floats = one.dtype.kind == "f"
        return isinstance(two, np.ndarray) and np.array_equal(one, two, equal_nan=floats)
    if isinstance(one, list | tuple):
        return (
            isinstance(two, list | tuple)
            and len(one) == len(two)
            and all(same(*pair) for pair in zip(one, two, strict=True))
        )
    if isinstance(one, Mapping):
        return (
            isinstance(two, Mapping)
            and one.keys() == two.keys()
            and all(same(one[key], two[key]) for key in one)
        )
    if isinstance(one, BaseModel):
        names = list(type(one).model_fields)
    elif is_dataclass(one):
        names = [field.name for field in fields(one)]
    else:
        return bool(one == two) or bool(one != one and two != two)
    return type(one) is type(two) and all(same(getattr(one, n), getattr(two, n)) for n in names)
