"""What views show of faces, lot by lot on the disk: one lot at a time is in memory."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from veduta.photos.texture.cells import Sights

_COLUMNS = ("colour", "seen", "density", "margin")


class Spool:
    """Lots of `Sights`, in files that go when the spool is closed."""

    def __init__(self) -> None:
        self._folder = TemporaryDirectory(prefix="veduta-texture-")
        self._outlines: dict[int, list[Sights]] = {}
        self._last: tuple[int, list[Sights]] | None = None

    def put(self, lot: int, sights: Sequence[Sights]) -> None:
        """Keep a lot, instead of what was kept under its number."""
        columns = {
            f"{name}{row}": getattr(one, name)
            for row, one in enumerate(sights)
            for name in _COLUMNS
        }
        np.savez(self._file(lot), **columns)
        self._outlines[lot] = [_without_columns(one) for one in sights]
        self._last = (lot, list(sights))

    def get(self, lot: int) -> list[Sights]:
        """The lot as it was kept."""
        if self._last is None or self._last[0] != lot:
            self._last = None
            self._last = (lot, self._read(lot))
        return self._last[1]

    def close(self) -> None:
        """Take the files away."""
        self._last = None
        self._folder.cleanup()

    def _file(self, lot: int) -> Path:
        return Path(self._folder.name) / f"{lot}.npz"

    def _read(self, lot: int) -> list[Sights]:
        with np.load(self._file(lot), allow_pickle=False) as file:
            return [
                replace(one, **{name: file[f"{name}{row}"] for name in _COLUMNS})
                for row, one in enumerate(self._outlines[lot])
            ]


def _without_columns(sights: Sights) -> Sights:
    none = np.zeros((0, 0, 0))
    return replace(
        sights,
        colour=none.astype(np.uint8),
        seen=none.astype(np.bool_),
        density=none.astype(np.float32),
        margin=none.astype(np.float32),
    )
