"""Results of steps on disk, so that a killed run goes on and memory holds one segment at a time.

Frozen dataclasses of arrays, numbers and documents are written as one file of arrays and one of the
rest, and read back by their types: nothing that a file says is run.
"""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from typing import Any, TypeVar, get_args, get_origin, get_type_hints

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, JsonValue

T = TypeVar("T")
_ARRAYS, _VALUES = "arrays.npz", "values.json"


def save_result(result: Any, folder: Path) -> None:
    """Write a frozen dataclass into a folder that exists."""
    arrays: dict[str, NDArray[Any]] = {}
    values = _taken(result, "", arrays)
    np.savez(folder / _ARRAYS, allow_pickle=False, **arrays)
    (folder / _VALUES).write_text(json.dumps(values), encoding="utf-8")


def load_result(kind: type[T], folder: Path) -> T:
    """What `save_result` wrote."""
    values = json.loads((folder / _VALUES).read_text(encoding="utf-8"))
    with np.load(folder / _ARRAYS, allow_pickle=False) as arrays:
        made: T = _made(kind, values, "", arrays)
    return made


def _taken(value: Any, name: str, arrays: dict[str, NDArray[Any]]) -> JsonValue:
    if isinstance(value, np.ndarray):
        arrays[name or "it"] = value
        return None
    if isinstance(value, BaseModel):
        told: JsonValue = json.loads(value.model_dump_json(by_alias=True))
        return told
    if dataclasses.is_dataclass(value):
        fields = [field.name for field in dataclasses.fields(value)]
        return {one: _taken(getattr(value, one), f"{name}/{one}", arrays) for one in fields}
    if isinstance(value, tuple | list):
        return [_taken(one, f"{name}/{row}", arrays) for row, one in enumerate(value)]
    if isinstance(value, bool | str) or value is None:
        return value
    return int(value) if isinstance(value, int | np.integer) else float(value)


def _made(kind: Any, value: Any, name: str, arrays: Any) -> Any:
    origin = get_origin(kind) or kind
    if origin is np.ndarray:
        return arrays[name or "it"]
    if isinstance(origin, type) and issubclass(origin, BaseModel):
        return origin.model_validate(value)
    if dataclasses.is_dataclass(origin):
        hints = get_type_hints(origin)
        return origin(**{
            field.name: _made(hints[field.name], value[field.name], f"{name}/{field.name}", arrays)
            for field in dataclasses.fields(origin)
        })  # type: ignore[operator]  # fmt: skip
    if origin in (tuple, list):
        inner = get_args(kind)[0] if get_args(kind) else Any
        return origin(_made(inner, one, f"{name}/{row}", arrays) for row, one in enumerate(value))
    return value
