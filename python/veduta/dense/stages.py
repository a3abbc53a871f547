"""Depth maps of a run, each kept as soon as it is made: a killed run loses the one in hand."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import JsonValue

from veduta.dense.document import DepthMap
from veduta.run.work import Work

Arrays = dict[str, NDArray[Any]]
K = TypeVar("K")
V = TypeVar("V")


class OnDisk(Mapping[K, V]):
    """What lies on disk and is read anew each time, so that memory does not grow with how many
    there are: nothing stays longer than it is used.
    """

    def __init__(self, readers: Mapping[K, Callable[[], V]]) -> None:
        self._readers = readers

    def __getitem__(self, key: K) -> V:
        return self._readers[key]()

    def __iter__(self) -> Iterator[K]:
        return iter(self._readers)

    def __len__(self) -> int:
        return len(self._readers)


def kept_reader(
    work: Work, name: str, inputs: JsonValue, make: Callable[[], Arrays]
) -> Callable[[], Arrays]:
    """What reads arrays from disk; they are made now where they are not there."""
    work.kept(name, inputs, make, _save, _nothing)
    return lambda: work.kept_again(name, inputs, _mapped)


def _save(arrays: Arrays, folder: Path) -> None:
    for name, values in arrays.items():
        np.save(folder / f"{name}.npy", values, allow_pickle=False)


def _nothing(folder: Path) -> Arrays:
    return {}


def _mapped(folder: Path) -> Arrays:
    files: Sequence[Path] = sorted(folder.glob("*.npy"))
    return {one.stem: np.load(one, mmap_mode="r", allow_pickle=False) for one in files}


def depth_arrays(found: DepthMap) -> Arrays:
    """A depth map as arrays by name."""
    return {
        "depths_m": found.depths_m,
        "normals": found.normals,
        "confidence": found.confidence,
        "agree": found.agree,
    }


def depth_map_of(arrays: Arrays) -> DepthMap:
    """Back from arrays by name."""
    return DepthMap(**{name: np.asarray(values) for name, values in arrays.items()})


def told(parameters: Any) -> JsonValue:
    """A frozen parameter class as what a key is made of."""
    values: dict[str, JsonValue] = asdict(parameters)
    return values
