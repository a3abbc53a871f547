"""Folders for results that nobody has named: they are there as long as what was read from them."""

from __future__ import annotations

import tempfile
import weakref
from pathlib import Path
from typing import Protocol


def scratch_folder() -> tuple[Path, tempfile.TemporaryDirectory[str]]:
    """A new folder to be OUT, and what it goes with."""
    above = tempfile.TemporaryDirectory(prefix="veduta-")
    return Path(above.name) / "out", above


class Holder(Protocol):
    """What hands on to all that still read from a folder that the folder is needed."""

    def hold(self, what: object) -> None:
        """Keep it alive as long as anything is still read."""


class _Use:
    """Somebody may still read from the folder."""


def goes_with(owner: Holder, folder: tempfile.TemporaryDirectory[str]) -> None:
    """Have a folder deleted when nobody can read from it any more."""
    use = _Use()
    weakref.finalize(use, folder.cleanup)
    owner.hold(use)
